// Linear viscoelastic solids against the relaxation and creep functions of one-dimensional rheology, here in uniaxial strain, where the
// spring has the stiffness M = K + 4 G/3.

#include <arenite/materials/viscoelastic.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Arenite;

namespace
{
Viscoelastic solid(const Viscoelastic::Model model)
{
  Viscoelastic law;
  law.spring          = {2000., 3e8, 2e8};
  law.model           = model;
  law.relaxation_time = 1e-3;
  law.branch_ratio    = 0.7;
  return law;
}

/// One point in uniaxial strain.
struct Point
{
  explicit Point(const Viscoelastic &law)
    : law(law)
    , history(law.initial_history())
  {}

  /// Axial stress after a step of the axial strain.
  double step(const double strain, const double dt)
  {
    PointIncrement<double> increment;
    increment.strain[0]   = strain;
    increment.density_old = increment.density = 2000.;
    increment.dt                              = dt;
    const SymTensor<double> old               = stress;
    response                                  = law.update(stress, increment, history);
    stress                                    = response.stress;
    work += 0.5 * (old[0] + stress[0]) * strain;
    dissipated += response.dissipated;
    return stress[0];
  }

  const Viscoelastic           &law;
  Viscoelastic::History<double> history;
  SymTensor<double>             stress;
  Response<double>              response;
  double                        work = 0., dissipated = 0.;
};

const double M = 3e8 + 4. / 3. * 2e8, tau = 1e-3;
} // namespace

BOOST_AUTO_TEST_SUITE(viscoelastic)

// A sudden strain that is held relaxes as k(t): Maxwell M e^(-t/tau), standard linear solid M (1 + m e^(-t/tau)). The exponential
// update is exact whatever the step, here a tenth and thirty relaxation times; the strain takes 1e-9 of tau to arrive.
BOOST_AUTO_TEST_CASE(relaxation_functions)
{
  for (const auto model : {Viscoelastic::Model::maxwell, Viscoelastic::Model::standard})
    for (const double dt : {1e-4, 3e-2})
      {
        const Viscoelastic law = solid(model);
        Point              point(law);
        point.step(1e-4, 1e-12);
        for (unsigned int k = 1; k <= 5; ++k)
          {
            const double decay = std::exp(-(k * dt) / tau);
            const double exact = 1e-4 * M * (model == Viscoelastic::Model::maxwell ? decay : 1. + 0.7 * decay);
            BOOST_TEST(std::abs(point.step(0., dt) - exact) < 1e-8 * 1e-4 * M);
          }
      }
}

// A constant strain rate from rest: standard linear solid M (r t + m r tau (1 - e^(-t/tau))), Kelvin-Voigt M r (t + tau); exact in one
// step and in many.
BOOST_AUTO_TEST_CASE(constant_strain_rate)
{
  for (const unsigned int n : {1u, 7u})
    {
      const double       rate = 0.3, t = 2.5e-3;
      const Viscoelastic standard = solid(Viscoelastic::Model::standard),
                         voigt    = solid(Viscoelastic::Model::kelvin_voigt);
      Point  a(standard), b(voigt);
      double stress_a = 0., stress_b = 0.;
      for (unsigned int k = 0; k < n; ++k)
        {
          stress_a = a.step(rate * t / n, t / n);
          stress_b = b.step(rate * t / n, t / n);
        }
      BOOST_TEST(stress_a == M * rate * (t + 0.7 * tau * (1. - std::exp(-t / tau))),
                 boost::test_tools::tolerance(1e-13));
      BOOST_TEST(stress_b == M * rate * (t + tau), boost::test_tools::tolerance(1e-13));
    }
}

// The creep function of the standard linear solid, c(t) = (1/M) (1 - m/(1+m) e^(-t/tau_sigma)), tau_sigma = tau (1 + m), imposed as
// strain keeps the stress at one; its curvature inside of a step leaves an error of second order, (dt/tau)^2/12 of the decaying part.
BOOST_AUTO_TEST_CASE(creep_function)
{
  const double       m = 0.7, tau_sigma = tau * (1. + m);
  const auto         creep = [&](const double t) { return (1. - m / (1. + m) * std::exp(-t / tau_sigma)) / M; };
  const Viscoelastic law   = solid(Viscoelastic::Model::standard);
  double             error[2];
  for (const unsigned int refinement : {0u, 1u})
    {
      Point              point(law);
      const unsigned int n  = refinement ? 100 : 50;
      const double       dt = 5e-3 / n;
      point.step(creep(0.), 1e-12);
      error[refinement] = 0.;
      for (unsigned int k = 1; k <= n; ++k)
        error[refinement] =
          std::max(error[refinement], std::abs(point.step(creep(k * dt) - creep((k - 1) * dt), dt) - 1.));
    }
  BOOST_TEST(error[1] < 1e-4);
  BOOST_TEST(std::log2(error[0] / error[1]) > 1.9);
}

// Work = stored + dissipated energy: the dissipation is integrated in closed form, the work by the trapezoidal rule, so that they
// agree to second order in the step.
BOOST_AUTO_TEST_CASE(energy)
{
  for (const auto model : {Viscoelastic::Model::maxwell, Viscoelastic::Model::standard})
    {
      const Viscoelastic law = solid(model);
      double             gap[2];
      for (const unsigned int refinement : {0u, 1u})
        {
          Point              point(law);
          const unsigned int n = refinement ? 400 : 200;
          for (unsigned int k = 0; k < n; ++k)
            {
              const auto strain = [&](const unsigned int i) { return 1e-3 * std::sin(6. * i / n); };
              point.step(strain(k + 1) - strain(k), 6e-3 / n);
              BOOST_TEST_REQUIRE(point.response.dissipated >= 0.);
            }
          gap[refinement] = std::abs(point.work - point.dissipated - point.response.stored) / point.dissipated;
        }
      BOOST_TEST(gap[1] < 1e-4);
      BOOST_TEST(std::log2(gap[0] / gap[1]) > 1.9);
    }
}

// The step of a Kelvin-Voigt solid on a fine mesh falls with h^2 (parabolic), on a coarse one with h.
BOOST_AUTO_TEST_CASE(parabolic_step_bound)
{
  const Viscoelastic law = solid(Viscoelastic::Model::kelvin_voigt);
  BOOST_TEST(law.stable_step(1e-4) / law.stable_step(5e-5) == 4., boost::test_tools::tolerance(1e-3));
  BOOST_TEST(law.stable_step(1e3) == 1e3 / law.wave_speed_bound(), boost::test_tools::tolerance(1e-3));
  // one mode: (2/omega)(sqrt(1 + xi^2) - xi) -> 1/(omega xi) = h^2/(2 c^2 tau)
  BOOST_TEST(law.stable_step(1e-5) == 1e-10 / (2. * M / 2000. * tau), boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
