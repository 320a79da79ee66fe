#include <arenite/io/files.h>
#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>

#include <cerrno>
#include <iostream>
#include <utility>

namespace Arenite
{
Log::Log(const MPI_Comm communicator, const bool silent)
  : communicator(communicator)
  , active(!silent && dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
{}

void Log::open(const OutputDirectory &directory, const bool append)
{
  if (!active)
    return;
  name  = directory.file("log.txt");
  errno = 0;
  file.open(name, append ? std::ios::app : std::ios::out);
  if (!(file << early << std::flush))
    problem = write_problem(name);
  early.clear();
}

void Log::to_file(const std::string &text)
{
  if (active && file.is_open())
    file << text << '\n' << std::flush;
}

void Log::line(const std::string &text) { *this << text << '\n'; }

void Log::write_lines()
{
  const std::string text = buffer.str();
  const auto        end  = text.rfind('\n');
  if (end == std::string::npos)
    return;
  const std::string lines = text.substr(0, end + 1);
  buffer.str(text.substr(end + 1));
  buffer.seekp(0, std::ios::end);

  std::cout << lines << std::flush;
  if (name.empty())
    early += lines;
  else if (problem.empty())
    {
      errno = 0;
      if (!(file << lines << std::flush))
        problem = write_problem(name);
    }
}

void Log::finish()
{
  if (active && !buffer.str().empty())
    line();
  if (file.is_open())
    {
      errno = 0;
      file.close();
      if (!file && problem.empty())
        problem = write_problem(name);
    }
  name.clear(); // what follows belongs to the next log.txt
  const std::string result = std::move(problem);
  problem.clear();
  agree_on_output(result, communicator);
}
} // namespace Arenite
