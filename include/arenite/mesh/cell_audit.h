#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <string>
#include <vector>

namespace Arenite
{
/// "(0.1 0.2 0)"
template <int dim>
std::string place_text(const dealii::Point<dim> &);

/// Determinant of the edges that leave corner @p v of a cell with these corners, in the directions of the reference axes [m^dim].
template <int dim>
double corner_jacobian(const std::vector<dealii::Point<dim>> &corners, unsigned int v);

/// First corner of a cell whose Jacobian is not positive, as a sentence; empty if the cell is sound.
template <int dim>
std::string corner_problem(const typename dealii::Triangulation<dim>::active_cell_iterator &cell);
} // namespace Arenite
