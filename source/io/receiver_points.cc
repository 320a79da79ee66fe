#include <arenite/base/names.h>
#include <arenite/base/values.h>
#include <arenite/io/receiver_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace Arenite
{
using namespace dealii;

const std::vector<std::string> &receiver_types()
{
  static const std::vector<std::string> types{"points", "line", "plane", "surface", "box"};
  return types;
}

const char *const receiver_type_sentence = "Single points, written as a table; a line or plane of points, written to "
                                           "receivers.h5; the force on a 'surface', its impulse and "
                                           "mean velocity, or the momentum in a 'box', written as tables.";

template <int dim>
void ReceiverPoints<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  type = parameters.peek_choice(path + "/Type", type, receiver_types());
  parameters.add_choice("Type", type, receiver_types(), receiver_type_sentence);
  if (type == "points")
    {
      const Symmetry symmetry   = DimensionChoice(parameters).symmetry;
      const auto     to_section = [symmetry](const Point<3> &x) { return reduce<dim>(symmetry, x); };
      parameters.add_points<dim>("Points", points, "m", "Places of the receivers p1, p2, ...", to_section);
      parameters.add_points<dim>(
        "Directions", directions, "",
        "Directions from the origin, of any length, for receivers at all Radii: d1r1, d1r2, ...", to_section);
      parameters.add_list("Radii", radii, "Distances from the origin [m] along every direction.");
    }
  else if (type == "line")
    {
      parameters.add_vector("Start", start, "m", "First point.");
      parameters.require("Start");
      parameters.add_vector("End", end, "m", "Last point.");
      parameters.require("End");
      parameters.add_integer("Number", number, 2, 1000000, "Points on the line, with both ends.");
    }
  else
    {
      parameters.add_vector("Corner", corner, "m", "First point.");
      parameters.require("Corner");
      parameters.add_vector("First edge", first_edge, "m", "From the corner to the end of the first edge.");
      parameters.require("First edge");
      parameters.add_vector("Second edge", second_edge, "m", "From the corner to the end of the second edge.");
      parameters.require("Second edge");
      parameters.add_integer("First number", first_number, 2, 10000, "Points along the first edge, with both ends.");
      parameters.add_integer("Second number", second_number, 2, 10000, "Points along the second edge, with both ends.");
    }
}

template <int dim>
void ReceiverPoints<dim>::finalize(const Parameters &parameters)
{
  names.clear();
  positions.clear();
  const auto add = [&](const std::string &name, const Point<dim> &x) {
    names.push_back(name);
    positions.push_back(x);
  };
  if (type == "points")
    {
      for (unsigned int i = 0; i < points.size(); ++i)
        add("p" + std::to_string(i + 1), points[i]);
      if (directions.empty() != radii.empty())
        parameters.refuse(path + (radii.empty() ? "/Directions" : "/Radii"),
                          "Directions and Radii need each other; one of them is missing.");
      for (unsigned int d = 0; d < directions.size(); ++d)
        for (unsigned int r = 0; r < radii.size(); ++r)
          {
            const std::string complaint = complaint_about_number(radii[r], "m");
            if (!complaint.empty())
              parameters.refuse(path + "/Radii", "'" + radii[r] + "' " + complaint);
            const double radius = Utilities::string_to_double(radii[r]), length = directions[d].norm();
            if (!(radius >= 0.))
              parameters.refuse(path + "/Radii", "must be >= 0 m.");
            if (!(length > 0. && length < std::numeric_limits<double>::max()))
              parameters.refuse(path + "/Directions", "direction " + std::to_string(d + 1) + " must have a length.");
            add("d" + std::to_string(d + 1) + "r" + std::to_string(r + 1), directions[d] * (radius / length));
          }
      if (positions.empty())
        parameters.refuse(path, "The set has no point: give Points, or Directions and Radii.");
    }
  else if (type == "line")
    for (unsigned int i = 0; i < number; ++i)
      add("p" + std::to_string(i + 1), Point<dim>(start + (end - start) * (double(i) / (number - 1))));
  else
    for (unsigned int i = 0; i < first_number; ++i)
      for (unsigned int j = 0; j < second_number; ++j)
        add("p" + std::to_string(i + 1) + "_" + std::to_string(j + 1),
            Point<dim>(corner + first_edge * (double(i) / (first_number - 1)) +
                       second_edge * (double(j) / (second_number - 1))));

  for (unsigned int i = 0; i < positions.size(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      if (!numbers::is_finite(positions[i][d]))
        parameters.refuse(path, "The coordinates of point " + names[i] + " are not finite.");
}

namespace
{
constexpr double contact_tolerance = 1e-9; // of the size of a cell
constexpr double outside_tolerance = 0.05; // of the size of a cell

/// visit(point, cell) for the points of @p subset in the enlarged box of each cell of this process.
template <int dim, typename Visit>
void for_each_candidate(const CellFields<dim> &fields, const std::vector<Point<dim>> &points,
                        std::vector<unsigned int> subset, const Visit &visit)
{
  std::sort(subset.begin(), subset.end(), [&](const auto a, const auto b) { return points[a][0] < points[b][0]; });
  for (unsigned int cell = 0; cell < fields.discretization.cells().size(); ++cell)
    {
      const auto box   = fields.enlarged_box(cell);
      const auto first = std::lower_bound(subset.begin(), subset.end(), box.lower_bound(0),
                                          [&](const auto point, const double x) { return points[point][0] < x; });
      for (auto point = first; point != subset.end() && points[*point][0] <= box.upper_bound(0); ++point)
        if (box.point_inside(points[*point]))
          visit(*point, cell);
    }
}

template <int dim>
typename PointLocation<dim>::Contact make_contact(const CellFields<dim> &fields, const unsigned int point,
                                                  const unsigned int cell, const Point<dim> &xi)
{
  const ShapeFactors<dim> factors = fields.shape(xi);
  return {point, cell, 1., factors, dealii::invert(fields.jacobian(cell, factors))};
}

template <int dim>
std::string extent(const Discretization<dim> &discretization)
{
  Tensor<1, dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::numeric_limits<double>::max();
      upper[d] = std::numeric_limits<double>::lowest();
      for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
        {
          lower[d] = std::min(lower[d], discretization.position(node)[d]);
          upper[d] = std::max(upper[d], discretization.position(node)[d]);
        }
      lower[d] = Utilities::MPI::min(lower[d], discretization.communicator);
      upper[d] = Utilities::MPI::max(upper[d], discretization.communicator);
    }
  return "(" + to_text<dim>(lower) + ") to (" + to_text<dim>(upper) + ") m";
}
} // namespace

template <int dim>
void PointLocation<dim>::reinit(const CellFields<dim> &fields, const std::vector<Point<dim>> &points,
                                const std::vector<std::string> &names, const std::string &label)
{
  const MPI_Comm            communicator = fields.discretization.communicator;
  std::vector<unsigned int> n_contacts(points.size(), 0), n_all(points.size());
  positions = points;
  contacts.clear();

  const auto add = [&](const unsigned int point, const unsigned int cell, const Point<dim> &xi) {
    contacts.push_back(make_contact(fields, point, cell, xi));
    ++n_contacts[point];
  };
  std::vector<unsigned int> outside(points.size());
  std::iota(outside.begin(), outside.end(), 0);
  for_each_candidate(fields, positions, outside, [&](const unsigned int point, const unsigned int cell) {
    const auto place  = fields.invert(cell, positions[point]);
    bool       inside = place.converged;
    for (unsigned int d = 0; d < dim; ++d)
      inside = inside && place.xi[d] >= -contact_tolerance && place.xi[d] <= 1. + contact_tolerance;
    if (inside)
      add(point, cell, place.xi);
  });

  Utilities::MPI::sum(n_contacts, communicator, n_all);
  outside.clear();
  for (unsigned int point = 0; point < points.size(); ++point)
    if (n_all[point] == 0)
      outside.push_back(point);
  if (!outside.empty())
    {
      project(fields, outside, names, label);
      for_each_candidate(fields, positions, outside, [&](const unsigned int point, const unsigned int cell) {
        const auto nearest = fields.nearest(cell, positions[point]);
        if (nearest.distance <= contact_tolerance * fields.size(cell))
          add(point, cell, nearest.xi);
      });
      Utilities::MPI::sum(n_contacts, communicator, n_all);
    }
  for (Contact &contact : contacts)
    contact.weight = 1. / n_all[contact.point];
}

template <int dim>
void PointLocation<dim>::project(const CellFields<dim> &fields, const std::vector<unsigned int> &outside,
                                 const std::vector<std::string> &names, const std::string &label)
{
  const MPI_Comm communicator = fields.discretization.communicator;
  const double   none         = std::numeric_limits<double>::max();

  // (i) nearest point on this process that is near enough
  std::vector<double>     distance(positions.size(), none), smallest(positions.size());
  std::vector<Point<dim>> nearest_position(positions.size());
  for_each_candidate(fields, positions, outside, [&](const unsigned int point, const unsigned int cell) {
    const auto nearest = fields.nearest(cell, positions[point]);
    if (nearest.distance < distance[point] && nearest.distance <= outside_tolerance * fields.size(cell))
      {
        distance[point]         = nearest.distance;
        nearest_position[point] = nearest.x;
      }
  });

  // (ii) nearest of all processes; of equal ones the first process
  Utilities::MPI::min(distance, communicator, smallest);
  const unsigned int        rank = Utilities::MPI::this_mpi_process(communicator);
  std::vector<unsigned int> owner(positions.size(), numbers::invalid_unsigned_int), first(positions.size());
  std::vector<double>       x(dim * positions.size(), 0.), x_all(x.size());
  for (const unsigned int point : outside)
    if (distance[point] < none && distance[point] == smallest[point])
      owner[point] = rank;
  Utilities::MPI::min(owner, communicator, first);
  for (const unsigned int point : outside)
    {
      if (first[point] == numbers::invalid_unsigned_int)
        throw InputError(label + " The point " + names[point] + " at (" + to_text<dim>(positions[point]) +
                         ") m lies outside of the mesh, which extends from " + extent(fields.discretization) +
                         ". A point is moved to the boundary only over 5 % of the size of a cell.");
      if (first[point] == rank)
        for (unsigned int d = 0; d < dim; ++d)
          x[dim * point + d] = nearest_position[point][d];
    }
  Utilities::MPI::sum(x, communicator, x_all);
  for (const unsigned int point : outside)
    for (unsigned int d = 0; d < dim; ++d)
      positions[point][d] = x_all[dim * point + d];
}

template class ReceiverPoints<1>;
template class ReceiverPoints<2>;
template class ReceiverPoints<3>;
template class PointLocation<1>;
template class PointLocation<2>;
template class PointLocation<3>;
} // namespace Arenite
