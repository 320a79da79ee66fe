#pragma once

#include <arenite/base/parameters.h>
#include <arenite/io/files.h>
#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>
#include <arenite/time/energy_balance.h>

#include <deal.II/base/types.h>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>

namespace Arenite
{
class StateArchive;

/// What a step had to do, for the row of the statistics and for the throughput.
struct StepInfo
{
  unsigned int  step    = 0;
  double        dt      = 0.; ///< the step that follows [s]
  std::uint64_t n_cells = 0, n_dofs = 0;
};

/// statistics.csv, one row per energy report, and the line that tells the user how far the run is.
///
/// All energies are those of the full body: the reports are multiplied by the symmetry factor, and the header says so. In plane strain
/// and plane waves they count for one metre or square metre, see per_extent().
///
///   statistics.open(directory, log, start, end, symmetry_factor);
///   if (statistics.is_due(step)) statistics.add(dynamics.report(state, dt), info);
///   statistics.finish();
class Statistics
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// Start the file, or go on with that of an interrupted run: exchange() must follow then. @p start is the time [s] at which the steps begin, @p end where they shall end. Collective.
  void open(const OutputDirectory &, Log &, double start, double end, double symmetry_factor,
            const std::string &per_extent = "", FileStart = FileStart::fresh);

  void exchange(StateArchive &);

  /// True for every row_interval-th step, counted from step 0.
  bool is_due(const unsigned int step) const { return step % row_interval == 0; }

  /// One row; now and then, and always for the first row, a line of progress. OutputError as soon as a row cannot be
  /// written. Collective.
  void add(const EnergyReport &, const StepInfo &);

  /// The last line of progress; the file is complete afterwards, or OutputError. Collective.
  void finish();

  /// Sum over the steps of the unknowns moved, from the first row to the last.
  double dof_steps() const { return work; }

  double       progress_interval = 2.; ///< wall time [s]
  unsigned int row_interval      = 50; ///< steps

private:
  using Clock = std::chrono::steady_clock;

  void write_header(const EnergyReport &);
  void print_progress();

  Log          *log          = nullptr;
  MPI_Comm      communicator = MPI_COMM_NULL;
  bool          active       = false; ///< this process writes
  double        start = 0., end = 0., symmetry_factor = 1.;
  std::string   name, problem, per_extent;
  std::ofstream file;

  EnergyReport  last;
  StepInfo      last_info;
  double        last_error = 0., largest_scale = 0., largest_momentum = 0., work = 0.;
  std::uint64_t n_rows = 0;

  bool              printed_last = true;
  double            printed_work = 0.;
  Clock::time_point begin, printed_at;
};

/// "42 s", "3 min 05 s", "2 h 10 min".
std::string duration(double seconds);
} // namespace Arenite
