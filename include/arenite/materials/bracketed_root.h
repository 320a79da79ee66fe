#pragma once

#include <arenite/base/number.h>

#include <limits>

namespace Arenite
{
/// A function and its slope at one point.
template <typename Number>
struct ValueAndSlope
{
  Number value, slope;
};

/// Root of an increasing function on [lower, upper], lane by lane: Newton's method inside a bracket that every evaluation
/// shrinks; where Newton's step leaves the bracket or does not halve the residual, the bracket is halved instead. A lane stops
/// when its step is below @p tolerance (absolute, in units of x) and is not changed again; others go on.
///
/// An evaluation halves the bracket or is followed by one that halves the residual or the bracket. A lane without sign change
/// in the bracket, or with a value that is not a number, returns NaN: it cannot be overlooked.
template <typename Number, typename Function>
Number bracketed_root(const Function &function, Number lower, Number upper, const Number &guess,
                      const Number &tolerance)
{
  const Number zero(0.), half(0.5), nan(std::numeric_limits<double>::quiet_NaN()),
    huge(std::numeric_limits<double>::max());

  const Number at_lower = function(lower).value, at_upper = function(upper).value;
  const auto   bracketed = (at_lower <= zero) && (at_upper >= zero);
  Number       x         = Arenite::min<Number>(Arenite::max<Number>(guess, lower), upper);
  Number       residual  = Arenite::max<Number>(Number(-at_lower), at_upper); // at the previous evaluation
  auto         active    = bracketed;
  for (int evaluation = 0; evaluation < 400 && Arenite::any_of(active); ++evaluation)
    {
      const ValueAndSlope<Number> f = function(x);
      lower                         = Arenite::select<Number>(active && f.value <= zero, x, lower);
      upper                         = Arenite::select<Number>(active && f.value >= zero, x, upper);

      const Number newton = x - f.value / f.slope;
      const Number middle = half * (lower + upper);
      const auto   useful = newton >= lower && newton <= upper && Arenite::absolute<Number>(f.value) <= half * residual;
      const Number next   = Arenite::select<Number>(useful, newton, middle);
      const auto   stop   = !(Arenite::absolute<Number>(next - x) > tolerance);
      // after a halving the next Newton step is free: two halvings in a row are needed only where Newton fails
      residual = Arenite::select<Number>(useful, Arenite::absolute<Number>(f.value), huge);
      x        = Arenite::select<Number>(active, next, x);
      active   = active && !stop;
    }
  // One more Newton step costs little, squares the error and carries the derivatives of differentiable numbers.
  const ValueAndSlope<Number> f      = function(x);
  const Number                newton = x - f.value / f.slope;
  const auto                  inside = Arenite::absolute<Number>(newton - x) <= Number(2.) * tolerance;
  x                                  = Arenite::select<Number>(inside, newton, x);
  return Arenite::select<Number>(bracketed && !active, x, nan);
}
} // namespace Arenite
