#include <arenite/verification/buried_cavity.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

#include "history_from_text.h"

using namespace Arenite;
using boost::test_tools::tolerance;

namespace
{
LinearElastic solid(const double E, const double nu, const double density)
{
  return {density, E / (3. * (1. - 2. * nu)), E / (2. * (1. + nu))};
}
} // namespace

BOOST_AUTO_TEST_SUITE(buried_cavity)

// Case with a = 0.1 m, h = 0.5 m, p = 1 MPa sin^6(pi t/1.2 ms). The figures come from another program for the same integrals, which was
// compared with Hankel-Laplace quadrature to 3e-9 of the largest displacement, 8e-5 m. Tolerance: the same.
BOOST_AUTO_TEST_CASE(independent_figures)
{
  const auto p = history_from_text("sin^n pulse", "set Amplitude = 1e6\nset Duration = 1.2e-3\nset Exponent = 6\n");
  const BuriedCavity exact(solid(2e8, .25, 2200.), .1, .5, p);
  const struct
  {
    double r, t, down, radial;
  } rows[] = {{0., 1.5e-3, -2.345019297341e-06, 0.},
              {0., 1.9e-3, -7.692895573708e-05, 0.},
              {0., 3.5e-3, -4.662165602726e-06, 0.},
              {.2, 1.9e-3, -4.813839514920e-05, 2.262629324911e-05},
              {.2, 3.0e-3, 1.276567808534e-05, -6.958585759966e-06},
              {.5, 1.9e-3, -4.021123954298e-11, 4.509212801135e-11},
              {.5, 2.5e-3, -3.322620005881e-05, 3.943463106978e-05},
              {1., 3.5e-3, -3.360417907526e-06, 6.618130073966e-06},
              {1., 5.0e-3, 3.749921699025e-07, -1.063486935571e-06}};
  for (const auto &row : rows)
    {
      const auto u = exact.displacement(row.r, row.t);
      BOOST_TEST(std::abs(u.upward + row.down) < 3e-9 * 8e-5);
      BOOST_TEST(std::abs(u.radial - row.radial) < 3e-9 * 8e-5);
    }
  BOOST_TEST(exact.valid_until(0.) == 0.00363318042491699, tolerance(1e-12));
  BOOST_TEST(exact.valid_until(1.) == 0.005504371249799894, tolerance(1e-12));
  BOOST_TEST(exact.displacement(1., 1e-3).upward == 0.);
}

// Long after a lasting pressure the surface stands where Mogi's static source puts it: u = (1 - nu) p a^3/(G R^3) (r, h). The difference
// falls with t^-2: 1.4e-4 (R/h)^2 of the displacement at 100 h/cp, a quarter of it at 200 h/cp.
BOOST_AUTO_TEST_CASE(comes_to_rest_at_the_static_solution)
{
  const double        nu = .3, a = .1, h = 1.;
  const LinearElastic m    = solid(2e8, nu, 2000.);
  const double        time = h / m.p_wave_speed();
  const auto p = history_from_text("C3 step", "set Amplitude = 1e5\nset Rise time = " + std::to_string(time) + "\n");
  const BuriedCavity exact(m, a, h, p);
  for (const double r : {0., .7, 2.})
    {
      const double scale  = (1. - nu) * 1e5 * a * a * a / (m.shear_modulus * std::pow(r * r + h * h, 1.5));
      double       before = 0.;
      for (const double t : {100., 200.})
        {
          const auto   u          = exact.displacement(r, t * time);
          const double difference = std::hypot(u.upward - scale * h, u.radial - scale * r) / (scale * std::hypot(r, h));
          BOOST_TEST_MESSAGE("r = " << r << ", t = " << t << " h/cp: " << difference);
          BOOST_TEST(difference < 1.4e-4 * (r * r + h * h) / (h * h) * 1e4 / (t * t));
          if (t == 200.)
            BOOST_TEST(difference < .3 * before);
          before = difference;
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
