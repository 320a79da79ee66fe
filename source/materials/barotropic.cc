#include <arenite/materials/barotropic.h>

#include <sstream>

namespace Arenite
{
ShockState shock_state(const double reference_density, const double density, const double pressure)
{
  const double chi = 1. - reference_density / density;
  return {std::sqrt(pressure / (reference_density * chi)), std::sqrt(pressure * chi / reference_density),
          pressure * chi / (2. * reference_density)};
}

void LinearCompression::declare_parameters(Parameters &parameters)
{
  parameters.add_quantity("Density", density, "kg/m^3", positive, "rho_0 at rest. Slows waves down.");
  parameters.add_quantity("Bulk modulus", bulk_modulus, "Pa", positive, "K. Constant; soils 1e7 to 1e10.");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the material parts and a gap opens. The default sets no limit.");
}

void PolynomialCompression::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity("Density", density, "kg/m^3", positive, "rho_0 at rest. Slows waves down.");
  parameters.add_quantity("K1", K1, "Pa", positive, "Bulk modulus at rest.");
  parameters.add_quantity("K2", K2, "Pa", any_value, "Stiffens the compressed material with mu^2.");
  parameters.add_quantity("K3", K3, "Pa", any_value, "Stiffens the compressed material with mu^3.");
  parameters.add_quantity("Bulk modulus in tension", tension_modulus, "Pa", non_negative,
                          "p = K_t mu for mu < 0. 0 stands for K1.");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the material parts and a gap opens. The default sets no limit.");
  parameters.add_quantity("Largest pressure", largest_pressure, "Pa", positive,
                          "End of the valid range; a larger one asks for a smaller time step.");
}

void PolynomialCompression::finalize(const Parameters &parameters)
{
  // walk up the curve to the largest pressure: it must rise all the way; the fastest wave on the way bounds the step
  const double K_t = tension_modulus > 0. ? tension_modulus : K1;
  speed_bound      = std::sqrt(std::max(K1, K_t) / density);
  speed_bound = std::max(speed_bound, std::sqrt(K_t / density)); // rho c^2 = K_t rho/rho_0 in tension: c is constant
  for (double mu = 0.;; mu += 1e-3)
    {
      const double slope = K1 + mu * (2. * K2 + 3. * mu * K3);
      if (!(slope > 0.) || mu > 10.)
        {
          std::ostringstream reason;
          reason << "the polynomial stops rising at mu = " << mu
                 << " with p = " << hugoniot_pressure(density * (1. + mu)) << " Pa, below the largest pressure "
                 << largest_pressure
                 << " Pa. Correct K2 and K3, or lower 'Largest pressure' [Pa] to what the fit covers.";
          parameters.refuse(path, reason.str());
        }
      speed_bound = std::max(speed_bound, std::sqrt(slope / density));
      if (hugoniot_pressure(density * (1. + mu)) >= largest_pressure)
        break;
    }
}
} // namespace Arenite
