#pragma once

#include <arenite/base/errors.h>
#include <arenite/base/symmetry.h>
#include <arenite/io/files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Arenite
{
class StateArchive;

/// What a set of receivers writes; the displacement is always measured, because the velocity follows from it.
struct ReceiverQuantities
{
  bool                     displacement = false, velocity = false, stress = false;
  std::vector<std::string> scalars; ///< with units: what points store, density first
};

/// Points of a set at one time.
template <int dim>
struct ReceiverRow
{
  double                                     time = 0.;
  std::vector<dealii::Tensor<1, dim>>        displacement, velocity;
  std::vector<dealii::SymmetricTensor<2, 3>> stress;  ///< empty if not wanted
  std::vector<double>                        scalars; ///< [point][scalar]
};

/// Destination of completed rows. Each process adds the points of a range; flush() writes what was added since the last time.
template <int dim>
class ReceiverFile
{
public:
  explicit ReceiverFile(const std::vector<unsigned int> &first_points)
    : first_points(first_points)
  {}
  virtual ~ReceiverFile() = default;

  /// The points of this process at one time; on all processes, also on those without points.
  virtual void add(const ReceiverRow<dim> &) = 0;

  /// Collective; raises OutputError on all processes if something could not be written.
  virtual void flush() = 0;

  /// How far the file is; after a resumed run has opened it, what was written beyond is cut off or will be written again. Collective.
  virtual void exchange(StateArchive &) = 0;

  /// Process i adds the points first_points[i] <= point < first_points[i + 1].
  const std::vector<unsigned int> first_points;
};

/// ReceiverFile::first_points with equal shares for all processes.
std::vector<unsigned int> divide_points(unsigned int n_points, MPI_Comm);

/// Table with the columns `t [s]`, then `<point>.<quantity>_<component> [unit]`; process 0 has all points. Components carry the letters
/// of the symmetry, and stresses are the first n_stress_components().
template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_table(const std::string              &file_name,
                                                       const std::vector<std::string> &names,
                                                       const ReceiverQuantities &quantities, Symmetry symmetry,
                                                       MPI_Comm communicator, FileStart);

/// Write a small text file from process 0; raises OutputError on all processes.
void write_text_file(const std::string &file_name, const std::string &text, MPI_Comm);

/// "density [kg/m^3]" -> "density", "kg/m^3"; without a unit the second is empty.
std::pair<std::string, std::string> name_and_unit(const std::string &);

/// "xx", "xy" ... of component @p k of a stress tensor.
std::string stress_component(Symmetry, unsigned int k);

/// Text of a number in tables.
std::string table_number(double value);
} // namespace Arenite
