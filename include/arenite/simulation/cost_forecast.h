#pragma once

#include <arenite/simulation/commands.h>

#include <deal.II/base/mpi.h>

#include <optional>

namespace Arenite
{
/// What a run on an adaptive mesh will cost.
struct CostForecast
{
  unsigned int levels;                  ///< of the largest trial
  double       trial_core_seconds;      ///< of all trials
  double       core_seconds, memory_mb; ///< of the run: time loop; all processes together
  double       cells;                   ///< most at a time
};

/// Runs the scene with fewer levels and tells from their growth what all its @p levels will cost: where and how long a wave keeps cells fine,
/// nobody knows before. With W_l the sum over the steps of the unknowns of a run with l levels, and k the last trial,
///
///   W_L = W_k (W_k / W_(k-1))^(L-k):   from 2^d for fine cells along surfaces to 2^(d+1) for all cells fine, twice the steps with each level.
///
/// Cells grow likewise. Trials go on to L-1 levels while the next is sure to end within a minute; nothing if that leaves less than two.
/// @p coarse_core_seconds: expected of the run without levels. Collective.
std::optional<CostForecast> forecast_cost(const RunOptions &, unsigned int levels, double coarse_core_seconds,
                                          MPI_Comm);
} // namespace Arenite
