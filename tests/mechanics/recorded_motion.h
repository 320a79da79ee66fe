#pragma once

#include <arenite/base/errors.h>
#include <arenite/io/receivers.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

/// A motion that is known exactly, on meshes with hanging nodes, and the receivers that record it.
namespace Arenite::Recorded
{
using namespace dealii;

constexpr int dim = 3;

const LinearElastic  soil{1600., 3e7, 2e7};
inline LinearElastic soil_everywhere(types::material_id) { return soil; }

enum class Body
{
  box,  ///< unit cube, distorted
  shell ///< octant 1 < r < 2
};

/// A mesh with hanging nodes and its nodes.
struct Mesh
{
  Mesh(const Body body, const unsigned int degree, const unsigned int refinements, const bool hanging = true)
    : triangulation(MPI_COMM_WORLD)
    , body(body)
  {
    if (body == Body::box)
      GridGenerator::hyper_cube(triangulation);
    else
      GridGenerator::quarter_hyper_shell(triangulation, Point<dim>(), 1., 2.);
    triangulation.refine_global(refinements);
    discretization = std::make_unique<Discretization<dim>>(triangulation, degree);
    if (hanging)
      refine([](const Point<dim> &x) { return x[0] > x[1] && x[2] < 0.7; });
    else
      number();
  }

  void refine(const std::function<bool(const Point<dim> &)> &where)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && where(cell->center()))
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    number();
  }

  void number()
  {
    discretization->distribute_nodes();
    discretization->positions_from_manifolds();
    if (body == Body::box)
      discretization->transform([](const Point<dim> &x) {
        const double bump = 0.08 * std::sin(2. * x[0]) * std::cos(3. * x[1]) * std::sin(2. * x[2] + 0.3);
        return x + Point<dim>(bump, -0.7 * bump, 0.5 * bump);
      });
  }

  parallel::distributed::Triangulation<dim> triangulation;
  Body                                      body;
  std::unique_ptr<Discretization<dim>>      discretization;
};

/// u = (1 + 20 t + 300 t^2) (A x + b) [mm]: linear in space, quadratic in time.
class LinearMotion : public ExactSolution<dim>
{
public:
  static double factor(const double t) { return 1. + 20. * t + 300. * t * t; }
  static double rate(const double t) { return 20. + 600. * t; }

  Tensor<1, dim> shape(const Point<dim> &x) const { return A * x + b; }

  Tensor<1, dim> displacement(const Point<dim> &x, const double t) const override { return factor(t) * shape(x); }
  Tensor<1, dim> velocity(const Point<dim> &x, const double t) const override { return rate(t) * shape(x); }
  SymmetricTensor<2, 3> stress(const Point<dim> &, const double t) const override { return factor(t) * soil.stress(A); }

  const Tensor<1, dim> b{{0.3e-3, -0.5e-3, 0.7e-3}};
  const Tensor<2, dim> A{{{1e-3, 0.3e-3, -0.2e-3}, {0.5e-3, -0.7e-3, 0.4e-3}, {0.1e-3, 0.6e-3, 0.9e-3}}};
};

inline void set(VectorType &vector, const Discretization<dim> &discretization,
                const std::function<Tensor<1, dim>(const Point<dim> &)> &field)
{
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      vector.local_element(dim * node + c) = field(discretization.position(node))[c];
}

inline VectorType interpolate(const Discretization<dim>                               &discretization,
                              const std::function<Tensor<1, dim>(const Point<dim> &)> &field)
{
  VectorType result = discretization.new_vector();
  set(result, discretization, field);
  make_consistent(discretization, result);
  return result;
}

/// The state that central differences would have on a prescribed motion; hanging nodes of the half-step velocity hold nonsense.
inline void prescribe(State<dim> &state, const Discretization<dim> &discretization, const LinearMotion &motion,
                      const Tensor<1, dim> &offset = {})
{
  state.displacement.zero_out_ghost_values();
  set(state.displacement, discretization,
      [&](const Point<dim> &x) { return motion.displacement(x, state.time) + offset; });
  make_consistent(discretization, state.displacement);
  state.half_velocity.zero_out_ghost_values();
  set(state.half_velocity, discretization,
      [&](const Point<dim> &x) { return motion.velocity(x, state.time - 0.5 * state.dt_last); });
  for (const unsigned int node : discretization.hanging.list())
    if (node < discretization.n_owned_nodes())
      state.half_velocity.local_element(dim * node) = 1e30;
}

/// Folder that all processes share, removed at the end.
struct Folder
{
  Folder()
    : path((std::filesystem::temp_directory_path() /
            ("arenite-receivers-" + std::to_string(Utilities::MPI::broadcast(MPI_COMM_WORLD, int(getpid())))))
             .string())
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::create_directories(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Folder()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(path, ignored);
  }
  const std::string path;
};

/// Sets declared by a scene, ready for open().
struct Sets
{
  explicit Sets(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    receivers.declare_parameters(parameters);
    parameters.parse();
    receivers.finalize(parameters);
  }
  ReceiverSets<dim> receivers;
};

inline bool mentions(const std::exception &error, const std::vector<std::string> &words)
{
  const std::string text = error.what();
  for (const std::string &word : words)
    if (text.find(word) == std::string::npos)
      {
        BOOST_TEST_MESSAGE(text);
        return false;
      }
  return true;
}

const std::string array_scene = R"(
set Receivers = array
subsection Receivers
  subsection array
    set Points = 1.3,0.4,0.2; 0.3,0.8,1.1; 0,0,1.5
  end
end
)";
} // namespace Arenite::Recorded
