// The surface of the viscoplastic cap, and the search for roots that its return mapping stands on.

#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/cap_surface.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <random>

using namespace Arenite;

BOOST_AUTO_TEST_SUITE(cap_surface)

// What is surely inside of the surface is inside; and it is most of the inside, so that the question is worth asking.
BOOST_AUTO_TEST_CASE(surely_inside)
{
  std::mt19937_64 random(11);
  const auto      uniform = [&]() { return (random() >> 11) * 0x1p-53; };
  unsigned int    inside = 0, sure = 0, wrong = 0;
  for (unsigned int set = 0; set < 200; ++set)
    {
      CapSurface s;
      s.alpha            = std::pow(10., 4. + 3. * uniform());
      s.gamma            = set % 5 ? s.alpha * 0.9 * uniform() : 0.;
      s.beta             = set % 7 ? std::pow(10., -8. + 3. * uniform()) : 0.;
      s.theta            = set % 11 ? 0.3 * uniform() : 0.;
      s.largest_strength = set % 3 ? 0. : s.alpha * std::pow(10., 0.01 + 4. * uniform());
      s.axis_ratio       = 1. + 5. * uniform();
      s.small_cap_rule   = true;
      s.hardening_rate   = 1e-8;
      s.hardening_limit  = 0.2;
      s.initial_position = 1e4;
      s.tension_limit    = uniform() * (s.alpha - s.gamma) / (2. * (s.beta * s.gamma + s.theta));
      if (!(s.tension_limit < 1e6) || s.finalize() != "")
        continue;
      for (unsigned int i = 0; i < 2000; ++i)
        {
          const double X = s.smallest_position * std::pow(10., 4. * uniform() - 2.), xi = s.junction(X);
          const double I1  = -1.1 * s.tension_limit + uniform() * (1.1 * X + 1.1 * s.tension_limit);
          const double j   = 1.5 * uniform() * s.failure(std::max(I1, 0.)).value;
          const double f   = s.yield_function(I1, j, s.cap(xi));
          const bool   yes = s.surely_inside(I1, j * j, xi);
          inside += f < 0.;
          sure += yes;
          wrong += yes && f > 1e-12 * (j + std::abs(I1));
        }
    }
  BOOST_TEST_MESSAGE(sure << " of " << inside);
  BOOST_TEST(inside > 50000u);
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(sure > 0.8 * inside);
}

// The cap through a past stress: on it, or the initial one where that holds the state already; from there a larger cap is elastic.
BOOST_AUTO_TEST_CASE(cap_through_a_state)
{
  CapSurface s;
  s.alpha            = 64200.;
  s.gamma            = 5890.;
  s.beta             = 3.4283e-7;
  s.theta            = 0.18257;
  s.axis_ratio       = 5.;
  s.hardening_rate   = 1e-8;
  s.hardening_limit  = 0.2;
  s.initial_position = 1e6;
  s.tension_limit    = 5000.;
  BOOST_REQUIRE(s.finalize() == "");
  std::mt19937_64 random(5);
  const auto      uniform = [&]() { return (random() >> 11) * 0x1p-53; };
  unsigned int    held    = 0;
  for (unsigned int i = 0; i < 1000; ++i)
    {
      const double I1 = std::pow(10., 3. + 5. * uniform()), j = 0.99 * uniform() * s.failure(I1).value;
      const double X = s.position_through(I1, j), f = s.yield_function(I1, j, s.cap(s.junction(X)));
      BOOST_TEST(X >= s.initial_position);
      if (X == s.initial_position)
        {
          BOOST_TEST(f <= 0.);
          ++held;
        }
      else // f = b times a relative size; X is found to 1e-14, and the junction behind it to 1e-15
        BOOST_TEST(std::abs(f) < 1e-12 * X);
    }
  BOOST_TEST(held > 100u);
  BOOST_TEST(held < 900u);
  BOOST_TEST(s.position_through(3e6, 0.) == 3e6, boost::test_tools::tolerance(1e-12)); // on the axis the cap ends there
  BOOST_TEST(s.complaint_about(3e6, 1e4) == "");
  BOOST_TEST(s.complaint_about(3e6, 1e7) != "");
  BOOST_TEST(s.complaint_about(-1., 0.) != "");
}

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
