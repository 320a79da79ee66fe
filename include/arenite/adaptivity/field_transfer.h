#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/distributed/solution_transfer.h>

#include <list>

namespace Arenite
{
/// Interpolates nodal fields from one mesh to the next, on any number of processes:
///
///   FieldTransfer<dim> transfer(discretization);
///   transfer.add(state.displacement);                       // ghosts and hanging nodes valid
///   transfer.prepare();
///   triangulation.execute_coarsening_and_refinement();
///   discretization.distribute_nodes();
///   transfer.interpolate();
///   transfer.next(state.displacement);                      // owned entries, in the order of add()
///
/// Refinement reproduces the polynomial of the parent, coarsening keeps the values at the parent's nodes.
template <int dim>
class FieldTransfer
{
public:
  explicit FieldTransfer(const Discretization<dim> &discretization)
    : discretization(discretization)
    , transfer(discretization.dofs)
  {}

  /// A vector with dim entries per node, or a scalar one.
  void add(const VectorType &field)
  {
    const unsigned int n_components = field.get_partitioner().get() == discretization.node_partitioner.get() ? 1 : dim;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        scalars.push_back(discretization.new_scalar());
        for (unsigned int node = 0; node < discretization.n_local_nodes(); ++node)
          scalars.back().local_element(node) = field.local_element(n_components * node + c);
        scalars.back().set_ghost_state(true);
      }
  }

  void prepare()
  {
    std::vector<const VectorType *> in;
    for (const VectorType &scalar : scalars)
      in.push_back(&scalar);
    transfer.prepare_for_coarsening_and_refinement(in);
  }

  void interpolate()
  {
    std::vector<VectorType *> out;
    for (VectorType &scalar : scalars)
      {
        scalar = discretization.new_scalar();
        out.push_back(&scalar);
      }
    transfer.interpolate(out);
  }

  void next(VectorType &field)
  {
    const unsigned int n_components = field.get_partitioner().get() == discretization.node_partitioner.get() ? 1 : dim;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
          field.local_element(n_components * node + c) = scalars.front().local_element(node);
        scalars.pop_front();
      }
  }

private:
  const Discretization<dim>                                       &discretization;
  std::list<VectorType>                                            scalars;
  dealii::parallel::distributed::SolutionTransfer<dim, VectorType> transfer;
};
} // namespace Arenite
