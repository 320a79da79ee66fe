#pragma once

#include <arenite/materials/iterations.h>

#include <limits>

namespace Arenite
{
/// A function and its slope at one point. Values of a size up to @p resolution are round-off: they end the search.
template <typename Number>
struct ValueAndSlope
{
  Number value, slope, resolution = Number(0.);
};

/// Where an increasing function has its root, and how well it is wanted.
template <typename Number>
struct Bracket
{
  Number lower, upper;                    ///< value(lower) <= 0 <= value(upper): the caller knows
  Number tolerance          = Number(0.); ///< of x, absolute
  double relative_tolerance = 0.;         ///< of x, is added; from 4e-16 on if it is all there is
  bool   many_scales        = false;      ///< lower = 0, and the root may be many powers of ten below upper
};

/// Root of an increasing function in a bracket: Newton's method inside of the bracket, which every evaluation shrinks; where
/// Newton's step leaves it, or the last step did not halve the value, the bracket is halved instead. A function without a slope
/// gives one that is not a number, and the search is bisection. All scalar equations of the laws that need a bracket are solved here.
///
/// Lane by lane: only lanes of @p active are searched, the others keep @p x. A lane stops when its step or its value is below the
/// tolerance, and is not changed again; others go on. A search without end gives NaN: it cannot be overlooked.
template <typename Number, typename Function>
Number root_in_bracket(const Function &function, Bracket<Number> bracket, Number x, Mask<Number> active,
                       Iterations &iterations)
{
  const Number zero(0.), half(0.5);
  Number       last(std::numeric_limits<double>::max()); // size of the value before
  for (unsigned int i = 0; i < 400 && any_of(active); ++i)
    {
      iterations.count(active);
      const ValueAndSlope<Number> f    = function(x);
      const Number                size = Arenite::absolute<Number>(f.value);
      bracket.lower                    = Arenite::select<Number>(active && f.value <= zero, x, bracket.lower);
      bracket.upper                    = Arenite::select<Number>(active && f.value >= zero, x, bracket.upper);

      const Number newton = x - f.value / f.slope;
      Number       middle = half * (bracket.lower + bracket.upper);
      if (bracket.many_scales)
        middle = Arenite::select<Number>(bracket.lower > zero, middle, Number(Number(1e-3) * bracket.upper));
      const Mask<Number> useful = newton >= bracket.lower && newton <= bracket.upper && size <= half * last;
      const Mask<Number> solved = size <= f.resolution;
      const Number       next   = Arenite::select<Number>(useful, newton, Arenite::select<Number>(solved, x, middle));
      const Mask<Number> ends =
        solved || !(Arenite::absolute<Number>(next - x) >
                    bracket.tolerance + Number(bracket.relative_tolerance) * Arenite::absolute<Number>(x));
      // after a halving the next Newton step is free: two halvings in a row are needed only where Newton fails
      last   = Arenite::select<Number>(useful, size, Number(std::numeric_limits<double>::max()));
      x      = Arenite::select<Number>(active, next, x);
      active = active && !ends;
    }
  if (any_of(active))
    x = Arenite::select<Number>(active, Number(std::numeric_limits<double>::quiet_NaN()), x);
  return x;
}

/// Root of an increasing function on [lower, upper] whose ends are asked first: a lane without sign change, or with a value
/// there that is not a number, returns NaN. @p tolerance is absolute, in units of x. The result carries the derivatives of
/// differentiable numbers.
template <typename Number, typename Function>
Number bracketed_root(const Function &function, const Number &lower, const Number &upper, const Number &guess,
                      const Number &tolerance)
{
  const Number       zero(0.);
  const Mask<Number> bracketed = function(lower).value <= zero && function(upper).value >= zero;
  const Number       start     = Arenite::min<Number>(Arenite::max<Number>(guess, lower), upper);
  Iterations         iterations;
  Number             x = root_in_bracket<Number>(function, {lower, upper, tolerance}, start, bracketed, iterations);
  // One more Newton step costs little, squares the error and carries the derivatives.
  const ValueAndSlope<Number> f      = function(x);
  const Number                newton = x - f.value / f.slope;
  const Mask<Number>          inside = Arenite::absolute<Number>(newton - x) <= Number(2.) * tolerance;
  x                                  = Arenite::select<Number>(inside, newton, x);
  return Arenite::select<Number>(bracketed, x, Number(std::numeric_limits<double>::quiet_NaN()));
}
} // namespace Arenite
