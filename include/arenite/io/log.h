#pragma once

#include <deal.II/base/mpi.h>

#include <fstream>
#include <sstream>
#include <string>

namespace Arenite
{
class OutputDirectory;

/// The words of a run: process 0 writes every line at once to the screen and to log.txt, the others are silent.
///
///   Log log(communicator);
///   log << "Cells: " << n_cells << '\n';      // or log.line("...")
///   log.open(directory);                      // log.txt begins with the lines so far
///   log.finish();
class Log
{
public:
  explicit Log(MPI_Comm, bool silent = false);

  /// Start log.txt in a directory that has been created, or go on with that of an interrupted run. Collective only in that everybody
  /// calls it.
  void open(const OutputDirectory &, bool append = false);

  /// A line for log.txt alone: what the user reads on the error stream.
  void to_file(const std::string &text);

  /// One line; no end of line in @p text.
  void line(const std::string &text = "");

  template <typename T>
  Log &operator<<(const T &piece)
  {
    if (active)
      {
        buffer << piece;
        write_lines();
      }
    return *this;
  }

  /// Close log.txt; OutputError if it could not be written completely, for which the run itself does not stop. The next open()
  /// starts another one, with the lines in between. Collective.
  void finish();

private:
  void write_lines();

  const MPI_Comm     communicator;
  const bool         active; ///< this process speaks
  std::ostringstream buffer; ///< the line that has not ended yet
  std::string        early;  ///< lines before open()
  std::string        name, problem;
  std::ofstream      file;
};
} // namespace Arenite
