#include <arenite/materials/eos_with_strength.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <string>

#include "equation_of_state_cases.h"

using namespace Arenite;
using namespace EquationOfStateCases;
using boost::test_tools::tolerance;

namespace
{
SelectedStrength selected(const SelectedStrength::Kind kind)
{
  SelectedStrength strength;
  strength.kind                  = kind;
  strength.elastic.poisson_ratio = .25;
  strength.mises.elastic         = strength.elastic;
  strength.mises.yield_stress    = 1e6;
  strength.mises.hardening       = 1e7;
  strength.friction.elastic      = strength.elastic;
  strength.friction.cohesion     = 1e4;
  strength.friction.slope        = .2;
  return strength;
}

/// A point of a law that takes strain increments.
template <typename Law>
struct LawPoint
{
  const Law                             &law;
  typename Law::template History<double> history = law.initial_history();
  SymTensor<double>                      stress;
  double                                 density = law.density(), work = 0., dissipated = 0.; ///< [J/kg]
  Response<double>                       response;

  explicit LawPoint(const Law &law)
    : law(law)
  {}

  void strain(const SymTensor<double> &increment, const double dt = 1e-6)
  {
    PointIncrement<double> step;
    step.strain                 = increment;
    step.density_old            = density;
    step.density                = density * std::exp(-trace(increment));
    step.dt                     = dt;
    const SymTensor<double> old = stress;
    response                    = law.update(stress, step, history);
    stress                      = response.stress;
    const double v_n = 1. / density, v = 1. / step.density;
    work += .5 * contract(deviator(old) + deviator(stress), deviator(increment)) * .5 * (v_n + v) -
            .5 * (pressure(old) + pressure(stress)) * (v - v_n);
    dissipated += response.dissipated / step.density;
    density = step.density;
  }
};

SymTensor<double> uniaxial(const double strain)
{
  SymTensor<double> e;
  e[2] = strain;
  return e;
}
} // namespace

BOOST_AUTO_TEST_SUITE(eos_with_strength)

BOOST_AUTO_TEST_CASE(is_a_law)
{
  using Number = Lanes<native_lanes>;
  for_every_equation_of_state([](const auto &eos, double, double) {
    using Law = EquationOfStateWithStrength<std::decay_t<decltype(eos)>>;
    static_assert(IsMaterialLaw<Law>::value, "");
    static_assert(IsMaterialLaw<Law, Number>::value, "");
    static_assert(IsMaterialLaw<EquationOfStateWithStrength<std::decay_t<decltype(eos)>, NoStrength>>::value, "");
  });
}

// Linear compression with elastic shear is Hooke's law in logarithmic strain. Round-off.
BOOST_AUTO_TEST_CASE(hooke)
{
  using Law = EquationOfStateWithStrength<LinearCompression, ElasticShear>;
  Law law{linear(), {}};
  law.strength.shear_modulus = 2e8;
  LawPoint<Law> point(law);
  for (int i = 0; i < 10; ++i)
    point.strain(uniaxial(-1e-3));
  BOOST_TEST(point.stress[2] == -1e-2 * (4e8 + 4. / 3. * 2e8), tolerance(1e-12));
  BOOST_TEST(point.stress[0] == -1e-2 * (4e8 - 2. / 3. * 2e8), tolerance(1e-12));
  BOOST_TEST(point.response.wave_speed == std::sqrt((4e8 + 4. / 3. * 2e8) / point.density), tolerance(1e-12));
  // nothing is lost but what belongs to Hooke's law per present volume: a third of the volume change of 1 % in the shear
  BOOST_TEST(std::abs(point.dissipated) < 3.4e-3 * point.work);
  BOOST_TEST(point.response.stored / point.density + point.dissipated == point.work, tolerance(1e-12));
}

// In uniaxial strain beyond yield the deviator is two thirds of the yield stress, whatever the equation of state; with hardening
// closed form of the radial return: q = (3 G eps' ...)/(...) for proportional loading. Round-off.
BOOST_AUTO_TEST_CASE(mises_uniaxial)
{
  using Law = EquationOfStateWithStrength<MieGrueneisen, MisesStrength>;
  Law law{wet_soil(), {}};
  law.strength.elastic.shear_modulus = 1e9;
  law.strength.yield_stress          = 1e6;
  LawPoint<Law> point(law);
  for (int i = 0; i < 10; ++i)
    point.strain(uniaxial(-1e-3));
  BOOST_TEST(point.stress[0] - point.stress[2] == 1e6, tolerance(1e-10));
  // plastic strain: equivalent strain 2/3 |eps| less the elastic part Y/(3 G)
  BOOST_TEST(point.history.shear.plastic_strain == 1e-2 * 2. / 3. - 1e6 / 3e9, tolerance(1e-10));
  // plastic work: Y times plastic strain per volume; the density changes by 1 %
  const double plastic = 1e6 * point.history.shear.plastic_strain / (.5 * (1800. + point.density));
  const double elastic = 1e6 * 1e6 / (6. * 1e9) / 1800.;
  BOOST_TEST(point.history.volume.energy > plastic);
  BOOST_TEST(point.response.stored / point.density + point.dissipated == point.work, tolerance(1e-12));
  BOOST_TEST(point.history.volume.energy == point.work, tolerance(1e-10)); // all work is internal energy
  BOOST_TEST_MESSAGE("plastic " << plastic << " elastic " << elastic << " J/kg");

  law.strength.hardening = 5e8;
  LawPoint<Law> hard(law);
  for (int i = 0; i < 10; ++i)
    hard.strain(uniaxial(-1e-3));
  // q = Y0 + H ep and q = 3 G (2/3 eps - ep)
  const double ep = (3e9 * 2e-2 / 3. - 1e6) / (3e9 + 5e8);
  BOOST_TEST(hard.history.shear.plastic_strain == ep, tolerance(1e-10));
  BOOST_TEST(hard.stress[0] - hard.stress[2] == 1e6 + 5e8 * ep, tolerance(1e-10));

  // n = 0.3, same condition: 3 G (2/3 eps - ep) = Y0 + H ep^n
  law.strength.hardening          = 5e6;
  law.strength.hardening_exponent = .3;
  LawPoint<Law> curved(law);
  for (int i = 0; i < 10; ++i)
    curved.strain(uniaxial(-1e-3));
  const double p_s = curved.history.shear.plastic_strain, q_s = curved.stress[0] - curved.stress[2];
  BOOST_TEST(q_s == 1e6 + 5e6 * std::pow(p_s, .3), tolerance(1e-10));
  BOOST_TEST(q_s == 3e9 * (2e-2 / 3. - p_s), tolerance(1e-10));
  law.strength.hardening_exponent = 1.;

  // two decades above the reference rate, C = 0.1: 1 + 0.1 ln 100
  law.strength.hardening        = 0.;
  law.strength.rate_coefficient = .1;
  law.strength.reference_rate   = 2. / 3. * 1e-3 / 1e-6 / 100.;
  LawPoint<Law> fast(law);
  for (int i = 0; i < 10; ++i)
    fast.strain(uniaxial(-1e-3), 1e-6);
  BOOST_TEST(fast.stress[0] - fast.stress[2] == 1e6 * (1. + .1 * std::log(100.)), tolerance(1e-10));
}

// Friction: sqrt(J2) = k + 3 alpha p up to the largest strength, times the rate factor; none in a gap; slow loading keeps the
// static strength.
BOOST_AUTO_TEST_CASE(friction)
{
  using Law = EquationOfStateWithStrength<SoilStiffening, FrictionStrength>;
  Law law{stiffening(), selected(SelectedStrength::Kind::friction).friction};
  law.strength.largest_strength = 2e7;
  LawPoint<Law> point(law);
  const auto    root = [](const LawPoint<Law> &p) { return std::sqrt(second_invariant(deviator(p.stress))); };
  for (int i = 0; i < 100; ++i)
    {
      point.strain(uniaxial(-1e-3));
      const double F = std::min(2e7, 1e4 + .6 * pressure(point.stress));
      BOOST_TEST(root(point) <= F * (1. + 1e-12));
      if (i > 20)
        BOOST_TEST(root(point) == F, tolerance(1e-12));
    }
  for (int i = 0; i < 100; ++i)
    point.strain(uniaxial(-1e-3));
  BOOST_TEST(root(point) == 2e7, tolerance(1e-12));
  for (int i = 0; i < 300; ++i)
    point.strain(uniaxial(1e-3));
  BOOST_TEST(pressure(point.stress) == -1e5, tolerance(1e-12));
  BOOST_TEST(root(point) < 1.); // no strength: 1e4 - 0.6 1e5 < 0

  // 1 + 0.02 ln 1000 = 1.14: the elastic trial exceeds the static strength by no more than 16 % on this path
  law.strength.rate_coefficient = .02;
  for (const double ratio : {.01, 1., 1000.})
    {
      law.strength.reference_rate = 2. / 3. * 1e-3 / 1e-6 / ratio;
      LawPoint<Law> rated(law);
      for (int i = 0; i < 60; ++i)
        rated.strain(uniaxial(-1e-3), 1e-6);
      const double F = std::min(2e7, 1e4 + .6 * pressure(rated.stress));
      BOOST_TEST(root(rated) == F * (1. + .02 * std::max(0., std::log(ratio))), tolerance(1e-12));
    }
}

// What is stored and what is dissipated make the work of the step, for every law, and no wave is faster than the bound. A closed cycle
// of a fluid gives no energy; tolerance: trapezoidal rule in steps of 0.05 %, across the tension limit.
BOOST_AUTO_TEST_CASE(random_paths)
{
  using Kind = SelectedStrength::Kind;
  for (const Kind kind : {Kind::none, Kind::elastic, Kind::mises, Kind::friction})
    for_every_equation_of_state([kind](const auto &eos, double, double) {
      using Law = EquationOfStateWithStrength<std::decay_t<decltype(eos)>>;
      const Law                              law{eos, selected(kind)};
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> number(-1., 1.);
      double                                 worst = 0.;
      for (int path = 0; path < 5; ++path)
        {
          LawPoint<Law>     point(law);
          double            largest = 0.;
          SymTensor<double> total;
          for (int leg = 0; leg < 4; ++leg)
            {
              SymTensor<double> increment;
              for (int k = 0; k < 6; ++k)
                increment[k] = leg < 3 ? .02 * number(generator) - (k < 3 && leg == 0 ? .02 : 0.) : -total[k];
              total += increment;
              for (int i = 0; i < 200; ++i)
                {
                  point.strain(increment * (1. / 200.));
                  BOOST_TEST_REQUIRE(point.response.wave_speed <= law.wave_speed_bound() * 1.001);
                }
              largest = std::max(largest, std::abs(point.work));
            }
          // round-off of sums whose terms are as large as the largest work on the path
          BOOST_TEST_REQUIRE(std::abs(point.response.stored / point.density + point.dissipated - point.work) <
                             1e-11 * largest);
          worst = std::min(worst, point.work / largest);
        }
      if (kind == Kind::none)
        BOOST_TEST(worst > -1e-2);
    });
}

// Lanes equal doubles. Tolerance as for the equations of state.
BOOST_AUTO_TEST_CASE(lanes_equal_scalar)
{
  using Number = Lanes<native_lanes>;
  using Kind   = SelectedStrength::Kind;
  for (const Kind kind : {Kind::mises, Kind::friction})
    for_every_equation_of_state([kind](const auto &eos, double, double) {
      using Law = EquationOfStateWithStrength<std::decay_t<decltype(eos)>>;
      Law law{eos, selected(kind)};
      law.strength.friction.rate_coefficient = law.strength.mises.rate_coefficient = .05;
      law.strength.mises.hardening_exponent                                        = .5;
      std::mt19937                                     generator(4);
      std::uniform_real_distribution<double>           number(-1., 1.);
      std::vector<LawPoint<Law>>                       scalar(native_lanes, LawPoint<Law>(law));
      const Point<std::decay_t<decltype(eos)>, Number> start(eos); // spreads the initial history over the lanes
      typename Law::template History<Number>           history;
      history.volume = start.history;
      SymTensor<Number> stress;
      Number            density(law.density());
      for (int step = 0; step < 100; ++step)
        {
          PointIncrement<Number> increment;
          increment.density_old = density;
          increment.dt          = 1e-5;
          Number ratio(1.);
          for (int l = 0; l < native_lanes; ++l)
            {
              SymTensor<double> e;
              for (int k = 0; k < 6; ++k)
                {
                  e[k] = .002 * number(generator) - (k < 3 && step < 50 ? .001 : 0.);
                  set_lane(increment.strain[k], l, e[k]);
                }
              set_lane(ratio, l, std::exp(-trace(e)));
              scalar[l].strain(e, 1e-5);
            }
          density = increment.density     = density * ratio;
          const Response<Number> response = law.update(stress, increment, history);
          stress                          = response.stress;
          for (int l = 0; l < native_lanes; ++l)
            for (int k = 0; k < 6; ++k)
              BOOST_TEST_REQUIRE(std::abs(lane(stress[k], l) - scalar[l].stress[k]) <=
                                 1e-10 * scalar[l].density * std::pow(scalar[l].response.wave_speed, 2));
        }
    });
}

// After a transfer the deviator is back on the surface, the pressure unchanged.
BOOST_AUTO_TEST_CASE(transfer)
{
  using Law = EquationOfStateWithStrength<SoilStiffening>;
  const Law         law{stiffening(), selected(SelectedStrength::Kind::friction)};
  auto              history = law.initial_history();
  SymTensor<double> stress  = spherical(-1e6);
  stress[3]                 = 5e6;
  law.after_transfer(stress, history);
  BOOST_TEST(pressure(stress) == 1e6, tolerance(1e-12));
  BOOST_TEST(stress[3] == 1e4 + .6e6, tolerance(1e-12));
}

// In a scene: the equation of state is the law, the strength an entry of it.
BOOST_AUTO_TEST_CASE(entries)
{
  Parameters parameters =
    Parameters::from_text("set Density = 1800\nset Bulk modulus = 4e8\nset Strength = drucker prager\n"
                          "set Friction slope = 0.2\nset Poisson ratio = 0.3\n",
                          "scene.prm");
  EquationOfStateWithStrength<LinearCompression> law;
  law.declare_parameters(parameters);
  parameters.parse();
  law.finalize(parameters);
  BOOST_TEST((law.strength.kind == SelectedStrength::Kind::friction));
  BOOST_TEST(law.strength.friction.slope == .2);
  BOOST_TEST(law.wave_speed_bound() > std::sqrt(4e8 * (1. + 4. / 3. * .4615) / 1800.));
}

BOOST_AUTO_TEST_SUITE_END()
