#include <arenite/materials/cavity_gas.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>

using namespace Arenite;
using boost::test_tools::tolerance;
using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;

namespace
{
DetonationProducts tnt() { return {1630., 371.2e9, 3.231e9, 4.15, .95, .30, 6930., 21e9, 7.0e9, 2e-3}; }
DetonationProducts tnt_b() { return {1630., 373.77e9, 3.7471e9, 4.15, .90, .35, 6930., 21e9, 6.0e9, 2e-3}; }
DetonationProducts c4() { return {1601., 609.77e9, 12.95e9, 4.5, 1.4, .25, 8193., 28e9, 9.0e9, 2e-3}; }

bool mentions(const std::string &message, const std::string &part)
{
  BOOST_TEST_MESSAGE(message);
  return message.find(part) != std::string::npos;
}
} // namespace

BOOST_AUTO_TEST_SUITE(cavity_gas)

// The published constants reproduce the detonation that they were fitted to: pressure, and the slope of the isentrope, which touches
// the Rayleigh line (Chapman-Jouguet). Tolerance: digits of the constants.
BOOST_AUTO_TEST_CASE(chapman_jouguet)
{
  for (const DetonationProducts &products : {tnt(), tnt_b(), c4()})
    {
      BOOST_TEST(products.complaint() == "");
      const double v = products.detonation_volume(), E = products.detonation_energy();
      BOOST_TEST(products.pressure_of_energy(v, E) == products.detonation_pressure, tolerance(5e-4));
      BOOST_TEST(products.inconsistency() < .02);
      BOOST_TEST_MESSAGE("inconsistency " << products.inconsistency());
      BOOST_TEST(products.warning() == "");
    }
  // pressure of the products in the volume of the charge, three digits
  BOOST_TEST(std::abs(tnt().pressure(2e-3) - 8.4e9) < .05e9);
  BOOST_TEST(std::abs(c4().pressure(2e-3) - 11.3e9) < .05e9);

  DetonationProducts wrong = tnt();
  wrong.specific_energy    = 5e9; // 4 % of p_CJ
  BOOST_TEST(mentions(wrong.warning(), "do not fit"));
}

// On the isentrope the energy falls by the work of the pressure, dE = -p dV, and pressure and energy fit the equation of state.
// Tolerance: quadrature.
BOOST_AUTO_TEST_CASE(work_of_expansion)
{
  for (const DetonationProducts &products : {tnt(), c4()})
    {
      const double C = products.fill_constant();
      BOOST_TEST(products.energy(products.charge_volume) == products.specific_energy * products.charge_volume,
                 tolerance(1e-13));
      for (const double v : {1.5, 4., 30.})
        {
          const double work = Quadrature::integrate([&](const double V) { return products.pressure(V); },
                                                    products.charge_volume, v * products.charge_volume, 15, 1e-12);
          BOOST_TEST(products.energy(products.charge_volume) - products.energy(v * products.charge_volume) == work,
                     tolerance(1e-10));
          BOOST_TEST(products.isentrope_pressure(v, C) ==
                       products.pressure_of_energy(v, products.isentrope_energy(v, C)),
                     tolerance(1e-12));
          const double h = 1e-5; // central difference, error h^2
          BOOST_TEST((products.isentrope_pressure(v - h, C) - products.isentrope_pressure(v + h, C)) / (2. * h) ==
                       products.isentrope_slope(v, C),
                     tolerance(1e-7));
        }
    }
  const AdiabaticGas air{2e5, .5, 1.4};
  BOOST_TEST(air.complaint() == "");
  BOOST_TEST(air.pressure(.5) == 2e5);
  const double work = Quadrature::integrate([&](const double V) { return air.pressure(V); }, .5, 2., 15, 1e-12);
  BOOST_TEST(air.energy(.5) - air.energy(2.) == work, tolerance(1e-10));
}

// Far out the products are an ideal gas with gamma = 1 + omega.
BOOST_AUTO_TEST_CASE(late_expansion)
{
  const DetonationProducts products = tnt();
  const AdiabaticGas       gas{products.pressure(100. * products.charge_volume), 100. * products.charge_volume,
                         1. + products.omega};
  BOOST_TEST(products.pressure(1000. * products.charge_volume) == gas.pressure(1000. * products.charge_volume),
             tolerance(1e-12));
}

// Constants without physical sense are refused with the numbers.
BOOST_AUTO_TEST_CASE(refusals)
{
  DetonationProducts products = tnt();
  products.R2                 = 5.;
  BOOST_TEST(mentions(products.complaint(), "0 < R2 < R1"));
  products       = tnt();
  products.omega = 0.;
  BOOST_TEST(mentions(products.complaint(), "omega"));
  products                 = tnt();
  products.specific_energy = .5e9; // less than A and B hold at v = 1
  BOOST_TEST(mentions(products.complaint(), "not that of a gas"));
  BOOST_TEST(mentions(AdiabaticGas{1e5, 1., 1.}.complaint(), "exceed 1"));
}

BOOST_AUTO_TEST_SUITE_END()
