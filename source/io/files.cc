#include <arenite/base/errors.h>
#include <arenite/io/files.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace Arenite
{
std::string write_problem(const std::string &name)
{
  const int reason = errno;
  return name + ": cannot be written" + (reason != 0 ? std::string(": ") + std::strerror(reason) : std::string()) + ".";
}

std::string create_file(const std::string &name, const std::function<void(std::ostream &)> &write)
{
  errno = 0;
  std::ofstream file(name, std::ios::binary);
  if (!file)
    return write_problem(name);
  try
    {
      write(file);
    }
  catch (const std::exception &)
    {
      // writers of deal.II throw when the stream is bad, everything else is not about files
      if (file)
        throw;
    }
  file.close(); // file systems over the network report a full disk only here
  if (file)
    return "";
  const std::string problem = write_problem(name);
  std::error_code   ignored;
  std::filesystem::remove(name, ignored);
  return problem;
}

std::string replace_file(const std::string &name, const std::function<void(std::ostream &)> &write)
{
  const std::string fresh   = name + ".new";
  const std::string problem = create_file(fresh, write);
  if (!problem.empty())
    return problem;
  std::error_code error;
  std::filesystem::rename(fresh, name, error);
  return error ? name + ": cannot be written: " + error.message() + "." : "";
}

void agree_on_output(const std::string &problem, const MPI_Comm communicator)
{
  const unsigned int none  = dealii::numbers::invalid_unsigned_int;
  const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int first = dealii::Utilities::MPI::min(problem.empty() ? none : rank, communicator);
  if (first != none)
    throw OutputError(dealii::Utilities::MPI::broadcast(communicator, problem, first));
}
} // namespace Arenite
