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

/// Numbers of cells on their way to the next mesh, wherever the cells go. Several cargoes travel in one parcel per cell, because parcels cost
/// more than what is in them:
///
///   CellTransport<dim> transport(triangulation, discretization);
///   const auto cargo = transport.add(pack, join);                // any number of them
///   transport.send();                                            // collective
///   triangulation.execute_coarsening_and_refinement();
///   discretization.distribute_nodes();
///   transport.receive();                                         // collective
///   transport.unpack(cargo, take);
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

  /// Appends the numbers of an owned active cell of the old mesh, with @p halved if its children will read them.
  using Pack = std::function<void(const Cell &, bool halved, Numbers &)>;
  /// Numbers of the cell that takes the place of children, from what these packed, perhaps as if they were halved.
  using Join = std::function<Numbers(const std::vector<Numbers> &children)>;
  using Take = std::function<void(const Cell &, const Numbers &, Change)>;

  CellTransport(ParallelTriangulation<dim> &, const Discretization<dim> &);
  CellTransport(const CellTransport &) = delete;

  /// @p pack and @p join are called until receive() is done.
  unsigned int add(Pack pack, Join join);
  void         send();
  void         receive();

  /// For all owned cells of the new mesh, or their parents; as often as wanted.
  void unpack(unsigned int cargo, const Take &take) const;

private:
  struct Cargo
  {
    Pack pack;
    Join join;
  };
  struct Arrival
  {
    Cell        cell;
    Change      change;
    std::size_t first; ///< of its numbers: how many each cargo has, then these
  };

  void pack(const Cell &, bool halved, Numbers &parcel) const;
  void join(const std::vector<Numbers> &children, Numbers &parcel) const;
  void arrive(const Cell &, Change, const double *parcel, std::size_t size);
  void gather();
  void receive_by_id();

  ParallelTriangulation<dim> &triangulation;
  const Discretization<dim>  &discretization;
  std::vector<Cargo>          cargoes;
  std::vector<Arrival>        arrivals;
  Numbers                     numbers; ///< of all arrivals

  unsigned int                      handle = dealii::numbers::invalid_unsigned_int;
  std::map<dealii::CellId, Numbers> by_id; ///< parcels, in one dimension
};
} // namespace Arenite
