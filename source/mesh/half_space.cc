#include <arenite/mesh/half_space.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace Arenite
{
using namespace dealii;

namespace
{
enum HalfSpaceBoundary : types::boundary_id
{
  cavity     = 0, ///< or the load
  surface    = 1,
  outer      = 2,
  symmetry_x = 3 ///< followed by y
};

/// Vertices that are found again by their place, and the cells between them.
template <int dim>
struct CoarseMesh
{
  std::vector<Point<dim>>    vertices;
  std::vector<CellData<dim>> cells;
  double                     snap; ///< places nearer than this are one [m]

  /// Cell with the corners in the order of deal.II.
  void add(const std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> &corners,
           const types::manifold_id                                            manifold)
  {
    CellData<dim> cell;
    for (unsigned int v = 0; v < corners.size(); ++v)
      cell.vertices[v] = index_of(corners[v]);
    cell.manifold_id = manifold;
    cells.push_back(cell);
  }

private:
  std::map<std::array<long, dim>, unsigned int> known;

  unsigned int index_of(const Point<dim> &x)
  {
    std::array<long, dim> key;
    for (unsigned int d = 0; d < dim; ++d)
      key[d] = std::lround(x[d] / snap);
    const auto [entry, is_new] = known.emplace(key, vertices.size());
    if (is_new)
      vertices.push_back(x);
    return entry->second;
  }
};

constexpr types::manifold_id sphere = 0, blended = 1;

/// Lengths of cells that fill @p distance: about first, first g, first g^2 ..., as many as fit, then stretched together.
std::vector<double> graded_lengths(const double first, const double distance, const double growth)
{
  std::vector<double> lengths = {first};
  double              sum     = first;
  while (sum + 0.5 * lengths.back() * growth < distance)
    {
      lengths.push_back(lengths.back() * growth);
      sum += lengths.back();
    }
  for (double &length : lengths)
    length *= distance / sum;
  return lengths;
}
} // namespace

template <int dim>
HalfSpace<dim>::HalfSpace()
{
  this->names = {"cavity", "surface", "outer", "symmetry x"};
  if (dim == 3)
    this->names.push_back("symmetry y");
}

template <int dim>
void HalfSpace<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity("Cavity radius", radius, "m", positive, "Radius of the boundary 'cavity' around the origin.");
  parameters.add_quantity("Depth", depth, "m", positive, "Of the cavity's centre below the boundary 'surface'.");
  parameters.add_quantity(
    "Outer distance", outer_distance, "m", positive,
    "From the centre to the boundary 'outer', at the sides and below. Larger: later reflections.");
  parameters.add_quantity("Growth", growth, "-", {1., 2., false, false},
                          "Ratio of the lengths of coarse cells from the cavity outwards; 1 keeps them equal.");
}

template <int dim>
void HalfSpace<dim>::finalize(const Parameters &parameters)
{
  if (depth < 1.2 * radius)
    parameters.refuse(path + "/Depth", "must be at least 1.2 times 'Cavity radius'");
  if (outer_distance < 1.5 * core())
    parameters.refuse(path + "/Outer distance",
                      "must be at least " + std::to_string(1.5 * core()) + " m, beyond the cells around the cavity");
}

template <int dim>
double HalfSpace<dim>::symmetry_factor() const
{
  return dim == 3 ? 4. : 1.;
}

template <int dim>
double HalfSpace<dim>::core() const
{
  return std::min(2. * radius, 0.5 * (radius + depth));
}

template <int dim>
std::vector<double> HalfSpace<dim>::lines(const bool upwards) const
{
  const double        end    = upwards ? depth : outer_distance;
  const double        factor = upwards ? 1. : growth;
  std::vector<double> result = {0., core()};
  for (const double length : graded_lengths(core(), end - core(), upwards ? 1. : growth))
    result.push_back(result.back() + length);
  return result;
}

template <int dim>
void HalfSpace<dim>::create(Triangulation<dim> &triangulation) const
{
  const double    s = core();
  CoarseMesh<dim> mesh;
  mesh.snap = 1e-6 * radius;

  // core: over each face of the cube [0, s]^dim and of its image below, one cell between sphere and face
  for (const double up : {1., -1.})
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> corners;
        // the last local coordinate points outwards; the others along the axes, swapped where the cell would be left-handed
        const bool   swap    = (d == dim - 1 && up < 0.) != (dim == 2 ? d == 0 : d == 1);
        unsigned int axes[2] = {dim, dim}, n = 0;
        for (unsigned int e = 0; e < dim; ++e)
          if (e != d)
            axes[n++] = e;
        for (unsigned int v = 0; v < corners.size(); ++v)
          {
            unsigned int bits[3] = {v & 1, (v >> 1) & 1, (v >> 2) & 1}; // of the local directions
            if (swap)
              std::swap(bits[0], bits[1]);
            // edges follow the positive axes, on both sides of z = 0, so that neighbours agree
            Point<dim> x;
            x[d] = d == dim - 1 ? up * s : s;
            for (unsigned int e = 0; e + 1 < dim; ++e)
              x[axes[e]] = axes[e] == dim - 1 && up < 0. ? (bits[e] - 1.) * s : bits[e] * s;
            corners[v] = bits[dim - 1] == 0 ? Point<dim>(x * (radius / x.norm())) : x;
          }
        mesh.add(corners, blended);
      }

  // bricks around it
  std::vector<double> sideways = lines(false), vertical;
  for (const double x : sideways)
    vertical.insert(vertical.begin(), -x);
  const std::vector<double> above = lines(true);
  vertical.insert(vertical.end(), above.begin() + 1, above.end());
  std::array<std::vector<double>, dim> axis;
  axis.fill(sideways);
  axis[dim - 1] = vertical;
  std::array<std::size_t, dim> at{};
  while (at[dim - 1] + 1 < vertical.size())
    {
      bool in_core = true;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double middle = 0.5 * (axis[d][at[d]] + axis[d][at[d] + 1]);
          in_core             = in_core && std::abs(middle) < s;
        }
      if (!in_core)
        {
          std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> corners;
          for (unsigned int v = 0; v < corners.size(); ++v)
            for (unsigned int d = 0; d < dim; ++d)
              corners[v][d] = axis[d][at[d] + ((v >> d) & 1)];
          mesh.add(corners, numbers::flat_manifold_id);
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          if (++at[d] + 1 < axis[d].size() || d == dim - 1)
            break;
          at[d] = 0;
        }
    }
  triangulation.create_triangulation(mesh.vertices, mesh.cells, SubCellData());

  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->manifold_id() == blended)
      cell->set_all_manifold_ids(blended);
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      {
        if (cell->manifold_id() == numbers::flat_manifold_id)
          face->set_all_manifold_ids(numbers::flat_manifold_id);
        if (!face->at_boundary())
          continue;
        const Point<dim>   x  = face->center();
        types::boundary_id id = outer;
        if (face->vertex(0).norm() < radius * (1. + 1e-6))
          {
            id = cavity;
            for (unsigned int v = 0; v < face->n_vertices(); ++v)
              if (face->vertex(v).norm() > radius * (1. + 1e-6))
                id = outer;
          }
        if (std::abs(x[dim - 1] - depth) < 1e-6 * radius)
          id = surface;
        for (unsigned int d = 0; d + 1 < dim; ++d)
          if (std::abs(x[d]) < 1e-6 * radius)
            id = symmetry_x + d;
        face->set_boundary_id(id);
      }
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == cavity)
        face->set_all_manifold_ids(sphere);
  triangulation.set_manifold(sphere, SphericalManifold<dim>());
  TransfiniteInterpolationManifold<dim> blending;
  blending.initialize(triangulation);
  triangulation.set_manifold(blended, blending);
}

void LoadedHalfSpace::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity("Load radius", radius, "m", positive,
                          "Radius of the boundary 'load' around the origin; half its width in plane strain.");
  parameters.add_integer("Cells across load", across, 1, 10000,
                         "Coarse cells from the origin to the edge of the load.");
  parameters.add_quantity("Outer distance", outer_distance, "m", positive,
                          "From the origin to the boundary 'outer', at the side and below.");
  parameters.add_quantity("Growth", growth, "-", {1., 2., false, false},
                          "Ratio of the lengths of coarse cells from the load outwards; 1 keeps them equal.");
}

void LoadedHalfSpace::finalize(const Parameters &parameters)
{
  if (outer_distance < 2. * radius)
    parameters.refuse(path + "/Outer distance", "must be at least twice 'Load radius'");
  if (n_hoop_directions(symmetry) == 0 && symmetry != Symmetry::plane_strain)
    parameters.refuse("Symmetry", "must be 'axisymmetric' or 'plane strain' for this mesh");
}

void LoadedHalfSpace::create(Triangulation<2> &triangulation) const
{
  std::vector<double> outwards(across, radius / across);
  for (const double length : graded_lengths(outwards.back(), outer_distance - radius, growth))
    outwards.push_back(length);
  const std::vector<double> upwards(outwards.rbegin(), outwards.rend());
  GridGenerator::subdivided_hyper_rectangle(triangulation, {outwards, upwards}, Point<2>(0., -outer_distance),
                                            Point<2>(outer_distance, 0.));
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        {
          const Point<2> x      = face->center();
          const double   nearly = 1e-6 * outwards.front();
          face->set_boundary_id(outer);
          if (std::abs(x[1]) < nearly)
            face->set_boundary_id(x[0] < radius ? cavity : surface);
          else if (x[0] < nearly)
            face->set_boundary_id(symmetry_x);
        }
}

template class HalfSpace<2>;
template class HalfSpace<3>;
} // namespace Arenite
