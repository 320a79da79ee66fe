#include <arenite/simulation/mesh_summary.h>

#include <cmath>
#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
void divide_by_cost(ParallelTriangulation<dim> &triangulation, const CostOfCells &cost)
{
  if constexpr (dim > 1)
    {
      using Triangulation = ParallelTriangulation<dim>;
      triangulation.signals.weight.connect(
        [cost](const typename Triangulation::cell_iterator &cell, const typename Triangulation::CellStatus) {
          return 1000 * cost(cell->material_id()); // families that are joined or halved keep their material
        });
      triangulation.repartition();
    }
}

template <int dim>
std::string describe_partition(const Discretization<dim> &discretization, const CostOfCells &cost)
{
  double work = 0.;
  for (const auto &cell : discretization.cells())
    work += cost(cell->material_id());
  const MPI_Comm communicator = discretization.communicator;
  const auto     cells        = Utilities::MPI::min_max_avg(double(discretization.cells().size()), communicator);
  const auto     works        = Utilities::MPI::min_max_avg(work, communicator);
  const double   ghosts = Utilities::MPI::sum(double(discretization.node_partitioner->n_ghost_indices()), communicator);
  std::ostringstream text;
  text.precision(3);
  text << cells.min << " to " << cells.max << " cells on a process, at most " << works.max / works.avg
       << " of the mean work; " << 100. * ghosts / discretization.n_nodes() << " % of the nodes are ghosts";
  return text.str();
}

template <int dim>
double share_of_updates(const ParallelTriangulation<dim> &triangulation)
{
  double updates = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      updates += std::pow(2., cell->level() - int(triangulation.n_global_levels()) + 1);
  return Utilities::MPI::sum(updates, triangulation.get_communicator()) / triangulation.n_global_active_cells();
}

#define ARENITE_INSTANTIATE(dim)                                                             \
  template void        divide_by_cost(ParallelTriangulation<dim> &, const CostOfCells &);    \
  template std::string describe_partition(const Discretization<dim> &, const CostOfCells &); \
  template double      share_of_updates(const ParallelTriangulation<dim> &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
