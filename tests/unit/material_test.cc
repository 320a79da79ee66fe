// The named tests of the bench on laws whose answers are known.

#include <arenite/base/errors.h>
#include <arenite/materials/law_types.h>
#include <arenite/materials/material_test.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <string>

#include "law_example.h"

using namespace Arenite;

namespace
{
MaterialTest test_from_text(const std::string &entries)
{
  Parameters   parameters = Parameters::from_text("subsection Test\n" + entries + "end\n", "test.prm");
  MaterialTest test;
  test.declare_parameters(parameters);
  parameters.parse();
  test.finalize(parameters);
  return test;
}

/// The state at the end of all legs.
template <typename Law>
PointState run(const Law &law, const std::string &entries, const std::function<void(const PointState &)> &observe = {})
{
  BatchLawFor<Law, 1> batch;
  batch.law = law;
  MaterialPoint      point(batch);
  const MaterialTest test = test_from_text(entries);
  for (const TestLeg &leg : test.legs())
    run_leg(point, leg, test.steps_per_row, [&]() {
      if (observe)
        observe(point.state);
    });
  return point.state;
}

LinearElasticLaw elastic()
{
  LinearElasticLaw law;
  law.elastic = {2000., 2e8, 1e8};
  return law;
}

using Cap = ViscoplasticCap<ConstantStiffness>;
Cap rate_independent() { return law_of_block<Cap>(example_file(Cap::name), "rate independent"); }
} // namespace

BOOST_AUTO_TEST_SUITE(material_test)

// Triaxial: Young's modulus and Poisson's ratio at constant lateral stress, 2 G at constant pressure.
BOOST_AUTO_TEST_CASE(triaxial_elastic)
{
  const auto   law = elastic();
  const double E = law.elastic.young_modulus(), nu = law.elastic.poisson_ratio(), p = 3e5;
  const auto   a =
    run(law, "set Type = triaxial\nset Strains = 0.01, -0.02\nset Rows = 7\nset Confining pressure = 3e5\n");
  const double lateral = -p / (3. * 2e8); // strain under the confining pressure
  BOOST_TEST(a.strain[0] - lateral == -0.02, boost::test_tools::tolerance(1e-10));
  BOOST_TEST(a.strain[1] - lateral == 0.02 * nu, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(a.strain[2] - lateral == 0.02 * nu, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(a.stress[0] == -p - 0.02 * E, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(a.stress[1] == -p, boost::test_tools::tolerance(1e-8));

  const auto b = run(law, "set Type = triaxial\nset Lateral = constant pressure\nset Strains = -0.02\nset Rows = 7\n"
                          "set Confining pressure = 3e5\n");
  BOOST_TEST(pressure(b.stress) == p, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(b.stress[0] == -p - 0.02 * 2. * 1e8, boost::test_tools::tolerance(1e-9));
}

// Creep and relaxation of a Maxwell solid in simple shear: gamma = (s/G) (1 + (hold + loading/2)/tau), s = s_0 exp(-t/tau).
BOOST_AUTO_TEST_CASE(creep_and_relaxation_of_a_maxwell_solid)
{
  auto         law = law_of_block<Viscoelastic>(example_file(Viscoelastic::name), "Maxwell");
  const double G = law.spring.shear_modulus, tau = law.relaxation_time;
  const auto   creep = run(law, "set Type = creep\nset Mode = simple shear\nset Stress = 1e5\nset Loading time = 1e-3\n"
                                  "set Hold time = 2e-3\nset Rows = 50\nset Steps per row = 4\n");
  BOOST_TEST(creep.stress[3] == 1e5, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(2. * creep.strain[3] == 1e5 / G * (1. + (0.5 * 1e-3 + 2e-3) / tau), boost::test_tools::tolerance(1e-4));

  const double rate = 1e-3 / 1e-6; // so fast that the ramp does not relax
  const auto   relaxed =
    run(law, "set Type = relaxation\nset Mode = simple shear\nset Strains = 1e-3\nset Strain rate = " +
               std::to_string(rate) + "\nset Hold time = 2e-3\nset Rows = 50\n");
  const double end_of_ramp = G * rate * tau * (1. - std::exp(-1e-6 / tau));
  BOOST_TEST(relaxed.stress[3] == end_of_ramp * std::exp(-2e-3 / tau), boost::test_tools::tolerance(1e-9));
}

// Isotropic compression by stress moves the cap to I1 = X; the cap in triaxial compression flows on its surface while the lateral
// stress stays.
BOOST_AUTO_TEST_CASE(cap_under_mixed_control)
{
  const Cap  law       = rate_independent();
  const auto by_stress = run(law, "set Type = creep\nset Mode = isotropic\nset Stress = -5e6\nset Rows = 20\n");
  BOOST_TEST(pressure(by_stress.stress) == 5e6, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(law.surface.cap(by_stress.history[0]).X == 15e6, boost::test_tools::tolerance(1e-8)); // I1 = X

  for (const std::string lateral : {"constant stress", "constant pressure"})
    for (const std::string strain : {"-0.1", "0.02"}) // compression and extension
      {
        double     worst_stress = 0., worst_yield = 0.;
        bool       confined = false;
        const auto end =
          run(law,
              "set Type = triaxial\nset Lateral = " + lateral + "\nset Strains = " + strain +
                "\nset Confining pressure = 1e6\nset Rows = 60\n",
              [&](const PointState &s) {
                confined = confined || std::abs(pressure(s.stress) / 1e6 - 1.) < 1e-9;
                if (!confined)
                  return;
                const double held = lateral == "constant stress" ? -s.stress[1] : pressure(s.stress);
                worst_stress      = std::max(worst_stress, std::abs(held / 1e6 - 1.));
                const double I1 = -trace(s.stress), j = std::sqrt(second_invariant(deviator(s.stress)));
                worst_yield = std::max(worst_yield, law.surface.yield_function(I1, j, law.surface.cap(s.history[0])));
              });
        BOOST_TEST_CONTEXT(lateral << ", strain " << strain)
        {
          BOOST_TEST(worst_stress < 1e-8);
          BOOST_TEST(worst_yield < 1e-8 * law.surface.F0);
          // flows: on the surface at the end
          const double I1 = -trace(end.stress), j = std::sqrt(second_invariant(deviator(end.stress)));
          BOOST_TEST(std::abs(law.surface.yield_function(I1, j, law.surface.cap(end.history[0]))) < 1e-6 * j);
        }
      }
}

// A stress that no state carries ends the test, and says so.
BOOST_AUTO_TEST_CASE(stress_beyond_the_strength)
{
  BOOST_CHECK_EXCEPTION(run(rate_independent(), "set Type = creep\nset Mode = triaxial\nset Stress = -1e8\n"
                                                "set Confining pressure = 1e6\n"),
                        PhysicsAlarm, [](const PhysicsAlarm &alarm) {
                          return std::string(alarm.what()).find("beyond the strength") != std::string::npos;
                        });
}

// A closed cycle of strain ends where it began; jumps to Hugoniot states conserve mass and momentum.
BOOST_AUTO_TEST_CASE(cycles_and_shocks)
{
  const auto end = run(elastic(), "set Type = strain cycle\nset First strain = -0.01, 0, 0, 0, 0, 0.01\n"
                                  "set Second strain = 0, 0.01, 0, 0.02, 0, 0\nset Cycles = 3\nset Rows = 10\n");
  for (int k = 0; k < 6; ++k)
    {
      BOOST_TEST(std::abs(end.strain[k]) < 1e-15);
      BOOST_TEST(std::abs(end.stress[k]) < 1e-6);
    }
  PointState ahead;
  ahead.density = 2000.;
  const auto shock =
    run(elastic(), "set Type = Hugoniot\nset Strains = -0.1\nset States = jumps\nset Rows = 4\n",
        [&](const PointState &s) {
          const ShockJump h = shock_jump(ahead, s);
          BOOST_TEST(2000. * h.shock_speed == s.density * (h.shock_speed - h.particle_speed),
                     boost::test_tools::tolerance(1e-12));
          BOOST_TEST(-s.stress[0] == 2000. * h.shock_speed * h.particle_speed, boost::test_tools::tolerance(1e-12));
        });
  BOOST_TEST(shock.strain[0] == -0.1, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
