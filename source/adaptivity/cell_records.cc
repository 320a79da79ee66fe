#include <arenite/adaptivity/cell_records.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Arenite
{
namespace
{
/// The smaller of two slopes of one sign, else 0.
double least(const double a, const double b) { return a * b > 0. ? (std::abs(a) < std::abs(b) ? a : b) : 0.; }
} // namespace

template <int dim>
CellRecords<dim>::CellRecords(const CellRecord &layout)
  : layout(layout)
  , n_line(static_cast<unsigned int>(layout.points.size()))
  , n_points(layout.n_points(dim))
  , n_values(layout.n_values > 0 ? layout.n_values - 1 : 0)
{
  double end = 0.;
  for (const double weight : layout.weights)
    ends.push_back(end += weight);
  if (!ends.empty())
    ends.back() = std::numeric_limits<double>::max();
}

template <int dim>
std::array<unsigned int, dim> CellRecords<dim>::index(unsigned int point) const
{
  std::array<unsigned int, dim> result;
  for (int d = 0; d < dim; ++d, point /= n_line)
    result[d] = point % n_line;
  return result;
}

template <int dim>
std::vector<double> CellRecords<dim>::means(const double *const record) const
{
  std::vector<double> mean(n_values, 0.);
  double              total = 0.;
  for (unsigned int q = 0; q < n_points; ++q)
    {
      total += volume(record, q);
      for (unsigned int k = 0; k < n_values; ++k)
        mean[k] += volume(record, q) * record[q * layout.n_values + k];
    }
  for (double &value : mean)
    value /= total;
  return mean;
}

template <int dim>
typename CellRecords<dim>::Surroundings CellRecords<dim>::look_around(const std::vector<double> &own,
                                                                      const std::vector<double> (&neighbour)[2 * dim],
                                                                      const double (&distance)[2 * dim]) const
{
  Surroundings result{std::vector<double>(dim * n_values, 0.), own, own};
  for (unsigned int k = 0; k < n_values; ++k)
    {
      double reach = 0.;
      for (int d = 0; d < dim; ++d)
        {
          double      slopes[2];
          const auto &below = neighbour[2 * d], &above = neighbour[2 * d + 1];
          for (int side = 0; side < 2; ++side)
            if (const auto &other = side == 0 ? below : above; !other.empty())
              slopes[side] = (side == 0 ? own[k] - other[k] : other[k] - own[k]) / distance[2 * d + side];
          double slope = 0.;
          if (!below.empty() && !above.empty())
            slope = least(slopes[0], slopes[1]);
          else if (k < 6 && (!below.empty() || !above.empty()))
            {
              // at a boundary stress goes on as it comes, as far as it does not change its sign
              slope = below.empty() ? slopes[1] : slopes[0];
              slope = std::clamp(slope, -2. * std::abs(own[k]), 2. * std::abs(own[k]));
              for (const double beyond : {own[k] - slope, own[k] + slope})
                {
                  result.lower[k] = std::min(result.lower[k], beyond);
                  result.upper[k] = std::max(result.upper[k], beyond);
                }
            }
          result.slope[d * n_values + k] = slope;
          reach += 0.5 * std::abs(slope);
          for (const auto *other : {&below, &above})
            if (!other->empty())
              {
                result.lower[k] = std::min(result.lower[k], (*other)[k]);
                result.upper[k] = std::max(result.upper[k], (*other)[k]);
              }
        }
      // the corners stay within the bounds
      const double room = std::min(own[k] - result.lower[k], result.upper[k] - own[k]);
      if (reach > room)
        for (int d = 0; d < dim; ++d)
          result.slope[d * n_values + k] *= room / reach;
    }
  return result;
}

/// Value k of the polynomial through the points of a cell at a place of it, cut off at the values of the points around the place.
template <int dim>
double CellRecords<dim>::polynomial(const double *const record, const double (&place)[dim], const unsigned int k) const
{
  double value = 0., lower = std::numeric_limits<double>::max(), upper = -lower;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      const auto of   = index(p);
      double     N    = 1.;
      bool       near = true; // one of the points around the place
      for (int d = 0; d < dim; ++d)
        {
          const double x = layout.points[of[d]];
          for (unsigned int j = 0; j < n_line; ++j)
            if (j != of[d])
              N *= (place[d] - layout.points[j]) / (x - layout.points[j]);
          near = near && (of[d] == 0 || layout.points[of[d] - 1] <= place[d]) &&
                 (of[d] + 1 == n_line || layout.points[of[d] + 1] >= place[d]);
        }
      const double there = record[p * layout.n_values + k];
      value += N * there;
      if (near)
        {
          lower = std::min(lower, there);
          upper = std::max(upper, there);
        }
    }
  return std::clamp(value, lower, upper);
}

template <int dim>
void CellRecords<dim>::refine(const double *const parent, const Surroundings &around, const unsigned int child,
                              double *const record) const
{
  std::vector<double> linear; // slope of the points' own linear field, [direction][value]
  std::vector<double> mean;
  if (n_line <= 2)
    {
      mean = means(parent);
      linear.assign(dim * n_values, 0.);
      for (unsigned int q = 0; n_line == 2 && q < n_points; ++q)
        for (int d = 0; d < dim; ++d)
          for (unsigned int k = 0; k < n_values; ++k)
            linear[d * n_values + k] += (index(q)[d] == 0 ? -1. : 1.) * parent[q * layout.n_values + k] /
                                        ((layout.points[1] - layout.points[0]) * 0.5 * n_points);
    }
  for (unsigned int q = 0; q < n_points; ++q)
    {
      const auto    at  = index(q);
      double *const own = record + q * layout.n_values;
      double        place[dim]; // in the parent
      for (int d = 0; d < dim; ++d)
        place[d] = 0.5 * ((child >> d & 1) + layout.points[at[d]]);
      for (unsigned int k = 0; k < n_values; ++k)
        {
          double value, lower, upper;
          if (n_line <= 2)
            {
              const unsigned int nearest = n_line == 1 ? 0 : child; // point and child of one corner have one number
              value                      = n_line == 1 ? mean[k] : parent[nearest * layout.n_values + k];
              for (int d = 0; d < dim; ++d)
                {
                  if (n_line == 2)
                    value -= linear[d * n_values + k] * (layout.points[child >> d & 1] - 0.5);
                  value += around.slope[d * n_values + k] * (place[d] - 0.5);
                }
              lower = around.lower[k];
              upper = around.upper[k];
              for (unsigned int p = 0; p < n_points; ++p)
                {
                  lower = std::min(lower, parent[p * layout.n_values + k]);
                  upper = std::max(upper, parent[p * layout.n_values + k]);
                }
            }
          else
            {
              own[k] = polynomial(parent, place, k);
              continue;
            }
          own[k] = std::clamp(value, lower, upper);
        }
      own[n_values] = volume(parent, n_line <= 2 ? std::min(child, n_points - 1) : q) / n_children;
    }
  const double *const of_parent = parent + n_points * layout.n_values;
  for (unsigned int i = 0; i < layout.of_cell.size(); ++i)
    record[n_points * layout.n_values + i] = layout.of_cell[i].to_child * of_parent[i];
}

template <int dim>
void CellRecords<dim>::coarsen(const std::vector<const double *> &children, double *const record) const
{
  std::fill_n(record, layout.size(dim), 0.);
  if (n_line > 2)
    take_polynomials(children, record);
  else
    take_means(children, record);
  double *const of_cell = record + n_points * layout.n_values;
  for (unsigned int i = 0; i < layout.of_cell.size(); ++i)
    {
      for (unsigned int child = 0; child < n_children; ++child)
        {
          const double value = children[child][n_points * layout.n_values + i];
          of_cell[i]         = layout.of_cell[i].sums || child == 0 ? of_cell[i] + value : std::max(of_cell[i], value);
        }
      of_cell[i] *= layout.of_cell[i].to_parent;
    }
}

/// Points of the cell from the points of the children in their part of it.
template <int dim>
void CellRecords<dim>::take_means(const std::vector<const double *> &children, double *const record) const
{
  for (unsigned int child = 0; child < n_children; ++child)
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const auto   at = index(q);
        unsigned int to = 0;
        for (int d = dim - 1; d >= 0; --d)
          {
            const double place = 0.5 * ((child >> d & 1) + layout.points[at[d]]);
            to =
              to * n_line + static_cast<unsigned int>(std::upper_bound(ends.begin(), ends.end(), place) - ends.begin());
          }
        const double *const from = children[child] + q * layout.n_values;
        double *const       sum  = record + to * layout.n_values;
        const double        v    = from[n_values];
        for (unsigned int k = 0; k < n_values; ++k)
          sum[k] += v * from[k];
        sum[n_values] += v;
      }
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int k = 0; k < n_values; ++k)
      record[q * layout.n_values + k] /= volume(record, q);
}

/// Points of the cell from the polynomials of the children they lie in, the mean where they lie between some.
template <int dim>
void CellRecords<dim>::take_polynomials(const std::vector<const double *> &children, double *const record) const
{
  for (unsigned int q = 0; q < n_points; ++q)
    for (const double *const child : children) // as halves divide it
      record[(q + 1) * layout.n_values - 1] += volume(child, q);
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int k = 0; k < n_values; ++k)
      {
        const auto   at    = index(q);
        double       sum   = 0.;
        unsigned int count = 0;
        for (unsigned int child = 0; child < n_children; ++child)
          {
            double place[dim];
            bool   inside = true;
            for (int d = 0; d < dim; ++d)
              {
                place[d] = 2. * layout.points[at[d]] - (child >> d & 1);
                inside   = inside && place[d] > -1e-9 && place[d] < 1. + 1e-9;
                place[d] = std::clamp(place[d], 0., 1.);
              }
            if (!inside)
              continue;
            sum += polynomial(children[child], place, k);
            ++count;
          }
        record[q * layout.n_values + k] = sum / count;
      }
}

template class CellRecords<1>;
template class CellRecords<2>;
template class CellRecords<3>;
} // namespace Arenite
