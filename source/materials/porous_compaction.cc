#include <arenite/materials/porous_compaction.h>

#include <algorithm>
#include <sstream>

namespace Arenite
{
void PorousCompaction::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity("Density", density, "kg/m^3", positive, "rho_0 of the porous soil at rest.");
  parameters.add_quantity("Elastic sound speed", elastic_speed, "m/s", positive,
                          "c_e, bulk sound speed of the porous soil at rest. Stiffens unloading while pores are open.");
  parameters.add_quantity("Crush onset", crush_onset, "Pa", positive,
                          "p_e where pores begin to collapse; sands 1e5 to 1e7.");
  parameters.add_quantity("Crush end", crush_end, "Pa", positive, "p_c where all pores are closed; sands 5e8 to 3e9.");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the soil parts and a gap opens that must close before pressure returns.");
  const auto section = parameters.section("Solid");
  solid.declare_parameters(parameters);
}

void PorousCompaction::finalize(const Parameters &parameters)
{
  solid.finalize(parameters);
  const std::string reason = prepare();
  if (!reason.empty())
    parameters.refuse(path, reason);
}

std::string PorousCompaction::prepare()
{
  std::ostringstream reason;
  const std::string  of_solid = solid.prepare();
  if (!of_solid.empty())
    return of_solid;
  if (!(density < solid.density))
    reason << "the density of the soil, " << density << " kg/m^3, must be below that of its solid, " << solid.density
           << ".";
  else if (!(crush_onset < crush_end))
    reason << "crushing begins at " << crush_onset << " Pa and must end above, not at " << crush_end << " Pa.";
  else if (!(elastic_speed < solid.sound_speed))
    reason << "the sound speed of the porous soil, " << elastic_speed << " m/s, must be below that of its solid, "
           << solid.sound_speed << ".";
  if (!reason.str().empty())
    return reason.str();

  // alpha_e = alpha_0 + p_e a(alpha_e); h = c_e/c_0 there
  const double alpha_0 = solid.density / density, K_s = solid.density * solid.sound_speed * solid.sound_speed;
  const double a_over_square = (1. - std::pow(solid.sound_speed / elastic_speed, 2)) / K_s;
  elastic_limit              = alpha_0;
  for (int i = 0; i < 100; ++i)
    elastic_limit = alpha_0 + crush_onset * a_over_square * elastic_limit * elastic_limit;
  if (!(elastic_limit > 1.))
    {
      reason << "the soil is compressed to its solid before it crushes: the elastic sound speed " << elastic_speed
             << " m/s is too low for a crush onset of " << crush_onset << " Pa.";
      return reason.str();
    }

  // the crush curve must be softer than the elastic range at every distension: |d alpha_c/dp| >= |a(alpha)|
  for (int i = 1; i <= 100; ++i)
    {
      const double alpha = 1. + (elastic_limit - 1.) * i / 100., span = crush_end - crush_onset;
      const double crush = 2. * (elastic_limit - 1.) * (crush_end - crush_pressure<double>(alpha)) / (span * span);
      if (crush < -elastic_slope<double>(alpha))
        {
          reason << "crushing is stiffer than the elastic range at the distension " << alpha
                 << ": -d alpha/dp = " << crush << " against " << -elastic_slope<double>(alpha)
                 << " 1/Pa. A cycle would create energy. Raise the elastic sound speed, " << elastic_speed
                 << " m/s, or lower the crush end, " << crush_end << " Pa.";
          return reason.str();
        }
    }

  // rho c^2 of the solid bounds that of the porous soil, hot shocked states are checked along the Hugoniot
  speed_bound = solid.bulk_sound_speed_bound();
  for (double rho = density; rho < 3. * solid.density; rho *= 1.002)
    {
      History<double> history  = initial_history();
      const auto      response = update(VolumeChange<double>{density, rho, 0., 0.}, history);
      if (!(response.pressure < solid.largest_pressure))
        break;
      speed_bound = std::max(speed_bound, std::sqrt(response.bulk_modulus / rho));
    }
  return "";
}
} // namespace Arenite
