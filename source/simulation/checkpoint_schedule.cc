#include <arenite/simulation/checkpoint_schedule.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr double time_between_looks = 0.2; ///< [s]

double seconds_since(const std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
} // namespace

void CheckpointSchedule::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Output");
  parameters.add_quantity(
    "Checkpoint interval", interval, "s", non_negative,
    "Wall time between two checkpoints, from which 'arenite run --resume' goes on; 0 writes none unless "
    "a signal asks for one.");
  parameters.add_integer("Checkpoint steps", steps, 0, 1000000000,
                         "Steps between two checkpoints, besides those of the interval; 0 for none.");
  parameters.add_quantity(
    "Largest wall time", largest_time, "s", non_negative,
    "A run that would take longer ends with a checkpoint before, and exit code 75; 0 for no limit.");
}

void CheckpointSchedule::start(const OutputDirectory &output, const unsigned int step)
{
  directory  = &output;
  first_step = looked_at = next_look = step;
  last_look = last_checkpoint = Clock::now();
  catch_signals();
}

/// Of the signals and of what only one process should look at.
Wish CheckpointSchedule::wish_of_first_process()
{
  const std::string stop_file = directory->file("STOP");
  std::error_code   error;
  const double      reserve = 2. * longest_write + std::min(10., 0.05 * largest_time) + 2. * time_between_looks;
  if (std::filesystem::exists(stop_file, error))
    {
      std::filesystem::remove(stop_file, error);
      why = "a file STOP";
    }
  else if (largest_time > 0. && seconds_since(begin) + reserve > largest_time)
    why = "the largest wall time";
  else
    return interval > 0. && seconds_since(last_checkpoint) > interval ? Wish::checkpoint : Wish::nothing;
  return Wish::stop;
}

/// So that the next look comes about when it should; grows slowly, because the first steps say little.
unsigned int CheckpointSchedule::steps_until_next_look(const unsigned int step)
{
  const double per_step = step > looked_at ? seconds_since(last_look) / (step - looked_at) : time_between_looks;
  const double pause    = std::min(time_between_looks / std::max(per_step, 1e-9), 2. * last_pause);
  last_look             = Clock::now();
  looked_at             = step;
  return last_pause     = static_cast<unsigned int>(std::max(1., std::min(pause, 1e6)));
}

Wish CheckpointSchedule::ask(const unsigned int step)
{
  Wish wish = steps > 0 && step > first_step && step % steps == 0 ? Wish::checkpoint : Wish::nothing;
  if (step < next_look)
    return wish;
  std::array<int, 2> numbers{{static_cast<int>(std::max(wish, wish_of_signals())), 0}}; // wish, pause
  if (Utilities::MPI::this_mpi_process(directory->communicator) == 0)
    {
      why        = "a signal";
      numbers[0] = std::max(numbers[0], static_cast<int>(wish_of_first_process()));
      numbers[1] = static_cast<int>(steps_until_next_look(step));
    }
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), 2, MPI_INT, MPI_MAX, directory->communicator);
  next_look = step + numbers[1];
  return static_cast<Wish>(numbers[0]);
}

void CheckpointSchedule::note_checkpoint(const double seconds)
{
  longest_write   = std::max(longest_write, seconds);
  last_checkpoint = last_look = Clock::now();
  if (wish_of_signals() == Wish::checkpoint) // those that came meanwhile have got theirs
    forget_signals();
}
} // namespace Arenite
