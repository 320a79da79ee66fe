#pragma once

#include <arenite/mesh/parallel_triangulation.h>
#include <arenite/time/dynamics.h>

#include <deal.II/grid/cell_id.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace Arenite
{
/// The mesh and all fields on it, cell by cell, as files that any number of processes can read: one file per process with the cells that
/// it owns, each with its place in the forest, its nodes' positions, displacements, velocities and boundary scalars, and the record that
/// its block packs. Values of nodes that several cells share are written with each of them.
///
///   SavedCells<dim> saved(files);
///   saved.make_mesh(triangulation);            // from the coarse mesh
///   discretization.distribute_nodes();
///   saved.read(discretization);                // own cells; sets the positions
///   dynamics.reinit(state, false);
///   saved.set_fields(dynamics, state, {&ratio, &trail});
template <int dim>
class SavedCells
{
public:
  /// What writes the file of this process, between two steps, before the forces of t_n. @p of_cells: one number per active cell each, or none,
  /// which is read as 0. All must live as long as the writer, which is not collective; this is.
  static std::function<void(std::ostream &)> writer(const Dynamics<dim> &, const State<dim> &,
                                                    const std::vector<const dealii::Vector<double> *> &of_cells);

  /// Which cells there are. CheckpointError if a file is not what it should be, on this process. Collective.
  SavedCells(const std::vector<std::string> &files, MPI_Comm);

  /// Refine the coarse mesh until it has the cells of the files. CheckpointError if it does not get there. Collective.
  void make_mesh(ParallelTriangulation<dim> &) const;

  /// Collective.
  void read(Discretization<dim> &);

  /// Displacements, velocities, boundary scalars, all that blocks keep, and numbers of cells. The memory is given back to the system. Collective.
  void set_fields(Dynamics<dim> &, State<dim> &, const std::vector<dealii::Vector<double> *> &of_cells);

private:
  using Numbers = std::vector<double>;

  const std::vector<std::string>                        files;
  std::vector<std::vector<dealii::CellId::binary_type>> ids; ///< [file][cell]
  std::vector<Numbers> numbers;                              ///< of own cells, in the order of Discretization::cells()
};
} // namespace Arenite
