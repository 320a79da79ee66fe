#include <arenite/verification/manufactured.h>

#include "convergence_tools.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
/// Errors on two nested meshes; the step falls with h^((p+1)/2) so that the error in time stays below that in space.
void check_order(const unsigned int degree, std::shared_ptr<const ExactSolution<3>> exact,
                 const std::function<void(Body::Triangulation &, unsigned int)> &make_mesh,
                 const std::vector<types::boundary_id> &boundaries, const double end, const std::string &what)
{
  double             error[2];
  const unsigned int p = element(degree).degree;
  for (const unsigned int k : {0u, 1u})
    error[k] = manufactured_error<3>(
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
  ManufacturedShell<3>::Motion motion;
  motion.breathing           = 1e-3;
  motion.twist               = 1e-3;
  motion.breathing_number    = 3.;
  motion.twist_number        = 2.;
  motion.breathing_frequency = 900.;
  motion.twist_frequency     = 700.;
  const auto exact           = std::make_shared<ManufacturedShell<3>>(soil(), 1., motion);
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
