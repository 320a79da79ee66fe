#include <arenite/base/errors.h>
#include <arenite/base/version.h>
#include <arenite/io/checkpoint_folder.h>
#include <arenite/io/files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <system_error>

namespace Arenite
{
using namespace dealii;
namespace fs = std::filesystem;

namespace
{
/// Of the files' contents; a checkpoint of another number is refused.
constexpr unsigned int format = 1;
constexpr unsigned int n_kept = 2;

const char *const manifest_name = "manifest.json";

/// Names of the checkpoints in a directory, newest first.
std::vector<std::string> checkpoints_in(const std::string &directory)
{
  static const std::regex  own("checkpoint-[0-9]{9,}");
  std::vector<std::string> found;
  std::error_code          error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error))
    if (const std::string name = entry->path().filename().string(); std::regex_match(name, own))
      found.push_back(name);
  std::sort(found.begin(), found.end(), [](const std::string &a, const std::string &b) {
    return a.size() != b.size() ? a.size() > b.size() : a > b;
  });
  return found;
}

/// Files of a checkpoint and their sums.
using Files = std::map<std::string, FileSum>;

/// Read the manifest. @return what is wrong with it
std::string read_manifest(const std::string &folder, CheckpointManifest &manifest, Files &files)
{
  try
    {
      std::ifstream stream(folder + "/" + manifest_name);
      if (!stream)
        return "it has no manifest";
      const nlohmann::json json = nlohmann::json::parse(stream);
      manifest.version          = json.at("version");
      manifest.commit           = json.at("commit");
      if (json.at("format") != format)
        return "it is of format " + json.at("format").dump() + ", written by version " + manifest.version +
               "; this version reads format " + std::to_string(format);
      manifest.step  = json.at("step");
      manifest.time  = json.at("time");
      manifest.ranks = json.at("ranks");
      for (const auto &[path, value] : json.at("parameters").items())
        manifest.parameters[path] = value;
      for (const auto &[name, sum] : json.at("files").items())
        files[name] = {sum.at("size"), sum.at("crc32")};
    }
  catch (const nlohmann::json::exception &)
    {
      return "its manifest is damaged";
    }
  return "";
}

std::string compare(const std::string &folder, const std::string &name, const FileSum &expected)
{
  FileSum found;
  if (!sum_up(folder + "/" + name, found).empty())
    return "its file " + name + " is missing";
  if (found.size != expected.size)
    return "its file " + name + " has " + std::to_string(found.size) + " bytes instead of " +
           std::to_string(expected.size);
  return found.crc == expected.crc ? "" : "its file " + name + " has another checksum than when it was written";
}

/// What is wrong with the files; the processes share the work. Collective.
std::string examine(const std::string &folder, const Files &files, const MPI_Comm communicator)
{
  const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator),
                     n_ranks = Utilities::MPI::n_mpi_processes(communicator);
  std::string  problem;
  unsigned int index = 0;
  for (const auto &[name, sum] : files)
    if (index++ % n_ranks == rank && problem.empty())
      problem = compare(folder, name, sum);
  for (const std::string &of_process : Utilities::MPI::all_gather(communicator, problem))
    if (!of_process.empty())
      return of_process;
  return "";
}

} // namespace

NewCheckpoint::NewCheckpoint(const OutputDirectory &directory)
  : directory(directory)
  , folder(directory.file("checkpoint.new"))
{
  if (Utilities::MPI::this_mpi_process(directory.communicator) == 0)
    {
      remove_checkpoint(folder);
      std::error_code error;
      fs::create_directories(folder, error);
      if (error)
        problem = folder + ": cannot be created: " + error.message() + ".";
    }
  agree_on_output(problem, directory.communicator);
}

void NewCheckpoint::add(const std::string &name, const std::function<void(std::ostream &)> &write)
{
  if (problem.empty())
    problem = create_file(folder + "/" + name, write);
  if (problem.empty())
    problem = synchronise(folder + "/" + name);
  own_files.push_back(name);
}

std::uint64_t NewCheckpoint::finish(CheckpointManifest manifest)
{
  const MPI_Comm       communicator = directory.communicator;
  const unsigned int   rank         = Utilities::MPI::this_mpi_process(communicator);
  std::vector<FileSum> own(own_files.size());
  for (std::size_t i = 0; i < own.size() && problem.empty(); ++i)
    problem = sum_up(folder + "/" + own_files[i], own[i]);

  nlohmann::ordered_json     files;
  std::uint64_t              bytes = 0;
  std::vector<std::uint64_t> sizes, sums;
  for (const FileSum &sum : own)
    {
      sizes.push_back(sum.size);
      sums.push_back(sum.crc);
    }
  const auto all_names = Utilities::MPI::all_gather(communicator, own_files);
  const auto all_sizes = Utilities::MPI::all_gather(communicator, sizes);
  const auto all_sums  = Utilities::MPI::all_gather(communicator, sums);
  for (std::size_t r = 0; r < all_names.size(); ++r)
    for (std::size_t i = 0; i < all_names[r].size(); ++i)
      {
        files[all_names[r][i]] = {{"size", all_sizes[r][i]}, {"crc32", all_sums[r][i]}};
        bytes += all_sizes[r][i];
      }
  const auto give_up_on_problem = [&]() {
    try
      {
        agree_on_output(problem, communicator);
      }
    catch (const OutputError &)
      {
        if (rank == 0)
          remove_checkpoint(folder);
        throw;
      }
  };
  give_up_on_problem(); // all files are there
  if (rank == 0)
    {
      nlohmann::ordered_json json;
      json["format"]         = format;
      json["version"]        = version();
      json["commit"]         = commit();
      json["step"]           = manifest.step;
      json["time"]           = manifest.time;
      json["ranks"]          = Utilities::MPI::n_mpi_processes(communicator);
      json["files"]          = files;
      json["parameters"]     = manifest.parameters;
      const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
      problem = create_file(folder + "/" + manifest_name, [&](std::ostream &file) { file << text << '\n'; });
      if (problem.empty())
        problem = synchronise(folder + "/" + manifest_name);
      if (problem.empty())
        problem = synchronise(folder);
      std::string number = std::to_string(manifest.step);
      number.insert(0, 9 - std::min<std::size_t>(number.size(), 9), '0');
      const std::string name = directory.file("checkpoint-" + number);
      std::error_code   error;
      if (problem.empty())
        {
          remove_checkpoint(name); // of a run that went on from an older one
          fs::rename(folder, name, error);
          problem = error ? name + ": cannot be written: " + error.message() + "." : synchronise(directory.path());
        }
      if (problem.empty())
        {
          const std::vector<std::string> all = checkpoints_in(directory.path());
          for (std::size_t old = n_kept; old < all.size(); ++old)
            remove_checkpoint(directory.file(all[old]));
        }
    }
  give_up_on_problem();
  return bytes;
}

FoundCheckpoint::FoundCheckpoint(const OutputDirectory &directory)
{
  const MPI_Comm           communicator = directory.communicator;
  std::vector<std::string> names        = checkpoints_in(directory.path());
  names = Utilities::MPI::broadcast(communicator, names, 0); // others might see a younger state of the disk
  for (const std::string &candidate : names)
    {
      folder = directory.file(candidate);
      Files       files;
      std::string problem = read_manifest(folder, manifest, files);
      problem             = Utilities::MPI::broadcast(communicator, problem, 0);
      if (problem.empty())
        problem = examine(folder, files, communicator);
      if (problem.empty())
        {
          name = candidate;
          return;
        }
      rejected.push_back(candidate + ": " + problem + ".");
    }
  std::string message =
    directory.path() + (rejected.empty()
                          ? ": there is no checkpoint to resume from. 'Output / Checkpoint interval' writes some."
                          : ": none of the checkpoints can be used.");
  for (std::size_t i = 0; i < std::min<std::size_t>(rejected.size(), 5); ++i)
    message += "\n  " + rejected[i];
  throw CheckpointError(message);
}

std::vector<std::string> differences(const std::map<std::string, std::string> &before,
                                     const std::map<std::string, std::string> &now)
{
  const auto may_change = [](const std::string &path) {
    return path == "Title" || path == "End time" || path.rfind("Output/", 0) == 0;
  };
  std::vector<std::string> result;
  for (const auto &[path, value] : before)
    if (const auto other = now.find(path); !may_change(path) && (other == now.end() || other->second != value))
      result.push_back(path + ": " + value + " in the checkpoint, " + (other == now.end() ? "absent" : other->second) +
                       " now");
  for (const auto &[path, value] : now)
    if (!may_change(path) && before.count(path) == 0)
      result.push_back(path + ": absent in the checkpoint, " + value + " now");
  return result;
}
} // namespace Arenite
