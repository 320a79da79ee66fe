// The kernels against an independent implementation of the same elements: deal.II's matrix-free evaluation.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

#include <map>
#include <tuple>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
/// - integral of sigma : grad N with n_q points per direction, for the displacement of a body without hanging nodes. Nodes are
/// matched by cell and position in the cell; the geometry is MappingQ of the same degree.
template <int degree, int n_q>
VectorType reference_force(const Body &body, const Quadrature<1> &rule)
{
  const FESystem<3>   fe(FE_Q<3>(QGaussLobatto<1>(degree + 1)), 3);
  const MappingQ<3>   mapping(degree);
  DoFHandler<3>       dofs(body.triangulation);
  AffineConstraints<> none;
  dofs.distribute_dofs(fe);
  none.close();
  typename MatrixFree<3, double>::AdditionalData data;
  data.tasks_parallel_scheme = MatrixFree<3, double>::AdditionalData::none;
  data.mapping_update_flags  = update_gradients | update_JxW_values;
  MatrixFree<3, double> matrix_free;
  matrix_free.reinit(mapping, dofs, none, rule, data);

  VectorType u, force;
  matrix_free.initialize_dof_vector(u);
  matrix_free.initialize_dof_vector(force);
  // system unknown <-> node and component
  std::vector<types::global_dof_index>            indices(fe.n_dofs_per_cell());
  std::map<types::global_dof_index, unsigned int> entry_of;
  const Discretization<3>                        &discretization = body.discretization;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      const auto &node_cell = discretization.cells()[cell];
      typename DoFHandler<3>::active_cell_iterator(&body.triangulation, node_cell->level(), node_cell->index(), &dofs)
        ->get_dof_indices(indices);
      for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          entry_of[indices[fe.component_to_system_index(c, discretization.lexicographic[i])]] =
            3 * discretization.cell_nodes(cell)[i] + c;
    }
  for (const auto &[index, entry] : entry_of)
    if (u.in_local_range(index))
      u(index) = body.state.displacement.local_element(entry);
  u.update_ghost_values();

  using Evaluation = FEEvaluation<3, degree, n_q, 3, double>;
  matrix_free.template cell_loop<VectorType, VectorType>(
    [&](const auto &, VectorType &result, const VectorType &source, const auto &range) {
      Evaluation values(matrix_free);
      for (unsigned int batch = range.first; batch < range.second; ++batch)
        {
          values.reinit(batch);
          values.gather_evaluate(source, EvaluationFlags::gradients);
          for (unsigned int q = 0; q < values.n_q_points; ++q)
            {
              const auto strain = values.get_symmetric_gradient(q);
              auto       stress = -2. * body.law.shear_modulus * strain;
              const auto mean   = -body.law.lame_lambda() * trace(strain);
              for (unsigned int d = 0; d < 3; ++d)
                stress[d][d] += mean;
              values.submit_symmetric_gradient(stress, q);
            }
          values.integrate_scatter(EvaluationFlags::gradients, result);
        }
    },
    force, u, true);

  VectorType result = discretization.new_vector();
  for (const auto &[index, entry] : entry_of)
    if (force.in_local_range(index))
      {
        // both handlers number owned nodes by the same cells, but a shared node may have different owners
        result.local_element(entry) = force(index);
      }
  result.compress(VectorOperation::add);
  return result;
}

template <int degree, int n_q>
void compare(const Quadrature<1> &rule)
{
  for (const bool curved : {false, true})
    {
      Body body(element(degree), [&](auto &t) {
        if (curved)
          shell_octant(t, degree < 3 ? 2 : 1, false);
        else
          distorted_cube(t, degree < 3 ? 6 : 3, false);
      });
      body.assemble();
      body.randomize(body.state.displacement, 1e-3);
      make_consistent(body.discretization, body.state.displacement);
      VectorType difference = reference_force<degree, n_q>(body, rule);
      body.dynamics->compute_force(body.state);
      const double scale = largest(body.state.force);
      difference -= body.state.force;
      BOOST_TEST_MESSAGE("matrix-free, degree " << degree << (curved ? ", shell: " : ", distorted cube: ")
                                                << largest(difference) / scale);
      BOOST_TEST(scale > 0.);
      BOOST_TEST(largest(difference) < 1e-12 * scale);
    }
}
} // namespace

BOOST_AUTO_TEST_SUITE(matrix_free)

// The force of a random displacement is that of deal.II's FEEvaluation to round-off (sums of some hundred terms): 2x2x2 Gauss points
// for the hexahedron, Gauss-Lobatto points at the nodes for spectral elements; distorted and curved cells.
BOOST_AUTO_TEST_CASE(degree_1, *label("parallel")) { compare<1, 2>(QGauss<1>(2)); }
BOOST_AUTO_TEST_CASE(degree_2, *label("parallel")) { compare<2, 3>(QGaussLobatto<1>(3)); }
BOOST_AUTO_TEST_CASE(degree_3, *label("parallel")) { compare<3, 4>(QGaussLobatto<1>(4)); }
BOOST_AUTO_TEST_CASE(degree_4, *label("parallel")) { compare<4, 5>(QGaussLobatto<1>(5)); }

BOOST_AUTO_TEST_SUITE_END()
