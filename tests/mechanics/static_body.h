#pragma once

#include <arenite/simulation/scene.h>
#include <arenite/statics/static_equilibrium.h>

#include <boost/test/unit_test.hpp>

#include "law_body.h"

namespace Arenite::Test
{
/// The body of a scene given as text, without its output.
template <int dim>
struct StaticBody
{
  explicit StaticBody(const std::string &text, const std::vector<std::string> &overrides = {})
    : parameters(Parameters::from_text(text, "test scene", overrides))
    , scene(parameters)
    , triangulation(MPI_COMM_WORLD)
    , discretization((scene.mesh.geometry->create(triangulation), triangulation), scene.element.degree, scene.symmetry)
  {
    triangulation.refine_global(scene.mesh.refinement);
    std::vector<types::boundary_id> loaded;
    for (const auto &load : scene.loads)
      for (const auto id : load->loaded_boundaries())
        loaded.push_back(id);
    scene.adaptor.initial_refinement(triangulation, discretization, loaded);
    std::vector<std::unique_ptr<InternalForce<dim>>> blocks;
    for (Block &block : scene.blocks)
      if (const auto id = scene.blocks.size() == 1 ? numbers::invalid_material_id : block.material_id; block.law)
        blocks.push_back(
          make_law_force<dim>(scene.element, scene.kinematics, std::move(block.law), id, scene.symmetry));
      else
        blocks.push_back(make_elastic_force<dim>(scene.element, block.material, id, scene.symmetry));
    const auto material = scene.blocks.front().material;
    dynamics            = std::make_unique<Dynamics<dim>>(discretization, std::move(blocks), std::move(scene.loads),
                                               scene.constraints, [material](types::material_id) { return material; });
    dynamics->reinit(state);
  }

  /// All load steps. @return what they took together
  typename StaticEquilibrium<dim>::Effort solve(const std::function<void()> &observe = {})
  {
    StaticEquilibrium<dim>                  equilibrium(*dynamics, state, scene.statics,
                                                        [](const std::string &text) { BOOST_TEST_MESSAGE(text); });
    typename StaticEquilibrium<dim>::Effort sum;
    for (unsigned int step = 1; step <= scene.statics.load_steps; ++step)
      {
        const auto effort = equilibrium.advance_to(step * scene.end_time / scene.statics.load_steps);
        sum.steps += effort.steps;
        sum.newton += effort.newton;
        sum.linear += effort.linear;
        sum.residual = effort.residual;
        if (observe)
          observe();
      }
    equilibrium.release();
    return sum;
  }

  /// Largest distance of nodes from a displacement, over all processes.
  double error(const std::function<Tensor<1, dim>(const Point<dim> &)> &exact) const
  {
    double worst = 0.;
    for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
      {
        Tensor<1, dim> u;
        for (unsigned int c = 0; c < dim; ++c)
          u[c] = state.displacement.local_element(dim * node + c);
        worst = std::max(worst, (u - exact(discretization.position(node))).norm());
      }
    return Utilities::MPI::max(worst, MPI_COMM_WORLD);
  }

  /// Root of the mean square of that distance over the volume, relative to that of the displacement.
  double mean_error(const std::function<Tensor<1, dim>(const Point<dim> &)> &exact) const
  {
    std::vector<double> sums(2, 0.);
    for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
      {
        const Tensor<1, dim> wanted = exact(discretization.position(node));
        Tensor<1, dim>       u;
        for (unsigned int c = 0; c < dim; ++c)
          u[c] = state.displacement.local_element(dim * node + c);
        sums[0] += dynamics->mass.local_element(node) * (u - wanted).norm_square();
        sums[1] += dynamics->mass.local_element(node) * wanted.norm_square();
      }
    Utilities::MPI::sum(sums, MPI_COMM_WORLD, sums);
    return std::sqrt(sums[0] / sums[1]);
  }

  Parameters                     parameters;
  Scene<dim>                     scene;
  ParallelTriangulation<dim>     triangulation;
  Discretization<dim>            discretization;
  std::unique_ptr<Dynamics<dim>> dynamics;
  State<dim>                     state;
};
} // namespace Arenite::Test
