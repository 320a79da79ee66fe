#include <arenite/base/values.h>
#include <arenite/mesh/box.h>
#include <arenite/mesh/cell_audit.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
Box<dim>::Box()
{
  for (const std::string axis : {"x", "y", "z"})
    {
      if (this->names.size() == 2 * dim)
        break;
      this->names.push_back(axis + " min");
      this->names.push_back(axis + " max");
    }
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] = 1.;
  cells.assign(dim, "1");
}

template <int dim>
void Box<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_vector("Lower corner", lower, "m", "Corner with the smallest coordinates.");
  parameters.add_vector("Upper corner", upper, "m", "Corner with the largest coordinates.");
  parameters.add_list("Cells", cells, "Coarse cells along x, y, z.");
  parameters.add_list("Layers", layer_words,
                      "Ascending x [m] where the material id of the cells rises by one: cells below the first have the "
                      "id 0. Must lie on faces of the coarse cells, before 'Distortion' and 'Map'. Empty: all cells "
                      "have the id 0.");
  parameters.add_quantity(
    "Distortion", distortion, "-", {0., 0.4, false, false},
    "Moves the coarse vertices by up to this part of a cell, for tests of accuracy; 0 keeps bricks.");
  parameters.add_text("Map", map_text,
                      "New place [m] of each coarse vertex: " + place_formula_rules<dim>() +
                        ". Refinement divides the straight cells between the mapped vertices; boundaries keep their "
                        "names. Empty: none. Example of a graded mesh: " +
                        (dim == 1   ? "0.1*20^x"
                         : dim == 2 ? "0.1*20^x; y"
                                    : "0.1*20^x; y; z"));
  path = parameters.current_path();
}

template <int dim>
void Box<dim>::finalize(const Parameters &parameters)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (upper[d] <= lower[d])
      parameters.refuse(path + "/Upper corner", "every coordinate must be larger than that of 'Lower corner'");
  if (n_hoop_directions(this->symmetry) > 0 && lower[0] < 0.)
    parameters.refuse(path + "/Lower corner", "the first coordinate is the radius and must not be negative");
  if (cells.size() != dim)
    parameters.refuse(path + "/Cells", "needs " + std::to_string(dim) + " numbers");
  for (const std::string &n : cells)
    {
      const bool digits = !n.empty() && n.size() <= 6 &&
                          std::all_of(n.begin(), n.end(), [](const char c) { return c >= '0' && c <= '9'; });
      if (!digits || std::stoi(n) < 1)
        parameters.refuse(path + "/Cells", "'" + n + "' is not a positive number of cells");
      repetitions.push_back(std::stoi(n));
    }
  read_layers(parameters);
  read_map(parameters);
}

template <int dim>
void Box<dim>::read_layers(const Parameters &parameters)
{
  const std::string entry = path + "/Layers";
  const double      h     = (upper[0] - lower[0]) / repetitions[0];
  for (const std::string &word : layer_words)
    {
      if (const std::string complaint = complaint_about_number(word, "m"); !complaint.empty())
        parameters.refuse(entry, "'" + word + "' " + complaint);
      const double x = Utilities::string_to_double(word);
      if (!(x > lower[0] && x < upper[0]))
        parameters.refuse(entry, word + " is not between " + to_text(lower[0]) + " and " + to_text(upper[0]) +
                                   ", the ends of the box");
      if (!layers.empty() && x <= layers.back())
        parameters.refuse(entry, "must ascend, but " + word + " follows " + to_text(layers.back()));
      const double face = lower[0] + std::round((x - lower[0]) / h) * h;
      if (std::abs(x - face) > 1e-6 * h)
        parameters.refuse(entry, word + " is not on a face of the coarse cells; the nearest is at " + to_text(face));
      layers.push_back(x);
    }
  if (layers.size() > 254)
    parameters.refuse(entry, "gives more than the 255 materials that a mesh may have");
}

template <int dim>
void Box<dim>::read_map(const Parameters &parameters)
{
  if (map_text.empty())
    return;
  const std::string entry = path + "/Map";
  if (const std::string complaint = map.read(map_text); !complaint.empty())
    parameters.refuse(entry, complaint);
  Triangulation<dim> mesh;
  create(mesh);
  for (const Point<dim> &x : mesh.get_vertices())
    {
      if (!std::isfinite(x.norm()))
        parameters.refuse(entry, "gives the place " + place_text(x) + " for a vertex");
      if (n_hoop_directions(this->symmetry) > 0 && x[0] < 0.)
        parameters.refuse(entry, "puts a vertex at " + place_text(x) + "; the first coordinate is the radius");
    }
  for (const auto &cell : mesh.active_cell_iterators())
    if (const std::string problem = corner_problem<dim>(cell); !problem.empty())
      parameters.refuse(entry, "folds the mesh: " + problem);
}

template <int dim>
void Box<dim>::create(Triangulation<dim> &triangulation) const
{
  GridGenerator::subdivided_hyper_rectangle(triangulation, repetitions, Point<dim>(lower), Point<dim>(upper), true);
  for (const auto &cell : triangulation.active_cell_iterators()) // the colours of the generator are octants
    cell->set_material_id(std::upper_bound(layers.begin(), layers.end(), cell->center()[0]) - layers.begin());
  if (distortion > 0.)
    distort(triangulation);
  if (!map_text.empty())
    GridTools::transform([&](const Point<dim> &x) { return Point<dim>(map.value(x)); }, triangulation);
}

/// An irregular but repeatable displacement; vertices stay on the planes of the box.
template <int dim>
void Box<dim>::distort(Triangulation<dim> &triangulation) const
{
  const Tensor<1, dim> size = upper - lower;
  double               h    = size[0] / repetitions[0];
  for (unsigned int d = 1; d < dim; ++d)
    h = std::min(h, size[d] / repetitions[d]);
  GridTools::transform(
    [&](const Point<dim> &x) {
      Point<dim> y = x;
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] > lower[d] + 1e-10 * size[d] && x[d] < upper[d] - 1e-10 * size[d])
          {
            double phase = 1.3 * d;
            for (unsigned int e = 0; e < dim; ++e)
              phase += (2.1 + 1.7 * ((d + e) % dim)) * (x[e] - lower[e]) / h;
            y[d] += distortion * h * std::sin(phase);
          }
      return y;
    },
    triangulation);
}

/// The sides along the coordinates that the form leaves out are cut.
template <int dim>
bool Box<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  if (n_hoop_directions(form.form) > 0 || !map_text.empty())
    return false;
  for (unsigned int d = form.dimension(); d < dim; ++d)
    form.cut.insert(form.cut.end(), {2 * d, 2 * d + 1});
  form.shorten(parameters, path + "/Lower corner", lower);
  form.shorten(parameters, path + "/Upper corner", upper);
  form.shorten(parameters, path + "/Cells", cells);
  return true;
}

template class Box<1>;
template class Box<2>;
template class Box<3>;
} // namespace Arenite
