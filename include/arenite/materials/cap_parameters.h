#pragma once

#include <arenite/materials/failure_surface.h>

#include <string>

namespace Arenite
{
/// Parameters that surfaces with a hardening cap share.
struct CapParameters : FailureSurface
{
  double axis_ratio       = 4.; ///< R [-]
  double initial_position = 0.; ///< X0 on the I1 axis [Pa]
  double hardening_rate   = 0.; ///< D [1/Pa]
  double hardening_limit  = 0.; ///< W [-]

  /// Entries of the failure surface, of R, X0 and D. @p hardening is the formula of k, for the manual.
  void declare_cap(Parameters &, const Range &position, const std::string &hardening);
  void declare_hardening_limit(Parameters &); ///< W

  /// For I1 >= 0, whether J2 + (<I1 - L>/ratio)^2 < F(min(I1, L))^2 with the F <= Fe that costs nothing: the failure surface seen from
  /// below and the quarter of an ellipse that begins at its top (L, F(L)) and ends at I1 = L + ratio F(L).
  template <typename Number>
  Mask<Number> surely_below(const Number &I1, const Number &J2, const Number &L, const Number &ratio) const
  {
    const auto   F      = failure_from_below(min(max(I1, Number(0.)), L));
    const Number beyond = max(Number(I1 - L), Number(0.)), strength = ratio * F.scaled;
    return F.scale * F.scale * (J2 * ratio * ratio + beyond * beyond) < strength * strength;
  }
};
} // namespace Arenite
