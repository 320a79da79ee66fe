#pragma once

#include <arenite/base/number.h>
#include <arenite/base/parameters.h>

#include <string>

namespace Arenite
{
/// Shear strength of soils and rocks under mean stress, that the cap models share:
///
///   sqrt(J2) = Fe(I1) = alpha - gamma exp(-beta I1) + theta I1,      I1 = -tr(sigma), compression positive
///
/// continued by its tangent for I1 < 0. Roger (2015), equation (2.3.7).
struct FailureSurface
{
  double alpha = 0.; ///< [Pa], > gamma
  double gamma = 0.; ///< [Pa]
  double beta  = 0.; ///< [1/Pa]
  double theta = 0.; ///< [-]

  // derived by finalize_failure()
  double F0 = 0., F0_slope = 0.; ///< Fe(0) [Pa], Fe'(0) [-]

  void declare_failure(Parameters &);

  /// @return the rule that the parameters break, with the numbers; empty if all is well.
  std::string finalize_failure();

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
    return {Number(alpha) - z + Number(theta) * I1, Number(beta) * z + Number(theta), Number(-beta * beta) * z};
  }

  template <typename Number>
  Failure<Number> failure(const Number &I1) const
  {
    const Mask<Number>    tension = I1 < Number(0.);
    const Failure<Number> F       = failure_expression(select(tension, Number(0.), I1));
    return {select(tension, Number(Number(F0) + Number(F0_slope) * I1), F.value), F.slope,
            select(tension, Number(0.), F.curvature)};
  }

  /// (1 + beta I1) F with F <= Fe(I1), for I1 >= 0; needs no exponential: 1 - exp(-z) >= z/(1 + z).
  template <typename Number>
  Number failure_from_below(const Number &I1, const Number &one_plus_z) const
  {
    return (Number(F0) + Number(theta) * I1) * one_plus_z + Number(gamma * beta) * I1;
  }
};
} // namespace Arenite
