#include <arenite/base/main_frequency.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <limits>
#include <vector>

namespace Arenite
{
double main_frequency(const TimeHistory &history, const double end)
{
  if (history.regularity() < 1)
    return std::numeric_limits<double>::infinity();
  std::vector<double> times = {0.};
  for (const double time : history.break_points())
    if (time > 0. && time < end)
      times.push_back(time);
  times.push_back(end);
  constexpr unsigned int n     = 5000;
  double                 rates = 0., accelerations = 0.; // integrals of p'^2, p''^2
  for (std::size_t piece = 0; piece + 1 < times.size(); ++piece)
    {
      const double dt     = (times[piece + 1] - times[piece]) / n;
      double       before = history.value(times[piece]), here = history.value(times[piece] + dt);
      for (unsigned int k = 2; k <= n; ++k)
        {
          const double next   = history.value(times[piece] + k * dt);
          const double weight = k == 2 || k == n ? 1.5 * dt : dt; // differences do not cross the ends of a piece
          rates += weight * std::pow((next - before) / (2. * dt), 2);
          accelerations += weight * std::pow((next - 2. * here + before) / (dt * dt), 2);
          before = here;
          here   = next;
        }
    }
  return rates > 0. ? std::sqrt(accelerations / rates) / (2. * dealii::numbers::PI) : 0.;
}
} // namespace Arenite
