#include <arenite/materials/elasticity_at_rest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Arenite
{
LinearElastic elasticity_at_rest(const BatchLaw &law)
{
  const int                 n     = law.n_lanes();
  const std::vector<double> start = law.initial_history();
  std::vector<double>       stress(6 * n, 0.), history(start.size() * n), strain(6 * n), density_old(n),
    density(n, law.density()), speed(n), stored(n), dissipated(n);
  for (std::size_t k = 0; k < start.size(); ++k)
    std::fill_n(&history[k * n], n, start[k]);

  PointBatch batch;
  batch.n_points            = 1;
  batch.dt                  = std::numeric_limits<double>::min(); // no time to flow
  batch.strain              = strain.data();
  batch.density_old         = density_old.data();
  batch.density             = density.data();
  batch.stress              = stress.data();
  batch.history             = history.data();
  batch.wave_speed          = speed.data();
  batch.stored              = stored.data();
  batch.dissipated          = dissipated.data();
  const auto pressure_after = [&](const double volume_strain) {
    density_old = density;
    std::fill(density.begin(), density.end(), density.front() * std::exp(-volume_strain));
    std::fill(strain.begin(), strain.begin() + 3 * n, volume_strain / 3.);
    law.update(batch);
    return -(stress[0] + stress[n] + stress[2 * n]) / 3.;
  };

  constexpr double e = 1e-7;
  pressure_after(0.);
  LinearElastic result;
  result.density      = law.density();
  const double M      = result.density * speed[0] * speed[0];
  const double loaded = pressure_after(-e), unloaded = pressure_after(0.5 * e);
  result.bulk_modulus  = std::min(M, (loaded - unloaded) / (0.5 * e));
  result.shear_modulus = 0.75 * (M - result.bulk_modulus);
  if (result.shear_modulus < 1e-5 * M) // round-off of the difference, and the curvature of p(rho)
    {
      result.shear_modulus = 0.;
      result.bulk_modulus  = M;
    }
  return result;
}
} // namespace Arenite
