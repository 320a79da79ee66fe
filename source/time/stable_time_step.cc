#include <arenite/time/stable_time_step.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void StableTimeStep<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Time stepping");
  parameters.add_quantity(
    "Courant number", courant, "-", {0., 2., true, false},
    "Part of the stable step. The error in time grows with its square; above 1 the run may blow up.");
  parameters.add_quantity("Fixed step", fixed, "s", non_negative,
                          "Use this step whatever the mesh needs; 0 follows the stable step.");
  parameters.add_quantity("Largest step", largest, "s", non_negative, "Upper limit, for accuracy in time; 0 for none.");
}

template <int dim>
void StableTimeStep<dim>::finalize(const Parameters &)
{}

template <int dim>
void StableTimeStep<dim>::calibrate(const Dynamics<dim> &dynamics)
{
  const auto    &cells = dynamics.discretization.cells();
  Vector<double> lambda(cells.size()), size(cells.size());
  for (const auto &block : dynamics.blocks)
    {
      block->largest_eigenvalue(lambda);
      block->inverse_size_squared(size);
    }
  ratio.reinit(dynamics.discretization.triangulation.n_active_cells());
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    ratio[cells[cell]->active_cell_index()] = lambda[cell] / size[cell];
  update(dynamics);
}

template <int dim>
void StableTimeStep<dim>::update(const Dynamics<dim> &dynamics)
{
  // The power iteration ends at most 1e-3 below the eigenvalue, and children of curved cells differ from their parents by some
  // percent (measured in tests/mechanics/stable_step.cc).
  constexpr double margin = 1.03;
  const auto      &cells  = dynamics.discretization.cells();
  Vector<double>   size(cells.size());
  for (const auto &block : dynamics.blocks)
    block->inverse_size_squared(size);
  double       largest_eigenvalue = 0.;
  unsigned int limiting           = 0;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      const double lambda = ratio[cells[cell]->active_cell_index()] * size[cell];
      if (lambda > largest_eigenvalue)
        {
          largest_eigenvalue = lambda;
          limiting           = cell;
        }
    }
  const MPI_Comm communicator = dynamics.discretization.communicator;
  const auto     winner       = Utilities::MPI::min_max_avg(largest_eigenvalue, communicator);
  critical_step               = 2. / std::sqrt(margin * winner.max);
  place                       = Point<dim>();
  if (!cells.empty() && Utilities::MPI::this_mpi_process(communicator) == winner.max_index)
    {
      std::vector<Point<dim>> x;
      dynamics.discretization.cell_positions(limiting, x);
      for (const auto &node : x)
        place += node / static_cast<double>(x.size());
    }
  place = Utilities::MPI::broadcast(communicator, place, winner.max_index);
}

template <int dim>
double StableTimeStep<dim>::next(const double time, const double end_time) const
{
  double dt = fixed > 0. ? fixed : courant * critical_step;
  if (largest > 0.)
    dt = std::min(dt, largest);
  const double left = end_time - time;
  return left / std::max(1., std::ceil(left / dt * (1. - 1e-12)));
}

template class StableTimeStep<3>;
} // namespace Arenite
