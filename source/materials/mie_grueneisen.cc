#include <arenite/materials/mie_grueneisen.h>

#include <algorithm>
#include <sstream>

namespace Arenite
{
void MieGrueneisen::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity("Density", density, "kg/m^3", positive, "rho_0 at rest.");
  parameters.add_quantity("Sound speed", sound_speed, "m/s", positive,
                          "c_0, speed of the weakest shock. Water 1480, quartz 3700.");
  parameters.add_quantity("Hugoniot slope", slope, "-", {0., 10., false, false},
                          "s in U_s = c_0 + s u_p. Stiffens strong shocks; no state is denser than rho_0/(1 - 1/s).");
  parameters.add_quantity("Grueneisen parameter", gamma, "-", {0., 10., false, false},
                          "Gamma_0. Raises the pressure of what shocks have heated.");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the material parts and a gap opens. The default sets no limit.");
  parameters.add_quantity("Largest pressure", largest_pressure, "Pa", positive,
                          "End of the valid range; a larger one asks for a smaller time step.");
}

void MieGrueneisen::finalize(const Parameters &parameters)
{
  const std::string reason = prepare();
  if (!reason.empty())
    parameters.refuse(path, reason);
}

std::string MieGrueneisen::prepare()
{
  // p = rho_0 (c_0 + s u) u at the largest pressure
  const double u =
    slope > 0.
      ? (std::sqrt(sound_speed * sound_speed + 4. * slope * largest_pressure / density) - sound_speed) / (2. * slope)
      : largest_pressure / (density * sound_speed);
  const double chi = u / (sound_speed + slope * u);
  if (!(chi < largest_chi() && chi < 1.))
    {
      std::ostringstream reason;
      reason << "a shock of the largest pressure " << largest_pressure
             << " Pa compresses by chi = 1 - rho_0/rho = " << chi << ", beyond 0.95/s = " << largest_chi()
             << ". Lower 'Largest pressure' [Pa] to the range of the Hugoniot.";
      return reason.str();
    }
  // c on the Hugoniot rises with compression unless Gamma_0 is large: take the largest on the way
  speed_bound = sound_speed;
  for (int i = 0; i <= 200; ++i)
    {
      const double rho = density / (1. - chi * i / 200.), p = hugoniot_pressure(rho);
      speed_bound = std::max(speed_bound, std::sqrt(modulus<double>(rho, cold<double>(rho).slope, p) / rho));
    }
  // in cold tension c grows as rho_0/rho down to the limit, or to 10 % if there is none
  const double expansion = 1. + std::min(.1, tension_limit / (density * sound_speed * sound_speed));
  speed_bound            = std::max(speed_bound, sound_speed * expansion * std::sqrt(1. + gamma * (expansion - 1.)));
  return "";
}
} // namespace Arenite
