#pragma once

#include <arenite/verification/spherical_cavity.h>

#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace Arenite
{
/// Motion of the free surface of a half-space above a spherical cavity of radius a at the depth h whose wall carries the pressure p(t).
///
/// The cavity is replaced by the point source with the potential F(tau)/R that is exact for it in the infinite solid
/// (SphericalCavity). With the response I of the surface to F'' = delta,
///
///   u_r = int F''(t - s + a/cp) I_r(s) ds,      u_z = int F''(t - s + a/cp) I_z(s) ds         (u_z positive upwards, out of the solid)
///
/// Cagniard's method as de Hoop has it gives I as an integral over real slowness q, R^2 = r^2 + h^2:
///
///   I_z = -(2/pi) int_0^{q_m} Im[ 2 Om/(cs^2 Ray) dzeta/ds ] dq,      I_r = (2/pi) int_0^{q_m} Im[ -4 zeta eta_b/(cs^2 Ray) dzeta/ds ] dq
///   zeta = [s r + i h sqrt(s^2 - R^2 (1/cp^2 + q^2))]/R^2,    p^2 = q^2 - zeta^2,    q_m^2 = s^2/R^2 - 1/cp^2
///   eta_a^2 = p^2 + 1/cp^2,   eta_b^2 = p^2 + 1/cs^2,   Om = 2 p^2 + 1/cs^2,   Ray = Om^2 - 4 p^2 eta_a eta_b
///
/// smooth in theta, q = q_m sin theta: 24 Gauss points give round-off. The convolution takes 24 points on panels of a/(2 cp); a pressure
/// whose k-th derivative jumps inside of a panel costs accuracy of the order of (1/24)^(k+1).
///
/// Source: Cagniard (1939), de Hoop (1960), with the source of the cavity in closed form.
///
/// What the cavity scatters of the wave that the surface sends back is missing: exact for the cavity
/// until valid_until(r) = [2 (h - a) + R - a]/cp, afterwards it is the motion of another problem.
class BuriedCavity
{
public:
  /// @param depth  h [m] of the centre below the surface, > a
  BuriedCavity(const LinearElastic &material, double radius, double depth, std::shared_ptr<const TimeHistory> pressure);

  /// Radial and upward component.
  struct SurfaceVector
  {
    double radial = 0., upward = 0.;
  };

  /// u [m] at the distance @p r [m] from the axis.
  SurfaceVector displacement(double r, double t) const;

  /// End of the window in which the cavity is solved exactly [s].
  double valid_until(double r) const;

  /// I [1/(m s)], see above; zero before R/cp.
  SurfaceVector response(double r, double s) const;

private:
  /// I at the points of a rule on panels from R/cp on, for one receiver: the panels do not depend on t.
  struct Samples
  {
    std::vector<double>        times;
    std::vector<SurfaceVector> response; ///< times Gauss' weight
  };

  LinearElastic      material;
  double             radius, depth, panel; ///< panel: length of a panel [s]
  SphericalCavity<3> cavity;

  mutable std::mutex                mutex;
  mutable std::map<double, Samples> samples; ///< by r

  /// Complete panels from R/cp to @p end, computed on demand.
  const Samples &sampled(double r, double start, double end) const;
};
} // namespace Arenite
