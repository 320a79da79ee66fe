#include <arenite/base/state_archive.h>
#include <arenite/io/receiver_history.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Arenite
{
using namespace dealii;

template <int dim>
void VelocityHistory<dim>::exchange(StateArchive &archive, const std::size_t first, const std::size_t n_own)
{
  for (bool *flag : {&chained, &pending, &has_acceleration})
    archive.common(*flag);
  archive.common(step);
  archive.common(pending_step);
  for (double *value : {&dt_before, &pending_dt, &pending_row.time})
    archive.common(*value);
  for (Vectors *vectors :
       {&last, &before, &pending_before, &acceleration, &pending_row.displacement, &pending_row.velocity})
    archive.of_points(*vectors, first, n_own);
  archive.of_points(pending_row.stress, first, n_own);
  archive.of_points(pending_row.scalars, first, n_own);
}

template <int dim>
void ReceiverErrors<dim>::reinit(const ExactSolution<dim> &solution, const std::vector<Point<dim>> &points_,
                                 const ReceiverQuantities &wanted)
{
  exact   = &solution;
  points  = points_;
  started = false;
  quantities.clear();
  const std::vector<Square> zero(points.size());
  for (const auto &[name, is_wanted] :
       {std::make_pair("displacement", wanted.displacement), std::make_pair("velocity", wanted.velocity),
        std::make_pair("stress", wanted.stress)})
    if (is_wanted && (solution.is_field() || std::string(name) == "displacement"))
      quantities.push_back({name, zero, zero});
}

template <int dim>
void ReceiverErrors<dim>::add(const ReceiverRow<dim> &row)
{
  const double half_step = started ? 0.5 * (row.time - last_time) : 0.;
  for (Quantity &quantity : quantities)
    for (unsigned int point = 0; point < points.size(); ++point)
      {
        const auto compare = [](const auto &computed, const auto &q) {
          return Square{(computed - q) * (computed - q), q * q};
        };
        const Square now = !exact->known_at(points[point], row.time) ? Square{0., 0.}
                           : quantity.name == "stress"
                             ? compare(row.stress[point], exact->stress(points[point], row.time))
                           : quantity.name == "velocity"
                             ? compare(row.velocity[point], exact->velocity(points[point], row.time))
                             : compare(row.displacement[point], exact->displacement(points[point], row.time));
        quantity.integral[point].error += half_step * (quantity.last[point].error + now.error);
        quantity.integral[point].exact += half_step * (quantity.last[point].exact + now.exact);
        quantity.last[point] = now;
      }
  last_time = row.time;
  started   = true;
}

template <int dim>
void ReceiverErrors<dim>::exchange(StateArchive &archive, const std::size_t first)
{
  for (Quantity &quantity : quantities)
    for (std::vector<Square> *squares : {&quantity.last, &quantity.integral})
      archive.of_points(*squares, first, points.size());
  archive.common(last_time);
  archive.common(started);
}

namespace
{
/// Zero exact values have no relative error: infinite, or zero if the computed values are zero too.
double relative(const double error, const double exact)
{
  if (exact > 0.)
    return std::sqrt(error / exact);
  return error > 0. ? std::numeric_limits<double>::infinity() : 0.;
}
} // namespace

template <int dim>
std::map<std::string, double> ReceiverErrors<dim>::of_point(const unsigned int point) const
{
  std::map<std::string, double> result;
  for (const Quantity &quantity : quantities)
    result[quantity.name + ".E_t"] = relative(quantity.integral[point].error, quantity.integral[point].exact);
  return result;
}

template <int dim>
std::map<std::string, double> ReceiverErrors<dim>::of_set(const MPI_Comm communicator) const
{
  std::map<std::string, double> result;
  for (const Quantity &quantity : quantities)
    {
      Square sum;
      for (const Square &square : quantity.integral)
        {
          sum.error += square.error;
          sum.exact += square.exact;
        }
      const double error = Utilities::MPI::sum(sum.error, communicator);
      const double exact = Utilities::MPI::sum(sum.exact, communicator);

      result[quantity.name + ".E_t"] = relative(error, exact);
    }
  return result;
}

template <int dim>
void ReceiverNorms<dim>::add(const ReceiverRow<dim> &row)
{
  const double half_step = started ? 0.5 * (row.time - last_time) : 0.;
  const auto   include   = [&](Norm &norm, const auto &values) {
    double sum = 0.;
    for (const auto &value : values)
      {
        sum += value * value;
        norm.peak = std::max(norm.peak, std::sqrt(value * value));
      }
    norm.integral += half_step * (norm.last + sum);
    norm.last     = sum;
    norm.n_points = values.size();
  };
  include(displacement, row.displacement);
  include(velocity, row.velocity);
  include(stress, row.stress);
  if (!started)
    first_time = row.time;
  last_time = row.time;
  started   = true;
}

template <int dim>
std::map<std::string, double> ReceiverNorms<dim>::of_set(const MPI_Comm communicator) const
{
  std::map<std::string, double> result;
  const auto                    add = [&](const std::string &name, const Norm &norm) {
    const auto   n_points = static_cast<double>(Utilities::MPI::sum(norm.n_points, communicator));
    const double integral = Utilities::MPI::sum(norm.integral, communicator);
    const double peak     = Utilities::MPI::max(norm.peak, communicator);
    if (n_points == 0. || !(last_time > first_time))
      return;
    result[name + ".rms"]  = std::sqrt(integral / (n_points * (last_time - first_time)));
    result[name + ".peak"] = peak;
  };
  add("displacement", displacement);
  add("velocity", velocity);
  add("stress", stress);
  return result;
}

template <int dim>
void ReceiverNorms<dim>::exchange(StateArchive &archive)
{
  for (Norm *norm : {&displacement, &velocity, &stress})
    {
      archive.sum(norm->integral);
      archive.sum(norm->last);
      norm->peak = Utilities::MPI::max(norm->peak, archive.communicator);
      archive.common(norm->peak);
    }
  archive.common(first_time);
  archive.common(last_time);
  archive.common(started);
}

template class VelocityHistory<1>;
template class VelocityHistory<2>;
template class VelocityHistory<3>;
template class ReceiverErrors<1>;
template class ReceiverErrors<2>;
template class ReceiverErrors<3>;
template class ReceiverNorms<1>;
template class ReceiverNorms<2>;
template class ReceiverNorms<3>;
} // namespace Arenite
