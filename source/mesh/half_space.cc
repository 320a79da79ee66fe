#include <arenite/mesh/half_space.h>

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
  cavity     = 0,
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
  const double end    = upwards ? depth : outer_distance;
  const double factor = upwards ? 1. : growth;
  // as many cells as fit, their lengths s, s g, s g^2 ... then stretched together to end at the boundary
  std::vector<double> lengths = {core()};
  double              sum     = core();
  while (core() + sum + 0.5 * lengths.back() * factor < end)
    {
      lengths.push_back(lengths.back() * factor);
      sum += lengths.back();
    }
  std::vector<double> result = {0., core()};
  for (const double length : lengths)
    result.push_back(result.back() + length * (end - core()) / sum);
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

template class HalfSpace<2>;
template class HalfSpace<3>;
} // namespace Arenite
