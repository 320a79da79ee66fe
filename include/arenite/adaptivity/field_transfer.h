#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/solution_transfer.h>

#include <list>
#include <type_traits>
#include <vector>

namespace Arenite
{
/// Vectors that all processes hold, of which each has filled in its part.
inline void sum_over_processes(dealii::Vector<double> &vector, const MPI_Comm communicator)
{
  const int ierr =
    MPI_Allreduce(MPI_IN_PLACE, vector.begin(), static_cast<int>(vector.size()), MPI_DOUBLE, MPI_SUM, communicator);
  AssertThrowMPI(ierr);
}

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
/// Refinement reproduces the polynomial of the parent, coarsening keeps the values at the parent's nodes. In one dimension, where
/// all processes hold the whole mesh, they also hold the whole fields while the mesh changes.
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
        if constexpr (dim == 1)
          {
            scalars.emplace_back(discretization.n_nodes());
            for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
              scalars.back()[discretization.node_partitioner->local_to_global(node)] =
                field.local_element(n_components * node + c);
            sum_over_processes(scalars.back(), discretization.communicator);
          }
        else // in place: a copy would lose the ghosts
          {
            scalars.push_back(discretization.new_scalar());
            for (unsigned int node = 0; node < discretization.n_local_nodes(); ++node)
              scalars.back().local_element(node) = field.local_element(n_components * node + c);
            scalars.back().set_ghost_state(true);
          }
      }
  }

  void prepare()
  {
    if constexpr (dim == 1)
      {
        before.assign(scalars.begin(), scalars.end());
        transfer.prepare_for_coarsening_and_refinement(before);
      }
    else
      {
        std::vector<const VectorType *> in;
        for (const VectorType &scalar : scalars)
          in.push_back(&scalar);
        transfer.prepare_for_coarsening_and_refinement(in);
      }
  }

  void interpolate()
  {
    if constexpr (dim == 1)
      {
        std::vector<dealii::Vector<double>> after(before.size(), dealii::Vector<double>(discretization.n_nodes()));
        transfer.interpolate(before, after);
        scalars.assign(after.begin(), after.end());
      }
    else
      {
        std::vector<VectorType *> out;
        for (VectorType &scalar : scalars)
          {
            scalar.reinit(discretization.node_partitioner);
            out.push_back(&scalar);
          }
        transfer.interpolate(out);
      }
  }

  void next(VectorType &field)
  {
    const unsigned int n_components = field.get_partitioner().get() == discretization.node_partitioner.get() ? 1 : dim;
    for (unsigned int c = 0; c < n_components; ++c)
      {
        for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
          field.local_element(n_components * node + c) =
            scalars.front()[discretization.node_partitioner->local_to_global(node)];
        scalars.pop_front();
      }
  }

private:
  using Field    = std::conditional_t<dim == 1, dealii::Vector<double>, VectorType>;
  using Transfer = std::conditional_t<dim == 1, dealii::SolutionTransfer<dim, dealii::Vector<double>>,
                                      dealii::parallel::distributed::SolutionTransfer<dim, VectorType>>;

  const Discretization<dim> &discretization;
  std::list<Field>           scalars;
  std::vector<Field>         before;
  Transfer                   transfer;
};
} // namespace Arenite
