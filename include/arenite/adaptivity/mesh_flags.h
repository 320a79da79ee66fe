#pragma once

#include <arenite/mechanics/discretization.h>
#include <arenite/mesh/parallel_triangulation.h>

#include <vector>

namespace Arenite
{
// Sets of active cells by their index, of which each process knows its own, and the flags that follow. The same mesh comes out on any number
// of processes. All are collective but keep_what_is_distorted().

/// Layers of cells of the level @p finest between each cell and the region, 0 for cells that touch it or are part of it; at most @p most. Coarser cells on the
/// way count as many layers as fine ones would.
template <int dim>
std::vector<unsigned int> layers_from(ParallelTriangulation<dim> &, const std::vector<bool> &region,
                                      unsigned int finest, unsigned int most);

/// Families of cells stay where joining them would move a node by more than a part of their deformed size: behind a blast neighbours are
/// stretched so differently that the one cell in their place would be inverted, or would be soon.
template <int dim>
void keep_what_is_distorted(const Discretization<dim> &, const VectorType &displacement, std::vector<bool> &quiet);

/// Refine what is below its wanted level, coarsen what is above and quiet.
template <int dim>
void set_flags(ParallelTriangulation<dim> &, const std::vector<unsigned int> &wanted, const std::vector<bool> &quiet);
} // namespace Arenite
