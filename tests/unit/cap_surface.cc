// The search for roots that the return mapping of the caps stands on.

#include <arenite/materials/bracketed_root.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace Arenite;

BOOST_AUTO_TEST_SUITE(cap_surface)

// Roots of any scale, with slopes or without, lane by lane; lanes that do not take part are left alone.
BOOST_AUTO_TEST_CASE(root_in_a_bracket)
{
  using V = Lanes<4>;
  V exact(0.);
  for (int l = 0; l < 4; ++l)
    set_lane(exact, l, std::pow(10., -3. * l));
  for (const bool slopes : {true, false})
    {
      const auto cube = [&](const V &x) {
        return ValueAndSlope<V>{x * x * x - exact * exact * exact,
                                slopes ? V(V(3.) * x * x) : V(std::numeric_limits<double>::quiet_NaN())};
      };
      Bracket<V> bracket{V(0.), V(7.)};
      bracket.relative_tolerance = 4e-16;
      bracket.many_scales        = true;
      Iterations iterations;
      const V    x = root_in_bracket<V>(cube, bracket, V(7.), exact < V(0.5), iterations);
      BOOST_TEST(lane(x, 0) == 7.);
      for (int l = 1; l < 4; ++l)
        BOOST_TEST(lane(x, l) == lane(exact, l),
                   boost::test_tools::tolerance(1e-14)); // x^3 loses a third of its digits
      BOOST_TEST(iterations.passes < (slopes ? 80u : 90u));
      BOOST_TEST(iterations.lanes <= 3 * iterations.passes);
    }
}

BOOST_AUTO_TEST_SUITE_END()
