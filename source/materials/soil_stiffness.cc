#include <arenite/materials/soil_stiffness.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
void SoilStiffness::declare_parameters(Parameters &parameters)
{
  soil.declare_parameters(parameters);
  parameters.add_quantity("Poisson ratio", poisson_ratio, "-", {-1., 0.5, true, true},
                          "Of the skeleton at rest. Larger: less shear stiffness.");
  parameters.add_choice("Shear stiffness", shear_rule, {"auto", "constant Poisson ratio", "constant"},
                        "Whether G grows with K; 'auto': it does, except in a saturated soil.");
}

void SoilStiffness::finalize(const Parameters &parameters)
{
  soil.finalize(parameters);
  shear_ratio    = 1.5 * (1. - 2. * poisson_ratio) / (1. + poisson_ratio);
  shear_modulus  = shear_ratio * soil.bulk_modulus;
  constant_shear = shear_rule == "constant" || (shear_rule == "auto" && !soil.porous());
}

std::string SoilStiffness::adopt_hardening_limit(double &W, const bool is_set)
{
  if (!soil.porous())
    return "a saturated soil has no air whose closing the cap could describe; choose the law 'undrained cap'";
  const double locking = std::log(soil.compacted_density / soil.density);
  if (!is_set)
    W = locking;
  if (W > locking * (1. + 1e-3)) // a limit that was typed with three digits
    {
      std::ostringstream problem;
      problem << "Hardening limit W = " << W << " is more than the air of the soil, a volume strain of " << locking
              << ": leave W out, or correct the densities";
      return problem.str();
    }
  soil.compacted_density = std::min(soil.compacted_density, soil.density * std::exp(W));
  return soil.prepare();
}

double SoilStiffness::wave_speed_bound() const
{
  const double c = soil.bulk_sound_speed_bound();
  return constant_shear ? std::sqrt(c * c + 4. / 3. * shear_modulus / soil.reference_density())
                        : c * std::sqrt(1. + 4. / 3. * shear_ratio);
}
} // namespace Arenite
