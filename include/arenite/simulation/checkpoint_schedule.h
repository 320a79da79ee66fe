#pragma once

#include <arenite/base/parameters.h>
#include <arenite/io/output_directory.h>
#include <arenite/simulation/stop_signals.h>

#include <chrono>
#include <string>

namespace Arenite
{
/// When a run writes checkpoints, and when it ends with one before its time: signals, a file STOP in its directory, its wall time, and the
/// entries of the scene. Nothing of it changes the result.
class CheckpointSchedule
{
public:
  void declare_parameters(Parameters &);

  /// From now on signals are wishes.
  void start(const OutputDirectory &, unsigned int first_step);

  /// Before each step. All processes get the same answer; they talk to each other some times per second.
  Wish ask(unsigned int step);

  /// After a checkpoint that took @p seconds.
  void note_checkpoint(double seconds);

  /// Why the last wish was to stop, on process 0.
  const std::string &reason() const { return why; }

private:
  using Clock = std::chrono::steady_clock;

  Wish         wish_of_first_process();
  unsigned int steps_until_next_look(unsigned int step);

  double       interval = 3600., largest_time = 0.; ///< wall time [s]
  unsigned int steps = 0;

  const Clock::time_point begin           = Clock::now();
  Clock::time_point       last_checkpoint = begin, last_look = begin;
  const OutputDirectory  *directory = nullptr;
  unsigned int            next_look = 0, looked_at = 0, last_pause = 1, first_step = 0;
  double                  longest_write = 0.;
  std::string             why;
};
} // namespace Arenite
