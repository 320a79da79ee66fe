#pragma once

#include <arenite/base/time_history.h>
#include <arenite/materials/linear_elastic.h>

#include <deal.II/base/tensor.h>

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

#include <memory>
#include <vector>

namespace Arenite
{
/// Motion of the free surface of a half-space under a vertical load on a disc of it (Lamb's problem).
///
/// A force Q q(t) at one point, downwards, moves the surface at the distance r by an integral over slowness z (a = 1/cp, b = 1/cs)
///
///   down      (Q/(pi^2 G)) PV int_a^{t/r} -Im[b^2 eta_a/Ray] z g_0(z) dz
///   radially  (Q/(pi^2 G)) { int_a^b -Im[(b^2 - 2 z^2 - 2 eta_a eta_b)/Ray] z^2 g_1(z) dz - pi H(t - r/cR) c^2 A g_1(c) }
///   g_n(z) = int_0^{acosh(t/(r z))} q'(t - r z cosh w) cosh^n w dw
///   eta_a^2 = a^2 - z^2,   eta_b^2 = b^2 - z^2,   Ray = (b^2 - 2 z^2)^2 + 4 z^2 eta_a eta_b
///
/// where Ray(c) = 0 at c = 1/cR is the Rayleigh wave, a pole of the first integrand and a wave of its own in the second (A: residue of
/// [..]/Ray). For a smooth pulse all is smooth but for square roots at a and b, which z = low + (high - low) sin^2 removes. A uniform
/// pressure p(t) on the disc of radius R < r is the integral of point forces over it.
///
/// Source: Lamb (1904), by Cagniard's method on the real axis. Checked with Pekeris' closed form of the step at nu = 1/4 (down: constant
/// after the Rayleigh wave) and Boussinesq's static displacements.
class SurfaceLoad
{
public:
  /// @param pressure  p(t) [Pa] on the disc, smooth between its break points, of which it has two at least
  SurfaceLoad(const LinearElastic &material, double disc_radius, std::shared_ptr<const TimeHistory> pressure);

  struct SurfaceVector
  {
    double radial = 0., upward = 0.; ///< [m]
  };

  /// u at r > R.
  SurfaceVector displacement(double r, double t) const;

  /// u at the distance r of the force p(t) 1 m^2.
  SurfaceVector point_force(double r, double t) const;

  /// cR [m/s]
  double rayleigh_speed() const { return 1. / rayleigh_slowness; }

private:
  LinearElastic                      material;
  double                             radius, a, b, rayleigh_slowness;
  std::shared_ptr<const TimeHistory> pressure;
  std::vector<double>                breaks; ///< of the pressure

  using Pair = dealii::Tensor<1, 2>;
  std::vector<boost::math::interpolators::cardinal_cubic_b_spline<double>> rates; ///< p' between the breaks

  double difference(double t, double step) const;

  /// g_0(z), g_1(z), see above
  Pair source(double z, double r, double t) const;
};
} // namespace Arenite
