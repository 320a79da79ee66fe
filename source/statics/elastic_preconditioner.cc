#include <arenite/statics/elastic_preconditioner.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <ml_MultiLevelPreconditioner.h>

namespace Arenite
{
using namespace dealii;

namespace
{
/// The nodes without lines of their own that a cell moves, and T with u_cell = T u: what hangs is resolved, what is held projected out.
template <int dim>
struct CellUnknowns
{
  std::vector<unsigned int> nodes;
  FullMatrix<double>        T;
};

template <int dim>
CellUnknowns<dim> unknowns_of(const unsigned int cell, const Discretization<dim> &discretization,
                              const std::vector<std::vector<HangingNodes::Master>> &masters,
                              const std::vector<Tensor<2, dim>>                    &free)
{
  const unsigned int  n          = discretization.nodes_per_cell();
  const unsigned int *cell_nodes = discretization.cell_nodes(cell);
  CellUnknowns<dim>   result;
  for (unsigned int i = 0; i < n; ++i)
    if (masters[cell_nodes[i]].empty())
      result.nodes.push_back(cell_nodes[i]);
    else
      for (const auto &master : masters[cell_nodes[i]])
        result.nodes.push_back(master.node);
  std::sort(result.nodes.begin(), result.nodes.end());
  result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());

  result.T.reinit(dim * n, dim * result.nodes.size());
  const auto add = [&](const unsigned int i, const HangingNodes::Master &master) {
    const unsigned int j =
      std::lower_bound(result.nodes.begin(), result.nodes.end(), master.node) - result.nodes.begin();
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        result.T(dim * i + c, dim * j + d) += (c == 0 ? master.radial_weight : master.weight) * free[master.node][c][d];
  };
  for (unsigned int i = 0; i < n; ++i)
    if (masters[cell_nodes[i]].empty())
      add(i, {cell_nodes[i], 1., 1.});
    else
      for (const auto &master : masters[cell_nodes[i]])
        add(i, master);
  return result;
}

/// Rows of the matrix for the components of @p nodes.
template <int dim>
std::vector<types::global_dof_index> rows_of(const std::vector<unsigned int>   &nodes,
                                             const Utilities::MPI::Partitioner &partitioner)
{
  std::vector<types::global_dof_index> rows;
  for (const unsigned int node : nodes)
    for (unsigned int c = 0; c < dim; ++c)
      rows.push_back(partitioner.local_to_global(dim * node + c));
  return rows;
}

/// Constants and rotations at owned nodes, one column each.
template <int dim>
std::vector<std::vector<double>> rigid_motions(const Discretization<dim> &discretization)
{
  constexpr unsigned int           n_rotations = dim * (dim - 1) / 2;
  const unsigned int               n           = discretization.n_owned_nodes();
  std::vector<std::vector<double>> motions(dim + n_rotations, std::vector<double>(dim * n, 0.));
  for (unsigned int node = 0; node < n; ++node)
    {
      const Point<dim> x        = discretization.position(node);
      unsigned int     rotation = dim;
      for (unsigned int c = 0; c < dim; ++c)
        {
          motions[c][dim * node + c] = 1.;
          for (unsigned int d = c + 1; d < dim; ++d, ++rotation)
            {
              motions[rotation][dim * node + c] = -x[d];
              motions[rotation][dim * node + d] = x[c];
            }
        }
    }
  return motions;
}
} // namespace

template <int dim>
void ElasticPreconditioner<dim>::reinit(const Dynamics<dim> &dynamics, const FreeMotion<dim> &free_motion)
{
  free = &free_motion;
  multigrid.clear();
  assemble(dynamics);
  build_multigrid(dynamics.discretization);
}

template <int dim>
void ElasticPreconditioner<dim>::assemble(const Dynamics<dim> &dynamics)
{
  const Discretization<dim>                     &discretization = dynamics.discretization;
  const Utilities::MPI::Partitioner             &partitioner    = *discretization.vector_partitioner;
  const auto                                     projectors     = free->of_local_nodes();
  std::vector<std::vector<HangingNodes::Master>> masters(discretization.n_local_nodes());
  for (unsigned int line = 0; line < discretization.hanging.size(); ++line)
    masters[discretization.hanging.list()[line]] = discretization.hanging.masters(line);

  const IndexSet                   &owned = partitioner.locally_owned_range();
  IndexSet                          written(owned);
  TrilinosWrappers::SparsityPattern pattern;
  written.add_indices(partitioner.ghost_indices());
  pattern.reinit(owned, owned, written, discretization.communicator);
  const unsigned int n_cells = discretization.cells().size();
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    {
      const auto rows = rows_of<dim>(unknowns_of(cell, discretization, masters, projectors).nodes, partitioner);
      for (const auto row : rows)
        pattern.add_entries(row, rows.begin(), rows.end(), true);
    }
  for (const auto row : owned) // of nodes that hang
    pattern.add(row, row);
  pattern.compress();
  matrix.reinit(pattern);

  FullMatrix<double> K, KT, projected;
  VectorType         unit_forces = discretization.new_scalar();
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    {
      for (const auto &block : dynamics.blocks)
        if (block->contains(cell))
          block->cell_stiffness(cell, K);
      const auto         unknowns = unknowns_of(cell, discretization, masters, projectors);
      const unsigned int n        = unknowns.T.n();
      KT.reinit(K.m(), n);
      projected.reinit(n, n);
      K.mmult(KT, unknowns.T);
      unknowns.T.Tmmult(projected, KT);
      const double diagonal = K.trace() / K.m();
      for (unsigned int j = 0; j < unknowns.nodes.size(); ++j)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            projected(dim * j + c, dim * j + d) +=
              diagonal * ((c == d ? 1. : 0.) - projectors[unknowns.nodes[j]][c][d]);
      for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
        unit_forces.local_element(discretization.cell_nodes(cell)[i]) +=
          discretization.cells()[cell]->minimum_vertex_distance() / discretization.degree() * K(dim * i, dim * i);
      matrix.add(rows_of<dim>(unknowns.nodes, partitioner), projected);
    }
  matrix.compress(VectorOperation::add);
  for (const unsigned int node : discretization.hanging.list())
    if (node < discretization.n_owned_nodes())
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto row = partitioner.local_to_global(dim * node + c);
          matrix.set(row, row, 1.);
        }
  matrix.compress(VectorOperation::insert);
  unit_forces.compress(VectorOperation::add);
  unit_force = unit_forces.l2_norm();
}

template <int dim>
void ElasticPreconditioner<dim>::build_multigrid(const Discretization<dim> &discretization)
{
  const auto         motions = rigid_motions(discretization);
  const Epetra_Map  &map     = matrix.trilinos_matrix().OperatorDomainMap();
  Epetra_MultiVector null_space(map, static_cast<int>(motions.size()));
  for (unsigned int k = 0; k < motions.size(); ++k)
    std::copy(motions[k].begin(), motions[k].end(), null_space[k]);

  Teuchos::ParameterList parameters;
  ML_Epetra::SetDefaults("SA", parameters);
  parameters.set("ML output", 0);
  parameters.set("PDE equations", dim);
  parameters.set("aggregation: type", "Uncoupled");
  // A hollow sphere in the meridian plane, 512 to 131 072 cells: 15, 17, 18, 20, 21 iterations to 1e-12. With V cycles they are 15 to 28, with a
  // threshold of 0.02 and V cycles 15 to 34. Elements of high degree do better with one: 53 against 68 at degree 3.
  parameters.set("prec type", "MGW");
  parameters.set("aggregation: threshold", discretization.degree() > 1 ? 0.02 : 0.);
  parameters.set("smoother: type", "Chebyshev");
  parameters.set("smoother: sweeps", 3);
  parameters.set("smoother: pre or post", "both");
  parameters.set("coarse: type", "Amesos-KLU");
  parameters.set("coarse: max size", 500);
  parameters.set("null space: type", "pre-computed");
  parameters.set("null space: dimension", null_space.NumVectors());
  parameters.set("null space: vectors", null_space.Values());
  multigrid.initialize(matrix, parameters);
}

template <int dim>
void ElasticPreconditioner<dim>::vmult(VectorType &z, const VectorType &r) const
{
  multigrid.vmult(z, r);
  free->project(z);
}

template class ElasticPreconditioner<1>;
template class ElasticPreconditioner<2>;
template class ElasticPreconditioner<3>;
} // namespace Arenite
