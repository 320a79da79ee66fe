#include <arenite/base/errors.h>
#include <arenite/base/names.h>
#include <arenite/base/version.h>
#include <arenite/simulation/commands.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <new>
#include <string>
#include <thread>
#include <vector>

namespace
{
constexpr int internal_error = 1, input_error = 2, physics_alarm = 3, output_error = 4, checkpoint_error = 5;

/// True in the process that speaks, before MPI_Init has told us: launchers announce the rank in the environment.
bool is_first_process()
{
  for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char *rank = std::getenv(name))
      return std::string(rank) == "0";
  return true;
}

/// How a run ends on every process when it fails.
///
/// InputError, PhysicsAlarm and OutputError are thrown by all processes alike. Each then waits here for the others:
/// when all have arrived, process 0 prints the message and everybody returns through MPI_Finalize, so that mpirun
/// stays quiet. When somebody does not come (the error was seen by one process only, and the others wait for it in
/// a reduction), and for every other exception, the process prints its message and takes the others down with
/// MPI_Abort instead of hanging.
class ErrorExit
{
public:
  ErrorExit()
  {
    // a communicator of its own: the barrier below must not meet a collective operation of the computation
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &size);
  }
  ~ErrorExit() { MPI_Comm_free(&communicator); }

  int collective(const std::string &message, const int code) const
  {
    if (!all_arrive())
      return single(message, code);
    if (rank == 0)
      print(message);
    return code;
  }

  int single(const std::string &message, const int code) const
  {
    print((size > 1 ? "process " + std::to_string(rank) + ": " : "") + message);
    if (size > 1)
      MPI_Abort(MPI_COMM_WORLD, code);
    return code;
  }

private:
  static void print(const std::string &message)
  {
    std::cout << std::flush;
    std::cerr << message << std::endl;
  }

  bool all_arrive() const
  {
    constexpr auto patience = std::chrono::seconds(10);
    const auto     start    = std::chrono::steady_clock::now();
    MPI_Request    request;
    int            done = 0;
    MPI_Ibarrier(communicator, &request);
    while (MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done)
      {
        if (std::chrono::steady_clock::now() - start > patience)
          return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    return true;
  }

  MPI_Comm communicator;
  int      rank, size;
};

int execute(const std::function<int(const Arenite::RunOptions &)> &command, const Arenite::RunOptions &options)
{
  const ErrorExit error_exit;
  try
    {
      return command(options);
    }
  catch (const Arenite::InputError &error)
    {
      return error_exit.collective(error.what(), input_error);
    }
  catch (const Arenite::PhysicsAlarm &error)
    {
      return error_exit.collective(error.what(), physics_alarm);
    }
  catch (const Arenite::OutputError &error)
    {
      return error_exit.collective(error.what(), output_error);
    }
  catch (const Arenite::CheckpointError &error)
    {
      return error_exit.collective(error.what(), checkpoint_error);
    }
  catch (const std::bad_alloc &)
    {
      return error_exit.single("Out of memory. Use a coarser mesh or more processes.", internal_error);
    }
  catch (const std::exception &error) // dealii::ExceptionBase as well: what() contains the stack
    {
      return error_exit.single(std::string("Internal error: ") + error.what(), internal_error);
    }
  catch (...)
    {
      return error_exit.single("Internal error: unknown exception.", internal_error);
    }
}
} // namespace

int main(int argc, char **argv)
{
  Arenite::RunOptions                             options;
  std::function<int(const Arenite::RunOptions &)> command;

  // The command line is read before MPI_Init, which costs 0.3 s: help and mistakes answer at once.
  CLI::App app(
    "Explicit dynamics of soils and solids under shock loading.\n"
    "Exit codes: 0 done; 1 internal error; 2 bad command, parameters or mesh; 3 physics alarm; 4 output failed;\n"
    "5 no usable checkpoint; 75 stopped on request, with a checkpoint.",
    "arenite");
  app.set_version_flag("--version", "arenite " + Arenite::version() + " (" + Arenite::commit() + "), deal.II " +
                                      Arenite::dealii_version() + ", " + Arenite::compiler());
  app.require_subcommand(1);

  const auto add_command = [&](const std::string &name, const std::string              &sentence,
                               int (*function)(const Arenite::RunOptions &), const bool scene_required) {
    CLI::App *subcommand = app.add_subcommand(name, sentence);
    subcommand->add_option("scene", options.scenes, "Parameter files (.prm); entries of later files win")
      ->required(scene_required)
      ->type_name("SCENE.prm");
    subcommand
      ->add_option("--set", options.overrides, "Replace one entry, \"Section/Sub section/Entry=value\"; repeatable")
      ->type_name("ENTRY=VALUE")
      ->allow_extra_args(false);
    subcommand->callback([&command, function]() { command = function; });
    return subcommand;
  };
  const auto add_output = [&](CLI::App *subcommand) {
    subcommand->add_option("--output", options.output, "Directory of the results (default: output/<scene>)")
      ->type_name("DIR");
    subcommand->add_flag("--overwrite", options.overwrite, "Replace the results that the directory holds");
  };

  CLI::App *run = add_command("run", "Run a scene", Arenite::run, true);
  add_output(run);
  run->add_flag("--resume", options.resume, "Go on from the newest checkpoint in the directory of the results")
    ->excludes("--overwrite");
  add_command("check", "Read a scene and print what a run would cost, without running it", Arenite::check, true);
  add_command("parameters", "Print the parameters of a scene with their values; without a scene, all that exist",
              Arenite::print_parameters, false)
    ->add_flag("--markdown", options.markdown, "As tables");
  CLI::App *converge = add_command("converge", "Run a scene on a sequence of meshes and print orders of convergence",
                                   Arenite::converge, true);
  add_output(converge);
  converge->add_option("--levels", options.levels, "Number of meshes, each twice as fine as the one before")
    ->capture_default_str()
    ->type_name("N")
    ->check(CLI::Range(2, 12));

  CLI::App *material = add_command("material", "Test a law at one point, without a mesh", Arenite::material, true);
  material->add_option("--strain-path", options.strain_path, "Follow the strains of this file instead of the test")
    ->type_name("FILE.csv");
  material->add_option("--substeps", options.steps_per_row, "Steps of the law per row of the result")
    ->type_name("N")
    ->check(CLI::Range(1, 100000000));
  material->add_option("--output", options.output, "Result (default: output/<name of the file>.csv)")
    ->type_name("FILE.csv");
  material
    ->add_option("--sweep", options.sweep, "One run for each of several values, \"Section/Entry=first:last:count\"")
    ->type_name("ENTRY=FIRST:LAST:COUNT");

  try
    {
      app.parse(argc, argv);
    }
  catch (const CLI::Success &request) // --help, --version
    {
      if (is_first_process())
        app.exit(request, std::cout, std::cerr);
      return 0;
    }
  catch (const CLI::Error &error)
    {
      // mpirun kills the others as soon as one process fails: only the one that prints may fail, or nothing is printed
      if (!is_first_process())
        return 0;
      std::string              used = "arenite", message = error.what();
      std::vector<std::string> names;
      for (const CLI::App *subcommand : app.get_subcommands())
        used += " " + subcommand->get_name();
      for (const CLI::App *subcommand : app.get_subcommands({}))
        names.push_back(subcommand->get_name());
      if (used == "arenite" && argc > 1 && argv[1][0] != '-')
        message = "'" + std::string(argv[1]) + "' is not a command." + Arenite::suggestion(argv[1], names);
      std::cerr << message << "\nSee '" << used << " --help'." << std::endl;
      return input_error;
    }

  std::signal(SIGXFSZ, SIG_IGN); // a file beyond the limit of the user (ulimit -f) is an OutputError
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return execute(command, options);
}
