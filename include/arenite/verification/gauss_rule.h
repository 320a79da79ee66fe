#pragma once

#include <deal.II/base/quadrature_lib.h>

namespace Arenite
{
/// Gauss' rule with 24 points on [0, 1], to rounding for what the exact solutions integrate over one panel.
inline const dealii::QGauss<1> &gauss_rule()
{
  static const dealii::QGauss<1> rule(24);
  return rule;
}

/// Integral of f, a number or a tensor of numbers, from @p low to @p high by gauss_rule().
template <typename Result = double, typename Function>
Result gauss_integral(const double low, const double high, const Function &f)
{
  Result sum{};
  for (unsigned int i = 0; i < gauss_rule().size(); ++i)
    sum += gauss_rule().weight(i) * (high - low) * f(low + gauss_rule().point(i)[0] * (high - low));
  return sum;
}
} // namespace Arenite
