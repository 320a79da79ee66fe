#include <arenite/base/state_archive.h>
#include <arenite/io/files.h>
#include <arenite/io/receiver_store.h>

#include <cerrno>
#include <exception>
#include <fcntl.h>
#include <limits>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

namespace Arenite
{
using namespace dealii;

namespace
{
/// HDF5 has failed.
struct Hdf5Failure
{};

/// Keeps HDF5 from printing its failures, which are reported by OutputError.
class QuietHdf5
{
public:
  QuietHdf5()
  {
    H5Eget_auto2(H5E_DEFAULT, &old_function, &old_data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, old_function, old_data); }
  QuietHdf5(const QuietHdf5 &) = delete;

private:
  H5E_auto2_t old_function = nullptr;
  void       *old_data     = nullptr;
};

/// An open object of HDF5.
class Handle
{
public:
  Handle(const hid_t id, herr_t (*close)(hid_t))
    : id(id)
    , close(close)
  {
    if (id < 0)
      throw Hdf5Failure();
  }
  ~Handle() { close(id); }
  Handle(const Handle &) = delete;
  operator hid_t() const { return id; }

private:
  const hid_t id;
  herr_t (*const close)(hid_t);
};

void check(const herr_t result)
{
  if (result < 0)
    throw Hdf5Failure();
}

/// The same attributes that deal.II writes: variable length, UTF-8.
void set_attribute(const hid_t object, const char *name, const std::string &text)
{
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, H5T_VARIABLE));
  check(H5Tset_cset(type, H5T_CSET_UTF8));
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char  *value = text.c_str();
  check(H5Awrite(attribute, type, &value));
}

void create_dataset(const hid_t file, const StoredDataset &dataset)
{
  const Handle space(H5Screate_simple(int(dataset.size.size()), dataset.size.data(), nullptr), H5Sclose);
  const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY));
  if (dataset.fill != 0.)
    check(H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &dataset.fill));
  const Handle id(H5Dcreate2(file, (dataset.group + "/" + dataset.name).c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                             properties, H5P_DEFAULT),
                  H5Dclose);
  set_attribute(id, "unit", dataset.unit);
  if (!dataset.components.empty())
    set_attribute(id, "components", dataset.components);
  if (!dataset.values.empty())
    check(H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, dataset.values.data()));
}

/// Upper bound of what HDF5 needs for the descriptions of @p n datasets and their groups (measured: 1.3 kB for each).
off_t size_of_descriptions(const std::size_t n) { return 16384 * off_t(n + 1); }

/// Let a file have @p size bytes, the first @p allocated of them on the disk. Returns 0 or errno.
int reserve(const std::string &name, const off_t size, const off_t allocated)
{
  const int descriptor = open(name.c_str(), O_RDWR | O_CREAT, 0666);
  if (descriptor < 0)
    return errno;
  int error = ftruncate(descriptor, size) == 0 ? posix_fallocate(descriptor, 0, allocated) : errno;
  if (::close(descriptor) != 0 && error == 0) // file systems over the network report a full disk only here
    error = errno;
  return error;
}

std::string failure(const std::string &file_name)
{
  return file_name + ": cannot be written. Is the disk full, or the directory gone?";
}
} // namespace

ReceiverStore::ReceiverStore(const std::string &file_name, const MPI_Comm communicator)
  : file_name(file_name)
  , communicator(communicator)
{}

ReceiverStore::~ReceiverStore()
{
  const QuietHdf5 quiet;
  if (file >= 0 && std::uncaught_exceptions() == 0)
    H5Fclose(file);
}

void ReceiverStore::plan(StoredDataset dataset) { datasets.push_back(std::move(dataset)); }

// HDF5 must not meet a full disk either: it crashes in MPI_Finalize when a file could not be closed. So the system is asked first,
// for the final size (limits of the file system and of the user) and for the space of what is written here.
std::string ReceiverStore::create_alone() const
{
  off_t size = size_of_descriptions(datasets.size()), written_now = size;
  for (const StoredDataset &dataset : datasets)
    {
      off_t bytes = sizeof(double);
      for (const hsize_t n : dataset.size)
        bytes *= off_t(n);
      size += bytes;
      if (!dataset.values.empty() || dataset.fill != 0.)
        written_now += bytes;
    }
  errno = reserve(file_name, size, written_now);
  if (errno != 0)
    return write_problem(file_name);

  const QuietHdf5 quiet;
  try
    {
      const Handle          new_file(H5Fcreate(file_name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
      std::set<std::string> groups;
      for (const StoredDataset &dataset : datasets)
        {
          if (groups.insert(dataset.group).second)
            const Handle group(H5Gcreate2(new_file, dataset.group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                               H5Gclose);
          create_dataset(new_file, dataset);
        }
      check(H5Fflush(new_file, H5F_SCOPE_GLOBAL));
    }
  catch (const Hdf5Failure &)
    {
      return failure(file_name);
    }

  struct stat now;
  errno = stat(file_name.c_str(), &now) == 0 ? reserve(file_name, now.st_size, now.st_size) : errno;
  return errno == 0 ? "" : write_problem(file_name);
}

void ReceiverStore::create()
{
  std::string problem;
  if (Utilities::MPI::this_mpi_process(communicator) == 0)
    {
      problem = create_alone();
      if (!problem.empty())
        unlink(file_name.c_str());
    }
  agree_on_output(problem, communicator);
  open_together();
}

void ReceiverStore::open()
{
  std::string problem;
  if (Utilities::MPI::this_mpi_process(communicator) == 0)
    problem = objection();
  problem = Utilities::MPI::broadcast(communicator, problem, 0);
  if (!problem.empty())
    throw InputError(problem);
  open_together();
}

/// What does not let a resumed run go on with the file, or nothing.
std::string ReceiverStore::objection() const
{
  const QuietHdf5 quiet;
  try
    {
      const Handle old(H5Fopen(file_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
      for (const StoredDataset &planned : datasets)
        {
          const Handle dataset(H5Dopen2(old, (planned.group + "/" + planned.name).c_str(), H5P_DEFAULT), H5Dclose);
          const Handle space(H5Dget_space(dataset), H5Sclose);
          std::vector<hsize_t> size(planned.size.size());
          if (H5Sget_simple_extent_ndims(space) != int(size.size()) ||
              H5Sget_simple_extent_dims(space, size.data(), nullptr) < 0 || size != planned.size)
            return file_name +
                   ": has room for another number of rows than this run needs. With lines or planes of receivers "
                   "a resumed run keeps its 'End time'.";
        }
    }
  catch (const Hdf5Failure &)
    {
      return file_name + ": is not the file of the run that is to be resumed.";
    }
  return "";
}

void ReceiverStore::open_together()
{
  std::string problem;
  errno = 0;
  if (access(file_name.c_str(), R_OK | W_OK) != 0) // a directory that not all computers share
    problem = write_problem(file_name);
  agree_on_output(problem, communicator);

  const QuietHdf5 quiet;
  try
    {
      const Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      check(H5Pset_fapl_mpio(properties, communicator, MPI_INFO_NULL));
      file = H5Fopen(file_name.c_str(), H5F_ACC_RDWR, properties);
      check(file >= 0 ? 0 : -1);
    }
  catch (const Hdf5Failure &)
    {
      problem = failure(file_name);
    }
  agree_on_output(problem, communicator);
}

std::string ReceiverStore::write(const std::string &group, const std::string &name, const std::vector<hsize_t> &offset,
                                 const std::vector<hsize_t> &count, const std::vector<double> &values)
{
  const QuietHdf5 quiet;
  try
    {
      const Handle dataset(H5Dopen2(file, (group + "/" + name).c_str(), H5P_DEFAULT), H5Dclose);
      const Handle space(H5Dget_space(dataset), H5Sclose);
      check(H5Sselect_hyperslab(space, H5S_SELECT_SET, offset.data(), nullptr, count.data(), nullptr));
      const Handle memory(H5Screate_simple(int(count.size()), count.data(), nullptr), H5Sclose);
      const Handle properties(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
      check(H5Pset_dxpl_mpio(properties, H5FD_MPIO_INDEPENDENT));
      check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, properties, values.data()));
    }
  catch (const Hdf5Failure &)
    {
      return failure(file_name);
    }
  return "";
}

void ReceiverStore::close()
{
  if (file < 0)
    return;
  const QuietHdf5 quiet;
  const bool      ok = H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0;
  agree_on_output(ok ? "" : failure(file_name), communicator);
  const bool closed = H5Fclose(file) >= 0;
  file              = -1;
  agree_on_output(closed ? "" : failure(file_name), communicator);
}

namespace
{
template <int dim>
class ReceiverGroup : public ReceiverFile<dim>
{
public:
  ReceiverGroup(std::shared_ptr<ReceiverStore> store_, const std::string &set, const std::vector<Point<dim>> &positions,
                const ReceiverQuantities &quantities, const Symmetry symmetry, const std::size_t n_rows)
    : ReceiverFile<dim>(divide_points(positions.size(), store_->communicator))
    , store(std::move(store_))
    , set(set)
    , quantities(quantities)
    , rank(Utilities::MPI::this_mpi_process(store->communicator))
    , first_point(this->first_points[rank])
    , n_own_points(this->first_points[rank + 1] - first_point)
    , n_rows(n_rows)
  {
    std::string axes, stresses;
    for (unsigned int d = 0; d < dim; ++d)
      axes += (d == 0 ? "" : ",") + std::string(1, direction_letters(symmetry)[d]);
    for (unsigned int k = 0; k < n_stress; ++k)
      stresses += (k == 0 ? "" : ",") + stress_component(symmetry, k);
    const hsize_t       n_points = positions.size();
    std::vector<double> x;
    for (const Point<dim> &point : positions)
      for (unsigned int d = 0; d < dim; ++d)
        x.push_back(point[d]);
    store->plan({set, "position", "m", axes, {n_points, hsize_t(dim)}, x});
    store->plan({set, "time", "s", "", {this->n_rows}, {}, std::numeric_limits<double>::quiet_NaN()});
    const auto plan = [&](const std::string &name, const std::string &unit, const hsize_t n_components,
                          const std::string &components) {
      store->plan({set, name, unit, components, {this->n_rows, n_points, n_components}, {}});
    };
    if (quantities.displacement)
      plan("displacement", "m", dim, axes);
    if (quantities.velocity)
      plan("velocity", "m/s", dim, axes);
    if (quantities.stress)
      plan("stress", "Pa", n_stress, stresses);
    for (const std::string &scalar : quantities.scalars)
      plan(name_and_unit(scalar).first, name_and_unit(scalar).second, 1, "");
    scalars.resize(quantities.scalars.size());
  }

  void add(const ReceiverRow<dim> &row) override
  {
    time.push_back(row.time);
    for (unsigned int point = 0; point < n_own_points; ++point)
      {
        for (unsigned int d = 0; d < dim && quantities.displacement; ++d)
          displacement.push_back(row.displacement[point][d]);
        for (unsigned int d = 0; d < dim && quantities.velocity; ++d)
          velocity.push_back(row.velocity[point][d]);
        for (unsigned int k = 0; k < n_stress && quantities.stress; ++k)
          stress.push_back(row.stress[point].access_raw_entry(k));
        for (std::size_t k = 0; k < scalars.size(); ++k)
          scalars[k].push_back(row.scalars[point * scalars.size() + k]);
      }
  }

  void flush() override { agree_on_output(write(), store->communicator); }

  /// Times beyond are not reached, whatever an interrupted run has written there.
  void exchange(StateArchive &archive) override
  {
    archive.common(n_written);
    std::string problem;
    if (archive.loads() && rank == 0 && n_written < n_rows)
      problem = store->write(set, "time", {n_written}, {n_rows - n_written},
                             std::vector<double>(n_rows - n_written, std::numeric_limits<double>::quiet_NaN()));
    agree_on_output(problem, store->communicator);
  }

private:
  static constexpr unsigned int n_stress = n_stress_components(dim);

  std::string write()
  {
    const hsize_t n = time.size();
    if (n_written + n > n_rows)
      return store->file_name + ": more rows than the end time and the interval promise.";
    std::string problem;
    if (n > 0 && rank == 0)
      problem = store->write(set, "time", {n_written}, {n}, time);
    const auto write_own = [&](const std::string &name, std::vector<double> &values, const hsize_t n_components) {
      if (!values.empty() && problem.empty())
        problem = store->write(set, name, {n_written, first_point, 0}, {n, n_own_points, n_components}, values);
      values.clear();
    };
    write_own("displacement", displacement, dim);
    write_own("velocity", velocity, dim);
    write_own("stress", stress, n_stress);
    for (std::size_t k = 0; k < scalars.size(); ++k)
      write_own(name_and_unit(quantities.scalars[k]).first, scalars[k], 1);
    time.clear();
    n_written += n;
    return problem;
  }

  std::shared_ptr<ReceiverStore>   store;
  const std::string                set;
  const ReceiverQuantities         quantities;
  const unsigned int               rank;
  const hsize_t                    first_point, n_own_points, n_rows;
  hsize_t                          n_written = 0;
  std::vector<double>              time, displacement, velocity, stress; ///< since the last flush
  std::vector<std::vector<double>> scalars;                              ///< as well, one after the other
};
} // namespace

template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_group(std::shared_ptr<ReceiverStore> store, const std::string &set,
                                                       const std::vector<Point<dim>> &positions,
                                                       const ReceiverQuantities &quantities, const Symmetry symmetry,
                                                       const std::size_t n_rows)
{
  return std::make_unique<ReceiverGroup<dim>>(std::move(store), set, positions, quantities, symmetry, n_rows);
}

#define ARENITE_INSTANTIATE(dim)                                                                             \
  template std::unique_ptr<ReceiverFile<dim>> make_receiver_group<dim>(std::shared_ptr<ReceiverStore>,       \
                                                                       const std::string &,                  \
                                                                       const std::vector<Point<dim>> &,      \
                                                                       const ReceiverQuantities &, Symmetry, \
                                                                       std::size_t);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
