#include <arenite/base/state_archive.h>

#include <numeric>

namespace Arenite
{
using namespace dealii;

StateArchive::StateArchive(const MPI_Comm communicator)
  : communicator(communicator)
  , out(std::make_unique<boost::archive::binary_oarchive>(stream))
{}

StateArchive::StateArchive(const std::string &bytes, const MPI_Comm communicator)
  : communicator(communicator)
  , stream(bytes)
  , in(std::make_unique<boost::archive::binary_iarchive>(stream))
{}

void StateArchive::sum(double &value)
{
  std::vector<double> parts;
  if (!loads())
    parts = Utilities::MPI::all_gather(communicator, value);
  common(parts);
  if (!loads())
    return;
  const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
  if (parts.size() == Utilities::MPI::n_mpi_processes(communicator))
    value = parts[rank];
  else
    value = rank == 0 ? std::accumulate(parts.begin(), parts.end(), 0.) : 0.;
}

void StateArchive::numbers_of_points(std::vector<double> &numbers, const std::size_t first, const std::size_t n_own)
{
  // of each point; a process without points does not know
  unsigned int        width = n_own > 0 ? static_cast<unsigned int>(numbers.size() / n_own) : 0;
  std::vector<double> all;
  if (!loads())
    {
      width = Utilities::MPI::max(width, communicator);
      for (const std::vector<double> &part : Utilities::MPI::gather(communicator, numbers)) // on process 0
        all.insert(all.end(), part.begin(), part.end());
    }
  common(width);
  common(all);
  if (loads())
    numbers.assign(all.begin() + first * width, all.begin() + (first + n_own) * width);
}
} // namespace Arenite
