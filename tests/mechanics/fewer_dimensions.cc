// The code in one and two dimensions: what tests/mechanics/elements.cc, stable_step.cc and convergence.cc demand in three.
#include <arenite/verification/manufactured.h>

#include "cavity_scene.h"
#include "convergence_tools.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::test_tools::tolerance;
using boost::unit_test::label;

namespace
{
/// All element kinds of one and two dimensions: those of three, and Gauss-Lobatto elements of degree 1.
std::vector<ElementChoice> all_elements_of_plane()
{
  std::vector<ElementChoice> choices;
  for (const unsigned int degree : all_elements)
    choices.push_back(element(degree));
  choices.push_back(element(1));
  choices.back().type = "spectral element";
  return choices;
}

std::string describe(const ElementChoice &choice, const Symmetry symmetry)
{
  return name(symmetry) + ", " + choice.type + " of degree " + std::to_string(choice.degree) + ": ";
}

/// Cartesian or with an axis or centre, where the first coordinate begins at @p inner.
constexpr Symmetry symmetries_1d[] = {Symmetry::plane_wave, Symmetry::spherical};
constexpr Symmetry symmetries_2d[] = {Symmetry::plane_strain, Symmetry::axisymmetric};

/// Box [inner, inner + 1] x [0, 1] of n cells per direction, in the plane with shifted vertices inside and hanging nodes.
template <int dim>
void box(ParallelTriangulation<dim> &triangulation, const unsigned int n, const double inner, const bool distorted)
{
  Point<dim> lower, upper;
  lower[0] = inner;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = lower[d] + 1.;
  GridGenerator::subdivided_hyper_rectangle(triangulation, std::vector<unsigned int>(dim, n), lower, upper);
  if (!distorted)
    return;
  GridTools::transform(
    [&](const Point<dim> &x) {
      Point<dim> y      = x;
      bool       inside = true; // of all faces; lines that meet an axis stay at right angles to it
      for (unsigned int d = 0; d < dim; ++d)
        inside = inside && x[d] > lower[d] + 1e-10 && x[d] < upper[d] - 1e-10;
      if (inside)
        for (unsigned int d = 0; d < dim; ++d)
          if (d == 0 || x[0] > lower[0] + 1.5 / n)
            y[d] += 0.15 / n * std::sin(17. * x[dim - 1 - d] + 7. * d + 3. * x[d]);
      return y;
    },
    triangulation);
  if (dim == 1)
    return;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[dim - 1] > 0.5)
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
}

/// Section of the shell 1 < r < 2 or of the ball r < 2, as scenes make them.
template <int dim>
std::function<void(ParallelTriangulation<dim> &)> round_body(const std::string &type, const Symmetry symmetry,
                                                             const unsigned int refinement)
{
  return [=](ParallelTriangulation<dim> &triangulation) {
    Parameters parameters = Parameters::from_text(type == "ball" ? "subsection Mesh\nset Radius = 2\nend\n"
                                                                 : "subsection Mesh\nset Inner radius = 1\n"
                                                                   "set Outer radius = 2\nend\n",
                                                  "test");
    const auto geometry = geometries<dim>().make(type);
    geometry->symmetry  = symmetry;
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
const std::vector<types::boundary_id> sphere_planes = {2, 3, 4};

/// Largest eigenvalue of the assembled M^-1 K by power iteration, from below.
template <int dim>
double spectral_radius(BodyOf<dim> &body)
{
  State<dim> &state = body.state;
  body.randomize(state.displacement, 1.);
  double lambda = 0.;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      state.force = 0.;
      body.dynamics->compute_force(state);
      body.constraints.project(state.force);
      double uu = 0., uf = 0.;
      for (unsigned int i = 0; i < state.force.locally_owned_size(); ++i)
        if (const double w = state.inverse_mass.local_element(i); w > 0.)
          {
            uu += std::pow(state.displacement.local_element(i), 2) / w;
            uf -= state.displacement.local_element(i) * state.force.local_element(i);
          }
      lambda = Utilities::MPI::sum(uf, MPI_COMM_WORLD) / Utilities::MPI::sum(uu, MPI_COMM_WORLD);
      for (unsigned int i = 0; i < state.force.locally_owned_size(); ++i)
        state.displacement.local_element(i) =
          -state.inverse_mass.local_element(i) * state.force.local_element(i) / lambda;
    }
  return lambda;
}

/// Mass, force as the derivative of the energy, and the step, with a mesh that touches the axis or centre.
template <int dim>
void check_operator(const ElementChoice &choice, const Symmetry symmetry)
{
  const std::string what = describe(choice, symmetry);
  BodyOf<dim>       body(
          choice, [](auto &t) { box<dim>(t, 4, 0., true); }, soil(), symmetry);
  body.assemble();

  // integral of 2 pi r = pi, of 4 pi r^2 = 4 pi/3
  const double volume = symmetry == Symmetry::axisymmetric ? numbers::PI
                        : symmetry == Symmetry::spherical  ? 4. / 3. * numbers::PI
                                                           : 1.;
  BOOST_TEST(body.dynamics->total_mass() == volume * body.law.density, tolerance(1e-12));
  for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
    BOOST_TEST_REQUIRE(body.dynamics->mass.local_element(node) >= 0.);

  VectorType direction = body.discretization.new_vector();
  body.randomize(body.state.displacement, 1e-3);
  body.randomize(direction, 7e-4);
  for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
    body.state.displacement.local_element(i) *= 1. + 0.3 * std::cos(5. * direction.local_element(i));
  body.dynamics->compute_force(body.state);
  double power = 0.;
  for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
    power -= body.state.force.local_element(i) * direction.local_element(i);
  power                    = Utilities::MPI::sum(power, MPI_COMM_WORLD);
  const VectorType u       = body.state.displacement;
  double           side[2] = {0., 0.};
  for (const int s : {0, 1})
    {
      for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
        body.state.displacement.local_element(i) = u.local_element(i) + (s ? 1. : -1.) * direction.local_element(i);
      make_consistent(body.discretization, body.state.displacement);
      const BlockEnergy energy = body.dynamics->stored_energy(body.state);
      side[s]                  = Utilities::MPI::sum(energy.strain + energy.hourglass, MPI_COMM_WORLD);
    }
  BOOST_TEST(0.5 * (side[1] - side[0]) == power, tolerance(1e-10));

  StableTimeStep<dim> step;
  step.calibrate(*body.dynamics);
  const double limit = 2. / std::sqrt(spectral_radius(body));
  BOOST_TEST_MESSAGE(what << "step " << step.limit() / limit << " elements " << step.element_limit() / limit);
  BOOST_TEST(step.limit() <= 0.9995 * limit, what << step.limit() / limit);
  BOOST_TEST(step.limit() >= 0.97 * limit, what << step.limit() / limit);
  BOOST_TEST(step.element_limit() <= 0.9995 * limit, what << step.element_limit() / limit);
}

/// Uniform strain, also in the hoop directions: inside of the body nothing moves.
template <int dim>
void check_patch(const ElementChoice &choice, const Symmetry symmetry)
{
  BodyOf<dim> body(
    choice, [](auto &t) { box<dim>(t, 4, 0., true); }, soil(), symmetry);
  body.assemble();
  body.set(body.state.displacement, [&](const Point<dim> &x) {
    Tensor<1, dim> u;
    u[0] = 1e-3 * x[0];
    if (dim > 1)
      u[dim - 1] = 0.3 - 4e-4 * x[dim - 1] + (n_hoop_directions(symmetry) == 0 ? 2e-4 * x[0] : 0.);
    return u;
  });
  body.dynamics->compute_force(body.state);
  body.constraints.project(body.state.force);
  double interior = 0., boundary = 0.;
  for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
    {
      const Point<dim> x       = body.discretization.position(node);
      bool             is_free = n_hoop_directions(symmetry) > 0 || x[0] > 1e-9; // the axis is part of the interior
      for (unsigned int d = 0; d < dim; ++d)
        is_free = is_free && (d == 0 || x[d] > 1e-9) && x[d] < 1. - 1e-9;
      for (unsigned int c = 0; c < dim; ++c)
        (is_free ? interior : boundary) =
          std::max(is_free ? interior : boundary, std::abs(body.state.force.local_element(dim * node + c)));
    }
  interior = Utilities::MPI::max(interior, MPI_COMM_WORLD);
  boundary = Utilities::MPI::max(boundary, MPI_COMM_WORLD);
  BOOST_TEST(interior < 1e-11 * boundary, describe(choice, symmetry) << interior / boundary);
}

/// Relative errors on two meshes fall with order p + 0.8 at least, or are round-off.
template <typename Error>
void check_order(const std::string &what, const unsigned int p, const Error &error_on_mesh)
{
  const double error[2] = {error_on_mesh(0u), error_on_mesh(1u)};
  const double q        = order(error[0], error[1]);
  BOOST_TEST_MESSAGE(what << error[0] << " " << error[1] << " order " << q);
  BOOST_TEST((q > p + 0.8 || error[1] < 1e-9), what << error[0] << " " << error[1] << " order " << q);
}

/// The step falls with h^((p+1)/2), so that the error in time stays below that in space.
double courant(const unsigned int p, const unsigned int k) { return 0.4 / std::pow(2., 0.5 * k * (p - 1.)); }

template <int dim>
void check_manufactured_cube(const ElementChoice &choice)
{
  Tensor<1, dim> amplitude, number;
  for (unsigned int d = 0; d < dim; ++d)
    {
      amplitude[d] = 1e-3 * (1. - 0.3 * d);
      number[d]    = numbers::PI;
    }
  const auto exact = std::make_shared<ManufacturedCube<dim>>(soil(), amplitude, number, 900., 0.4);
  check_order("manufactured, " + describe(choice, cartesian<dim>()), choice.degree, [&](const unsigned int k) {
    return manufactured_error<dim>(
      choice, exact, [&](auto &t) { box<dim>(t, (choice.degree < 3 ? 8 : 4) << k, 0., false); }, {0, 1},
      courant(choice.degree, k), 1e-3);
  });
}

template <int dim>
void check_manufactured_shell(const ElementChoice &choice, const Symmetry symmetry)
{
  typename ManufacturedShell<dim>::Motion motion;
  motion.breathing           = 1e-3;
  motion.twist               = 0.;
  motion.breathing_number    = 3.;
  motion.breathing_frequency = 900.;
  const auto exact           = std::make_shared<ManufacturedShell<dim>>(soil(), 1., motion);
  check_order("manufactured shell, " + describe(choice, symmetry), choice.degree, [&](const unsigned int k) {
    return manufactured_error<dim>(choice, exact,
                                   round_body<dim>("spherical shell", symmetry, (choice.degree < 2 ? 3 : 2) + k),
                                   {0, 1, 2, 3, 4}, courant(choice.degree, k), 1e-3, symmetry);
  });
}

/// Breathing of a ball or shell; the meshes of the ball contain the centre.
template <int dim>
void check_breathing(const ElementChoice &choice, const Symmetry symmetry, const std::string &type)
{
  const LinearElastic      law = soil();
  const BreathingMode<dim> mode(law, type == "ball" ? 0. : 1., 2.);
  check_order(type + " breathing, " + describe(choice, symmetry), choice.degree, [&](const unsigned int k) {
    BodyOf<dim> body(choice, round_body<dim>(type, symmetry, (choice.degree < 2 ? 3 : (choice.degree < 3 ? 1 : 2)) + k),
                     law, symmetry);
    body.constraints.set_symmetry(sphere_planes);
    body.assemble();
    return std::abs(measured_frequency(body, mode, 1.5) / mode.angular_frequency() - 1.);
  });
}
} // namespace

BOOST_AUTO_TEST_SUITE(fewer_dimensions)

// In every symmetry the masses are those of the body, the force is the negative derivative of the energy, and the stable step is that
// of the assembled system, with cells that touch the axis or the centre.
BOOST_AUTO_TEST_CASE(operators, *label("parallel"))
{
  for (const ElementChoice &choice : all_elements_of_plane())
    {
      for (const Symmetry symmetry : symmetries_1d)
        check_operator<1>(choice, symmetry);
      for (const Symmetry symmetry : symmetries_2d)
        check_operator<2>(choice, symmetry);
    }
}

// Uniform strain leaves interior nodes in equilibrium, also those on the axis; the hoop stress balances the radial one. Gauss-Lobatto
// elements of degree 1 do not integrate r exactly.
BOOST_AUTO_TEST_CASE(patch_test, *label("parallel"))
{
  for (const ElementChoice &choice : all_elements_of_plane())
    {
      const bool inexact = choice.type == "spectral element" && choice.degree == 1;
      check_patch<1>(choice, Symmetry::plane_wave);
      check_patch<2>(choice, Symmetry::plane_strain);
      if (!inexact)
        {
          check_patch<1>(choice, Symmetry::spherical);
          check_patch<2>(choice, Symmetry::axisymmetric);
        }
    }
}

// Manufactured motions converge with order p + 0.8 at least (p + 1 asymptotically), for all elements: in a cube of one and two
// dimensions, and between spheres in sections of them.
BOOST_AUTO_TEST_CASE(manufactured)
{
  for (const ElementChoice &choice : all_elements_of_plane())
    {
      check_manufactured_cube<1>(choice);
      check_manufactured_cube<2>(choice);
      check_manufactured_shell<1>(choice, Symmetry::spherical);
      check_manufactured_shell<2>(choice, Symmetry::axisymmetric);
    }
}

// Frequencies of breathing balls and shells on the radius and in the meridian plane; a ball has its centre and axis in the mesh.
BOOST_AUTO_TEST_CASE(breathing)
{
  for (const ElementChoice &choice : all_elements_of_plane())
    for (const std::string type : {"ball", "spherical shell"})
      {
        check_breathing<1>(choice, Symmetry::spherical, type);
        check_breathing<2>(choice, Symmetry::axisymmetric, type);
      }
}

// Lame mode of a square in plane strain: no change of volume, no traction on its sides.
BOOST_AUTO_TEST_CASE(lame_square)
{
  const LinearElastic law = soil();
  const LameMode<2>   mode(law, 1.);
  for (const ElementChoice &choice : all_elements_of_plane())
    check_order("Lame mode, " + describe(choice, Symmetry::plane_strain), choice.degree, [&](const unsigned int k) {
      // the error of Gauss-Lobatto elements of degree 1 is a difference of two that nearly cancel on coarse meshes
      const unsigned int n = choice.degree > 1 ? 2 : (choice.type == "spectral element" ? 32 : 8);
      BodyOf<2>          body(choice, [&](auto &t) { GridGenerator::subdivided_hyper_cube(t, n << k); });
      body.assemble();
      return std::abs(measured_frequency(body, mode, 1.5) / mode.angular_frequency() - 1.);
    });
}

// One scene in three forms with two lines changed: the octant, its meridian plane and the radius. The signals at the generic receivers
// differ by no more than their errors against the exact solution.
BOOST_AUTO_TEST_CASE(one_scene_in_three_forms)
{
  std::vector<std::string> overrides = {"Mesh/Refinement=2", "Loads/far field/Condition=spherical"};
  std::vector<RunRecord>   records{run_scene(cavity_scene, overrides)};
  for (const std::vector<std::string> form : {std::vector<std::string>{"Dimension=2", "Symmetry=axisymmetric"},
                                              std::vector<std::string>{"Dimension=1", "Symmetry=spherical"}})
    {
      auto lines = overrides;
      lines.insert(lines.end(), form.begin(), form.end());
      records.push_back(run_scene(cavity_scene, lines));
    }
  for (const RunRecord &record : records)
    for (const std::string quantity : {"displacement", "stress"})
      {
        const double error = record.errors.at("array." + quantity + ".E_t");
        const double first = records[0].values.at("array." + quantity + ".rms"),
                     other = record.values.at("array." + quantity + ".rms");
        BOOST_TEST_MESSAGE(record.dimension << "-D " << quantity << " E_t " << error << " rms " << other / first - 1.
                                            << " cells " << record.cells << " core seconds " << record.core_seconds);
        BOOST_TEST(error < (quantity == "stress" ? 1e-2 : 1e-3));
        BOOST_TEST(std::abs(other / first - 1.) < error + records[0].errors.at("array." + quantity + ".E_t"));
        BOOST_TEST(record.energy_error < 1e-11);
      }
}

BOOST_AUTO_TEST_SUITE_END()
