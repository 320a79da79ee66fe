#include <arenite/base/main_frequency.h>
#include <arenite/loads/nodal_force.h>
#include <arenite/simulation/resolution.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Arenite
{
using namespace dealii;

std::array<double, 3> needed_cells_per_wave(const ElementChoice &element)
{
  if (element.type == "one-point hexahedron")
    return {9.6, 30., 92.};
  switch (element.degree)
    {
    case 1:
      return {5.6, 19., 60.};
    case 2:
      return {2.0, 6.0, 15.};
    case 3:
      return {1.2, 3.0, 7.4};
    default:
      return {1.2, 1.8, 4.5};
    }
}

namespace
{
/// Longest edge of the smallest and of the largest cell [m].
template <int dim>
std::pair<double, double> cell_sizes(const Triangulation<dim> &triangulation, const MPI_Comm communicator)
{
  double smallest = std::numeric_limits<double>::max(), largest = 0.;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        double size = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          size = std::max(size, cell->extent_in_direction(d));
        smallest = std::min(smallest, size);
        largest  = std::max(largest, size);
      }
  return {Utilities::MPI::min(smallest, communicator), Utilities::MPI::max(largest, communicator)};
}
} // namespace

template <int dim>
std::string describe_resolution(const Triangulation<dim> &triangulation, const Dynamics<dim> &dynamics,
                                const ElementChoice &element, const double slowest_speed, const double end_time,
                                const MPI_Comm communicator)
{
  const auto [smallest, largest] = cell_sizes(triangulation, communicator);
  const auto         needed      = needed_cells_per_wave(element);
  std::ostringstream text;
  text.precision(2);
  for (const auto &load : dynamics.loads)
    if (const auto *pressure = dynamic_cast<const Pressure<dim> *>(load.get()))
      {
        const double frequency = main_frequency(*pressure->pressure_history().get(), end_time);
        if (frequency == 0.)
          continue; // constant
        text << "Resolution ";
        if (!std::isfinite(frequency))
          text << "'" << load->name << "' jumps or has a kink: its front is never resolved, and the order is below 2\n";
        else
          text << "the S wave of '" << load->name << "', " << slowest_speed / frequency << " m at "
               << std::lround(frequency) << " Hz, has " << slowest_speed / frequency / largest << " to "
               << slowest_speed / frequency / smallest
               << " cells; for an error of 10, 1, 0.1 % within four waves it needs " << needed[0] << ", " << needed[1]
               << ", " << needed[2] << '\n';
      }
  return text.str();
}

template std::string describe_resolution(const Triangulation<1> &, const Dynamics<1> &, const ElementChoice &, double,
                                         double, MPI_Comm);
template std::string describe_resolution(const Triangulation<2> &, const Dynamics<2> &, const ElementChoice &, double,
                                         double, MPI_Comm);
template std::string describe_resolution(const Triangulation<3> &, const Dynamics<3> &, const ElementChoice &, double,
                                         double, MPI_Comm);
} // namespace Arenite
