#pragma once

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>

namespace Arenite
{
class StateArchive;

// Files that are complete or not there. A problem is a text for the user, "file: reason"; empty when all is well.

/// Let @p write fill a new file; removed again if it cannot be written to its end (disk full, no permission).
std::string create_file(const std::string &name, const std::function<void(std::ostream &)> &write);

/// The same under a temporary name first: a reader, or a crash, never meets half a file or finds the old one gone.
std::string replace_file(const std::string &name, const std::function<void(std::ostream &)> &write);

/// Have the system put a file, or the entries of a directory, on the disk.
std::string synchronise(const std::string &name);

/// "name: reason" with the reason of the last failed system call.
std::string write_problem(const std::string &name);

/// Size and CRC-32 (ISO 3309, as in zlib) of what a file holds.
struct FileSum
{
  std::uint64_t size = 0;
  std::uint32_t crc  = 0;
  bool          operator==(const FileSum &other) const { return size == other.size && crc == other.crc; }
};

/// Read a file to its end. @return a problem
std::string sum_up(const std::string &name, FileSum &);

/// Whether a run begins its files or goes on with those of one that was interrupted.
enum class FileStart
{
  fresh,
  resumed
};

/// Length of a file that process 0 writes from its beginning to its end; a resumed run, which has opened it to append, cuts off what is behind.
/// OutputError if less is there. Collective.
void exchange_length(StateArchive &, const std::string &name, std::ofstream &);

/// OutputError on all processes when one of them has a problem; the message is that of the lowest. Collective.
void agree_on_output(const std::string &problem, MPI_Comm);
} // namespace Arenite
