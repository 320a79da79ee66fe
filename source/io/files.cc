#include <arenite/base/errors.h>
#include <arenite/base/state_archive.h>
#include <arenite/io/files.h>

#include <boost/archive/archive_exception.hpp>
#include <boost/crc.hpp>

#include <cerrno>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <system_error>
#include <typeinfo>
#include <unistd.h>
#include <vector>

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
  bool is_complete = false;
  try
    {
      write(file);
      file.close(); // file systems over the network report a full disk only here
      is_complete = bool(file);
    }
  catch (const boost::archive::archive_exception &)
    {} // archives write past the stream, whose state tells nothing
  catch (const std::bad_cast &)
    {} // and may leave a buffer behind that cannot be closed
  catch (const std::exception &)
    {
      // writers of deal.II throw when the stream is bad, everything else is not about files
      if (file)
        throw;
    }
  if (is_complete)
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

void exchange_length(StateArchive &archive, const std::string &name, std::ofstream &file)
{
  std::uint64_t length = 0;
  std::string   problem;
  const bool    is_writer = dealii::Utilities::MPI::this_mpi_process(archive.communicator) == 0;
  if (is_writer && !archive.loads())
    {
      errno = 0;
      std::error_code error;
      if (file << std::flush)
        length = std::filesystem::file_size(name, error); // a stream that appends does not know
      if (error || !file)
        problem = write_problem(name);
    }
  archive.common(length);
  if (is_writer && archive.loads())
    {
      std::error_code error;
      const auto      present = std::filesystem::file_size(name, error);
      if (error || present < length)
        problem = name + ": is shorter than it was when the checkpoint was written; results are missing.";
      else
        {
          std::filesystem::resize_file(name, length, error);
          if (error || !file)
            problem = write_problem(name);
        }
    }
  agree_on_output(problem, archive.communicator);
}

std::string synchronise(const std::string &name)
{
  errno                     = 0;
  const int         file    = open(name.c_str(), O_RDONLY);
  const bool        is_done = file >= 0 && fsync(file) == 0;
  const std::string problem = is_done ? "" : write_problem(name);
  if (file >= 0)
    close(file);
  return problem;
}

std::string sum_up(const std::string &name, FileSum &sum)
{
  errno = 0;
  std::ifstream      file(name, std::ios::binary);
  std::vector<char>  piece(1 << 20);
  boost::crc_32_type crc;
  sum.size = 0;
  while (file)
    {
      file.read(piece.data(), piece.size());
      crc.process_bytes(piece.data(), file.gcount());
      sum.size += file.gcount();
    }
  sum.crc = crc.checksum();
  if (file.eof())
    return "";
  return name + ": cannot be read" + (errno != 0 ? std::string(": ") + std::strerror(errno) : std::string()) + ".";
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
