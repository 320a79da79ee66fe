#include <arenite/base/names.h>
#include <arenite/base/time_history.h>
#include <arenite/io/files.h>
#include <arenite/simulation/cheaper_form.h>
#include <arenite/simulation/commands.h>
#include <arenite/simulation/convergence_table.h>
#include <arenite/simulation/cost_forecast.h>
#include <arenite/simulation/simulation.h>

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
/// The checkpoint that a run shall go on from; InputError if the scene moves otherwise than that of the checkpoint.
FoundCheckpoint find_checkpoint(const OutputDirectory &directory, const std::map<std::string, std::string> &parameters,
                                Log &log)
{
  FoundCheckpoint checkpoint(directory);
  for (const std::string &reason : checkpoint.rejected)
    log.line("Warning    " + reason);
  const std::vector<std::string> changes = differences(checkpoint.manifest.parameters, parameters);
  if (!changes.empty())
    {
      constexpr std::size_t most    = 6;
      std::string           message = directory.path() + "/" + checkpoint.name + " belongs to another scene:";
      for (std::size_t i = 0; i < std::min(changes.size(), most); ++i)
        message += "\n  " + changes[i];
      if (changes.size() > most)
        message += "\n  and " + std::to_string(changes.size() - most) + " more";
      throw InputError(message + "\nOnly 'Title', 'End time' and 'Output' may change when a run is resumed.");
    }
  std::ostringstream text;
  text << "Resumed    " << checkpoint.name << ": t = " << checkpoint.manifest.time << " s, written by "
       << checkpoint.manifest.ranks << (checkpoint.manifest.ranks == 1 ? " process" : " processes");
  log.line(text.str());
  return checkpoint;
}

/// One run of a scene, or the rest of one; nothing if it was asked to stop before its end.
template <int dim>
std::optional<RunRecord> run_scene(Parameters &parameters, const RunOptions &options,
                                   const std::vector<std::string> &overrides, const OutputDirectory &directory,
                                   Log &log)
{
  const MPI_Comm  communicator = MPI_COMM_WORLD;
  Scene<dim>      scene(parameters);
  Simulation<dim> simulation(scene, log, communicator);
  simulation.parameters = parameters.values();
  if (!scene.title.empty())
    log.line(scene.title);
  std::optional<FoundCheckpoint> checkpoint;
  if (options.resume)
    checkpoint = find_checkpoint(directory, simulation.parameters, log);
  simulation.set_up(checkpoint ? &*checkpoint : nullptr);
  directory.create();
  log.open(directory, options.resume);
  if (Utilities::MPI::this_mpi_process(communicator) == 0)
    agree_on_output(create_file(directory.file("parameters_used.prm"),
                                [&](std::ostream &file) { file << parameters.echo(); }),
                    communicator);
  else
    agree_on_output("", communicator);

  RunRecord &record = simulation.record;
  record.title      = scene.title;
  record.scenes     = options.scenes;
  record.overrides  = overrides;
  if (!simulation.run(directory))
    {
      log << "Stopped    by " << scene.checkpoints.reason() << "; 'arenite run --resume' goes on from the checkpoint\n";
      log.finish();
      return {};
    }
  record.measure_memory(communicator);
  record.write(directory);
  record.print_summary(log, directory);
  log.finish();
  return record;
}

std::optional<RunRecord> run_scene(const RunOptions &options, const std::vector<std::string> &overrides,
                                   const std::string &output, Log &log)
{
  using Mode                 = OutputDirectory::Mode;
  const Mode            mode = options.resume ? Mode::resume : (options.overwrite ? Mode::overwrite : Mode::refuse);
  const OutputDirectory directory(output, options.scenes.front(), mode, MPI_COMM_WORLD);
  Parameters            parameters = Parameters::from_files(options.scenes, overrides);
  return with_dimension(parameters, [&](const auto dim) {
    return run_scene<decltype(dim)::value>(parameters, options, overrides, directory, log);
  });
}

/// A scene as it stands before its first step.
struct Size
{
  std::uint64_t unknowns;
  double        steps;
};

Size size_of(Parameters parameters)
{
  return with_dimension(parameters, [&](const auto dim) {
    Log                              silent(MPI_COMM_WORLD, true);
    Scene<decltype(dim)::value>      scene(parameters);
    Simulation<decltype(dim)::value> simulation(scene, silent, MPI_COMM_WORLD);
    simulation.set_up();
    return Size{simulation.unknowns(), simulation.expected_steps()};
  });
}

/// Lines for the first of the forms that is a scene when its entries are changed, or nothing.
std::string cheaper_form(const std::vector<Reduction> &forms, const RunOptions &options, const Size &present)
{
  for (const Reduction &form : forms)
    try
      {
        auto overrides = options.overrides;
        overrides.insert(overrides.end(), form.changes.begin(), form.changes.end());
        const Size         reduced = size_of(Parameters::from_files(options.scenes, overrides));
        std::ostringstream text;
        text << "Cheaper    the scene is " << (form.form == Symmetry::plane_wave ? "a " : "") << name(form.form)
             << (form.form == Symmetry::spherical ? "ly symmetric" : "")
             << (form.far.empty() ? "" : " but for where its mesh ends") << ": the same motion with "
             << reduced.unknowns << " unknowns instead of " << present.unknowns << " ("
             << std::llround(double(present.unknowns) / reduced.unknowns) << " times fewer) and "
             << std::llround(reduced.steps) << " steps instead of " << std::llround(present.steps) << "\n          ";
        for (const std::string &change : form.changes)
          text << " --set " << (change.find(' ') == std::string::npos ? change : '"' + change + '"');
        return text.str();
      }
    catch (const InputError &) // an entry that has no meaning there, such as a solution to compare with
      {}
  return "";
}

/// A line of what an adaptive scene will cost, from trials.
std::string describe_forecast(const RunOptions &options, const unsigned int levels, const double coarse_core_seconds)
{
  std::optional<CostForecast> forecast;
  try
    {
      forecast = forecast_cost(options, levels, coarse_core_seconds, MPI_COMM_WORLD);
    }
  catch (const PhysicsAlarm &)
    {
      return "Forecast   none: a trial with fewer levels left physics, which its coarse cells may explain";
    }
  if (!forecast)
    return levels < 2 ? "Forecast   none: with one level a trial would be the run"
                      : "Forecast   none: trials with fewer levels would take more than a minute";
  std::ostringstream text;
  text.precision(3);
  text << "Forecast   about " << forecast->core_seconds << " core-seconds for the time loop with all levels, "
       << std::lround(forecast->memory_mb) << " MB of memory, at most " << std::lround(forecast->cells)
       << " cells: from trials of up to " << forecast->levels << (forecast->levels == 1 ? " level (" : " levels (")
       << forecast->trial_core_seconds << " core-seconds)";
  return text.str();
}

/// `Mesh / Refinement` as the scene has it, before the objects that check it exist.
unsigned int first_refinement(const Parameters &parameters)
{
  const std::string text = parameters.peek("Mesh/Refinement", "0");
  if (text.empty() || text.size() > 2 || text.find_first_not_of("0123456789") != std::string::npos)
    parameters.refuse("Mesh/Refinement", "must be a number of refinements");
  return std::stoi(text);
}
} // namespace

int run(const RunOptions &options)
{
  Log log(MPI_COMM_WORLD);
  return run_scene(options, options.overrides, options.output, log) ? 0 : stopped_on_request;
}

int check(const RunOptions &options)
{
  Log        log(MPI_COMM_WORLD);
  Parameters parameters = Parameters::from_files(options.scenes, options.overrides);
  with_dimension(parameters, [&](const auto dim) {
    Scene<decltype(dim)::value>      scene(parameters);
    Simulation<decltype(dim)::value> simulation(scene, log, MPI_COMM_WORLD);
    if (!scene.title.empty())
      log.line(scene.title);
    const std::vector<Reduction> forms = cheaper_forms(scene, parameters);
    simulation.set_up();
    const double coarse = simulation.describe_cost();
    if (scene.adaptor.active() && !scene.is_static())
      log.line(describe_forecast(options, scene.adaptor.max_passes(), coarse));
    const std::string cheaper = cheaper_form(forms, options, {simulation.unknowns(), simulation.expected_steps()});
    if (!cheaper.empty())
      log.line(cheaper);
  });
  return 0;
}

int print_parameters(const RunOptions &options)
{
  const auto print = [&](const std::string &text) {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << text;
  };
  if (!options.scenes.empty())
    {
      Parameters parameters = Parameters::from_files(options.scenes, options.overrides);
      with_dimension(parameters, [&](const auto dim) { Scene<decltype(dim)::value> scene(parameters); });
      print(options.markdown ? parameters.manual() : parameters.echo());
      return 0;
    }
  print(complete_manual());
  return 0;
}

int converge(const RunOptions &options)
{
  Log                    log(MPI_COMM_WORLD);
  const Parameters       parameters = Parameters::from_files(options.scenes, options.overrides);
  const unsigned int     first      = first_refinement(parameters);
  const OutputDirectory  base(options.output, options.scenes.front(), OutputDirectory::Mode::overwrite, MPI_COMM_WORLD);
  std::vector<RunRecord> records;
  for (unsigned int level = 0; level < options.levels; ++level)
    {
      std::vector<std::string> overrides = options.overrides;
      overrides.push_back("Mesh/Refinement=" + std::to_string(first + level));
      log << "\n--- refinement " << first + level << '\n';
      const auto record =
        run_scene(options, overrides, base.path() + "/refinement-" + std::to_string(first + level), log);
      if (!record)
        return stopped_on_request;
      records.push_back(*record);
    }
  log << "\nConvergence of " << options.scenes.front() << ", refinements " << first << " to "
      << first + options.levels - 1 << '\n'
      << convergence_table(records);
  return 0;
}
} // namespace Arenite
