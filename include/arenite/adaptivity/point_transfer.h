#pragma once

#include <arenite/adaptivity/cell_records.h>
#include <arenite/adaptivity/cell_transport.h>
#include <arenite/time/dynamics.h>

#include <optional>

namespace Arenite
{
/// Moves what the points of all blocks store from one mesh to the next, on any number of processes:
///
///   PointTransfer<dim> points(transport, triangulation, dynamics, state);   // before the change
///   transport.send();
///   triangulation.execute_coarsening_and_refinement();
///   ...                                              // nodes, transport.receive(), dynamics.reinit(state, false), fields
///   points.unpack(state);                                        // displacement and velocity with ghosts and hanging nodes
///
/// Cells that stay as they are keep their numbers bit by bit; CellRecords has the rules for the others. Where only hanging nodes were moved, density and
/// stored energy are taken anew. Displacement gradients, and what follows
/// from them, are not moved but computed from the displacement.
template <int dim>
class PointTransfer
{
public:
  /// Takes the arrays of the points out of the state. Collective.
  PointTransfer(CellTransport<dim> &, ParallelTriangulation<dim> &, Dynamics<dim> &, State<dim> &);
  PointTransfer(const PointTransfer &) = delete;

  /// Into the points of the new mesh; the sums of each block go on. Collective.
  void unpack(State<dim> &);

private:
  using Cell    = typename CellTransport<dim>::Cell;
  using Numbers = std::vector<double>;

  /// What an active cell of the old mesh has, and what others know of it.
  struct OldCell
  {
    unsigned int block = dealii::numbers::invalid_unsigned_int;
    double       moved = 0.;   ///< a number of its nodes' displacements, to see whether they change
    Numbers      record, mean; ///< the record of owned cells only; both empty where nothing is stored
  };

  void                                    share_means(const ParallelTriangulation<dim> &);
  typename CellRecords<dim>::Surroundings surroundings(const Cell &) const;
  void                                    pack(const Cell &, bool halved, Numbers &) const;
  Numbers                                 join(const std::vector<Numbers> &children) const;
  void put_children(const Cell &parent, const Numbers &packed, const std::vector<unsigned int> &index, State<dim> &);

  CellTransport<dim>                    &transport;
  Dynamics<dim>                         &dynamics;
  std::vector<CellRecords<dim>>          rules;   ///< per block
  std::vector<OldCell>                   old;     ///< per active cell of the old mesh
  std::vector<std::vector<unsigned int>> changed; ///< cells of the new mesh, per block
  std::vector<PointData>                 sums;    ///< per block, without arrays
  std::optional<unsigned int>            cargo;   ///< none where nothing is stored
};
} // namespace Arenite
