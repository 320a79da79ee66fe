#pragma once

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace Arenite
{
/// What a run knows besides the fields of its mesh, on the way into a checkpoint or out of it. Classes say once what they are made of, for
/// both ways:
///
///   void exchange(StateArchive &archive) { archive.common(step); archive.sum(work); }
///
/// All processes call the same in the same order; each call but common() is collective. The archive may be read by another number of
/// processes than wrote it.
class StateArchive
{
public:
  /// Collect.
  explicit StateArchive(MPI_Comm);

  /// Give back what bytes() gave.
  StateArchive(const std::string &bytes, MPI_Comm);

  bool loads() const { return in != nullptr; }

  /// The same on all processes. Anything that Boost can serialise.
  template <typename T>
  void common(T &value)
  {
    if (loads())
      *in >> value;
    else
      *out << value;
  }

  /// Of which only the sum over processes has a meaning: on as many processes as before each gets back its own part, otherwise the first gets all.
  void sum(double &value);

  /// Of points that are divided among processes, @p n_own of them from @p first on here: some values of each point, one point after the
  /// other, or none. @tparam T made of double.
  template <typename T>
  void of_points(std::vector<T> &values, const std::size_t first, const std::size_t n_own)
  {
    static_assert(sizeof(T) % sizeof(double) == 0, "numbers only");
    std::vector<double> numbers(values.size() * (sizeof(T) / sizeof(double)));
    if (!loads() && !values.empty())
      std::memcpy(numbers.data(), static_cast<const void *>(values.data()), numbers.size() * sizeof(double));
    numbers_of_points(numbers, first, n_own);
    if (!loads())
      return;
    values.resize(numbers.size() / (sizeof(T) / sizeof(double)));
    if (!values.empty())
      std::memcpy(static_cast<void *>(values.data()), numbers.data(), numbers.size() * sizeof(double));
  }

  /// Of what was collected, on process 0.
  std::string bytes() const { return stream.str(); }

  const MPI_Comm communicator;

private:
  void numbers_of_points(std::vector<double> &numbers, std::size_t first, std::size_t n_own);

  std::stringstream                                stream;
  std::unique_ptr<boost::archive::binary_oarchive> out;
  std::unique_ptr<boost::archive::binary_iarchive> in;
};
} // namespace Arenite
