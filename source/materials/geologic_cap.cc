#include <arenite/materials/geologic_cap.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
std::string GeologicCapSurface::finalize()
{
  const std::string rule = finalize_failure();
  smallest_position      = axis_ratio * F0;
  return rule;
}

double GeologicCapSurface::junction(const double X) const
{
  // X(kappa) increases with a slope above one
  double high = X;
  while (cap(high).X < X)
    high += std::abs(X) + smallest_position;
  double low = high;
  while (cap(low).X > X)
    low -= std::abs(X) + smallest_position;
  Bracket<double> bracket{low, high, 1e-16 * smallest_position, 4e-16};
  Iterations      iterations;
  const auto      excess = [&](const double &kappa) {
    const auto c = cap(kappa);
    return ValueAndSlope<double>{c.X - X, c.dX};
  };
  return root_in_bracket<double>(excess, bracket, high, true, iterations);
}

void GeologicCap::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  constants.declare_parameters(parameters);
  surface.declare_cap(parameters, non_negative, "k = W (1 - exp(-D (X - X0)))");
  surface.declare_hardening_limit(parameters);
  parameters.add_quantity("Tension cutoff T", tension_cutoff, "Pa", non_negative,
                          "Tensile strength on the I1 axis: three times the mean tensile stress. Larger: later spall.");
  parameters.add_choice("Type", type, {"soil", "rock"},
                        "The cap of a soil contracts when it dilates, that of a rock never.");
}

void GeologicCap::finalize(const Parameters &parameters)
{
  elastic = constants.finalize(parameters);
  if (const std::string problem = surface.finalize(); !problem.empty())
    parameters.refuse(path, problem);
  if (!(surface.failure(-tension_cutoff).value >= 0.))
    {
      std::ostringstream problem;
      problem << "must not lie beyond the apex of the failure surface, T = " << surface.F0 / surface.F0_slope << " Pa";
      parameters.refuse(path + "/Tension cutoff T", problem.str());
    }
  derive();
}

void GeologicCap::derive() { smallest_kappa = surface.junction(surface.initial_position); }

static_assert(IsMaterialLaw<GeologicCap>::value);
static_assert(IsMaterialLaw<GeologicCap, Lanes<native_lanes>>::value);
} // namespace Arenite
