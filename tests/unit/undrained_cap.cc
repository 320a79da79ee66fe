// Effective stress: skeleton and pores side by side. Closed forms of both, and of the whole where one of them dominates.

#include <arenite/materials/batch_law.h>
#include <arenite/materials/material_point.h>
#include <arenite/materials/undrained_cap.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include "law_example.h"

using namespace Arenite;
using boost::test_tools::tolerance;

namespace
{
UndrainedCap example(const std::string &block)
{
  return law_of_block<UndrainedCap>(example_file(UndrainedCap::name), block);
}
BatchLawFor<UndrainedCap, 1> batch_of(const UndrainedCap &law)
{
  BatchLawFor<UndrainedCap, 1> batch;
  batch.law = law;
  return batch;
}
SymTensor<double> uniaxial(const double strain)
{
  SymTensor<double> e;
  e[0] = strain;
  return e;
}
double shear_strength_used(const SymTensor<double> &stress) { return std::sqrt(second_invariant(deviator(stress))); }
} // namespace

BOOST_AUTO_TEST_SUITE(undrained_cap)

// Stress less pore pressure is that of the skeleton alone, the pore pressure that of the mixture alone, on random paths. Tolerance:
// round-off of the larger of the two stresses, which is subtracted again in every step.
BOOST_AUTO_TEST_CASE(stresses_add_up)
{
  for (const std::string &block : example_blocks(UndrainedCap::name))
    {
      const auto                                         batch = batch_of(example(block));
      BatchLawFor<ViscoplasticCap<ConstantStiffness>, 1> skeleton;
      skeleton.law = batch.law.skeleton;
      MaterialPoint                          wet(batch), dry(skeleton);
      std::mt19937                           generator(1);
      std::uniform_real_distribution<double> number(-1., 1.);
      for (int step = 0; step < 400; ++step)
        {
          SymTensor<double> increment;
          for (int k = 0; k < 6; ++k)
            increment[k] = 2e-4 * number(generator) - (k < 3 ? (step < 200 ? 1e-4 : -1e-4) : 0.);
          wet.advance(increment, 1e-5);
          dry.advance(increment, 1e-5);
          const double p_f = wet.state.history[0];
          const auto   gap = wet.state.stress + spherical(p_f) - dry.state.stress;
          BOOST_TEST_REQUIRE(std::sqrt(contract(gap, gap)) < 1e-9 * (std::abs(p_f) + 1e5));
          NoHistory<double> none;
          const double      expected =
            batch.law.pores.update(VolumeChange<double>{wet.state.density, wet.state.density, p_f}, none).pressure;
          BOOST_TEST_REQUIRE(std::abs(p_f - expected) < 1e-8 * (std::abs(p_f) + 1e5));
        }
    }
}

// Small compression of a saturated soil at rest: K' + K_W, which is above Gassmann's K' + (1 - K'/K_s)^2/(n/K_w + (1 - n)/K_s - K'/K_s^2)
// by 2 K' K_W/K_s and less; and the pores take the part B = K_W/(K' + K_W) of the pressure (Skempton). Tolerance of the first:
// nonlinearity of the phases at a strain of 1e-6 (7 times 1e-6).
BOOST_AUTO_TEST_CASE(undrained_stiffness_at_rest)
{
  const auto    batch = batch_of(example("saturated sand"));
  const auto   &state = *batch.law.skeleton.stiffness.constants.soil_state();
  const double  K = batch.law.skeleton.stiffness.elastic.bulk_modulus, n = state.porosity(), K_s = state.grain_modulus;
  const double  K_W = 1. / (n / state.water_modulus + (1. - n) / K_s);
  MaterialPoint point(batch);
  point.advance(spherical(-1e-6 / 3.), 1e-6);
  const double K_u = pressure(point.state.stress) / 1e-6;
  BOOST_TEST(K_u == K + K_W, tolerance(1e-5));
  BOOST_TEST(batch.law.undrained_modulus() == K + K_W, tolerance(1e-12));
  BOOST_TEST(point.state.history[0] / pressure(point.state.stress) == K_W / (K + K_W), tolerance(1e-6));
  const double gassmann = K + std::pow(1. - K / K_s, 2) / (n / state.water_modulus + (1. - n) / K_s - K / (K_s * K_s));
  BOOST_TEST(K_u > gassmann);
  BOOST_TEST(K_u - gassmann < 2. * K * K_W / K_s);
}

// Friction knows the effective stress only: at 0.5 GPa the strength of the saturated sand is what its skeleton has at the few per cent
// of strain that the water allows; the same skeleton, compressed without water to the same pressure, is a hundred times stronger.
BOOST_AUTO_TEST_CASE(water_bounds_the_strength)
{
  UndrainedCap law       = example("saturated sand");
  law.skeleton.viscosity = ViscoplasticCap<ConstantStiffness>::Viscosity::none;
  const auto    batch    = batch_of(law);
  MaterialPoint point(batch);
  while (pressure(point.state.stress) < 5e8)
    {
      point.advance(uniaxial(-1e-4), 1e-5);
      const SymTensor<double> effective = point.state.stress + spherical(point.state.history[0]);
      const auto             &surface   = law.skeleton.surface;
      // on or inside of the failure surface of the effective stress; tolerance: round-off of the total stress
      BOOST_TEST_REQUIRE(shear_strength_used(effective) < surface.failure(-trace(effective)).value + 1.);
    }
  const double j = shear_strength_used(point.state.stress);
  BOOST_TEST_MESSAGE("saturated at 0.5 GPa: volume strain " << trace(point.state.strain) << ", sqrt(J2) " << j
                                                            << " Pa");
  BOOST_TEST(j < 0.01 * 5e8);
  BOOST_TEST(law.skeleton.surface.failure(3. * 5e8).value > 50. * j);
}

// A step of the largest volume strain makes the pores stiffer by half: dK/dp of the mixture is that of differences, 1e-5 of it with increments of 1e-3 of
// p + p_a. At rest that is (1 + g)/(part of air) - 1 but for water and grains, stiffer by 1e-4, and without air the law asks for nothing.
BOOST_AUTO_TEST_CASE(limit_of_volume_strains)
{
  const UndrainedCap law   = example("wet sand");
  const auto         batch = batch_of(law);
  BOOST_TEST(batch.limits_volume_change());
  BOOST_TEST(!batch_of(example("saturated sand")).limits_volume_change());
  for (const double p : {0., 1e4, 1e6, 1e8, 3e9})
    {
      const double d       = 1e-3 * (p + law.pores.air_pressure);
      const auto   modulus = [&](const double at) {
        const auto V = law.pores.volume<double>(at);
        return V.volume / V.compliance;
      };
      UndrainedCap::History<double> history = law.initial_history();
      history.pore_pressure                 = p;
      BOOST_TEST(0.5 / law.volume_limit(history) == (modulus(p + d) - modulus(p - d)) / (2. * d), tolerance(1e-5));
    }
  const double air = law.pores.fraction[0];
  BOOST_TEST(law.pores.stiffening(0.) == (1. + law.pores.exponent[0]) / air - 1., tolerance(1e-2));
  BOOST_TEST(law.pores.stiffening(3e9) < 10.);
}

// While air is left, the pores carry the pressure of the air that is compressed without exchange of heat, p_a (V/V_0)^-1.4: the water and
// the grains hardly change their volume (part p/K_w of it). Then the mixture takes over: the stiffness is that of grains and water.
BOOST_AUTO_TEST_CASE(air_closes_first)
{
  const auto    batch = batch_of(example("wet sand"));
  const auto   &state = *batch.law.skeleton.stiffness.constants.soil_state();
  const double  a = state.air_fraction(), p_a = state.air_pressure;
  MaterialPoint point(batch);
  for (const double part : {.25, .5, .75, .9})
    {
      while (point.state.volume_ratio() > 1. - part * a)
        point.advance(spherical(-a / 3e3), 1e-6);
      const double closed = 1. - point.state.volume_ratio();
      const double air    = p_a * (std::pow(1. - closed / a, -1.4) - 1.);
      // what water and grains give way makes room for the air: its volume is a part p/K_W/(a - closed) larger
      BOOST_TEST(point.state.history[0] == air, tolerance(2. * 1.4 * air * 1.4 / 2e9 / (a - closed) + 1e-3));
    }
  while (point.state.volume_ratio() > 1. - 1.3 * a)
    point.advance(spherical(-a / 3e3), 1e-6);
  const double p = point.state.history[0], density = point.state.density;
  point.advance(spherical(-1e-6 / 3.), 1e-6);
  const double K = (point.state.history[0] - p) / std::log(point.state.density / density);
  // grains and water of the soil without air, stiffer with pressure: water by dK/dp = 7, and it is the softer one; what is left of the air, a (p/p_a)^(-1/1.4) with the
  // modulus 1.4 p, gives way by 3 % of the whole
  BOOST_TEST(K > state.compacted_modulus() * .95);
  BOOST_TEST(K < state.compacted_modulus() * (1. + 7. * p / state.water_modulus));
}

// Work is stored and dissipated energy and what the change of volume did to the skeleton's store; without that the ledger would not close at any
// step. Of second order in the step: the mixture stores by its curve, work sees mean pressures.
BOOST_AUTO_TEST_CASE(energy_closes)
{
  for (const std::string &block : example_blocks(UndrainedCap::name))
    {
      const auto batch = batch_of(example(block));
      double     error[2], by_volume = 0.;
      for (const int i : {0, 1})
        {
          const int     n = 1000 << i;
          MaterialPoint point(batch);
          double        work = 0.;
          error[i]           = 0.;
          for (int step = 0; step < n; ++step)
            {
              SymTensor<double> increment = uniaxial((step < 3 * n / 4 ? -0.2 : 0.1) / n);
              increment[3]                = 0.05 / n;
              point.advance(increment, 1e-3 / n);
              const PointState &s = point.state;
              work                = std::max(work, s.work);
              error[i]            = std::max(error[i], std::abs(s.work - s.stored - s.dissipated + s.stored_by_volume));
              by_volume           = std::max(by_volume, std::abs(s.stored_by_volume));
            }
          error[i] /= work;
          by_volume /= work;
        }
      BOOST_TEST_MESSAGE(block << ": " << error[0] << ", " << error[1] << "; by volume " << by_volume);
      BOOST_TEST(error[1] < 1e-6);
      BOOST_TEST(error[1] < 0.27 * error[0]);
      BOOST_TEST(by_volume > 100. * error[1]);
    }
}

BOOST_AUTO_TEST_SUITE_END()
