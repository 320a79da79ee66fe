#pragma once

#include <arenite/io/receiver_file.h>

#include <deal.II/base/mpi.h>

#include <hdf5.h>

namespace Arenite
{
/// A dataset of numbers in a group, with the attributes `unit` and `components` (if any).
struct StoredDataset
{
  std::string          group, name, unit, components;
  std::vector<hsize_t> size;
  std::vector<double>  values; ///< known from the beginning; empty if they come with write()
  double               fill = 0.;
};

/// One file receivers.h5 for all lines and planes of a scene, written by all processes side by side.
///
/// Many processes must not meet a full disk while they write one file (measured: doc/architecture.md, section 5). Hence nothing
/// but numbers is written together, to places that are theirs already:
///
///   1. All datasets are planned before the file exists.
///   2. Process 0 alone creates the file with groups, datasets and attributes, and has the system allocate all of it on the disk.
///   3. All processes agree that this went well, and open the file together with the MPI driver.
///   4. Each process writes the numbers that it has. The write is not collective: its failure on one process leaves nobody
///      waiting, and the caller can make it known.
class ReceiverStore
{
public:
  ReceiverStore(const std::string &file_name, MPI_Comm);

  /// Closes the file, unless an exception is on its way: processes may be missing then. HDF5 closes what is left in
  /// MPI_Finalize, where all processes come along.
  ~ReceiverStore();
  ReceiverStore(const ReceiverStore &) = delete;

  /// Before create(), on all processes alike.
  void plan(StoredDataset);

  /// Create the file, or replace one of the same name. OutputError on all processes when the disk has not enough space for
  /// everything that was planned; then no file is left. Collective.
  void create();

  /// Open the file that an interrupted run has left. InputError if it has other sizes than planned. Collective.
  void open();

  /// Write a block of a dataset, on this process alone. Returns a problem for agree_on_output().
  std::string write(const std::string &group, const std::string &name, const std::vector<hsize_t> &offset,
                    const std::vector<hsize_t> &count, const std::vector<double> &values);

  /// Have everything on the disk; OutputError on all processes. Collective.
  void close();

  const std::string file_name;
  const MPI_Comm    communicator;

private:
  std::string create_alone() const;
  std::string objection() const;
  void        open_together();

  std::vector<StoredDataset> datasets;
  hid_t                      file = -1;
};

/// Group @p set of the store with the datasets time[n_rows], position[point][3], displacement and velocity
/// [n_rows][point][component] and stress[n_rows][point][xx, yy, zz, xy, xz, yz], components as in tables; attributes `unit` and `components`.
/// The time of rows that were never reached is NaN. Before ReceiverStore::create(); the points are divided among all processes.
template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_group(std::shared_ptr<ReceiverStore> store, const std::string &set,
                                                       const std::vector<dealii::Point<dim>> &positions,
                                                       const ReceiverQuantities &quantities, Symmetry symmetry,
                                                       std::size_t n_rows);
} // namespace Arenite
