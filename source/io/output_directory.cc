#include <arenite/base/errors.h>
#include <arenite/io/files.h>
#include <arenite/io/output_directory.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <system_error>

namespace Arenite
{
namespace fs = std::filesystem;

namespace
{
const char *const pictures = "solution"; ///< sub-directory of the VTU files

/// Names of the files that Arenite writes; with ".new" at the end while they are written.
bool is_result(const std::string &name)
{
  static const std::regex own("(parameters_used\\.prm|run\\.json|log\\.txt|statistics\\.csv|convergence\\.csv|"
                              "solution\\.pvd|solution\\.visit|receivers\\.h5|receivers-[^/]*\\.csv)(\\.new)?");
  return std::regex_match(name, own);
}

bool is_picture(const std::string &name)
{
  static const std::regex own("step-[0-9]{6,}(\\.[0-9]+\\.vtu|\\.pvtu)(\\.new)?");
  return std::regex_match(name, own);
}

bool is_checkpoint(const std::string &name)
{
  static const std::regex own("checkpoint(-[0-9]{9,}|\\.new)");
  return std::regex_match(name, own);
}

bool is_part_of_checkpoint(const std::string &name)
{
  static const std::regex own("manifest\\.json|run\\.state|cells-[0-9]+\\.bin");
  return std::regex_match(name, own);
}

void collect(const fs::path &folder, const std::string &prefix, bool (*own)(const std::string &),
             std::vector<std::string> &found)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    {
      const std::string name = entry->path().filename().string();
      std::error_code   ignored;
      if (own(name) && !(fs::is_directory(entry->symlink_status(ignored))))
        found.push_back(prefix + name);
    }
}

/// Folders of checkpoints, also of an unfinished one.
std::vector<std::string> checkpoints_of(const std::string &directory)
{
  std::vector<std::string> found;
  std::error_code          error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (is_checkpoint(entry->path().filename().string()))
      found.push_back(entry->path().filename().string());
  return found;
}

/// Message of a refusal, or nothing.
std::string objection(const std::string &directory, const OutputDirectory::Mode mode)
{
  std::error_code error;
  const auto      status = fs::status(directory, error);
  if (!fs::exists(status))
    return "";
  if (!fs::is_directory(status))
    return directory + " is not a directory. Choose another one with --output DIR.";
  const std::vector<std::string> results = results_in(directory);
  if (mode != OutputDirectory::Mode::refuse || results.empty())
    return "";
  return directory + " already holds results (" + results.front() +
         "). Replace them with --overwrite, go on with an interrupted run with --resume, or choose another directory "
         "with "
         "--output DIR.";
}

/// Problem, or nothing.
std::string prepare(const std::string &directory, const bool keep)
{
  std::error_code error;
  if (!keep)
    {
      for (const std::string &name : results_in(directory))
        if (!fs::remove(fs::path(directory) / name, error) && error)
          return directory + "/" + name + ": cannot be removed: " + error.message() + ".";
      fs::remove(fs::path(directory) / pictures, error); // succeeds only if nothing of somebody else is left in it
      for (const std::string &name : checkpoints_of(directory))
        fs::remove(fs::path(directory) / name, error);
    }

  fs::create_directories(directory, error);
  if (error)
    return directory + ": cannot be created: " + error.message() + ". Choose another directory with --output DIR.";

  const std::string probe   = directory + "/log.txt.new";
  const std::string problem = create_file(probe, [](std::ostream &out) { out << "probe\n"; });
  fs::remove(probe, error);
  return problem;
}
} // namespace

std::vector<std::string> results_in(const std::string &directory)
{
  std::vector<std::string> found;
  collect(directory, "", is_result, found);
  collect(fs::path(directory) / pictures, std::string(pictures) + "/", is_picture, found);
  for (const std::string &name : checkpoints_of(directory))
    collect(fs::path(directory) / name, name + "/", is_part_of_checkpoint, found);
  std::sort(found.begin(), found.end());
  return found;
}

void remove_checkpoint(const std::string &folder)
{
  std::error_code          ignored;
  std::vector<std::string> parts;
  collect(folder, "", is_part_of_checkpoint, parts);
  for (const std::string &part : parts)
    fs::remove(fs::path(folder) / part, ignored);
  fs::remove(folder, ignored);
}

OutputDirectory::OutputDirectory(const std::string &requested, const std::string &scene, const Mode mode,
                                 const MPI_Comm communicator)
  : mode(mode)
  , communicator(communicator)
  , directory(requested)
{
  if (directory.empty())
    {
      const fs::path file(scene);
      directory = "output/" + (file.extension() == ".prm" ? file.stem() : file.filename()).string();
    }
  while (directory.size() > 1 && directory.back() == '/')
    directory.pop_back();

  std::string message;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    message = objection(directory, mode);
  message = dealii::Utilities::MPI::broadcast(communicator, message, 0);
  if (!message.empty())
    throw InputError(message);
}

void OutputDirectory::create() const
{
  std::string problem;
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    problem = prepare(directory, mode == Mode::resume);
  agree_on_output(problem, communicator);
}
} // namespace Arenite
