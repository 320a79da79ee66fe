#pragma once

#include <arenite/mechanics/discretization.h>
#include <arenite/mesh/parallel_triangulation.h>

#include <functional>
#include <string>

namespace Arenite
{
/// Time that a cell takes in a step, as a multiple of that of a fused elastic one: calibrated constants (benchmarks/law_cost), because nothing
/// may depend on measured times.
struct CellCost
{
  static constexpr unsigned int elastic = 1, law = 4, law_with_memory = 8;
};

/// By material id.
using CostOfCells = std::function<unsigned int(dealii::types::material_id)>;

/// From now on the cells are divided among processes so that all have as much to do. Without effect in one dimension, where cells are counted. Collective.
template <int dim>
void divide_by_cost(ParallelTriangulation<dim> &, const CostOfCells &);

/// How the work is divided, for the log: fewest and most cells, most work over the mean, nodes that others own. Collective.
template <int dim>
std::string describe_partition(const Discretization<dim> &, const CostOfCells &);

/// Part of the updates of cells that would be left if each level of the mesh had its own step, half as long as that of the next coarser one:
/// sum over cells of 2^(level - finest level) over their number. Collective.
template <int dim>
double share_of_updates(const ParallelTriangulation<dim> &);
} // namespace Arenite
