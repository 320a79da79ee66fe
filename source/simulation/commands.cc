#include <arenite/base/names.h>
#include <arenite/base/time_history.h>
#include <arenite/io/files.h>
#include <arenite/simulation/commands.h>
#include <arenite/simulation/simulation.h>

#include <cmath>
#include <iomanip>
#include <iostream>

namespace Arenite
{
using namespace dealii;

namespace
{
/// One complete run of a scene.
RunRecord run_scene(const RunOptions &options, const std::vector<std::string> &overrides, const std::string &output,
                    Log &log)
{
  const MPI_Comm        communicator = MPI_COMM_WORLD;
  const OutputDirectory directory(output, options.scenes.front(), options.overwrite, communicator);
  Parameters            parameters = Parameters::from_files(options.scenes, overrides);
  Scene<3>              scene(parameters);
  Simulation<3>         simulation(scene, log, communicator);
  if (!scene.title.empty())
    log.line(scene.title);
  simulation.set_up();
  directory.create();
  log.open(directory);
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
  simulation.run(directory);
  record.measure_memory(communicator);
  record.write(directory);
  record.print_summary(log, directory);
  log.finish();
  return record;
}
} // namespace

int run(const RunOptions &options)
{
  Log log(MPI_COMM_WORLD);
  run_scene(options, options.overrides, options.output, log);
  return 0;
}

int check(const RunOptions &options)
{
  Log           log(MPI_COMM_WORLD);
  Parameters    parameters = Parameters::from_files(options.scenes, options.overrides);
  Scene<3>      scene(parameters);
  Simulation<3> simulation(scene, log, MPI_COMM_WORLD);
  if (!scene.title.empty())
    log.line(scene.title);
  simulation.set_up();
  simulation.describe_cost();
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
      Scene<3>   scene(parameters);
      print(options.markdown ? parameters.manual() : parameters.echo());
      return 0;
    }
  print(complete_manual());
  return 0;
}

namespace
{
/// Order of the error and the coefficient C of e = C h^q from two meshes.
double observed_order(const double coarse, const double fine) { return std::log2(coarse / fine); }
} // namespace

int converge(const RunOptions &options)
{
  Log                log(MPI_COMM_WORLD);
  const unsigned int first =
    std::stoi(Parameters::from_files(options.scenes, options.overrides).peek("Mesh/Refinement", "0"));
  std::vector<RunRecord> records;
  const OutputDirectory  base(options.output, options.scenes.front(), true, MPI_COMM_WORLD);
  for (unsigned int level = 0; level < options.levels; ++level)
    {
      std::vector<std::string> overrides = options.overrides;
      overrides.push_back("Mesh/Refinement=" + std::to_string(first + level));
      records.push_back(run_scene(options, overrides, base.path() + "/level-" + std::to_string(first + level), log));
    }

  log << "\nConvergence under refinement of " << options.scenes.front()
      << ": error, and observed order in the cell size\n";
  for (const auto &[key, value] : records.front().errors)
    {
      (void)value;
      std::ostringstream line;
      line << std::left << std::setw(36) << key << std::scientific << std::setprecision(3);
      for (unsigned int i = 0; i < records.size(); ++i)
        {
          const double error = records[i].errors.at(key);
          line << error;
          if (i > 0)
            line << std::fixed << std::setprecision(2) << " (" << observed_order(records[i - 1].errors.at(key), error)
                 << ")" << std::scientific << std::setprecision(3);
          line << "  ";
        }
      log.line(line.str());
    }
  std::ostringstream cost;
  cost << std::left << std::setw(36) << "core-seconds" << std::scientific << std::setprecision(3);
  for (const RunRecord &record : records)
    cost << record.core_seconds << "         ";
  log.line(cost.str());
  return 0;
}
} // namespace Arenite
