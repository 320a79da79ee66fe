#include <arenite/materials/cap_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

double CapSurface::position_through(const double I1, const double j) const
{
  if (I1 <= 0.) // tension: no cap holds it
    return initial_position;
  if (j >= failure(I1).value)
    return std::max(I1, initial_position);
  const auto inside = [&](const double X) { return -yield_function<double>(I1, j, cap(junction(X))); };
  if (inside(initial_position) >= 0.)
    return initial_position;
  double upper = std::max(I1, initial_position);
  while (inside(upper) < 0.)
    upper *= 2.;
  // without a slope: the search is bisection
  const double    none = std::numeric_limits<double>::quiet_NaN();
  const auto      f    = [&](const double X) { return ValueAndSlope<double>{inside(X), none}; };
  Bracket<double> bracket{initial_position, upper};
  bracket.relative_tolerance = 1e-14;
  Iterations iterations;
  return root_in_bracket<double>(f, bracket, upper, true, iterations);
}

std::string CapSurface::complaint_about(const double I1, const double j) const
{
  const double strength = failure(std::max(I1, 0.)).value;
  if (I1 >= 0. && j <= strength)
    return "";
  std::ostringstream reason;
  reason << "the stress at rest, I1 = " << I1 << " Pa with sqrt(J2) = " << j
         << " Pa, lies beyond the failure surface, sqrt(J2) = " << strength
         << " Pa. Take an earth pressure coefficient nearer to 1.";
  return reason.str();
}
} // namespace Arenite
