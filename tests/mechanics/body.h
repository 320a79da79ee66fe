#pragma once

#include <arenite/mechanics/elastic_force.h>
#include <arenite/mesh/parallel_triangulation.h>
#include <arenite/time/stable_time_step.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <boost/test/unit_test.hpp>

#include <functional>
#include <memory>
#include <random>

namespace Arenite::Test
{
using namespace dealii;

/// Soil of the reference cavities: E = 200 MPa, nu = 0.3, cp = 349.8 m/s.
inline LinearElastic soil(const double poisson_ratio = 0.3)
{
  LinearElastic law;
  law.density       = 2200.;
  law.shear_modulus = 200e6 / (2. * (1. + poisson_ratio));
  law.bulk_modulus  = 200e6 / (3. * (1. - 2. * poisson_ratio));
  return law;
}

/// The element kinds that a scene can choose, by degree; degree 0 stands for the one-point hexahedron.
inline ElementChoice element(const unsigned int degree)
{
  ElementChoice choice;
  choice.type   = degree == 0 ? "one-point hexahedron" : (degree == 1 ? "hexahedron" : "spectral element");
  choice.degree = std::max(1u, degree);
  return choice;
}
constexpr unsigned int all_elements[] = {0, 1, 2, 3, 4};

inline ElementChoice viscous_element(const double hourglass_coefficient = 0.05)
{
  ElementChoice choice         = element(0);
  choice.hourglass_control     = "viscous";
  choice.hourglass_coefficient = hourglass_coefficient;
  return choice;
}

/// The same and viscous hourglass control.
inline std::vector<ElementChoice> all_choices()
{
  std::vector<ElementChoice> choices;
  for (const unsigned int degree : all_elements)
    choices.push_back(element(degree));
  choices.push_back(viscous_element());
  return choices;
}

/// A mesh with one elastic block, without loads unless a test adds them.
template <int dim>
struct BodyOf
{
  using Triangulation = ParallelTriangulation<dim>;

  BodyOf(const ElementChoice &choice, const std::function<void(Triangulation &)> &make_mesh,
         const LinearElastic &law = soil(), const Symmetry symmetry = cartesian<dim>())
    : choice(choice)
    , law(law)
    , triangulation(MPI_COMM_WORLD)
    , discretization((make_mesh(triangulation), triangulation), choice.degree, symmetry)
  {
    discretization.distribute_nodes();
    discretization.positions_from_manifolds();
  }

  void assemble(std::vector<std::unique_ptr<Load<dim>>> loads = {})
  {
    std::vector<std::unique_ptr<InternalForce<dim>>> blocks;
    blocks.push_back(make_elastic_force<dim>(choice, law, numbers::invalid_material_id, discretization.symmetry));
    dynamics = std::make_unique<Dynamics<dim>>(discretization, std::move(blocks), std::move(loads), constraints);
    dynamics->reinit(state);
  }

  /// Owned entries from a function of position.
  void set(VectorType &vector, const std::function<Tensor<1, dim>(const Point<dim> &)> &f) const
  {
    for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
      {
        const Tensor<1, dim> value = f(discretization.position(node));
        for (unsigned int c = 0; c < dim; ++c)
          vector.local_element(dim * node + c) = value[c];
      }
  }

  /// Random numbers in [-scale, scale] that do not depend on the partition: a function of the node's place.
  void randomize(VectorType &vector, const double scale) const
  {
    set(vector, [&](const Point<dim> &x) {
      double place = x[0];
      if constexpr (dim == 2)
        place = x[0] + 1.7 * x[1];
      else if constexpr (dim == 3)
        place = x[0] + 1.7 * x[1] + 2.3 * x[2];
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = scale * std::sin(1e4 * place + 1.1 * c);
      return value;
    });
    zero_at_hanging_nodes(discretization, vector);
    constraints.project(vector);
  }

  ElementChoice                  choice;
  LinearElastic                  law;
  Triangulation                  triangulation;
  Discretization<dim>            discretization;
  Constraints<dim>               constraints;
  std::unique_ptr<Dynamics<dim>> dynamics;
  State<dim>                     state;
};
using Body = BodyOf<3>;

/// Cube [0,1]^3 of n^3 cells whose interior vertices are moved by up to a quarter of a cell; optionally its corner is refined.
inline void distorted_cube(Body::Triangulation &triangulation, const unsigned int n, const bool hanging,
                           const double distortion = 0.25)
{
  GridGenerator::subdivided_hyper_cube(triangulation, n);
  GridTools::transform(
    [&](const Point<3> &x) {
      Point<3> y = x;
      for (unsigned int d = 0; d < 3; ++d)
        if (x[d] > 1e-10 && x[d] < 1. - 1e-10)
          y[d] += distortion / n * std::sin(17. * x[(d + 1) % 3] + 29. * x[(d + 2) % 3] + 7. * d + 3. * x[d]);
      return y;
    },
    triangulation);
  if (hanging)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().norm() < 0.7)
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
}

/// Octant of the shell 1 < r < 2; optionally refined again around r = 1.5.
inline void shell_octant(Body::Triangulation &triangulation, const unsigned int refinement, const bool hanging)
{
  GridGenerator::quarter_hyper_shell(triangulation, Point<3>(), 1., 2., 3, true);
  triangulation.refine_global(refinement);
  if (hanging)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && std::abs(cell->center().norm() - 1.3) < 0.25 &&
            cell->center()[0] > cell->center()[1])
          cell->set_refine_flag();
      triangulation.execute_coarsening_and_refinement();
    }
}

/// Largest absolute entry over all processes.
inline double largest(const VectorType &vector)
{
  double value = 0.;
  for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
    value = std::max(value, std::abs(vector.local_element(i)));
  return Utilities::MPI::max(value, MPI_COMM_WORLD);
}
} // namespace Arenite::Test
