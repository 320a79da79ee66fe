#include <arenite/materials/tabulated_compaction.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
void TabulatedCompaction::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_points<2>("Compaction curve", loading, "",
                           "Rows density [kg/m^3], pressure [Pa] of first loading; the first row is the soil at rest.");
  parameters.require("Compaction curve");
  parameters.add_points<2>("Unloading speed", unloading, "",
                           "Rows density [kg/m^3], bulk sound speed [m/s] of unloading and reloading.");
  parameters.require("Unloading speed");
  parameters.add_quantity("Tension limit", tension_limit, "Pa", non_negative,
                          "T: below p = -T the soil parts and a gap opens that must close before pressure returns.");
}

void TabulatedCompaction::finalize(const Parameters &parameters)
{
  const std::string reason = prepare();
  if (!reason.empty())
    parameters.refuse(path, reason);
}

std::string TabulatedCompaction::prepare()
{
  std::ostringstream reason;
  if (loading.size() < 2 || unloading.empty())
    return "needs at least two rows of 'Compaction curve' and one of 'Unloading speed'.";
  if (loading.front()[1] != 0. || !(loading.front()[0] > 0.))
    {
      reason << "the first row of 'Compaction curve' is the soil at rest: a positive density and the pressure 0, not "
             << loading.front()[0] << ", " << loading.front()[1] << ".";
      return reason.str();
    }
  for (std::size_t i = 1; i < loading.size(); ++i)
    if (!(loading[i][0] > loading[i - 1][0] && loading[i][1] > loading[i - 1][1]))
      {
        reason << "'Compaction curve' must increase in density and pressure; the row " << loading[i][0] << ", "
               << loading[i][1] << " follows " << loading[i - 1][0] << ", " << loading[i - 1][1] << ".";
        return reason.str();
      }
  for (std::size_t j = 0; j < unloading.size(); ++j)
    if (!(unloading[j][1] > 0.) || (j > 0 && !(unloading[j][0] > unloading[j - 1][0])))
      {
        reason << "'Unloading speed' needs positive speeds at increasing densities; see the row " << unloading[j][0]
               << ", " << unloading[j][1] << ".";
        return reason.str();
      }

  segments.clear();
  for (std::size_t i = 0; i + 1 < loading.size(); ++i)
    segments.push_back(
      {loading[i][0], loading[i][1], (loading[i + 1][1] - loading[i][1]) / (loading[i + 1][0] - loading[i][0]), 0.});
  speeds.clear();
  double integral = 0.;
  speed_bound     = 0.;
  for (std::size_t j = 0; j < unloading.size(); ++j)
    {
      const bool   last  = j + 1 == unloading.size();
      const double width = last ? 0. : unloading[j + 1][0] - unloading[j][0], c = unloading[j][1];
      const double slope = last ? 0. : (unloading[j + 1][1] - c) / width;
      speeds.push_back({unloading[j][0], c, slope, integral});
      integral += width * (c * c + width * (c * slope + width * slope * slope / 3.));
      speed_bound = std::max(speed_bound, c);
    }

  // c is linear between the breaks of both tables: the smallest is at one of them
  std::vector<double> breaks;
  for (const auto &row : loading)
    breaks.push_back(row[0]);
  for (const auto &row : unloading)
    breaks.push_back(row[0]);
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const double rho : breaks)
      {
        const double c = sound_speed<double>(rho);
        if (rho >= loading[i][0] && rho <= loading[i + 1][0] && c * c < segments[i].slope)
          {
            reason << "unloading is softer than loading at the density " << rho << " kg/m^3: c = " << c
                   << " m/s gives c^2 = " << c * c << " m^2/s^2, the curve rises with " << segments[i].slope
                   << ". A cycle of loading and unloading would create energy.";
            return reason.str();
          }
      }
  return "";
}
} // namespace Arenite
