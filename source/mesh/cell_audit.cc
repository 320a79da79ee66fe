#include <arenite/mesh/cell_audit.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/tria_accessor.h>

#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
std::string place_text(const Point<dim> &x)
{
  std::ostringstream stream;
  stream << '(' << x << ')';
  return stream.str();
}

template <int dim>
double corner_jacobian(const std::vector<Point<dim>> &corners, const unsigned int v)
{
  Tensor<2, dim> J;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const Tensor<1, dim> edge = corners[v ^ (1u << d)] - corners[v];
      for (unsigned int c = 0; c < dim; ++c)
        J[c][d] = (v >> d) & 1u ? -edge[c] : edge[c];
    }
  return determinant(J);
}

template <int dim>
std::string corner_problem(const typename Triangulation<dim>::active_cell_iterator &cell)
{
  std::vector<Point<dim>> corners;
  for (const unsigned int v : cell->vertex_indices())
    corners.push_back(cell->vertex(v));
  for (const unsigned int v : cell->vertex_indices())
    if (const double J = corner_jacobian(corners, v); !(J > 0.))
      return "cell " + std::to_string(cell->active_cell_index()) + " is inverted or flat at corner " +
             place_text(cell->vertex(v)) + " (Jacobian " + Utilities::to_string(J) + " m^" + std::to_string(dim) + ")";
  return "";
}

#define ARENITE_INSTANTIATE(dim)                                                       \
  template std::string place_text(const Point<dim> &);                                 \
  template double      corner_jacobian(const std::vector<Point<dim>> &, unsigned int); \
  template std::string corner_problem<dim>(const typename Triangulation<dim>::active_cell_iterator &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
