#include <arenite/io/error_norms.h>
#include <arenite/loads/body_force.h>
#include <arenite/verification/free_vibration.h>
#include <arenite/verification/manufactured.h>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
double order(const double coarse, const double fine) { return std::log2(coarse / fine); }

/// Relative error of the displacement at @p end of a manufactured motion whose boundary values are prescribed.
double manufactured_error(const ElementChoice &choice, std::shared_ptr<const ExactSolution<3>> exact,
                          const std::function<void(Body::Triangulation &)> &make_mesh,
                          const std::vector<types::boundary_id> &boundaries, const double courant, const double end)
{
  Body body(choice, make_mesh);
  body.constraints.set_exact(boundaries, exact.get());
  std::vector<std::unique_ptr<Load<3>>> loads;
  loads.push_back(std::make_unique<BodyForce<3>>(exact));
  body.assemble(std::move(loads));
  body.set(body.state.displacement, [&](const Point<3> &x) { return exact->displacement(x, 0.); });
  body.set(body.state.half_velocity, [&](const Point<3> &x) { return exact->velocity(x, 0.); });
  zero_at_hanging_nodes(body.discretization, body.state.half_velocity);
  StableTimeStep<3> limit;
  limit.calibrate(*body.dynamics);
  const unsigned int n_steps = std::ceil(end / (courant * limit.limit()));
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, end / n_steps);
      body.dynamics->advance(body.state, end / n_steps);
    }
  make_consistent(body.discretization, body.state.displacement);
  return volume_errors<3>(
           body.discretization, [&](types::material_id) { return body.law; }, body.state.displacement,
           body.state.displacement, *exact, end)
    .at("volume.displacement.E_x");
}

/// Errors on two nested meshes; the step falls with h^((p+1)/2) so that the error in time stays below that in space.
void check_order(const unsigned int degree, std::shared_ptr<const ExactSolution<3>> exact,
                 const std::function<void(Body::Triangulation &, unsigned int)> &make_mesh,
                 const std::vector<types::boundary_id> &boundaries, const double end, const std::string &what)
{
  double             error[2];
  const unsigned int p = element(degree).degree;
  for (const unsigned int k : {0u, 1u})
    error[k] = manufactured_error(
      element(degree), exact, [&](auto &t) { make_mesh(t, k); }, boundaries, 0.4 / std::pow(2., 0.5 * k * (p - 1.)),
      end);
  const double q = order(error[0], error[1]);
  BOOST_TEST_MESSAGE(what << ", degree " << degree << ": " << error[0] << " " << error[1] << " order " << q);
  BOOST_TEST(q > p + 0.8, what << ", degree " << degree << ": " << error[0] << " " << error[1] << " order " << q);
}
} // namespace

BOOST_AUTO_TEST_SUITE(convergence)

// Manufactured motion of one distorted cube, nested refinement, with and without hanging nodes: the displacement converges with
// order p + 0.8 at least (p + 1 asymptotically), for every element.
BOOST_AUTO_TEST_CASE(manufactured_cube)
{
  const auto exact =
    std::make_shared<ManufacturedCube<3>>(soil(), Tensor<1, 3>({1e-3, 7e-4, 4e-4}),
                                          Tensor<1, 3>({numbers::PI, numbers::PI, numbers::PI}), 900., 0.4);
  for (const unsigned int degree : all_elements)
    for (const bool hanging : {false, true})
      check_order(
        degree, exact,
        [&](Body::Triangulation &t, const unsigned int k) {
          distorted_cube(t, 2, hanging, 0.2);
          t.refine_global((degree < 2 ? 2 : (degree < 4 ? 1 : 0)) + k);
        },
        {0}, 1e-3, hanging ? "distorted cube with hanging nodes" : "distorted cube");
}

// The same on a curved shell: breathing and twisting motion between two spheres.
BOOST_AUTO_TEST_CASE(manufactured_shell)
{
  ManufacturedShell::Motion motion;
  motion.breathing           = 1e-3;
  motion.twist               = 1e-3;
  motion.breathing_number    = 3.;
  motion.twist_number        = 2.;
  motion.breathing_frequency = 900.;
  motion.twist_frequency     = 700.;
  const auto exact           = std::make_shared<ManufacturedShell>(soil(), 1., motion);
  for (const unsigned int degree : all_elements)
    for (const bool hanging : {false, true})
      check_order(
        degree, exact,
        [&](Body::Triangulation &t, const unsigned int k) {
          shell_octant(t, degree < 3 ? 1 : 0, hanging);
          t.refine_global((degree < 2 || degree == 4 ? 1 : 0) + k); // degree 4 is not asymptotic on three cells
        },
        {0, 1, 2, 3, 4}, 1e-3, hanging ? "shell with hanging nodes" : "shell");
}

// Free vibration: the frequency that the discrete body shows, from the three-term recurrence of its projection on the mode,
// q(t+dt) + q(t-dt) = 2 cos(w dt) q(t), and corrected for the known error of central differences, sin(w dt/2) = w_h dt/2.
double measured_frequency(Body &body, const FreeVibration<3> &mode, const double periods)
{
  body.set(body.state.displacement, [&](const Point<3> &x) { return mode.mode(x); });
  StableTimeStep<3> limit;
  limit.calibrate(*body.dynamics);
  const double        dt    = 0.8 * limit.limit();
  VectorType          shape = body.state.displacement;
  std::vector<double> q;
  const unsigned int  n_steps = periods * 2. * numbers::PI / mode.angular_frequency() / dt;
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < shape.locally_owned_size(); ++i)
        if (const double w = body.state.inverse_mass.local_element(i); w > 0.)
          sum += shape.local_element(i) * body.state.displacement.local_element(i) / w;
      q.push_back(Utilities::MPI::sum(sum, MPI_COMM_WORLD));
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, dt);
      body.dynamics->advance(body.state, dt);
    }
  double numerator = 0., denominator = 0.;
  for (unsigned int k = 1; k + 1 < q.size(); ++k)
    {
      numerator += (q[k + 1] + q[k - 1]) * q[k];
      denominator += 2. * q[k] * q[k];
    }
  const double angle = std::acos(numerator / denominator);
  return 2. / dt * std::sin(0.5 * angle);
}

// Breathing and torsion of a ball, breathing of a shell: relative error of the frequency small, falling with order 2 p or the
// order p + 1 of the curved geometry, whichever is lower; all elements.
BOOST_AUTO_TEST_CASE(frequencies_of_shell)
{
  const LinearElastic law = soil();
  BreathingMode<3>    mode(law, 1., 2.);
  mode.finalize();
  for (const unsigned int degree : all_elements)
    {
      double error[2];
      for (const unsigned int k : {0u, 1u})
        {
          Body body(element(degree),
                    [&](auto &t) { shell_octant(t, (degree < 2 ? 2 : (degree == 2 ? 1 : 0)) + k, false); });
          // the planes of symmetry need no constraint: the mode has no tangential gradient and its free vibration keeps the symmetry
          body.constraints.set_symmetry({2, 3, 4});
          body.assemble();
          error[k] = std::abs(measured_frequency(body, mode, 1.5) / mode.angular_frequency() - 1.);
        }
      const double q = order(error[0], error[1]);
      BOOST_TEST_MESSAGE("shell frequency, degree " << degree << ": " << error[0] << " " << error[1] << " order " << q);
      BOOST_TEST((q > element(degree).degree + 0.8 || error[1] < 1e-9),
                 "degree " << degree << ": " << error[0] << " " << error[1]);
    }
}

// Lame mode of the free cube: isochoric, zero traction on all faces, any Poisson ratio.
BOOST_AUTO_TEST_CASE(lame_cube)
{
  const LinearElastic law = soil();
  LameMode<3>         mode(law, 1.);
  mode.finalize();
  for (const unsigned int degree : all_elements)
    {
      double error[2];
      for (const unsigned int k : {0u, 1u})
        {
          const unsigned int n = (degree < 2 ? 4 : 2) << k;
          Body               body(element(degree), [&](auto &t) { GridGenerator::subdivided_hyper_cube(t, n); });
          body.assemble();
          error[k] = std::abs(measured_frequency(body, mode, 1.5) / mode.angular_frequency() - 1.);
        }
      const double q = order(error[0], error[1]);
      BOOST_TEST_MESSAGE("Lame cube, degree " << degree << ": " << error[0] << " " << error[1] << " order " << q);
      BOOST_TEST((q > element(degree).degree + 0.8 || error[1] < 1e-9),
                 "degree " << degree << ": " << error[0] << " " << error[1]);
    }
}

BOOST_AUTO_TEST_SUITE_END()
