#include <arenite/mesh/cell_audit.h>
#include <arenite/mesh/imported_mesh.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Two different vertices closer than 1e-6 of the smallest cell: the parts would not be glued.
template <int dim>
std::string unglued_vertices(const Triangulation<dim> &mesh)
{
  const double              tolerance = 1e-6 * GridTools::minimal_cell_diameter(mesh);
  std::vector<unsigned int> order;
  for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
    if (mesh.vertex_used(v))
      order.push_back(v);
  const auto &x = mesh.get_vertices();
  std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) { return x[a][0] < x[b][0]; });
  for (unsigned int i = 0; i < order.size(); ++i)
    for (unsigned int j = i + 1; j < order.size() && x[order[j]][0] - x[order[i]][0] <= tolerance; ++j)
      if (x[order[i]].distance(x[order[j]]) <= tolerance)
        return "two nodes lie at " + place_text(x[order[i]]) + " without being the same: the parts there are not glued";
  return "";
}
} // namespace

template <int dim>
void ImportedMesh<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_text("File name", file, "Gmsh mesh (.msh), hexahedra only.");
  parameters.add_list("Boundary names", boundary_list,
                      "List of 'id: name' for the physical surfaces of the file; others are called 'boundary ID'.");
  parameters.add_quantity("Scale", scale, "-", positive, "Factor on all coordinates: 1e-3 for a file in millimetres.");
  parameters.require("File name");
}

template <int dim>
void ImportedMesh<dim>::finalize(const Parameters &parameters)
{
  const std::string entry = path + "/File name";
  std::ifstream     stream(file);
  if (!stream)
    parameters.refuse(entry, "the file cannot be read");

  // Gmsh element types 4 (tetrahedron), 6 (prism), 7 (pyramid) would end in a crash further down.
  GridIn<dim> reader;
  reader.attach_triangulation(mesh);
  try
    {
      reader.read_msh(stream);
    }
  catch (const ExceptionBase &)
    {
      parameters.refuse(
        entry,
        "deal.II cannot read it as a mesh of hexahedra; Arenite needs hexahedra only, in Gmsh format 2.2 or 4.1");
    }
  for (const auto &cell : mesh.active_cell_iterators())
    if (!cell->reference_cell().is_hyper_cube())
      parameters.refuse(entry, "contains cells that are not hexahedra (the first one around " +
                                 place_text(cell->center()) + "); Arenite needs hexahedra only");
  GridTools::scale(scale, mesh);
  for (const auto &cell : mesh.active_cell_iterators())
    {
      const std::string problem = corner_problem<dim>(cell);
      if (!problem.empty())
        parameters.refuse(entry, problem);
    }
  if (n_hoop_directions(this->symmetry) > 0)
    for (const Point<dim> &x : mesh.get_vertices())
      if (x[0] < 0.)
        parameters.refuse(entry, "has a node at " + place_text(x) + "; the first coordinate is the radius");
  const std::string problem = unglued_vertices(mesh);
  if (!problem.empty())
    parameters.refuse(entry, problem);

  // boundary id of the file -> consecutive id with a name
  std::map<types::boundary_id, std::string> wanted;
  for (const std::string &item : boundary_list)
    {
      const auto parts = Utilities::split_string_list(item, ':');
      int        id    = -1;
      try
        {
          id = Utilities::string_to_int(parts.front());
        }
      catch (const ExceptionBase &)
        {}
      if (parts.size() != 2 || id < 0 || parts[1].empty())
        parameters.refuse(path + "/Boundary names", "'" + item + "' must have the form 'id: name'");
      wanted[id] = parts[1];
    }
  std::map<types::boundary_id, types::boundary_id> renumbered;
  for (const auto id : mesh.get_boundary_ids())
    {
      renumbered[id] = this->names.size();
      this->names.push_back(wanted.count(id) ? wanted[id] : "boundary " + std::to_string(id));
      wanted.erase(id);
    }
  if (!wanted.empty())
    parameters.refuse(path + "/Boundary names", "the file has no surface with id " +
                                                  std::to_string(wanted.begin()->first) +
                                                  "; it has: " + join(this->names));
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(renumbered.at(face->boundary_id()));
}

template <int dim>
void ImportedMesh<dim>::create(Triangulation<dim> &triangulation) const
{
  triangulation.copy_triangulation(mesh);
}

template class ImportedMesh<2>;
template class ImportedMesh<3>;
} // namespace Arenite
