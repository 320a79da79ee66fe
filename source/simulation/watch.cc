#include <arenite/base/errors.h>
#include <arenite/mesh/cell_audit.h>
#include <arenite/simulation/simulation.h>

#include <cmath>
#include <sstream>

namespace Arenite
{
using namespace dealii;

/// Where a cell is, and what its first node stores.
template <int dim>
std::string Simulation<dim>::describe_points(const unsigned int block, const unsigned int cell) const
{
  std::vector<double> values;
  dynamics->blocks[block]->point_values(state, state.blocks[block], cell, values);
  const auto         names = dynamics->blocks[block]->names_of_point_values();
  const std::size_t  n     = 6 + names.size();
  std::ostringstream text;
  text << "cell " << discretization.cells()[cell]->id() << " around (" << discretization.cells()[cell]->center()
       << "), block '" << scene.blocks[block].name << "'";
  bool inverted = false, finite = true;
  for (std::size_t k = 0; k < values.size(); ++k)
    {
      inverted = inverted || (k % n == 6 && !(values[k] > 0.)); // density
      finite   = finite && std::isfinite(values[k]);
    }
  if (inverted || !finite)
    text << (inverted ? ": the cell is inverted (J <= 0)" : ": a value is not a number");
  text << ".\nAt its first node: stress";
  for (unsigned int k = 0; k < 6; ++k)
    text << ' ' << values[k];
  text << " Pa";
  for (std::size_t k = 0; k < names.size(); ++k)
    text << ", " << names[k] << ' ' << values[6 + k];
  return text.str();
}

/// A point that is inverted or not finite ends the run, and so does a step that became too short: with the cell, its place and its
/// state.
template <int dim>
void Simulation<dim>::watch(const PointLimits<dim> &limits) const
{
  const double smallest  = scene.time_step.smallest(scene.end_time);
  const bool   too_short = limits.stable_step < smallest;
  if (!limits.failed && !too_short)
    return;
  const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
  unsigned int       speaker = limits.failed_rank;
  if (!limits.failed)
    {
      double own = std::numeric_limits<double>::infinity();
      for (const BlockState &record : state.blocks)
        own = std::min(own, record.points.stable_step);
      speaker = Utilities::MPI::min_max_avg(own, communicator).min_index;
    }
  std::string text;
  if (rank == speaker)
    for (unsigned int b = 0; b < dynamics->blocks.size() && text.empty(); ++b)
      {
        const PointData &points = state.blocks[b].points;
        if (limits.failed && points.failed_cell != std::numeric_limits<unsigned int>::max())
          text = describe_points(b, points.failed_cell);
        else if (!limits.failed && points.stores_points && points.stable_step <= limits.stable_step)
          text = describe_points(b, points.limiting_cell);
      }
  text = Utilities::MPI::broadcast(communicator, text, speaker);
  std::ostringstream message;
  message << "t = " << state.time << " s, step " << state.step << ", " << text << ".\nThe step is " << state.dt_last
          << " s";
  if (too_short && !limits.failed)
    message << ", and no longer one than " << limits.stable_step << " s is stable now, less than the " << smallest
            << " s of 'Time stepping / Smallest step'. Look at the law and the load there, or allow shorter steps.";
  else
    message << ". Lower 'Time stepping / Courant number', refine there, raise the bulk viscosity, or look at the load.";
  if (scene.pictures.last_time() >= 0.)
    message << " The last picture is that of t = " << scene.pictures.last_time() << " s.";
  throw PhysicsAlarm(message.str());
}

/// Warn once of a step above the stability limit: what it spoils may look like a result.
template <int dim>
void Simulation<dim>::watch_step(const double dt)
{
  if (warned_of_step || dt <= scene.time_step.limit())
    return;
  warned_of_step = true;
  std::ostringstream text;
  text << "Warning    t = " << state.time << " s: the step of " << dt << " s is above the stability limit of "
       << scene.time_step.limit()
       << " s; do not trust the result. Lower 'Time stepping / Courant number' or remove 'Fixed step'.";
  log.line(text.str());
}

/// Warn once of cells that are folded at a corner, though their points see nothing of it: gas and liquids have no stiffness against
/// patterns in which cells turn inside out, and a run goes on without an alarm.
template <int dim>
void Simulation<dim>::watch_corners()
{
  if (warned_of_folding || dim == 1 || !scene.kinematics.finite_strain())
    return;
  const unsigned int      p = discretization.degree();
  std::vector<Point<dim>> corners(GeometryInfo<dim>::vertices_per_cell);
  unsigned int            folded = 0, first = 0;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          unsigned int node = 0;
          for (unsigned int d = 0; d < dim; ++d)
            node += (v >> d & 1) * p * Utilities::pow(p + 1, d);
          node       = discretization.cell_nodes(cell)[node];
          corners[v] = discretization.position(node);
          for (unsigned int c = 0; c < dim; ++c)
            corners[v][c] += state.displacement.local_element(dim * node + c);
        }
      bool is_sound = true;
      for (unsigned int v = 0; v < corners.size() && is_sound; ++v)
        is_sound = !(corner_jacobian(corners, v) < 0.);
      if (!is_sound && folded++ == 0)
        first = cell;
    }
  const unsigned int total = Utilities::MPI::sum(folded, communicator);
  if (total == 0)
    return;
  warned_of_folding          = true;
  const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
  const unsigned int speaker = Utilities::MPI::min(folded > 0 ? rank : numbers::invalid_unsigned_int, communicator);
  Point<dim>         place   = rank == speaker ? discretization.cells()[first]->center() : Point<dim>();
  place                      = Utilities::MPI::broadcast(communicator, place, speaker);
  std::ostringstream text;
  text << "Warning    t = " << state.time << " s: " << total << (total == 1 ? " cell is" : " cells are")
       << " folded at a corner, one around (" << place
       << ") before it moved; do not trust the motion there. Hourglass control and a smoother start help.";
  log.line(text.str());
}

/// Stop a run whose state left physics: with the time, the place and the likely cause.
template <int dim>
void Simulation<dim>::watch(const EnergyReport &report)
{
  double input = report.initial;
  for (const auto &account : report.work)
    input += std::abs(account.second);
  const double       stored = report.strain + report.hourglass;
  const bool         finite = std::isfinite(report.kinetic) && std::isfinite(stored);
  std::ostringstream reason;
  if (!finite)
    reason << "the state is not a number any more";
  // the leapfrog kinetic energy of a mode near the limit may be negative, but below it the sum never is, and the strain energy stays
  // below the sum over 1 - (omega dt/2)^2
  else if (stored > 1e3 * input && input > 0.)
    reason << "the strain energy grew to " << stored << " J from " << input
           << " J of work, the sign of a step above the stability limit";
  else if (report.kinetic + stored > 10. * input && input > 0.)
    reason << "the energy grew to " << report.kinetic + stored << " J from " << input << " J of work";
  else if (std::abs(report.imbalance()) > 0.1 * report.scale() && report.scale() > 0.)
    reason << "the energy balance is off by " << 100. * report.imbalance() / report.scale() << " %";
  else
    return;

  // where: the node with a value that is not finite, else the fastest one
  double       worst = -1.;
  unsigned int where = 0;
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    {
      double speed = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        speed += std::pow(state.half_velocity.local_element(dim * node + c), 2);
      if (!std::isfinite(speed))
        speed = std::numeric_limits<double>::max();
      if (speed > worst)
        {
          worst = speed;
          where = node;
        }
    }
  const auto winner = Utilities::MPI::min_max_avg(worst, communicator);
  Point<dim> place  = worst >= 0. ? discretization.position(where) : Point<dim>();
  place             = Utilities::MPI::broadcast(communicator, place, winner.max_index);
  std::ostringstream message;
  message << "t = " << report.time << " s, step " << state.step << ", near (" << place << "): " << reason.str()
          << ".\nThe step is " << state.dt_last << " s, the stable limit " << scene.time_step.limit()
          << " s. Lower 'Time stepping / Courant number'"
          << (state.dt_last > scene.time_step.limit() ? " or remove 'Fixed step'" : "")
          << ", and look at the mesh at that place.";
  throw PhysicsAlarm(message.str());
}

#define ARENITE_INSTANTIATE(dim)                                                           \
  template std::string Simulation<dim>::describe_points(unsigned int, unsigned int) const; \
  template void        Simulation<dim>::watch(const PointLimits<dim> &) const;             \
  template void        Simulation<dim>::watch(const EnergyReport &);                       \
  template void        Simulation<dim>::watch_corners();                                   \
  template void        Simulation<dim>::watch_step(double);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
