#include <arenite/mesh/box.h>
#include <arenite/mesh/geometry.h>
#include <arenite/mesh/half_space.h>
#include <arenite/mesh/imported_mesh.h>
#include <arenite/mesh/round_bodies.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>

namespace Arenite
{
using namespace dealii;

template <int dim>
std::vector<types::boundary_id> Geometry<dim>::boundary_ids(const Parameters &parameters, const std::string &path,
                                                            const std::vector<std::string> &list) const
{
  std::vector<types::boundary_id> ids;
  for (const std::string &name : list)
    {
      const auto position = std::find(names.begin(), names.end(), name);
      if (position == names.end())
        parameters.refuse(path, "'" + name + "' is not a boundary of this mesh." + suggestion(name, names));
      const auto id = static_cast<types::boundary_id>(position - names.begin());
      if (std::find(ids.begin(), ids.end(), id) == ids.end())
        ids.push_back(id);
    }
  return ids;
}

namespace
{
/// Prismatic bar along x with its own boundary names.
class Bar : public Geometry<3>
{
public:
  Bar() { names = {"near end", "far end", "sides"}; }

  void declare_parameters(Parameters &parameters) override
  {
    parameters.add_quantity("Length", length, "m", positive, "Length along x, from x = 0.");
    parameters.add_quantity("Width", width, "m", positive, "Width along y and z.");
    parameters.add_integer("Cells along", along, 1, 1000000, "Coarse cells along x.");
    parameters.add_integer("Cells across", across, 1, 10000, "Coarse cells along y and z.");
  }

  void create(Triangulation<3> &triangulation) const override
  {
    GridGenerator::subdivided_hyper_rectangle(triangulation, {along, across, across}, Point<3>(),
                                              Point<3>(length, width, width), true);
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        cell->set_material_id(0);
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() > 2)
            face->set_boundary_id(2);
      }
  }

private:
  double       length = 1., width = 0.1;
  unsigned int along = 10, across = 1;
};

template <int dim>
Registry<Geometry<dim>> make_geometries()
{
  Registry<Geometry<dim>> registry("mesh type");
  registry.template add<SphericalShell<dim>>(
    "spherical shell", "Octant, half or full shell around a spherical cavity, graded towards it.");
  registry.template add<Ball<dim>>("ball", "Octant or full solid ball.");
  registry.template add<Box<dim>>("box",
                                  "Box, rectangle or segment along the axes, in layers of material, mapped if wanted.");
  if constexpr (dim == 3)
    {
      registry.template add<Bar>("bar", "Prismatic bar along x; three dimensions only.");
      registry.template add<Cylinder>("cylinder", "Solid circular cylinder along x; three dimensions only.");
    }
  if constexpr (dim > 1)
    {
      registry.template add<HalfSpace<dim>>(
        "half-space",
        "Spherical cavity below a free surface: quarter of the body, or its meridian plane. Not in one dimension.");
      if constexpr (dim == 2)
        registry.template add<LoadedHalfSpace>(
          "loaded half-space", "Rectangles below a free surface with a loaded disc or strip; two dimensions only.");
      registry.template add<ImportedMesh<dim>>("file", "Hexahedra (quadrilaterals) from a Gmsh file, audited.");
    }
  return registry;
}
} // namespace

template <int dim>
const Registry<Geometry<dim>> &geometries()
{
  static const Registry<Geometry<dim>> registry = make_geometries<dim>();
  return registry;
}

template <int dim>
MeshChoice<dim>::MeshChoice(const Parameters &parameters)
  : type(parameters.peek_choice("Mesh/Type", "spherical shell", geometries<dim>().names()))
  , geometry(geometries<dim>().make(type))
{
  geometry->symmetry = DimensionChoice(parameters).symmetry;
}

template <int dim>
void MeshChoice<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Mesh");
  parameters.add_choice("Type", type, geometries<dim>().names(), "Geometry of the body; its own entries follow.");
  parameters.add_integer("Refinement", refinement, 0, 12,
                         "Global refinements of the coarse mesh: each halves the cells and costs 16 times the work in "
                         "3-D, 8 in 2-D, 4 in 1-D.");
  parameters.add_flag(
    "Refine geometry", refine_geometry,
    "Put nodes of adaptively refined cells on the exact surfaces instead of keeping the shape of their parents. "
    "Mass and fields are then transferred only approximately.");
  geometry->declare_parameters(parameters);
}

template <int dim>
void MeshChoice<dim>::finalize(const Parameters &parameters)
{
  geometry->finalize(parameters);
}

template class Geometry<1>;
template class Geometry<2>;
template class Geometry<3>;
template struct MeshChoice<1>;
template struct MeshChoice<2>;
template struct MeshChoice<3>;
template const Registry<Geometry<1>> &geometries<1>();
template const Registry<Geometry<2>> &geometries<2>();
template const Registry<Geometry<3>> &geometries<3>();
} // namespace Arenite
