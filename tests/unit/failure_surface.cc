#include <arenite/materials/cap_surface.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

#include "loose_sand.h"

using namespace Arenite;
using boost::test_tools::tolerance;

namespace
{
CapSurface sand(const double largest_strength)
{
  CapSurface s       = loose_sand();
  s.largest_strength = largest_strength;
  return s;
}
} // namespace

BOOST_AUTO_TEST_SUITE(failure_surface)

// Bounded friction: the strength of the unbounded surface at low pressure (the first neglected term is theta I1^2/(2 I_s)), F_max at
// high pressure, slope and curvature as differences have them (h^2 and round-off/h^2), concave.
BOOST_AUTO_TEST_CASE(largest_strength)
{
  CapSurface bounded = sand(1.3e8), unbounded = sand(0.);
  BOOST_REQUIRE(bounded.finalize() == "");
  BOOST_REQUIRE(unbounded.finalize() == "");
  const double I_s = (1.3e8 - 64200.) / 0.18257;
  for (const double I1 : {0., 1e4, 1e6, 1e7})
    {
      const double difference = unbounded.failure(I1).value - bounded.failure(I1).value;
      BOOST_TEST(difference >= 0.);
      BOOST_TEST(difference <= .18257 * I1 * I1 / (2. * I_s) * (1. + 1e-9) + 1e-9);
    }
  BOOST_TEST(bounded.failure(100. * I_s).value == 1.3e8, tolerance(1e-12));
  BOOST_TEST(bounded.failure(I_s).value == 64200. + (1.3e8 - 64200.) * (1. - std::exp(-1.)), tolerance(1e-12));
  for (double I1 = 1e4; I1 < 20. * I_s; I1 *= 1.7)
    {
      const double h = 1e-4 * I1;
      const auto   F = bounded.failure(I1), low = bounded.failure(I1 - h), high = bounded.failure(I1 + h);
      BOOST_TEST(std::abs((high.value - low.value) / (2. * h) - F.slope) < 1e-8 * .2);
      BOOST_TEST(std::abs((high.slope - low.slope) / (2. * h) - F.curvature) < 1e-8 * .2 / I1);
      BOOST_TEST(F.slope >= 0.);
      BOOST_TEST(F.curvature <= 0.);
    }
  // tension is not touched
  BOOST_TEST(bounded.F0_slope == unbounded.F0_slope);
  BOOST_TEST(bounded.tension_axis == unbounded.tension_axis);
}

// A warning where the friction of a sand would be beyond all measurements, and only there.
BOOST_AUTO_TEST_CASE(warning)
{
  CapSurface bounded = sand(1.3e8), unbounded = sand(0.);
  BOOST_REQUIRE(bounded.finalize() == "");
  BOOST_REQUIRE(unbounded.finalize() == "");
  BOOST_TEST(bounded.strength_warning(1e10) == "");
  BOOST_TEST(unbounded.strength_warning(4e8) == "");
  // q = sqrt(3) (alpha + theta 3 p) = 9.49 GPa at 10 GPa
  BOOST_TEST(unbounded.strength_q(1e10) == std::sqrt(3.) * (64200. + .18257 * 3e10), tolerance(1e-12));
  BOOST_TEST(unbounded.strength_warning(1e10).find("q = 9.48") != std::string::npos);
}

// The rule is refused with the numbers.
BOOST_AUTO_TEST_CASE(refused)
{
  CapSurface weak = sand(6e4);
  BOOST_TEST(weak.finalize().find("60000 Pa, must exceed alpha = 64200") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
