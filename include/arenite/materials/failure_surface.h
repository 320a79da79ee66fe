#pragma once

#include <arenite/base/number.h>
#include <arenite/base/parameters.h>

#include <cmath>
#include <string>

namespace Arenite
{
/// Shear strength of soils and rocks under mean stress, that the cap models share:
///
///   sqrt(J2) = Fe(I1) = alpha - gamma exp(-beta I1) + theta I1,      I1 = -tr(sigma), compression positive
///
/// continued by its tangent for I1 < 0. Roger (2015), equation (2.3.7).
///
/// Sands lose their friction at high pressure: above some 0.5 GPa the strength no longer grows. With a largest strength F_max the last
/// term bends into it, theta I1 -> theta I_s (1 - exp(-I1/I_s)) with I_s = (F_max - alpha)/theta: the same slope at low pressure, Fe -> F_max
/// at high, concave between. Without one (F_max = 0) friction is unbounded. Ours.
struct FailureSurface
{
  double alpha            = 0.; ///< [Pa], > gamma
  double gamma            = 0.; ///< [Pa]
  double beta             = 0.; ///< [1/Pa]
  double theta            = 0.; ///< [-]
  double largest_strength = 0.; ///< F_max [Pa]; 0: none

  // derived by finalize_failure()
  double F0 = 0., F0_slope = 0.; ///< Fe(0) [Pa], Fe'(0) [-]
  double friction_range = 0.;    ///< I_s [Pa]; 0: friction is not bounded

  void declare_failure(Parameters &);

  /// @return the rule that the parameters break, with the numbers; empty if all is well.
  std::string finalize_failure();

  /// q = sqrt(3) Fe at the pressure @p p [Pa], for the log
  double strength_q(const double p) const { return std::sqrt(3.) * failure(3. * p).value; }

  /// A sentence if friction grows without bound in a range of pressure where that of sand does not; or nothing.
  std::string strength_warning(double largest_pressure) const;

  template <typename Number>
  struct Failure
  {
    Number value, slope, curvature; ///< Fe [Pa], Fe' [-], Fe'' [1/Pa]
  };

  /// Fe for any I1, without the tangent.
  template <typename Number>
  Failure<Number> failure_expression(const Number &I1) const
  {
    const Number z = gamma > 0. ? Number(gamma) * exponential(Number(Number(-beta) * I1)) : Number(0.);
    if (friction_range == 0.)
      return {Number(alpha) - z + Number(theta) * I1, Number(beta) * z + Number(theta), Number(-beta * beta) * z};
    const Number less = exponential_minus_one(Number(Number(-1. / friction_range) * I1)), y = Number(1.) + less;
    return {Number(alpha) - z - Number(theta * friction_range) * less, Number(beta) * z + Number(theta) * y,
            Number(-beta * beta) * z - Number(theta / friction_range) * y};
  }

  template <typename Number>
  Failure<Number> failure(const Number &I1) const
  {
    const Mask<Number>    tension = I1 < Number(0.);
    const Failure<Number> F       = failure_expression(select(tension, Number(0.), I1));
    return {select(tension, Number(Number(F0) + Number(F0_slope) * I1), F.value), F.slope,
            select(tension, Number(0.), F.curvature)};
  }

  /// F <= Fe(I1), for I1 >= 0, as scaled / scale; needs neither exponential nor division: 1 - exp(-z) >= z/(1 + z).
  template <typename Number>
  struct LowerBound
  {
    Number scaled, scale;
  };
  template <typename Number>
  LowerBound<Number> failure_from_below(const Number &I1) const
  {
    const Number of_gamma = Number(1.) + Number(beta) * I1;
    if (friction_range == 0.)
      return {(Number(F0) + Number(theta) * I1) * of_gamma + Number(gamma * beta) * I1, of_gamma};
    const Number of_theta = Number(1.) + Number(1. / friction_range) * I1;
    return {(Number(F0) * of_theta + Number(theta) * I1) * of_gamma + Number(gamma * beta) * I1 * of_theta,
            of_gamma * of_theta};
  }
};
} // namespace Arenite
