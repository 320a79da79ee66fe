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

/// Boundary ids of a body between spheres around the origin and coordinate planes through it. Coordinate d of the mesh belongs to
/// symmetry plane x, y or z of the body: the second of a meridian plane to z.
template <int dim>
void name_spheres_and_planes(Triangulation<dim> &triangulation, const double inner_radius, const Symmetry symmetry)
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
                id = symmetry_x + (symmetry == Symmetry::axisymmetric && d == 1 ? 2 : d);
            }
          face->set_boundary_id(id);
        }
}

/// Parts of the full body that the sector leaves out, for an axis- or point-symmetric section as for the body itself.
double copies(const std::string &sector, const Symmetry symmetry)
{
  switch (symmetry)
    {
    case Symmetry::none:
      return sector == "octant" ? 8. : (sector == "half" ? 2. : 1.);
    case Symmetry::plane_strain:
      return sector == "octant" ? 4. : (sector == "half" ? 2. : 1.);
    case Symmetry::axisymmetric:
      return sector == "octant" ? 2. : 1.;
    default:
      return 1.;
    }
}

/// A body between spheres looks the same from all sides, whichever sector or section of it the planes bound.
bool admits_sphere(Reduction &form, const Symmetry symmetry)
{
  form.cut = {symmetry_x, symmetry_x + 1, symmetry_x + 2};
  return n_hoop_directions(form.form) > 0 && symmetry != Symmetry::plane_strain;
}

/// One layer of cells of a sector of a shell; in the meridian plane the half ring is all.
template <int dim>
void make_shell(Triangulation<dim> &layer, const std::string &sector, const Symmetry symmetry,
                const double inner_radius, const double outer_radius)
{
  if constexpr (dim == 1)
    {
      GridGenerator::hyper_cube(layer, inner_radius, outer_radius);
      return (void)sector, (void)symmetry;
    }
  else
    {
      if (sector == "octant")
        GridGenerator::quarter_hyper_shell(layer, Point<dim>(), inner_radius, outer_radius, dim == 3 ? 3 : 2);
      else if (sector == "half" || symmetry == Symmetry::axisymmetric)
        GridGenerator::half_hyper_shell(layer, Point<dim>(), inner_radius, outer_radius, dim == 3 ? 0 : 4);
      else
        GridGenerator::hyper_shell(layer, Point<dim>(), inner_radius, outer_radius, dim == 3 ? 6 : 8);
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
  parameters.add_choice("Sector", sector, {"octant", "half", "full"},
                        "Part of the sphere that is modelled. The octant x, y, z > 0 gives the same answer for an "
                        "eighth of the cost. In fewer "
                        "dimensions the section of that part.");
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
  return copies(sector, this->symmetry);
}

template <int dim>
bool SphericalShell<dim>::admits(Reduction &form, const Parameters &) const
{
  return admits_sphere(form, this->symmetry);
}

template <int dim>
void SphericalShell<dim>::create(Triangulation<dim> &triangulation) const
{
  Triangulation<dim> layer;
  make_shell(layer, sector, this->symmetry, inner_radius, outer_radius);
  // width over radius of a coarse cell: 45 degrees in the octant and in fewer dimensions, 90 degrees in the other sectors
  const double opening = numbers::PI / (sector == "octant" || dim < 3 ? 4. : 2.);
  const auto   automatic =
    static_cast<unsigned int>(std::max(1., std::round(std::log(outer_radius / inner_radius) / std::log(1. + opening))));
  const unsigned int  n = layers > 0 ? layers : automatic;
  std::vector<double> radii;
  for (unsigned int k = 0; k <= n; ++k)
    radii.push_back(k == n                 ? outer_radius
                    : spacing == "uniform" ? inner_radius + (outer_radius - inner_radius) * k / n
                                           : inner_radius * std::pow(outer_radius / inner_radius, double(k) / n));
  stack_layers(layer, radii, triangulation);
  name_spheres_and_planes(triangulation, inner_radius, this->symmetry);
  if constexpr (dim > 1)
    {
      triangulation.set_all_manifold_ids(0);
      triangulation.set_manifold(0, SphericalManifold<dim>());
    }
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
double Ball<dim>::symmetry_factor() const
{
  return copies(sector, this->symmetry);
}

template <int dim>
bool Ball<dim>::admits(Reduction &form, const Parameters &) const
{
  return admits_sphere(form, this->symmetry);
}

template <int dim>
void Ball<dim>::create(Triangulation<dim> &triangulation) const
{
  if constexpr (dim == 1)
    {
      GridGenerator::hyper_cube(triangulation, 0., radius);
      triangulation.begin_active()->face(0)->set_boundary_id(symmetry_x);
      triangulation.begin_active()->face(1)->set_boundary_id(outer);
    }
  else
    {
      if (sector == "octant")
        GridGenerator::quarter_hyper_ball(triangulation, Point<dim>(), radius);
      else if (this->symmetry == Symmetry::axisymmetric)
        GridGenerator::half_hyper_ball(triangulation, Point<dim>(), radius);
      else
        GridGenerator::hyper_ball(triangulation, Point<dim>(), radius);
      name_spheres_and_planes(triangulation, 0., this->symmetry);
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

template class SphericalShell<1>;
template class SphericalShell<2>;
template class SphericalShell<3>;
template class Ball<1>;
template class Ball<2>;
template class Ball<3>;
} // namespace Arenite
