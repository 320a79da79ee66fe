#pragma once

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>

namespace Arenite
{
/// Mesh whose cells are divided among processes: a p4est forest in two and three dimensions.
template <int dim>
class ParallelTriangulation : public dealii::parallel::distributed::Triangulation<dim>
{
public:
  explicit ParallelTriangulation(const MPI_Comm communicator)
    : dealii::parallel::distributed::Triangulation<dim>(communicator)
  {}
};

/// One dimension, where p4est does not exist (and a forest would own no cell, without a word): all processes hold the whole mesh,
/// must flag it alike, and own consecutive parts of it. No cell is artificial.
template <>
class ParallelTriangulation<1> : public dealii::parallel::shared::Triangulation<1>
{
public:
  explicit ParallelTriangulation(const MPI_Comm communicator)
    : dealii::parallel::shared::Triangulation<1>(communicator, dealii::Triangulation<1>::none, false,
                                                 dealii::parallel::shared::Triangulation<1>::partition_zorder)
  {}
};
} // namespace Arenite
