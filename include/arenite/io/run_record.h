#pragma once

#include <arenite/base/number.h>
#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace Arenite
{
/// What a run was and what it cost: run.json and the table at the end of the log. Version, commit, compiler, deal.II and the
/// number of ranks are added by write().
struct RunRecord
{
  std::string              title;
  std::vector<std::string> scenes, overrides; ///< as on the command line

  std::string   element, symmetry = "none";
  unsigned int  dimension = 3, degree = 1, lanes = native_lanes;
  double        symmetry_factor = 1.;
  std::uint64_t cells = 0, dofs = 0, steps = 0; ///< of the last mesh; unknowns = components of all nodes
  double        time       = 0.;                ///< reached [s]
  double        most_cells = 0.;                ///< at a time
  double        dof_steps  = 0.;                ///< sum over the steps of the unknowns, for the throughput

  // ranks x wall time [s]
  double setup_core_seconds = 0., core_seconds = 0., output_core_seconds = 0.;
  double adaptation_core_seconds = 0.; ///< part of core_seconds

  double energy_error = 0., impulse_error = 0., mass_error = 0., momentum_error = 0.;
  double dissipation = 0., artificial_dissipation = 0.,
         hourglass_energy         = 0.;    ///< by laws; by bulk viscosity; full body [J]
  bool          is_static         = false; ///< steps are those of a load; no energy balance
  std::uint64_t newton_iterations = 0, linear_iterations = 0;

  /// "<receiver set>.<quantity>.E_t", "volume.<quantity>.E_x", "boundary.traction.E_inf" -> relative error
  std::map<std::string, double> errors;
  /// "<receiver set>.<quantity>.rms|peak": what runs without an exact solution are compared by
  std::map<std::string, double> values;

  /// Core-seconds of the parts of the step, if they were measured.
  std::map<std::string, double> parts;

  double peak_memory_mb = 0., total_memory_mb = 0.; ///< largest process, and all together; see measure_memory()

  /// Largest memory in use so far by one process, and the sum over all [MB]. Collective.
  void measure_memory(MPI_Comm);

  /// Million unknowns per second that one core moves; 0 before the first step.
  double mdofs_per_core_second() const { return core_seconds > 0. ? dof_steps / core_seconds / 1e6 : 0.; }

  /// Write run.json; OutputError if it is not complete. Collective.
  void write(const OutputDirectory &) const;

  /// The table at the end: errors, cost, energy error and the files that the run has written.
  void print_summary(Log &, const OutputDirectory &) const;
};
} // namespace Arenite
