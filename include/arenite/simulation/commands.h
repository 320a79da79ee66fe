#pragma once

#include <string>
#include <vector>

namespace Arenite
{
/// What the command line says.
struct RunOptions
{
  std::vector<std::string> scenes, overrides;
  std::string              output;
  bool                     overwrite = false, resume = false, markdown = false;
  unsigned int             levels = 3;
  std::string              strain_path, sweep; ///< of `material`
  unsigned int             steps_per_row = 0;  ///< of `material`; 0: what the file says
};

/// Exit code of a run that was asked to stop and has written a checkpoint.
constexpr int stopped_on_request = 75;

// The commands of the binary; each returns the exit code.
int run(const RunOptions &);
int check(const RunOptions &);
int print_parameters(const RunOptions &);
int converge(const RunOptions &);
int material(const RunOptions &);

/// Tables of every entry that a scene can have, for all models.
std::string complete_manual();
} // namespace Arenite
