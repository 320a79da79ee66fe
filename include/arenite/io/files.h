#pragma once

#include <deal.II/base/mpi.h>

#include <functional>
#include <ostream>
#include <string>

namespace Arenite
{
// Files that are complete or not there. A problem is a text for the user, "file: reason"; empty when all is well.

/// Let @p write fill a new file; removed again if it cannot be written to its end (disk full, no permission).
std::string create_file(const std::string &name, const std::function<void(std::ostream &)> &write);

/// The same under a temporary name first: a reader, or a crash, never meets half a file or finds the old one gone.
std::string replace_file(const std::string &name, const std::function<void(std::ostream &)> &write);

/// "name: reason" with the reason of the last failed system call.
std::string write_problem(const std::string &name);

/// OutputError on all processes when one of them has a problem; the message is that of the lowest. Collective.
void agree_on_output(const std::string &problem, MPI_Comm);
} // namespace Arenite
