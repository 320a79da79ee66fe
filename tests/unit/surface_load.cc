#include <arenite/verification/surface_load.h>

#include <deal.II/base/numbers.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "history_from_text.h"

using namespace Arenite;
using boost::test_tools::tolerance;

namespace
{
LinearElastic solid(const double nu)
{
  const double G = 8e7;
  return {2000., 2. * G * (1. + nu) / (3. * (1. - 2. * nu)), G};
}
const double pi = dealii::numbers::PI;
} // namespace

BOOST_AUTO_TEST_SUITE(surface_load)

// cR/cs of the literature, all digits that are printed there.
BOOST_AUTO_TEST_CASE(rayleigh_speed)
{
  const auto p = history_from_text("C5 step", "set Amplitude = 1\nset Rise time = 1e-3\n");
  for (const auto &[nu, ratio] : {std::make_pair(0., .874032048898), {.25, .919401686762}, {.4, .942195433116}})
    {
      const LinearElastic m = solid(nu);
      BOOST_TEST(SurfaceLoad(m, .1, p).rayleigh_speed() / m.s_wave_speed() == ratio, tolerance(1e-11));
    }
}

// Pekeris: at nu = 1/4 the vertical displacement by a step is Boussinesq's static one as soon as the Rayleigh wave is over, for good.
// Horizontally the static one is approached as t^-2: a quarter of the difference at twice the time. Tolerance of the first:
// difference quotients of the pressure, (1e-3)^4, and quadrature next to the pole.
BOOST_AUTO_TEST_CASE(static_displacements)
{
  const double        r    = 1.;
  const LinearElastic m    = solid(.25);
  const double        time = r / m.s_wave_speed();
  const auto          p =
    history_from_text("C5 step", "set Amplitude = 1000\nset Rise time = " + std::to_string(.5 * time) + "\n");
  const SurfaceLoad load(m, .1, p);
  for (const double t : {2., 3., 10.})
    BOOST_TEST(load.point_force(r, t * time).upward == -.75 * 1e3 / (2. * pi * m.shear_modulus * r), tolerance(1e-7));
  const double at_rest = -.5 * 1e3 / (4. * pi * m.shear_modulus * r);
  double       before  = 1.;
  for (const double t : {4., 8., 16.})
    {
      const double difference = std::abs(load.point_force(r, t * time).radial / at_rest - 1.);
      BOOST_TEST_MESSAGE("t = " << t << " r/cs: " << difference);
      BOOST_TEST(difference < .3 * before);
      before = difference;
    }
  BOOST_TEST(load.point_force(r, .99 * r / m.p_wave_speed()).upward == 0.);
}

// A disc is a point for a far receiver: the first correction of the static field is of the order of (R/r)^2.
BOOST_AUTO_TEST_CASE(disc)
{
  const LinearElastic m = solid(.3);
  const double        r = 2., R = .1, time = r / m.s_wave_speed();
  const auto p = history_from_text("C5 step", "set Amplitude = 1000\nset Rise time = " + std::to_string(time) + "\n");
  const SurfaceLoad load(m, R, p);
  const auto        disc = load.displacement(r, 40. * time), point = load.point_force(r, 40. * time);
  BOOST_TEST(disc.upward == pi * R * R * point.upward, tolerance(R * R / (r * r)));
  // Boussinesq's potential of a disc: 1/r (1 + (R/r)^2/8 + ...)
  BOOST_TEST(disc.upward == -.7 * 1e3 * R * R / (2. * m.shear_modulus * r) * (1. + R * R / (8. * r * r)),
             tolerance(2e-4));
}

BOOST_AUTO_TEST_SUITE_END()
