#pragma once

#include <arenite/base/errors.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// What a set of receivers writes; the displacement is always measured, because the velocity follows from it.
struct ReceiverQuantities
{
  bool displacement = false, velocity = false, stress = false;
};

/// All points of a set at one time.
template <int dim>
struct ReceiverRow
{
  double                                     time = 0.;
  std::vector<dealii::Tensor<1, dim>>        displacement, velocity;
  std::vector<dealii::SymmetricTensor<2, 3>> stress; ///< empty if not wanted
};

/// Destination of completed rows. Process 0 adds them; flush() writes what was added since the last time.
template <int dim>
class ReceiverFile
{
public:
  virtual ~ReceiverFile() = default;

  /// On process 0.
  virtual void add(const ReceiverRow<dim> &) = 0;

  /// Collective; raises OutputError on all processes if something could not be written.
  virtual void flush() = 0;
};

/// One file receivers.h5 for all lines and planes of a scene. Process 0 has the rows and writes them alone: a collective write
/// that fails on one process (disk full) leaves the others waiting for ever in Open MPI.
class ReceiverStore
{
public:
  /// Creates the file, or replaces one of the same name.
  ReceiverStore(const std::string &file_name, MPI_Comm);
  ~ReceiverStore();

  const std::string                   file_name;
  const MPI_Comm                      communicator;
  std::unique_ptr<dealii::HDF5::File> file; ///< on process 0
};

/// Table with the columns `t [s]`, then `<point>.<quantity>_<component> [unit]`.
template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_table(const std::string              &file_name,
                                                       const std::vector<std::string> &names,
                                                       const ReceiverQuantities &quantities, MPI_Comm communicator);

/// Group @p set of the store with the datasets time[n_rows], position[point][3], displacement and velocity
/// [n_rows][point][component] and stress[n_rows][point][xx, yy, zz, xy, xz, yz]; attributes `unit` and `components`.
/// The time of rows that were never reached is NaN.
template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_group(std::shared_ptr<ReceiverStore> store, const std::string &set,
                                                       const std::vector<dealii::Point<dim>> &positions,
                                                       const ReceiverQuantities &quantities, std::size_t n_rows);

/// Write a small text file from process 0; raises OutputError on all processes.
void write_text_file(const std::string &file_name, const std::string &text, MPI_Comm);

/// Text of a number in tables.
std::string table_number(double value);
} // namespace Arenite
