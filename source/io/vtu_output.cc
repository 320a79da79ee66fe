#include <arenite/base/state_archive.h>
#include <arenite/io/files.h>
#include <arenite/io/receiver_file.h>
#include <arenite/io/vtu_output.h>
#include <arenite/mechanics/nodal_stress.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <ostream>
#include <system_error>
#include <tuple>

namespace Arenite
{
using namespace dealii;

namespace
{
using Interpretation = DataComponentInterpretation::DataComponentInterpretation;

/// The cells as deal.II's writers want them, filled directly from nodes: no finite element or mapping stands between the
/// polynomial that the step computes with and the one that is shown.
template <int dim>
class CellPatches : public DataOutInterface<dim>
{
public:
  std::vector<DataOutBase::Patch<dim>> patches;

  /// Append a field of @p n_components; returns the row of its first component in the data of a patch.
  unsigned int add(const std::string &name, const std::string &unit, const Interpretation meaning,
                   const unsigned int n_components)
  {
    const unsigned int first = n_rows();
    names.insert(names.end(), n_components, name);
    if (n_components > 1)
      ranges.emplace_back(first, first + n_components - 1, name, meaning);
    if (!unit.empty())
      units[name] = unit;
    return first;
  }
  unsigned int n_rows() const { return static_cast<unsigned int>(names.size()); }

  std::map<std::string, std::string> units;

protected:
  const std::vector<DataOutBase::Patch<dim>> &get_patches() const override { return patches; }
  std::vector<std::string>                    get_dataset_names() const override { return names; }
  std::vector<std::tuple<unsigned int, unsigned int, std::string, Interpretation>> get_nonscalar_data_ranges()
    const override
  {
    return ranges;
  }

private:
  std::vector<std::string>                                                         names;
  std::vector<std::tuple<unsigned int, unsigned int, std::string, Interpretation>> ranges;
};

/// Values of the Gauss-Lobatto polynomials at s + 1 points of equal distance in one direction, [point][node].
FullMatrix<double> interpolation_matrix(const unsigned int degree, const unsigned int s)
{
  const auto         basis = Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
  FullMatrix<double> matrix(s + 1, degree + 1);
  for (unsigned int i = 0; i <= s; ++i)
    for (unsigned int j = 0; j <= degree; ++j)
      matrix(i, j) = basis[j].value(static_cast<double>(i) / s);
  return matrix;
}

/// Nodal values of one cell -> values at the (s + 1)^dim output points, direction by direction, both lexicographic.
template <int dim>
void interpolate(const FullMatrix<double> &matrix, std::vector<double> &values, std::vector<double> &scratch)
{
  unsigned int before = 1, after = Utilities::pow(matrix.n(), dim - 1);
  for (unsigned int d = 0; d < dim; ++d)
    {
      scratch.assign(before * matrix.m() * after, 0.);
      for (unsigned int a = 0; a < after; ++a)
        for (unsigned int i = 0; i < matrix.m(); ++i)
          for (unsigned int j = 0; j < matrix.n(); ++j)
            for (unsigned int b = 0; b < before; ++b)
              scratch[b + before * (i + matrix.m() * a)] += matrix(i, j) * values[b + before * (j + matrix.n() * a)];
      values.swap(scratch);
      before *= matrix.m();
      after /= matrix.n();
    }
}
} // namespace

template <int dim>
void VTUOutput<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Output");
  parameters.add_quantity(
    "VTU interval", interval, "s", non_negative,
    "Simulated time between two pictures for ParaView or VisIt; the first and the last state are always "
    "among them. 0 writes none.");
  parameters.add_integer(
    "Subdivisions", subdivisions, 0, 10,
    "Parts of a cell's edge in the pictures; 0 takes the degree of the element, which shows its polynomial "
    "exactly. 1 writes straight cells, for small files and for programs without high-order cells.");
}

template <int dim>
void VTUOutput<dim>::finalize(const Parameters &)
{}

template <int dim>
bool VTUOutput<dim>::is_due(const double time, const double dt) const
{
  return enabled() && time + 0.5 * dt > next_time;
}

template <int dim>
unsigned int VTUOutput<dim>::expected_pictures(const double end_time) const
{
  return enabled() ? 1 + static_cast<unsigned int>(std::ceil(end_time / interval * (1. - 1e-12))) : 0;
}

template <int dim>
double VTUOutput<dim>::expected_bytes(const Discretization<dim> &discretization) const
{
  // per point: three coordinates, the fields, and its number in a cell, four bytes each
  const double points =
    std::pow(parts(discretization) + 1., dim) * discretization.triangulation.n_global_active_cells();
  return 4. * points * (3. + n_field_rows + 1.);
}

template <int dim>
void VTUOutput<dim>::write(const OutputDirectory &directory, const Discretization<dim> &discretization,
                           const VectorType &displacement, const VectorType &velocity,
                           const std::vector<LinearElastic> &materials, const double time, const unsigned int step,
                           const std::map<std::string, Vector<float>> &cell_fields, const StoredFields<dim> &stored)
{
  const MPI_Comm         communicator = discretization.communicator;
  const unsigned int     rank         = Utilities::MPI::this_mpi_process(communicator);
  const unsigned int     n_ranks      = Utilities::MPI::n_mpi_processes(communicator);
  const unsigned int     s            = parts(discretization);
  constexpr unsigned int n_stress     = n_stress_components(dim);

  CellPatches<dim>   out;
  const auto         scalar     = DataComponentInterpretation::component_is_scalar;
  const auto         vector     = DataComponentInterpretation::component_is_part_of_vector;
  const unsigned int u_row      = out.add("displacement", "m", vector, dim);
  const unsigned int v_row      = out.add("velocity", "m/s", vector, dim);
  const unsigned int stress_row = out.add("stress", "Pa", DataComponentInterpretation::component_is_part_of_tensor, 9);
  const unsigned int pressure_row = out.add("pressure", "Pa", scalar, 1);
  const unsigned int mises_row    = out.add("von_mises_stress", "Pa", scalar, 1);
  const unsigned int cell_row     = out.add("material", "", scalar, 1);
  out.add("refinement_level", "", scalar, 1);
  out.add("subdomain", "", scalar, 1);
  AssertDimension(out.n_rows(), n_field_rows);
  for (const auto &field : cell_fields)
    out.add(field.first, "", scalar, 1);
  const unsigned int stored_row = out.n_rows();
  for (const std::string &name : stored.names)
    {
      auto [plain, unit] = name_and_unit(name);
      std::replace(plain.begin(), plain.end(), ' ', '_');
      out.add(plain, unit, scalar, 1);
    }
  const unsigned int x_row = out.n_rows();

  std::vector<VectorType>  others;
  const NodalStress<dim>   stresses = nodal_stress(discretization, displacement, materials, stored, &others);
  const FullMatrix<double> matrix   = interpolation_matrix(discretization.degree(), s);
  const unsigned int       n_nodes  = discretization.nodes_per_cell();
  const unsigned int       n_points = Utilities::pow(s + 1, dim);

  std::vector<double>                       values, scratch;
  std::array<std::vector<double>, n_stress> stress_values;
  out.patches.resize(discretization.cells().size());
  for (unsigned int cell = 0; cell < out.patches.size(); ++cell)
    {
      const auto         &iterator = discretization.cells()[cell];
      const unsigned int *nodes    = discretization.cell_nodes(cell);
      auto               &patch    = out.patches[cell];
      patch.patch_index            = cell;
      patch.reference_cell         = ReferenceCells::get_hypercube<dim>();
      patch.n_subdivisions         = s;
      patch.points_are_available   = true; // the last dim rows are positions
      patch.data.reinit(TableIndices<2>(x_row + dim, n_points));

      const auto evaluate = [&](const VectorType &field, const unsigned int n_components,
                                const unsigned int component) {
        values.resize(n_nodes);
        for (unsigned int n = 0; n < n_nodes; ++n)
          values[n] = field.local_element(n_components * nodes[n] + component);
        interpolate<dim>(matrix, values, scratch);
      };
      const auto store = [&](const unsigned int row, const VectorType &field) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            evaluate(field, dim, c);
            for (unsigned int q = 0; q < n_points; ++q)
              patch.data(row + c, q) = static_cast<float>(values[q]);
          }
      };
      store(u_row, displacement);
      store(v_row, velocity);
      store(x_row, discretization.positions);

      for (unsigned int k = 0; k < others.size(); ++k)
        {
          evaluate(others[k], 1, 0);
          for (unsigned int q = 0; q < n_points; ++q)
            patch.data(stored_row + k, q) = static_cast<float>(values[q]);
        }
      for (unsigned int k = 0; k < n_stress; ++k)
        {
          evaluate(stresses[k], 1, 0);
          stress_values[k] = values;
        }
      for (unsigned int q = 0; q < n_points; ++q)
        {
          SymmetricTensor<2, 3> stress;
          for (unsigned int k = 0; k < n_stress; ++k)
            stress.access_raw_entry(k) = stress_values[k][q];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              patch.data(stress_row + 3 * i + j, q) = static_cast<float>(stress[i][j]);
          patch.data(pressure_row, q) = static_cast<float>(pressure(stress));
          patch.data(mises_row, q)    = static_cast<float>(von_mises_stress(stress));

          unsigned int row     = cell_row;
          patch.data(row++, q) = static_cast<float>(iterator->material_id());
          patch.data(row++, q) = static_cast<float>(iterator->level());
          patch.data(row++, q) = static_cast<float>(rank);
          for (const auto &field : cell_fields)
            patch.data(row++, q) = field.second(iterator->active_cell_index());
        }
      // the writer takes corners from the positions above; these serve other formats
      for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
        patch.vertices[v] = iterator->vertex(v);
    }
  out.set_flags(DataOutBase::VtkFlags(time, step, /*print_date_and_time=*/false, DataOutBase::VtkFlags::best_speed,
                                      /*write_higher_order_cells=*/s > 1, out.units));

  // every process writes its piece, process 0 the records when all pieces are complete
  Picture           picture{time, "", {}};
  const std::string name   = "step-" + Utilities::int_to_string(step, 6);
  const unsigned    digits = Utilities::needed_digits(n_ranks);
  for (unsigned int r = 0; r < n_ranks; ++r)
    picture.pieces.push_back(name + "." + Utilities::int_to_string(r, digits) + ".vtu");
  picture.record = "solution/" + name + ".pvtu";

  std::string problem;
  if (rank == 0)
    {
      std::error_code error;
      std::filesystem::create_directories(directory.file("solution"), error);
      if (error)
        problem = directory.file("solution") + ": cannot be created: " + error.message() + ".";
    }
  agree_on_output(problem, communicator);
  problem =
    create_file(directory.file("solution/" + picture.pieces[rank]), [&](std::ostream &file) { out.write_vtu(file); });
  agree_on_output(problem, communicator);

  if (rank == 0)
    problem = replace_file(directory.file(picture.record),
                           [&](std::ostream &file) { out.write_pvtu_record(file, picture.pieces); });
  for (std::string &piece : picture.pieces)
    piece = "solution/" + piece;
  if (!pictures.empty() && pictures.back().record == picture.record)
    pictures.pop_back();
  pictures.push_back(picture);
  if (rank == 0 && problem.empty())
    problem = replace_file(directory.file("solution.pvd"), [&](std::ostream &file) {
      std::vector<std::pair<double, std::string>> times_and_names;
      for (const Picture &p : pictures)
        times_and_names.emplace_back(p.time, p.record);
      file.precision(12); // more pictures than six digits can tell apart
      DataOutBase::write_pvd_record(file, times_and_names);
    });
  if (rank == 0 && problem.empty())
    problem = replace_file(directory.file("solution.visit"), [&](std::ostream &file) {
      std::vector<std::pair<double, std::vector<std::string>>> times_and_pieces;
      for (const Picture &p : pictures)
        times_and_pieces.emplace_back(p.time, p.pieces);
      DataOutBase::write_visit_record(file, times_and_pieces);
    });
  agree_on_output(problem, communicator);

  if (enabled())
    next_time = interval * (std::floor(time / interval + 0.5) + 1.);
}

template <int dim>
void VTUOutput<dim>::exchange(StateArchive &archive)
{
  archive.common(next_time);
  std::size_t n = pictures.size();
  archive.common(n);
  pictures.resize(n);
  for (Picture &picture : pictures)
    {
      archive.common(picture.time);
      archive.common(picture.record);
      archive.common(picture.pieces);
    }
}

template class VTUOutput<1>;
template class VTUOutput<2>;
template class VTUOutput<3>;
} // namespace Arenite
