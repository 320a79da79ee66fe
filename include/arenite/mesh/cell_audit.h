#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <string>

namespace Arenite
{
/// "(0.1 0.2 0)"
template <int dim>
std::string place_text(const dealii::Point<dim> &);

/// First corner of a cell whose Jacobian is not positive, as a sentence; empty if the cell is sound.
template <int dim>
std::string corner_problem(const typename dealii::Triangulation<dim>::active_cell_iterator &cell);
} // namespace Arenite
