#pragma once

#include <arenite/base/number.h>

namespace Arenite
{
/// Viscoplastic multiplier of one step as a function of the overstress variable t:
///
///   Perzyna            f = f0 t,  dlambda = eta dt t^N    (t = f/f0; the fluidity eta -> infinity is rate independent)
///   rate independent   f = 0,     dlambda = t
///
/// Duvaut-Lions is rate independent and goes a part of the way from the elastic trial state to that solution.
///
/// With t as unknown the equations of the step are well scaled for every eta dt and N: no division by eta dt, no root.
struct CapFlow
{
  bool   rate_independent = false;
  double fluidity_dt      = 0.; ///< eta dt [-]
  double f0               = 1.; ///< [Pa]
  double exponent         = 1.; ///< N
  double part_of_way      = 1.; ///< dt/(tau + dt) of Duvaut-Lions; 1 is all of it

  template <typename Number>
  struct Rates
  {
    Number f, df, multiplier, d_multiplier; ///< and derivatives with respect to t
  };
  template <typename Number>
  Rates<Number> rates(const Number &t) const
  {
    if (rate_independent)
      return {Number(0.), Number(0.), t, Number(1.)};
    const Number q = power(t, exponent - 1.);
    return {Number(f0) * t, Number(f0), Number(fluidity_dt) * q * t, Number(fluidity_dt * exponent) * q};
  }

  /// First guess from f at the trial state and the decrease of f per multiplier.
  template <typename Number>
  Number start(const Number &f, const Number &decrease) const
  {
    if (rate_independent)
      return f / decrease;
    if (exponent == 1.)
      return f / (Number(f0) + decrease * Number(fluidity_dt));
    return min(Number(f / Number(f0)), power(Number(f / (decrease * Number(fluidity_dt))), 1. / exponent));
  }

  /// Above this t there is no solution; @p stiffness is the smallest elastic modulus of the invariants.
  template <typename Number>
  Number upper(const Number &f, const Number &stiffness) const
  {
    return rate_independent ? f / stiffness : f / Number(f0);
  }
};
} // namespace Arenite
