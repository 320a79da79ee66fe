#include <arenite/simulation/block_summary.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Where the cell with the largest hourglass energy is, and that energy; collective.
template <int dim>
std::string worst_cell(const Discretization<dim> &discretization, const BlockEnergy &own)
{
  const auto worst = Utilities::MPI::min_max_avg(own.largest_hourglass, discretization.communicator);
  Point<dim> place;
  if (own.hourglass_cell < discretization.cells().size())
    place = discretization.cells()[own.hourglass_cell]->center();
  place = Utilities::MPI::broadcast(discretization.communicator, place, worst.max_index);
  std::ostringstream text;
  text.precision(3);
  text << worst.max << " J in the cell at (" << place << ')';
  return text.str();
}
} // namespace

template <int dim>
std::string describe_blocks(const Dynamics<dim> &dynamics, const State<dim> &state,
                            const std::vector<std::string> &names, const double factor)
{
  const MPI_Comm     communicator = dynamics.discretization.communicator;
  std::ostringstream text;
  text.precision(3);
  for (unsigned int b = 0; b < dynamics.blocks.size(); ++b)
    {
      const InternalForce<dim> &block = *dynamics.blocks[b];
      const BlockEnergy         own   = block.energy(state, state.blocks[b]);
      std::vector<double>       sums{own.strain, own.dissipated, own.bulk_viscosity, own.hourglass};
      Utilities::MPI::sum(sums, communicator, sums);
      const auto [stored, law, viscous, hourglass] = std::tie(sums[0], sums[1], sums[2], sums[3]);
      if (block.stores_points())
        {
          text << "Energy     " << names[b] << ": " << factor * stored << " J stored, " << factor * law
               << " J dissipated by the law, " << factor * viscous << " J by bulk viscosity";
          if (const double tau = block.relaxation_time(); tau > 0. && state.step > 0)
            {
              // of the cells as they are now
              double shortest = std::numeric_limits<double>::infinity();
              for (const double frequency : state.blocks[b].points.frequency)
                if (frequency > 0.)
                  shortest = std::min(shortest, 2. / std::sqrt(frequency));
              text << "; relaxation time " << tau << " s = " << tau * state.step / state.time
                   << " mean steps = " << tau / Utilities::MPI::min(shortest, communicator)
                   << " h/c of the smallest cell";
            }
          const double parts = Utilities::MPI::max(state.blocks[b].points.substeps, communicator);
          if (parts > 1.)
            text << "; the law divided steps into up to " << parts << " parts";
          text << '\n';
        }
      if (hourglass != 0.)
        text << "Hourglass  " << names[b] << ": " << factor * hourglass << " J, "
             << 100. * hourglass / (stored + law + viscous + hourglass) << " % of the block's energy; most "
             << worst_cell(dynamics.discretization, own)
             << (std::abs(hourglass) > 0.1 * std::abs(stored + law + viscous + hourglass)
                   ? ". Too much: patterns rule the motion, refine, or take 'Hourglass control = viscous' or 'Type = "
                     "hexahedron'"
                   : "")
             << '\n';
    }
  return text.str();
}

template std::string describe_blocks(const Dynamics<1> &, const State<1> &, const std::vector<std::string> &, double);
template std::string describe_blocks(const Dynamics<2> &, const State<2> &, const std::vector<std::string> &, double);
template std::string describe_blocks(const Dynamics<3> &, const State<3> &, const std::vector<std::string> &, double);
} // namespace Arenite
