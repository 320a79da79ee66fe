#include <arenite/materials/three_phase_mixture.h>

#include <algorithm>
#include <sstream>

namespace Arenite
{
void ThreePhaseMixture::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  soil.declare_parameters(parameters);
  declare_phases(parameters);
  parameters.add_quantity(
    "Tension limit", tension_limit, "Pa", non_negative,
    "T below the air pressure at rest, where a gap opens that must close before pressure returns.");
}

void ThreePhaseMixture::declare_phases(Parameters &parameters)
{
  const Range above_one{1., 20., true, false};
  parameters.add_quantity("Exponent of air", exponent[0], "-", above_one,
                          "g of p V^g = const; 1.4 without exchange of heat.");
  parameters.add_quantity("Exponent of water", exponent[1], "-", above_one,
                          "g of water, 7 (some authors 3). Stiffens above 0.1 GPa.");
  parameters.add_quantity("Exponent of grains", exponent[2], "-", above_one,
                          "g of the grains, 3 to 5. Stiffens above 1 GPa.");
  parameters.add_quantity("Largest pressure", largest_pressure, "Pa", positive,
                          "End of the valid range; a larger one asks for a smaller time step.");
}

void ThreePhaseMixture::finalize(const Parameters &parameters)
{
  set(soil.finalize(parameters));
  const std::string reason = prepare();
  if (!reason.empty())
    parameters.refuse(path, reason);
}

void ThreePhaseMixture::set(const SoilState &state)
{
  density       = state.density();
  fraction[0]   = std::max(0., state.air_fraction());
  fraction[1]   = state.water_fraction();
  fraction[2]   = 1. - fraction[0] - fraction[1];
  air_pressure  = state.air_pressure;
  modulus_of[0] = exponent[0] * air_pressure;
  modulus_of[1] = state.water_modulus;
  modulus_of[2] = state.grain_modulus;
}

std::string ThreePhaseMixture::prepare()
{
  std::ostringstream reason;
  if (std::abs(fraction[0] + fraction[1] + fraction[2] - 1.) > 1e-9)
    reason << "the fractions of air, water and grains, " << fraction[0] << ", " << fraction[1] << ", " << fraction[2]
           << ", must add up to 1.";
  else if (fraction[0] > 0. && tension_limit > .99 * air_pressure)
    reason << "the tension limit " << tension_limit << " Pa exceeds 0.99 of the air pressure " << air_pressure
           << " Pa: the air in the pores cannot have a negative pressure. Lower 'Tension limit' [Pa], or set the "
              "saturation to 1.";
  else
    for (int i = 0; i < 3; ++i)
      if (fraction[i] > 0. && exponent[i] * tension_limit > .5 * modulus_of[i])
        reason << "the tension limit " << tension_limit << " Pa is out of proportion to the modulus of a phase, "
               << modulus_of[i] << " Pa. ";
  if (!reason.str().empty())
    return reason.str();

  log_shift            = fraction[0] > 0. ? air_pressure : 2. * tension_limit + air_pressure;
  const auto at_limit  = volume<double>(-tension_limit);
  volume_at_limit      = at_limit.volume;
  limit_speed          = std::sqrt(at_limit.volume * at_limit.volume / (at_limit.compliance * density));
  const auto compacted = volume<double>(largest_pressure); // c rises with pressure
  speed_bound =
    std::max(limit_speed, std::sqrt(compacted.volume * compacted.volume / (compacted.compliance * density)));
  return "";
}
} // namespace Arenite
