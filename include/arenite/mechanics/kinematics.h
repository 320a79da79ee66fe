#pragma once

#include <arenite/base/number.h>
#include <arenite/base/symmetry.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Arenite
{
// All that a symmetry changes in mechanics. With H hoop directions (0: Cartesian, 1: axisymmetric, 2: spherical):
//
//   dV = m(r) dx,   m = 1, 2 pi r, 4 pi r^2       volumes, and surfaces of the boundaries of the mesh likewise
//   eps_tt = u_r/r                                 in each hoop direction, du_r/dr on the axis
//   f_r -= H sigma_tt/r dV                         what the hoop stress adds to the force on a point
//
// Kernels take H as a template parameter, everything else from the symmetry of the Discretization.

/// m(r): volume of the body per volume of the mesh.
template <int n_hoop, typename V>
ARENITE_INLINE V measure(const V &r)
{
  constexpr double pi = 3.14159265358979323846;
  if constexpr (n_hoop == 0)
    return (void)r, V(1.);
  else if constexpr (n_hoop == 1)
    return V(2. * pi) * r;
  else
    return V(4. * pi) * r * r;
}

/// The same for a place in the mesh.
template <int dim>
double measure(const Symmetry symmetry, const dealii::Point<dim> &x)
{
  switch (n_hoop_directions(symmetry))
    {
    case 0:
      return measure<0>(x[0]);
    case 1:
      return measure<1>(x[0]);
    default:
      return measure<2>(x[0]);
    }
}

/// 1/r, finite on the axis, where it only meets zeros: u_r is none there, and so is the measure of collocated points.
template <typename V>
ARENITE_INLINE V inverse_radius(const V &r)
{
  return V(1.) / (r + V(1e-100));
}

/// Gradient in three dimensions, H_ij = d u_i/d x_j, of a displacement @p u at @p x with @p gradient in the mesh.
template <int dim>
dealii::Tensor<2, 3> full_gradient(const Symmetry symmetry, const dealii::Tensor<2, dim> &gradient,
                                   const dealii::Tensor<1, dim> &u, const dealii::Point<dim> &x)
{
  dealii::Tensor<2, 3> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = gradient[i][j];
  if constexpr (dim < 3)
    if (n_hoop_directions(symmetry) > 0)
      for (unsigned int h = dim; h < 3; ++h)
        result[h][h] = std::abs(x[0]) > 1e-12 * x.norm() ? u[0] / x[0] : gradient[0][0];
  (void)symmetry, (void)u, (void)x;
  return result;
}

/// Weights of the values u_1 ... u_p along a line of Gauss-Lobatto nodes that begins on the axis, where the function is even:
///
///   u_0 = sum_m c_m u_m,   c_m = - l_m'(0)/l_0'(0),   from u'(0) = 0.
///
/// Nodes of degree p >= 2 on the axis of a body of revolution have no mass (the measure is zero at the point of the rule) and
/// follow their line by this; the polynomials that are left, 1, s^2 ... s^p, approximate even functions as well as all of them.
/// Entry 0 is unused.
std::vector<double> even_line_weights(unsigned int degree);
} // namespace Arenite
