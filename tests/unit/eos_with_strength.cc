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
    work += .5 * contract(deviator(old) * v_n + deviator(stress) * v, deviator(increment)) -
            .5 * (pressure(old) + pressure(stress)) * (v - v_n);
    dissipated += response.dissipated * .5 * (v_n + v);
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

// Linear compression with elastic shear is Hooke's law in logarithmic strain: for the pressure in Cauchy, for the deviator in Kirchhoff
// stress. Nothing is lost. Round-off.
BOOST_AUTO_TEST_CASE(hooke)
{
  using Law = EquationOfStateWithStrength<LinearCompression, ElasticShear>;
  Law law{linear(), {}};
  law.strength.shear_modulus = 2e8;
  LawPoint<Law> point(law);
  for (int i = 0; i < 10; ++i)
    point.strain(uniaxial(-1e-3));
  const double J = std::exp(-1e-2);
  BOOST_TEST(point.stress[2] == -1e-2 * (4e8 + 4. / 3. * 2e8 / J), tolerance(1e-12));
  BOOST_TEST(point.stress[0] == -1e-2 * (4e8 - 2. / 3. * 2e8 / J), tolerance(1e-12));
  BOOST_TEST(point.response.wave_speed == std::sqrt(4e8 / point.density + 4. / 3. * 2e8 / 1800.), tolerance(1e-12));
  BOOST_TEST(std::abs(point.dissipated) < 1e-13 * point.work);
  BOOST_TEST(point.response.stored / point.density == point.work,
             tolerance(1e-5)); // ten steps of second order in the pressure
}

// In uniaxial strain beyond yield the difference of the stresses is the yield stress, whatever the equation of state; with hardening the
// closed form of the radial return for proportional loading. Round-off.
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
  // plastic strain: equivalent strain 2/3 |eps| less the elastic part J Y/(3 G)
  const double J = std::exp(-1e-2), elastic_part = J * 1e6 / 3e9;
  BOOST_TEST(point.history.shear.plastic_strain == 1e-2 * 2. / 3. - elastic_part, tolerance(1e-10));
  // plastic work per reference volume: int J Y d ep, ep = -2/3 ln J - J Y/(3 G), from yield to the end; fine steps, because the mean
  // stress of the step that yields is not Y
  LawPoint<Law> fine(law);
  for (int i = 0; i < 10000; ++i)
    fine.strain(uniaxial(-1e-6));
  const double at_yield = std::exp(-5e-4),
               plastic  = 1e6 * 2. / 3. * (at_yield - J) - 1e12 / 6e9 * (J * J - at_yield * at_yield);
  BOOST_TEST(fine.dissipated == plastic / 1800., tolerance(1e-4)); // ln J at yield to second order in Y/G
  BOOST_TEST(point.history.heat == point.dissipated, tolerance(1e-12));
  // all work is internal energy: of the pressure, and of the shear
  BOOST_TEST(point.history.volume.energy + J * J * 1e12 / (6. * 1e9) / 1800. == point.work, tolerance(1e-10));
  BOOST_TEST(point.response.stored / point.density + point.dissipated == point.work, tolerance(1e-12));

  law.strength.hardening = 5e8;
  LawPoint<Law> hard(law);
  for (int i = 0; i < 10; ++i)
    hard.strain(uniaxial(-1e-3));
  // q = Y0 + H ep and J q = 3 G (2/3 eps - ep)
  const double ep = (3e9 * 2e-2 / 3. - J * 1e6) / (3e9 + J * 5e8);
  BOOST_TEST(hard.history.shear.plastic_strain == ep, tolerance(1e-10));
  BOOST_TEST(hard.stress[0] - hard.stress[2] == 1e6 + 5e8 * ep, tolerance(1e-10));

  // n = 0.3, same condition: 3 G (2/3 eps - ep) = J (Y0 + H ep^n)
  law.strength.hardening          = 5e6;
  law.strength.hardening_exponent = .3;
  LawPoint<Law> curved(law);
  for (int i = 0; i < 10; ++i)
    curved.strain(uniaxial(-1e-3));
  const double p_s = curved.history.shear.plastic_strain, q_s = curved.stress[0] - curved.stress[2];
  BOOST_TEST(q_s == 1e6 + 5e6 * std::pow(p_s, .3), tolerance(1e-10));
  BOOST_TEST(J * q_s == 3e9 * (2e-2 / 3. - p_s), tolerance(1e-10));
  law.strength.hardening_exponent = 1.;

  // plastic strain about two decades above the reference rate, C = 0.1
  law.strength.hardening           = 0.;
  law.strength.rate.coefficient    = .1;
  law.strength.rate.reference_rate = 2. / 3. * 1e-3 / 1e-6 / 100.;
  LawPoint<Law> fast(law);
  double        before = 0.;
  for (int i = 0; i < 10; ++i)
    {
      before = fast.history.shear.plastic_strain;
      fast.strain(uniaxial(-1e-3), 1e-6);
    }
  const double rate = (fast.history.shear.plastic_strain - before) / 1e-6 / law.strength.rate.reference_rate;
  BOOST_TEST(rate == 100., tolerance(1e-3)); // J Y/(3 G) falls on the way
  BOOST_TEST(fast.stress[0] - fast.stress[2] == 1e6 * (1. + .1 * std::log(rate)), tolerance(1e-10));
  // at rest the stress goes down to the static strength, q = Y (1 + C ln(ep_dot/rate_0)) all the way: 3 G dep = -dq, explicit Euler
  double q = fast.stress[0] - fast.stress[2], time = 0.;
  for (; time < 1e-3; time += 1e-7)
    q -= 1e-7 * 3e9 / J * law.strength.rate.reference_rate * std::exp((q / 1e6 - 1.) / .1);
  for (int i = 0; i < 10000; ++i)
    fast.strain(SymTensor<double>(), 1e-7);
  BOOST_TEST(fast.stress[0] - fast.stress[2] == std::max(1e6, q), tolerance(1e-3));
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

  // with the plastic rate of the last step
  law.strength.rate.coefficient = .02;
  for (const double ratio : {.01, 1., 1000.})
    {
      law.strength.rate.reference_rate = 2. / 3. * 1e-3 / 1e-6 / ratio;
      LawPoint<Law> rated(law);
      double        before = 0.;
      for (int i = 0; i < 60; ++i)
        {
          before = rated.history.shear.plastic_strain;
          rated.strain(uniaxial(-1e-3), 1e-6);
        }
      const double F    = std::min(2e7, 1e4 + .6 * pressure(rated.stress)),
                   rate = (rated.history.shear.plastic_strain - before) / 1e-6 / law.strength.rate.reference_rate;
      BOOST_TEST(rate < ratio);       // a part is elastic
      BOOST_TEST(rate > .05 * ratio); // friction: the strength grows with the pressure, most of the strain is elastic
      BOOST_TEST(root(rated) == F * (1. + .02 * std::max(0., std::log(rate))), tolerance(1e-12));
    }
}

namespace
{
/// Of a random path of four legs that ends where it began, in steps of one @p n-th of a leg.
struct Ledgers
{
  double gain = 0., gap = 0.; ///< energy won, and |work - stored - dissipated|, both of the largest work on the way
};
template <typename Law>
Ledgers random_path(const Law &law, const unsigned int path, const int n)
{
  std::mt19937                           generator(path);
  std::uniform_real_distribution<double> number(-1., 1.);
  LawPoint<Law>                          point(law);
  double                                 largest = 0.;
  SymTensor<double>                      total;
  for (int leg = 0; leg < 4; ++leg)
    {
      SymTensor<double> increment;
      for (int k = 0; k < 6; ++k)
        increment[k] = leg < 3 ? .02 * number(generator) - (k < 3 && leg == 0 ? .02 : 0.) : -total[k];
      total += increment;
      for (int i = 0; i < n; ++i)
        {
          point.strain(increment * (1. / n), 1e-3 / n);
          BOOST_TEST_REQUIRE(point.response.wave_speed <= law.wave_speed_bound() * 1.001);
          largest = std::max(largest, std::abs(point.work));
        }
    }
  return {-point.work / largest,
          std::abs(point.response.stored / point.density + point.dissipated - point.work) / largest};
}
} // namespace

// Work is what is stored and what is dissipated: to round-off where the energy of the volume is integrated with its pressure, to second
// order in the step elsewhere. No closed path wins energy; what seems to be won is the error of the mean pressure, and falls in the same way.
BOOST_AUTO_TEST_CASE(random_paths)
{
  using Kind = SelectedStrength::Kind;
  for (const Kind kind : {Kind::none, Kind::elastic, Kind::mises, Kind::friction})
    for_every_equation_of_state([kind](const auto &eos, double, double) {
      using EOS = std::decay_t<decltype(eos)>;
      const EquationOfStateWithStrength<EOS> law{eos, selected(kind)};
      double                                 gain[2] = {}, gap[2] = {};
      for (unsigned int path = 1; path <= 10; ++path)
        for (const int level : {0, 1})
          {
            const Ledgers ledgers = random_path(law, path, level == 0 ? 200 : 800);
            gain[level]           = std::max(gain[level], ledgers.gain);
            gap[level]            = std::max(gap[level], ledgers.gap);
          }
      BOOST_TEST_MESSAGE(EOS::name << ", strength " << int(kind) << ": gain " << gain[0] << ' ' << gain[1] << ", gap "
                                   << gap[0] << ' ' << gap[1]);
      BOOST_TEST(gap[1] < (EOS::uses_energy ? 1e-9 : std::max(1e-10, gap[0] / 8.))); // second order: 1/16
      BOOST_TEST(gap[1] < 1e-3);
      BOOST_TEST(gain[1] < std::max(1e-9, gain[0] / 8.));
      BOOST_TEST(gain[1] < 1e-3);
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
      law.strength.friction.rate.coefficient = law.strength.mises.rate.coefficient = .05;
      law.strength.mises.hardening_exponent                                        = .5;
      std::mt19937                                     generator(4);
      std::uniform_real_distribution<double>           number(-1., 1.);
      std::vector<LawPoint<Law>>                       scalar(native_lanes, LawPoint<Law>(law));
      const Point<std::decay_t<decltype(eos)>, Number> start(eos); // spreads the initial history over the lanes
      typename Law::template History<Number>           history;
      history.volume              = start.history;
      history.shear.shear_modulus = Number(law.initial_history().shear.shear_modulus);
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
