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
};
} // namespace Arenite
