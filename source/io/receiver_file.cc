#include <arenite/io/files.h>
#include <arenite/io/receiver_file.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr const char *axis[3]             = {"x", "y", "z"};
constexpr const char *stress_component[6] = {"xx", "yy", "zz", "xy", "xz", "yz"}; // raw entries of SymmetricTensor<2,3>

bool is_root(const MPI_Comm communicator) { return Utilities::MPI::this_mpi_process(communicator) == 0; }

void append(std::string &text, const double value)
{
  char word[32];
  text.append(word, std::snprintf(word, sizeof(word), "%.9e", value));
}

template <int dim>
class ReceiverTable : public ReceiverFile<dim>
{
public:
  ReceiverTable(const std::string &file_name, const std::vector<std::string> &names,
                const ReceiverQuantities &quantities, const MPI_Comm communicator)
    : file_name(file_name)
    , quantities(quantities)
    , communicator(communicator)
  {
    if (is_root(communicator))
      {
        errno = 0;
        file.open(file_name, std::ios::binary);
      }
    text = "t [s]";
    for (const std::string &name : names)
      {
        for (unsigned int d = 0; d < dim && quantities.displacement; ++d)
          text += "," + name + ".displacement_" + axis[d] + " [m]";
        for (unsigned int d = 0; d < dim && quantities.velocity; ++d)
          text += "," + name + ".velocity_" + axis[d] + " [m/s]";
        for (unsigned int k = 0; k < 6 && quantities.stress; ++k)
          text += "," + name + ".stress_" + stress_component[k] + " [Pa]";
      }
    text += "\n";
    flush();
  }

  void add(const ReceiverRow<dim> &row) override
  {
    char time[40]; // all digits: rows may be closer to each other than 1e-9 of the time
    text.append(time, std::snprintf(time, sizeof(time), "%.15e", row.time));
    const auto put = [&](const double value) {
      text += ",";
      append(text, value);
    };
    for (unsigned int point = 0; point < row.displacement.size(); ++point)
      {
        for (unsigned int d = 0; d < dim && quantities.displacement; ++d)
          put(row.displacement[point][d]);
        for (unsigned int d = 0; d < dim && quantities.velocity; ++d)
          put(row.velocity[point][d]);
        for (unsigned int k = 0; k < 6 && quantities.stress; ++k)
          put(row.stress[point].access_raw_entry(k));
      }
    text += "\n";
  }

  void flush() override
  {
    std::string problem;
    if (is_root(communicator))
      {
        errno = 0;
        file.write(text.data(), text.size());
        file.flush();
        if (!file)
          problem = write_problem(file_name);
        text.clear();
      }
    agree_on_output(problem, communicator);
  }

private:
  const std::string        file_name;
  const ReceiverQuantities quantities;
  const MPI_Comm           communicator;
  std::ofstream            file;
  std::string              text;
};

/// Notes failures of HDF5, which deal.II does not report in release mode, and keeps the library from printing them.
class WatchHdf5
{
public:
  WatchHdf5()
  {
    H5Eget_auto2(H5E_DEFAULT, &old_function, &old_data);
    H5Eset_auto2(H5E_DEFAULT, &note, &failed);
  }
  ~WatchHdf5() { H5Eset_auto2(H5E_DEFAULT, old_function, old_data); }
  WatchHdf5(const WatchHdf5 &) = delete;

  /// Message about the failures so far; empty if there were none.
  std::string problem(const std::string &file_name) const
  {
    return failed ? file_name + ": cannot be written. Is the disk full, or the directory gone?" : "";
  }

private:
  static herr_t note(hid_t, void *failed)
  {
    *static_cast<bool *>(failed) = true;
    return 0;
  }

  H5E_auto2_t old_function = nullptr;
  void       *old_data     = nullptr;
  bool        failed       = false;
};

/// Destroy an HDF5 object of deal.II, unless an exception is on its way: then deal.II would abort the program. HDF5 itself
/// closes what is left in MPI_Finalize.
template <typename T>
void keep_during_exception(std::unique_ptr<T> &object)
{
  if (std::uncaught_exceptions() > 0)
    object.release();
  object.reset();
}

template <int dim>
class ReceiverGroup : public ReceiverFile<dim>
{
public:
  ReceiverGroup(std::shared_ptr<ReceiverStore> store_, const std::string &set, const std::vector<Point<dim>> &positions,
                const ReceiverQuantities &quantities, const std::size_t n_rows)
    : store(std::move(store_))
    , n_points(positions.size())
    , n_rows(n_rows)
  {
    if (!is_root(store->communicator))
      return;
    const WatchHdf5 watch;
    HDF5::Group     group  = store->file->create_group(set);
    const auto      create = [&](const std::string &name, const std::string &unit, const std::vector<hsize_t> size,
                            const std::string &components) {
      HDF5::DataSet dataset = group.create_dataset<double>(name, size);
      dataset.set_attribute("unit", unit);
      if (!components.empty())
        dataset.set_attribute("components", components);
      return dataset;
    };
    const std::string axes[] = {"x", "x,y", "x,y,z"};

    HDF5::DataSet       position = create("position", "m", {n_points, hsize_t(dim)}, axes[dim - 1]);
    std::vector<double> x;
    for (const Point<dim> &point : positions)
      for (unsigned int d = 0; d < dim; ++d)
        x.push_back(point[d]);
    position.write_hyperslab(x, {0, 0}, {n_points, hsize_t(dim)});

    columns.push_back({create("time", "s", {this->n_rows}, ""), 0, {}});
    columns[0].dataset.write(std::vector<double>(n_rows, std::numeric_limits<double>::quiet_NaN()));
    const auto add_column = [&](const bool wanted, const std::string &name, const std::string &unit,
                                const hsize_t n_components, const std::string &components) {
      index.push_back(wanted ? columns.size() : 0);
      if (wanted)
        columns.push_back({create(name, unit, {this->n_rows, n_points, n_components}, components), n_components, {}});
    };
    add_column(quantities.displacement, "displacement", "m", dim, axes[dim - 1]);
    add_column(quantities.velocity, "velocity", "m/s", dim, axes[dim - 1]);
    add_column(quantities.stress, "stress", "Pa", 6, "xx,yy,zz,xy,xz,yz");
    problem = watch.problem(store->file_name);
  }

  ~ReceiverGroup() override
  {
    const WatchHdf5 watch;
    keep_during_exception(open_columns);
  }

  void add(const ReceiverRow<dim> &row) override
  {
    columns[0].data.push_back(row.time);
    for (unsigned int point = 0; point < n_points; ++point)
      {
        for (unsigned int d = 0; d < dim && index[0]; ++d)
          columns[index[0]].data.push_back(row.displacement[point][d]);
        for (unsigned int d = 0; d < dim && index[1]; ++d)
          columns[index[1]].data.push_back(row.velocity[point][d]);
        for (unsigned int k = 0; k < 6 && index[2]; ++k)
          columns[index[2]].data.push_back(row.stress[point].access_raw_entry(k));
      }
  }

  void flush() override
  {
    if (is_root(store->communicator) && problem.empty())
      write();
    agree_on_output(problem, store->communicator);
  }

private:
  struct Column
  {
    HDF5::DataSet       dataset;
    hsize_t             n_components; ///< per point; 0 for one number per row
    std::vector<double> data;
  };

  void write()
  {
    const hsize_t n = columns[0].data.size();
    if (n == 0)
      return;
    if (n_written + n > n_rows)
      {
        problem = store->file_name + ": more rows than the end time and the interval promise.";
        return;
      }
    const WatchHdf5 watch;
    for (Column &column : columns)
      {
        if (column.n_components == 0)
          column.dataset.write_hyperslab(column.data, {n_written}, {n});
        else
          column.dataset.write_hyperslab(column.data, {n_written, 0, 0}, {n, n_points, column.n_components});
        column.data.clear();
      }
    n_written += n;
    problem = watch.problem(store->file_name);
  }

  std::shared_ptr<ReceiverStore>       store; // outlives the datasets
  const hsize_t                        n_points, n_rows;
  hsize_t                              n_written    = 0;
  std::unique_ptr<std::vector<Column>> open_columns = std::make_unique<std::vector<Column>>();
  std::vector<Column>                 &columns      = *open_columns;
  std::string                          problem;
  std::vector<std::size_t>             index; ///< columns of displacement, velocity, stress; 0 if not wanted
};
} // namespace

ReceiverStore::ReceiverStore(const std::string &file_name, const MPI_Comm communicator)
  : file_name(file_name)
  , communicator(communicator)
{
  std::string problem;
  if (is_root(communicator))
    {
      const WatchHdf5 watch;
      file    = std::make_unique<HDF5::File>(file_name, HDF5::File::FileAccessMode::create);
      problem = watch.problem(file_name);
      if (!problem.empty())
        file.reset();
    }
  agree_on_output(problem, communicator);
}

ReceiverStore::~ReceiverStore()
{
  const WatchHdf5 watch;
  keep_during_exception(file);
}

template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_table(const std::string              &file_name,
                                                       const std::vector<std::string> &names,
                                                       const ReceiverQuantities       &quantities,
                                                       const MPI_Comm                  communicator)
{
  return std::make_unique<ReceiverTable<dim>>(file_name, names, quantities, communicator);
}

template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_group(std::shared_ptr<ReceiverStore> store, const std::string &set,
                                                       const std::vector<Point<dim>> &positions,
                                                       const ReceiverQuantities &quantities, const std::size_t n_rows)
{
  auto group = std::make_unique<ReceiverGroup<dim>>(std::move(store), set, positions, quantities, n_rows);
  group->flush(); // not in the constructor, which must not throw: see keep_during_exception()
  return group;
}

void write_text_file(const std::string &file_name, const std::string &text, const MPI_Comm communicator)
{
  std::string problem;
  if (is_root(communicator))
    problem = create_file(file_name, [&](std::ostream &file) { file << text; });
  agree_on_output(problem, communicator);
}

std::string table_number(const double value)
{
  std::string text;
  append(text, value);
  return text;
}

template std::unique_ptr<ReceiverFile<3>> make_receiver_table<3>(const std::string &, const std::vector<std::string> &,
                                                                 const ReceiverQuantities &, MPI_Comm);
template std::unique_ptr<ReceiverFile<3>> make_receiver_group<3>(std::shared_ptr<ReceiverStore>, const std::string &,
                                                                 const std::vector<Point<3>> &,
                                                                 const ReceiverQuantities &, std::size_t);
} // namespace Arenite
