#pragma once

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Arenite
{
/// Where a run puts its files, and the guard of what is there already.
///
///   OutputDirectory directory(options.output, scene, options.overwrite, communicator);   // early: refuses old results
///   ... read the scene, build the mesh ...
///   directory.create();                                                                  // late: nothing was touched before
///
/// A directory holds results when one of Arenite's own files is in it. They are never mixed with those of another run, and
/// files of somebody else are never removed.
class OutputDirectory
{
public:
  /// What becomes of results that are there already.
  enum class Mode
  {
    refuse,
    overwrite,
    resume ///< a run goes on with them
  };

  /// @p requested, or "output/<name of @p scene without .prm>" when it is empty. InputError if old results are there and
  /// must not be overwritten. Collective; process 0 looks.
  OutputDirectory(const std::string &requested, const std::string &scene, Mode, MPI_Comm);

  /// Remove old results unless the run goes on with them, create the directory and try to write into it; OutputError if that fails. Collective.
  void create() const;

  const std::string &path() const { return directory; }
  /// Path of a file in the directory.
  std::string file(const std::string &name) const { return directory + "/" + name; }

  const Mode     mode;
  const MPI_Comm communicator;

private:
  std::string directory;
};

/// Files in @p directory that Arenite has written, as paths relative to it, sorted.
std::vector<std::string> results_in(const std::string &directory);

/// Remove a checkpoint, but nothing that Arenite has not written.
void remove_checkpoint(const std::string &folder);
} // namespace Arenite
