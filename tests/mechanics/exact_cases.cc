#include <arenite/verification/free_vibration.h>

#include <cmath>

#include "body.h"
#include "cavity_scene.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;

namespace
{
/// Solid ball of radius 1 m as scenes make it.
std::function<void(Body::Triangulation &)> ball(const std::string &sector, const unsigned int refinement)
{
  return [=](Body::Triangulation &triangulation) {
    Parameters parameters =
      Parameters::from_text("subsection Mesh\nset Sector = " + sector + "\nset Radius = 1\nend\n", "test");
    const auto geometry = geometries<3>().make("ball");
    {
      const auto section = parameters.section("Mesh");
      geometry->declare_parameters(parameters);
    }
    parameters.parse();
    geometry->finalize(parameters);
    geometry->create(triangulation);
    triangulation.refine_global(refinement);
  };
}

/// Angular frequency with which the body swings when it starts in the given mode. The projection q on the mode obeys
/// q(t + dt) + q(t - dt) = 2 cos(w dt) q(t); sin(w dt/2) = w_h dt/2 takes the known error of central differences out.
double frequency(Body &body, const FreeVibration<3> &mode)
{
  body.set(body.state.displacement, [&](const Point<3> &x) { return mode.mode(x); });
  body.constraints.project(body.state.displacement);
  const VectorType  shape = body.state.displacement;
  StableTimeStep<3> limit;
  limit.calibrate(*body.dynamics);
  const double       dt        = 0.8 * limit.limit();
  const unsigned int n_steps   = 1.5 * 2. * numbers::PI / mode.angular_frequency() / dt;
  double             numerator = 0., denominator = 0., q[3] = {0., 0., 0.};
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      q[0] = q[1];
      q[1] = q[2];
      q[2] = 0.;
      for (unsigned int i = 0; i < shape.locally_owned_size(); ++i)
        if (const double w = body.state.inverse_mass.local_element(i); w > 0.)
          q[2] += shape.local_element(i) * body.state.displacement.local_element(i) / w;
      if (k >= 2)
        {
          numerator += (q[2] + q[0]) * q[1];
          denominator += 2. * q[1] * q[1];
        }
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, dt);
      body.dynamics->advance(body.state, dt);
    }
  return 2. / dt * std::sin(0.5 * std::acos(numerator / denominator));
}

/// The relative error of the frequency is below @p most[degree] on the finer of two meshes and falls with order p + 0.8 at least.
void check_frequencies(const std::string &name, const FreeVibration<3> &mode, const std::string &sector,
                       const std::vector<types::boundary_id> &planes, const unsigned int (&first)[5],
                       const double (&most)[5])
{
  for (const unsigned int degree : {1u, 2u, 4u})
    {
      double error[2];
      for (const unsigned int k : {0u, 1u})
        {
          Body body(element(degree), ball(sector, first[degree] + k));
          body.constraints.set_symmetry(planes);
          body.assemble();
          error[k] = std::abs(frequency(body, mode) / mode.angular_frequency() - 1.);
        }
      const double order = std::log2(error[0] / error[1]);
      BOOST_TEST_MESSAGE(name << ", degree " << degree << ": " << error[0] << " " << error[1] << " order " << order);
      BOOST_TEST(error[1] < most[degree]);
      BOOST_TEST(order > degree + 0.8);
    }
}
} // namespace

BOOST_AUTO_TEST_SUITE(exact_cases)

// Pressure step (three continuous derivatives, rise in 1.5e-4 s) in the cavity: displacement at twelve generic receivers.
BOOST_AUTO_TEST_CASE(cavity_under_pressure_step)
{
  const RunRecord record = run_scene(cavity_scene, {"Mesh/Refinement=2", "Loads/far field/Condition=spherical"});
  for (const auto &[name, error] : record.errors)
    BOOST_TEST_MESSAGE("pressure step: " << name << " " << error);
  BOOST_TEST(record.errors.at("array.displacement.E_t") < 1e-3); // measured 2.8e-4
  BOOST_TEST(record.errors.at("array.stress.E_t") < 5e-3);       // 2.5e-3
  BOOST_TEST(record.errors.at("volume.displacement.E_x") < 2e-4);
  BOOST_TEST(record.energy_error < 1e-12);
}

// Smooth pulse sin^6, 1.2 ms long, in the same cavity: a quarter of the cells resolve it.
BOOST_AUTO_TEST_CASE(cavity_under_smooth_pulse)
{
  std::string scene   = cavity_scene;
  const auto  replace = [&](const std::string &what, const std::string &by) {
    scene.replace(scene.find(what), what.size(), by);
  };
  replace("set History   = C3 step", "set History   = sin^n pulse\n    set Exponent = 6");
  replace("set Rise time = 1.5e-4", "set Duration  = 1.2e-3");
  const RunRecord record = run_scene(scene, {"Mesh/Refinement=1", "Loads/far field/Condition=spherical"});
  for (const auto &[name, error] : record.errors)
    BOOST_TEST_MESSAGE("smooth pulse: " << name << " " << error);
  BOOST_TEST(record.errors.at("array.displacement.E_t") < 1e-3);
  BOOST_TEST(record.errors.at("array.stress.E_t") < 5e-3);
  BOOST_TEST(record.energy_error < 1e-12);
}

// Breathing of a solid ball, tan x = x/(1 - (x^2/4)(cp/cs)^2) with x = w b/cp (the first root).
BOOST_AUTO_TEST_CASE(ball_breathing)
{
  const LinearElastic law = soil();
  BreathingMode<3>    mode(law, 0., 1.);
  check_frequencies("ball breathing", mode, "octant", {2, 3, 4}, {0, 2, 1, 0, 0}, {0., 1e-2, 1e-3, 0., 1e-4});
}

// Twisting of a solid ball, tan x = 3 x/(3 - x^2) with x = w b/cs = 5.763459196895 for every Poisson ratio. The whole ball: the
// planes through the axis move.
BOOST_AUTO_TEST_CASE(ball_torsion)
{
  const LinearElastic law = soil();
  const TorsionMode   mode(law, 1.);
  check_frequencies("ball torsion", mode, "full", {}, {0, 2, 1, 0, 0}, {0., 5e-2, 1e-2, 0., 1e-3});
}

BOOST_AUTO_TEST_SUITE_END()
