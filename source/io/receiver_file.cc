#include <arenite/base/state_archive.h>
#include <arenite/io/files.h>
#include <arenite/io/receiver_file.h>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstdio>
#include <fstream>

namespace Arenite
{
using namespace dealii;

namespace
{
bool is_root(const MPI_Comm communicator) { return Utilities::MPI::this_mpi_process(communicator) == 0; }

void append(std::string &text, const double value)
{
  char word[32];
  text.append(word, std::snprintf(word, sizeof(word), "%.9e", value));
}

std::vector<unsigned int> points_of_root(const unsigned int n_points, const MPI_Comm communicator)
{
  std::vector<unsigned int> first_points(Utilities::MPI::n_mpi_processes(communicator) + 1, n_points);
  first_points[0] = 0;
  return first_points;
}

template <int dim>
class ReceiverTable : public ReceiverFile<dim>
{
public:
  ReceiverTable(const std::string &file_name, const std::vector<std::string> &names,
                const ReceiverQuantities &quantities, const Symmetry symmetry, const MPI_Comm communicator,
                const FileStart start)
    : ReceiverFile<dim>(points_of_root(names.size(), communicator))
    , file_name(file_name)
    , quantities(quantities)
    , communicator(communicator)
  {
    if (is_root(communicator))
      {
        errno = 0;
        file.open(file_name, std::ios::binary | (start == FileStart::resumed ? std::ios::app : std::ios::out));
      }
    if (start == FileStart::resumed)
      return;
    text = "t [s]";
    for (const std::string &name : names)
      {
        for (unsigned int d = 0; d < dim && quantities.displacement; ++d)
          text += "," + name + ".displacement_" + direction_letters(symmetry)[d] + " [m]";
        for (unsigned int d = 0; d < dim && quantities.velocity; ++d)
          text += "," + name + ".velocity_" + direction_letters(symmetry)[d] + " [m/s]";
        for (unsigned int k = 0; k < n_stress_components(dim) && quantities.stress; ++k)
          text += "," + name + ".stress_" + stress_component(symmetry, k) + " [Pa]";
        for (const std::string &scalar : quantities.scalars)
          text += "," + name + "." + scalar;
      }
    text += "\n";
    flush();
  }

  void add(const ReceiverRow<dim> &row) override
  {
    if (!is_root(communicator))
      return;
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
        for (unsigned int k = 0; k < n_stress_components(dim) && quantities.stress; ++k)
          put(row.stress[point].access_raw_entry(k));
        for (std::size_t k = 0; k < quantities.scalars.size(); ++k)
          put(row.scalars[point * quantities.scalars.size() + k]);
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

  void exchange(StateArchive &archive) override { exchange_length(archive, file_name, file); }

private:
  const std::string        file_name;
  const ReceiverQuantities quantities;
  const MPI_Comm           communicator;
  std::ofstream            file;
  std::string              text;
};
} // namespace

std::vector<unsigned int> divide_points(const unsigned int n_points, const MPI_Comm communicator)
{
  const std::size_t         n_processes = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<unsigned int> first_points;
  for (std::size_t process = 0; process <= n_processes; ++process)
    first_points.push_back(static_cast<unsigned int>(process * n_points / n_processes));
  return first_points;
}

template <int dim>
std::unique_ptr<ReceiverFile<dim>> make_receiver_table(const std::string              &file_name,
                                                       const std::vector<std::string> &names,
                                                       const ReceiverQuantities &quantities, const Symmetry symmetry,
                                                       const MPI_Comm communicator, const FileStart start)
{
  return std::make_unique<ReceiverTable<dim>>(file_name, names, quantities, symmetry, communicator, start);
}

std::pair<std::string, std::string> name_and_unit(const std::string &text)
{
  const std::size_t unit = text.find(" [");
  return {text.substr(0, unit), unit == std::string::npos ? "" : text.substr(unit + 2, text.size() - unit - 3)};
}

std::string stress_component(const Symmetry symmetry, const unsigned int k)
{
  constexpr unsigned int first[] = {0, 1, 2, 0, 0, 1}, second[] = {0, 1, 2, 1, 2, 2};
  const char            *letters = direction_letters(symmetry);
  return {letters[first[k]], letters[second[k]]};
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

#define ARENITE_INSTANTIATE(dim)                                                                                       \
  template std::unique_ptr<ReceiverFile<dim>> make_receiver_table<dim>(const std::string &,                            \
                                                                       const std::vector<std::string> &,               \
                                                                       const ReceiverQuantities &, Symmetry, MPI_Comm, \
                                                                       FileStart);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
