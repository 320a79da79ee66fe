#include <arenite/verification/free_vibration.h>

#include "body.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
const std::string soil_block = R"(
subsection Materials
  subsection solid
    set Density = 2200
    set Young modulus = 200e6
    set Poisson ratio = 0.3
  end
end
)";

std::vector<std::string> element_overrides(const unsigned int degree)
{
  return {"Element/Type=" + element(degree).type, "Element/Degree=" + std::to_string(element(degree).degree)};
}

double order(const double coarse, const double fine) { return std::log2(coarse / fine); }
} // namespace

BOOST_AUTO_TEST_SUITE(convergence)

// Manufactured motion of one distorted cube, nested refinement, boundary moved exactly, small steps: the displacement converges
// with order p + 0.8 at least (p + 1 asymptotically).
BOOST_AUTO_TEST_CASE(manufactured_cube)
{
  const std::string scene = soil_block + R"(
    set End time = 2e-3
    subsection Mesh
      set Type = box
      set Cells = 2, 2, 2
      set Distortion = 0.12
    end
    subsection Constraints
      set Exact boundaries = x min, x max, y min, y max, z min, z max
    end
    subsection Initial conditions
      set State = exact solution
    end
    subsection Verification
      set Exact solution = manufactured cube
      set Angular frequency = 900
    end
  )";
  // coarsest refinement and step on it; the step falls with h^((p+1)/2) so that the error in time stays below that in space
  const unsigned int first[] = {2, 2, 1, 1, 0};
  for (const unsigned int degree : all_elements)
    {
      double errors[2];
      for (const unsigned int k : {0u, 1u})
        {
          auto overrides = element_overrides(degree);
          overrides.push_back("Mesh/Refinement=" + std::to_string(first[degree] + k));
          overrides.push_back(
            "Time stepping/Courant number=" +
            std::to_string(k == 0 || degree < 2 ? 0.4 : 0.4 / std::pow(2., (element(degree).degree - 1) * 0.5)));
          errors[k] = run_scene(scene, overrides).errors.at("volume.displacement.E_x");
        }
      const double q = order(errors[0], errors[1]);
      BOOST_TEST_MESSAGE("cube degree " << degree << ": " << errors[0] << " " << errors[1] << " order " << q);
      BOOST_TEST(q > element(degree).degree + 0.8,
                 "degree " << degree << ": " << errors[0] << " " << errors[1] << " order " << q);
    }
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
