#include <arenite/materials/cap_surface.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
std::string CapSurface::finalize()
{
  if (const std::string rule = finalize_failure(); !rule.empty())
    return rule;
  std::ostringstream problem;
  if (!(F0_slope > 0.))
    return "failure surface: beta gamma + theta must be positive";
  const double largest_tension = F0 / (2. * F0_slope);
  if (!(tension_limit > 0. && tension_limit < largest_tension))
    {
      problem << "tension limit T = " << tension_limit
              << " Pa must satisfy 0 < T < (alpha - gamma)/(2 (beta gamma + theta)) = " << largest_tension << " Pa";
      return problem.str();
    }

  // the ellipse through (-T, 0) that meets (0, F0) with the slope of the failure surface
  const double T = tension_limit, n = F0 - 2. * F0_slope * T;
  tension_center = F0_slope * T * T / n;
  tension_axis   = std::sqrt(F0) * (F0 - F0_slope * T) / std::sqrt(n);
  tension_ratio  = T / std::sqrt(F0 * n);

  const double h              = axis_ratio * F0_slope;
  smallest_position           = axis_ratio * F0 * (h + std::sqrt(1. + h * h));
  per_F0                      = 1. / F0;
  first_ratio                 = smallest_position / F0;
  const double smallest_slope = axis_ratio * (friction_range > 0. ? 0. : theta);
  inner_ratio                 = axis_ratio * (smallest_slope + std::sqrt(1. + smallest_slope * smallest_slope));
  // junction L unique: dX/dL > 0; thirty decay lengths from 0 the exponential is gone
  for (const double decay_length : {beta > 0. ? 1. / beta : 0., friction_range})
    for (unsigned int i = 0; i <= 3000; ++i)
      {
        const double L = i * 0.01 * decay_length;
        const auto   F = failure(L);
        if (!(1. + axis_ratio * axis_ratio * (F.slope * F.slope + F.value * F.curvature) > 0.))
          {
            problem << "the junction of cap and failure surface is not unique near L = " << L
                    << " Pa: reduce the cap axis ratio R, beta or gamma";
            return problem.str();
          }
      }
  if (initial_position < smallest_position && !small_cap_rule)
    {
      problem << "initial cap position X0 = " << initial_position << " Pa is below X_min = " << smallest_position
              << " Pa: the cap would start inside of the tension cut-off; raise X0 or set 'Small cap rule = true'";
      return problem.str();
    }
  return "";
}

double CapSurface::junction(const double X) const
{
  if (X <= smallest_position)
    return X - smallest_position;
  Iterations iterations;
  return junction<double>(X, 0., X, iterations);
}
} // namespace Arenite
