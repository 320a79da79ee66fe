#include <arenite/mechanics/cell_fields.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>

namespace Arenite
{
using namespace dealii;

template <int dim>
CellFields<dim>::CellFields(const Discretization<dim> &discretization)
  : discretization(discretization)
  , n(discretization.degree() + 1)
  , node(n)
  , inverse_product(n, 1.)
{
  AssertThrow(discretization.degree() <= largest_degree, ExcMessage("The degree of the element is too high."));
  const QGaussLobatto<1> rule(n);
  for (unsigned int i = 0; i < n; ++i)
    node[i] = rule.point(i)[0];
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int k = 0; k < n; ++k)
      if (k != i)
        inverse_product[i] /= node[i] - node[k];
}

// Products, not the barycentric quotient: no division by the distance to a node, which may be zero.
template <int dim>
ShapeFactors<dim> CellFields<dim>::shape(const Point<dim> &xi) const
{
  ShapeFactors<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int i = 0; i < n; ++i)
      {
        double value = inverse_product[i], derivative = 0.;
        for (unsigned int k = 0; k < n; ++k)
          if (k != i)
            {
              derivative = derivative * (xi[d] - node[k]) + value;
              value *= xi[d] - node[k];
            }
        result.value[d][i]      = value;
        result.derivative[d][i] = derivative;
      }
  return result;
}

template <int dim>
double CellFields<dim>::interpolate(const double *nodal, const std::size_t stride,
                                    const ShapeFactors<dim> &factors) const
{
  double sum = 0.;
  for (unsigned int line = 0; line < discretization.nodes_per_cell() / n; ++line)
    {
      double weight = 1.;
      for (unsigned int d = 1, rest = line; d < dim; ++d, rest /= n)
        weight *= factors.value[d][rest % n];
      for (unsigned int i = 0; i < n; ++i)
        sum += weight * factors.value[0][i] * nodal[(line * n + i) * stride];
    }
  return sum;
}

template <int dim>
Tensor<1, dim> CellFields<dim>::value(const VectorType &field, const unsigned int cell,
                                      const ShapeFactors<dim> &factors) const
{
  const double       *u     = field.begin();
  const unsigned int *nodes = discretization.cell_nodes(cell);
  Tensor<1, dim>      sum;
  for (unsigned int line = 0; line < discretization.nodes_per_cell() / n; ++line)
    {
      double weight = 1.;
      for (unsigned int d = 1, rest = line; d < dim; ++d, rest /= n)
        weight *= factors.value[d][rest % n];
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += weight * factors.value[0][i] * u[dim * nodes[line * n + i] + c];
    }
  return sum;
}

template <int dim>
Tensor<2, dim> CellFields<dim>::reference_gradient(const VectorType &field, const unsigned int cell,
                                                   const ShapeFactors<dim> &factors) const
{
  Tensor<2, dim>      result;
  const double       *u     = field.begin();
  const unsigned int *nodes = discretization.cell_nodes(cell);
  for (unsigned int line = 0; line < discretization.nodes_per_cell() / n; ++line)
    {
      Tensor<1, dim> sum, slope; // along the line, in direction 0
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double value = u[dim * nodes[line * n + i] + c];
            sum[c] += factors.value[0][i] * value;
            slope[c] += factors.derivative[0][i] * value;
          }
      for (unsigned int direction = 0; direction < dim; ++direction)
        {
          double weight = 1.;
          for (unsigned int d = 1, rest = line; d < dim; ++d, rest /= n)
            weight *= d == direction ? factors.derivative[d][rest % n] : factors.value[d][rest % n];
          for (unsigned int c = 0; c < dim; ++c)
            result[c][direction] += weight * (direction == 0 ? slope[c] : sum[c]);
        }
    }
  return result;
}

template <int dim>
Point<dim> CellFields<dim>::position(const unsigned int cell, const ShapeFactors<dim> &factors) const
{
  return Point<dim>(value(discretization.positions, cell, factors));
}

template <int dim>
Tensor<2, dim> CellFields<dim>::jacobian(const unsigned int cell, const ShapeFactors<dim> &factors) const
{
  return reference_gradient(discretization.positions, cell, factors);
}

template <int dim>
Tensor<2, dim> CellFields<dim>::gradient(const VectorType &field, const unsigned int cell,
                                         const ShapeFactors<dim> &factors) const
{
  return reference_gradient(field, cell, factors) * dealii::invert(jacobian(cell, factors));
}

namespace
{
/// Place in the unit cell of the node nearest to @p x.
template <int dim>
Point<dim> nearest_node(const Discretization<dim> &discretization, const std::vector<double> &node,
                        const unsigned int cell, const Point<dim> &x)
{
  unsigned int best     = 0;
  double       smallest = std::numeric_limits<double>::max();
  for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
    if (const double distance = x.distance_square(discretization.position(discretization.cell_nodes(cell)[i]));
        distance < smallest)
      {
        smallest = distance;
        best     = i;
      }
  Point<dim> xi;
  for (unsigned int d = 0; d < dim; ++d, best /= node.size())
    xi[d] = node[best % node.size()];
  return xi;
}

// Newton's method converges quadratically: after a step of 1e-9 the next one would be below round-off.
constexpr unsigned int most_steps = 60;
constexpr double       last_step  = 1e-9;
} // namespace

template <int dim>
typename CellFields<dim>::Place CellFields<dim>::invert(const unsigned int cell, const Point<dim> &x) const
{
  Place place;
  place.xi = nearest_node(discretization, node, cell, x);
  for (unsigned int step = 0; step < most_steps; ++step)
    {
      const auto           factors = shape(place.xi);
      const Tensor<2, dim> J       = jacobian(cell, factors);
      if (!(determinant(J) > 0.))
        return place;
      Tensor<1, dim> change = dealii::invert(J) * (x - position(cell, factors));
      const double   length = change.norm();
      if (length > 0.5) // stay where the polynomial describes the cell
        change *= 0.5 / length;
      place.xi += change;
      for (unsigned int d = 0; d < dim; ++d)
        place.xi[d] = std::clamp(place.xi[d], -1., 2.);
      if (length < last_step)
        {
          place.converged = true;
          return place;
        }
    }
  return place;
}

template <int dim>
typename CellFields<dim>::Nearest CellFields<dim>::nearest(const unsigned int cell, const Point<dim> &x) const
{
  Nearest result;
  result.xi       = nearest_node(discretization, node, cell, x);
  auto factors    = shape(result.xi);
  result.x        = position(cell, factors);
  result.distance = x.distance(result.x);
  for (unsigned int step = 0; step < most_steps; ++step)
    {
      // minimise |x(xi) - x|^2 / 2 in the coordinates that do not press against a face of the unit cell
      const Tensor<2, dim>  J     = jacobian(cell, factors);
      const Tensor<1, dim>  slope = transpose(J) * (x - result.x);
      Tensor<2, dim>        matrix;
      Tensor<1, dim>        right_side;
      std::array<bool, dim> held;
      for (unsigned int d = 0; d < dim; ++d)
        held[d] = (result.xi[d] <= 0. && slope[d] <= 0.) || (result.xi[d] >= 1. && slope[d] >= 0.);
      for (unsigned int d = 0; d < dim; ++d)
        {
          right_side[d] = held[d] ? 0. : slope[d];
          for (unsigned int e = 0; e < dim; ++e)
            for (unsigned int c = 0; c < dim && !held[d] && !held[e]; ++c)
              matrix[d][e] += J[c][d] * J[c][e];
          if (held[d])
            matrix[d][d] = 1.;
        }
      if (!(determinant(matrix) > 0.))
        return result;
      const Tensor<1, dim> direction = dealii::invert(matrix) * right_side;

      bool   closer = false;
      double moved  = 0.;
      for (double scale = 1.; scale > 1e-4 && !closer; scale *= 0.5)
        {
          Point<dim> xi = result.xi + scale * direction;
          for (unsigned int d = 0; d < dim; ++d)
            xi[d] = std::clamp(xi[d], 0., 1.);
          const auto       trial = shape(xi);
          const Point<dim> at    = position(cell, trial);
          if (const double distance = x.distance(at); distance < result.distance)
            {
              moved   = xi.distance(result.xi);
              closer  = true;
              factors = trial;
              result  = {xi, at, distance};
            }
        }
      if (!closer || moved < 1e-13)
        return result;
    }
  return result;
}

template <int dim>
BoundingBox<dim> CellFields<dim>::enlarged_box(const unsigned int cell) const
{
  Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::numeric_limits<double>::max();
      upper[d] = std::numeric_limits<double>::lowest();
    }
  double longest = 0.;
  for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double x = discretization.positions.local_element(dim * discretization.cell_nodes(cell)[i] + d);
        lower[d]       = std::min(lower[d], x);
        upper[d]       = std::max(upper[d], x);
      }
  for (unsigned int d = 0; d < dim; ++d)
    longest = std::max(longest, upper[d] - lower[d]);
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] -= 0.1 * longest;
      upper[d] += 0.1 * longest;
    }
  return BoundingBox<dim>(std::make_pair(lower, upper));
}

template <int dim>
double CellFields<dim>::size(const unsigned int cell) const
{
  const BoundingBox<dim> box     = enlarged_box(cell);
  double                 longest = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    longest = std::max(longest, box.side_length(d));
  return longest / 1.2;
}

template class CellFields<1>;
template class CellFields<2>;
template class CellFields<3>;
} // namespace Arenite
