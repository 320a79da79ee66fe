#include <arenite/base/errors.h>
#include <arenite/simulation/cost_forecast.h>
#include <arenite/simulation/simulation.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr double longest_trial = 60.; ///< [s]

/// A directory that lives as long as this; the same for all processes.
class ScratchDirectory
{
public:
  explicit ScratchDirectory(const MPI_Comm communicator)
    : is_mine(Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    std::string name = (std::filesystem::temp_directory_path() / "arenite-trial-XXXXXX").string();
    if (is_mine && mkdtemp(name.data()) == nullptr)
      name.clear();
    path = Utilities::MPI::broadcast(communicator, name);
    if (path.empty())
      throw OutputError("no directory for trial runs could be made in " +
                        std::filesystem::temp_directory_path().string());
  }
  ScratchDirectory(const ScratchDirectory &) = delete;
  ~ScratchDirectory()
  {
    std::error_code ignored;
    if (is_mine)
      std::filesystem::remove_all(path, ignored);
  }

  std::string path;

private:
  const bool is_mine;
};

/// The scene with @p levels levels and without pictures; nothing if it was asked to stop.
std::optional<RunRecord> trial(const RunOptions &options, const unsigned int levels, const std::string &path,
                               const MPI_Comm communicator)
{
  auto overrides = options.overrides;
  for (const char *entry : {"Output/VTU interval=0", "Output/Checkpoint interval=0", "Output/Checkpoint steps=0",
                            "Output/Largest wall time=0"})
    overrides.emplace_back(entry);
  overrides.push_back("Adaptivity/Levels=" + std::to_string(levels));
  Parameters            parameters = Parameters::from_files(options.scenes, overrides);
  const OutputDirectory directory(path, options.scenes.front(), OutputDirectory::Mode::overwrite, communicator);
  return with_dimension(parameters, [&](const auto dim) -> std::optional<RunRecord> {
    Log                              silent(communicator, true);
    Scene<decltype(dim)::value>      scene(parameters);
    Simulation<decltype(dim)::value> simulation(scene, silent, communicator);
    simulation.parameters = parameters.values();
    simulation.set_up();
    directory.create();
    if (!simulation.run(directory))
      return {};
    simulation.record.measure_memory(communicator);
    return simulation.record;
  });
}
} // namespace

std::optional<CostForecast> forecast_cost(const RunOptions &options, const unsigned int levels,
                                          const double coarse_core_seconds, const MPI_Comm communicator)
{
  const ScratchDirectory scratch(communicator);
  const double           ranks = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<RunRecord> trials;
  RunRecord              before;
  before.measure_memory(communicator);
  double spent = 0., next = coarse_core_seconds;
  // all processes have the same times, of the slowest
  while (trials.size() < levels && Utilities::MPI::max(next, communicator) < longest_trial * ranks)
    {
      const auto record = trial(options, static_cast<unsigned int>(trials.size()), scratch.path, communicator);
      if (!record)
        return {};
      trials.push_back(*record);
      const RunRecord &last = trials.back();
      spent += last.core_seconds;
      next = last.core_seconds * std::pow(2., last.dimension + 1.);
    }
  if (trials.size() < 2)
    return {};
  const RunRecord &last = trials.back(), &previous = trials[trials.size() - 2];
  const double     missing = levels + 1. - double(trials.size());
  const double     growth = last.dof_steps / previous.dof_steps, more_cells = last.most_cells / previous.most_cells;

  CostForecast forecast;
  forecast.levels             = static_cast<unsigned int>(trials.size()) - 1;
  forecast.trial_core_seconds = spent;
  forecast.core_seconds       = last.core_seconds * std::pow(growth, missing);
  forecast.cells              = last.most_cells * std::pow(more_cells, missing);
  forecast.memory_mb          = last.total_memory_mb + (forecast.cells - last.most_cells) *
                                                (last.total_memory_mb - before.total_memory_mb) / last.most_cells;
  return forecast;
}
} // namespace Arenite
