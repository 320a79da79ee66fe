#pragma once

#include <arenite/io/output_directory.h>

#include <cstdint>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace Arenite
{
/// What a checkpoint says about itself: manifest.json.
struct CheckpointManifest
{
  unsigned int                       step = 0, ranks = 0;
  double                             time = 0.; ///< [s]
  std::string                        version, commit;
  std::map<std::string, std::string> parameters; ///< all values of the scene by path
};

/// A checkpoint as it is being written: a folder of files that becomes valid as a whole.
///
///   NewCheckpoint folder(directory);                       // empties checkpoint.new
///   folder.add("cells-0.bin", write);                      // each process its own files
///   folder.finish(manifest);                               // collective
///
/// Files are written to their end and onto the disk, then the manifest with their sizes and checksums, then the folder gets its name
/// checkpoint-<step>; a crash at any moment leaves the checkpoints before it alone. The last two are kept.
class NewCheckpoint
{
public:
  /// Collective, as are all problems: OutputError on all processes, and what was begun is removed.
  explicit NewCheckpoint(const OutputDirectory &);

  /// A file of this process. Not collective: the problem is known in finish().
  void add(const std::string &name, const std::function<void(std::ostream &)> &write);

  /// @return bytes of all files together. Collective.
  std::uint64_t finish(CheckpointManifest);

private:
  const OutputDirectory   &directory;
  const std::string        folder;
  std::vector<std::string> own_files;
  std::string              problem;
};

/// The newest checkpoint in a directory that is as it was written.
class FoundCheckpoint
{
public:
  /// All sizes and checksums are compared before anything is believed. CheckpointError on all processes if there is no checkpoint, or none
  /// that can be used. Collective.
  explicit FoundCheckpoint(const OutputDirectory &);

  CheckpointManifest       manifest;
  std::vector<std::string> rejected; ///< newer ones, with the reasons
  std::string              name;     ///< of the folder

  std::string file(const std::string &file_name) const { return folder + "/" + file_name; }

private:
  std::string folder;
};

/// Entries in which two scenes differ, "Section/Entry: old, now new"; those that change nothing of the motion up to the end time are
/// left out.
std::vector<std::string> differences(const std::map<std::string, std::string> &before,
                                     const std::map<std::string, std::string> &now);
} // namespace Arenite
