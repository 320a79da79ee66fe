#pragma once

#include <arenite/mechanics/discretization.h>
#include <arenite/mesh/parallel_triangulation.h>
#include <arenite/time/dynamics.h>

#include <deal.II/grid/cell_id.h>

#include <functional>
#include <map>
#include <vector>

namespace Arenite
{
/// Position in Discretization::cells() per active cell index.
template <int dim>
std::vector<unsigned int> index_of_active_cells(const Discretization<dim> &discretization)
{
  std::vector<unsigned int> index(discretization.triangulation.n_active_cells(), dealii::numbers::invalid_unsigned_int);
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    index[discretization.cells()[cell]->active_cell_index()] = cell;
  return index;
}

/// Position in Dynamics::blocks of the block that a cell of Discretization::cells() belongs to.
template <int dim>
unsigned int block_of(const Dynamics<dim> &dynamics, const unsigned int cell)
{
  unsigned int b = 0;
  while (!dynamics.blocks[b]->contains(cell))
    ++b;
  return b;
}

/// Numbers of cells on their way to the next mesh, wherever the cells go:
///
///   CellTransport<dim> transport(triangulation, discretization, pack, join);   // before the change; collective
///   triangulation.execute_coarsening_and_refinement();
///   discretization.distribute_nodes();
///   transport.unpack(take);
///
/// In one dimension, where all processes hold the whole mesh, they hold all numbers while it changes.
template <int dim>
class CellTransport
{
public:
  using Cell    = typename dealii::Triangulation<dim>::cell_iterator;
  using Numbers = std::vector<double>;

  enum class Change
  {
    none,
    halved, ///< take() sees the parent of the new cells
    joined
  };

  /// @p pack: of an owned active cell, with @p halved if its children will read them. @p join: of the cell that takes the place of children,
  /// from what they packed, perhaps as if they were halved. Both are called until unpack() is done.
  /// @p equal_sizes: every cell packs as many numbers.
  CellTransport(ParallelTriangulation<dim> &, const Discretization<dim> &,
                std::function<Numbers(const Cell &, bool halved)>    pack,
                std::function<Numbers(const std::vector<Numbers> &)> join, bool equal_sizes);
  CellTransport(const CellTransport &) = delete;

  /// For all owned cells of the new mesh, or their parents.
  void unpack(const std::function<void(const Cell &, const Numbers &, Change)> &take);

private:
  void gather();
  void unpack_by_id(const std::function<void(const Cell &, const Numbers &, Change)> &take) const;

  ParallelTriangulation<dim>                                &triangulation;
  const Discretization<dim>                                 &discretization;
  const std::function<Numbers(const Cell &, bool)>           pack;
  const std::function<Numbers(const std::vector<Numbers> &)> join;

  unsigned int                      handle = dealii::numbers::invalid_unsigned_int;
  std::map<dealii::CellId, Numbers> by_id; ///< in one dimension
};
} // namespace Arenite
