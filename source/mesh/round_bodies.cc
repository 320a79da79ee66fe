#include <arenite/mesh/round_bodies.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
enum SphereBoundary : types::boundary_id
{
  inner      = 0,
  outer      = 1,
  symmetry_x = 2 ///< followed by y and z
};

/// Boundary ids of a body between spheres around the origin and coordinate planes through it.
template <int dim>
void name_spheres_and_planes(Triangulation<dim> &triangulation, const double inner_radius)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        {
          types::boundary_id id = face->vertex(0).norm() < inner_radius * (1. + 1e-6) ? inner : outer;
          for (unsigned int d = 0; d < dim; ++d)
            {
              bool on_plane = true;
              for (unsigned int v = 0; v < face->n_vertices(); ++v)
                on_plane = on_plane && std::abs(face->vertex(v)[d]) < 1e-8 * cell->diameter();
              if (on_plane)
                id = symmetry_x + d;
            }
          face->set_boundary_id(id);
        }
}

/// Stack copies of a one-layer shell, each scaled to its own radii.
template <int dim>
void stack_layers(const Triangulation<dim> &layer, const std::vector<double> &radii, Triangulation<dim> &result)
{
  std::vector<Point<dim>>   directions, vertices;
  std::vector<unsigned int> direction_of(layer.n_vertices());
  const double              middle = 0.5 * (radii.front() + radii.back());
  for (unsigned int v = 0; v < layer.n_vertices(); ++v)
    {
      const Point<dim> direction = layer.get_vertices()[v] / layer.get_vertices()[v].norm();
      const auto       known     = std::find_if(directions.begin(), directions.end(),
                                                [&](const Point<dim> &d) { return d.distance(direction) < 1e-8; });
      direction_of[v]            = known - directions.begin();
      if (known == directions.end())
        directions.push_back(direction);
    }
  for (const double r : radii)
    for (const Point<dim> &direction : directions)
      vertices.push_back(r * direction);
  std::vector<CellData<dim>> cells;
  for (unsigned int k = 0; k + 1 < radii.size(); ++k)
    for (const auto &cell : layer.active_cell_iterators())
      {
        CellData<dim> data;
        for (const unsigned int v : cell->vertex_indices())
          data.vertices[v] =
            direction_of[cell->vertex_index(v)] + directions.size() * (k + (cell->vertex(v).norm() > middle ? 1 : 0));
        cells.push_back(data);
      }
  result.create_triangulation(vertices, cells, SubCellData());
}
} // namespace

template <int dim>
SphericalShell<dim>::SphericalShell()
{
  this->names = {"cavity", "outer", "symmetry x", "symmetry y", "symmetry z"};
}

template <int dim>
void SphericalShell<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_choice(
    "Sector", sector, {"octant", "half", "full"},
    "Part of the sphere that is modelled. The octant x, y, z > 0 gives the same answer for an eighth of the cost.");
  parameters.add_quantity("Inner radius", inner_radius, "m", positive, "Radius of the cavity.");
  parameters.add_quantity("Outer radius", outer_radius, "m", positive, "Radius of the boundary 'outer'.");
  parameters.add_integer("Radial layers", layers, 0, 1000,
                         "Coarse cells along the radius; 0 chooses cells about as long as wide.");
  parameters.add_choice("Radial spacing", spacing, {"geometric", "uniform"},
                        "Geometric spacing grades the cells towards the cavity.");
}

template <int dim>
void SphericalShell<dim>::finalize(const Parameters &parameters)
{
  if (outer_radius <= inner_radius)
    parameters.refuse(path + "/Outer radius", "must be larger than 'Inner radius'");
}

template <int dim>
double SphericalShell<dim>::symmetry_factor() const
{
  return sector == "octant" ? 8. : (sector == "half" ? 2. : 1.);
}

template <int dim>
void SphericalShell<dim>::create(Triangulation<dim> &triangulation) const
{
  Triangulation<dim> layer;
  if (sector == "octant")
    GridGenerator::quarter_hyper_shell(layer, Point<dim>(), inner_radius, outer_radius, 3);
  else if (sector == "half")
    GridGenerator::half_hyper_shell(layer, Point<dim>(), inner_radius, outer_radius);
  else
    GridGenerator::hyper_shell(layer, Point<dim>(), inner_radius, outer_radius, 6);
  // width over radius of a coarse cell: 45 degrees in the octant, 90 degrees in the other sectors
  const double opening = numbers::PI / (sector == "octant" ? 4. : 2.);
  const auto   automatic =
    static_cast<unsigned int>(std::max(1., std::round(std::log(outer_radius / inner_radius) / std::log(1. + opening))));
  const unsigned int  n = layers > 0 ? layers : automatic;
  std::vector<double> radii;
  for (unsigned int k = 0; k <= n; ++k)
    radii.push_back(k == n                 ? outer_radius
                    : spacing == "uniform" ? inner_radius + (outer_radius - inner_radius) * k / n
                                           : inner_radius * std::pow(outer_radius / inner_radius, double(k) / n));
  stack_layers(layer, radii, triangulation);
  name_spheres_and_planes(triangulation, inner_radius);
  triangulation.set_all_manifold_ids(0);
  triangulation.set_manifold(0, SphericalManifold<dim>());
}

template <int dim>
Ball<dim>::Ball()
{
  this->names = {"unused", "surface", "symmetry x", "symmetry y", "symmetry z"};
}

template <int dim>
void Ball<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_choice("Sector", sector, {"octant", "full"}, "Part of the ball that is modelled.");
  parameters.add_quantity("Radius", radius, "m", positive, "Radius of the boundary 'surface'.");
}

template <int dim>
void Ball<dim>::create(Triangulation<dim> &triangulation) const
{
  if (sector == "octant")
    GridGenerator::quarter_hyper_ball(triangulation, Point<dim>(), radius);
  else
    GridGenerator::hyper_ball(triangulation, Point<dim>(), radius);
  name_spheres_and_planes(triangulation, 0.);
  triangulation.reset_all_manifolds();
  triangulation.set_all_manifold_ids(1);
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() == outer)
        face->set_all_manifold_ids(0);
  triangulation.set_manifold(0, SphericalManifold<dim>());
  TransfiniteInterpolationManifold<dim> blending;
  blending.initialize(triangulation);
  triangulation.set_manifold(1, blending);
}

Cylinder::Cylinder() { names = {"lateral", "left end", "right end"}; }

void Cylinder::declare_parameters(Parameters &parameters)
{
  parameters.add_quantity("Radius", radius, "m", positive, "Radius of the boundary 'lateral'.");
  parameters.add_quantity("Length", length, "m", positive, "Length along x, from -length/2 to length/2.");
  parameters.add_integer("Cells along", cells_along, 1, 100000, "Coarse cells along x.");
}

void Cylinder::create(Triangulation<3> &triangulation) const
{
  GridGenerator::subdivided_cylinder(triangulation, cells_along, radius, 0.5 * length);
}

template class SphericalShell<3>;
template class Ball<3>;
} // namespace Arenite
