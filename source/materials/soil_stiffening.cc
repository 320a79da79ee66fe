#include <arenite/materials/soil_stiffening.h>

#include <sstream>

namespace Arenite
{
void SoilStiffening::declare_parameters(Parameters &parameters)
{
  path                         = parameters.current_path();
  const std::string from_state = " Without it from the soil state.";
  parameters.add_quantity("Density", density, "kg/m^3", non_negative, "rho_0 at rest." + from_state);
  parameters.leave_out_if_unset("Density");
  parameters.add_quantity("Density without air", compacted_density, "kg/m^3", non_negative,
                          "rho_L, where all air is closed. Delays the stiffening." + from_state);
  parameters.leave_out_if_unset("Density without air");
  parameters.add_quantity("Bulk modulus", bulk_modulus, "Pa", positive, "K_0 of the loose skeleton at rest.");
  parameters.add_quantity("Bulk modulus without air", compacted_modulus, "Pa", non_negative,
                          "K_wg of grains and water, reached at rho_L." + from_state);
  parameters.leave_out_if_unset("Bulk modulus without air");
  parameters.add_integer("Stiffening exponent", exponent, 1, 4,
                         "m. A larger one keeps the soil soft for longer and lets it stiffen more suddenly.");
  parameters.add_quantity("Stiffening without air", compacted_stiffening, "-", {1., 20., false, false},
                          "K' = dK/dp of grains and water, 4 to 7. Limits the density at high pressure.");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the soil parts and a gap opens that must close before pressure returns.");
  parameters.add_quantity("Largest pressure", largest_pressure, "Pa", positive,
                          "End of the valid range; a larger one asks for a smaller time step.");
  soil.declare_parameters(parameters);
}

void SoilStiffening::finalize(const Parameters &parameters)
{
  if (soil.is_set(parameters))
    {
      state           = soil.finalize(parameters);
      density         = soil.density_of_block(parameters, density);
      const auto take = [&](const char *entry, double &value, const double derived) {
        if (!parameters.is_set(path + "/" + entry))
          value = derived;
      };
      take("Density without air", compacted_density, state->compacted_density());
      take("Bulk modulus without air", compacted_modulus, state->compacted_modulus());
    }
  const std::string reason = prepare();
  if (!reason.empty())
    parameters.refuse(path, reason);
}

std::string SoilStiffening::prepare()
{
  std::ostringstream reason;
  if (!(density > 0. && compacted_density > 0. && compacted_modulus > 0.))
    reason << "needs the density, the density without air and the bulk modulus without air: set them, or describe the "
              "soil in "
              "'subsection Soil state'.";
  else if (compacted_density < density * (1. - 1e-9))
    reason << "the density without air, " << compacted_density << " kg/m^3, is below the density at rest, " << density
           << ".";
  else if (bulk_modulus > compacted_modulus)
    reason << "the bulk modulus at rest, " << bulk_modulus << " Pa, exceeds that without air, " << compacted_modulus
           << " Pa: the soil would soften under compression.";
  if (!reason.str().empty())
    return reason.str();
  if (compacted_density < density * (1. + 1e-9))
    compacted_density = density;

  // the density at the largest pressure: bisection on the rising curve
  double lower = density, upper = compacted_density;
  while (first_loading<double>(upper) < largest_pressure && upper < 100. * compacted_density)
    upper *= 1.1;
  for (int i = 0; i < 60; ++i)
    (first_loading<double>(.5 * (lower + upper)) < largest_pressure ? lower : upper) = .5 * (lower + upper);
  // c^2 = K/rho is largest at the end of the branch of largest K, in tension: rho_z exp(-T/K)
  speed_bound = 0.;
  for (int i = 0; i <= 1000; ++i)
    {
      const double rho_m = density + i / 1000. * (upper - density);
      const double K     = modulus<double>(rho_m);
      speed_bound =
        std::max(speed_bound, std::sqrt(K / (rho_m * std::exp(-(first_loading<double>(rho_m) + tension_limit) / K))));
    }
  return "";
}
} // namespace Arenite
