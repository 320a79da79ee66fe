#pragma once

#include <arenite/mechanics/internal_force.h>
#include <arenite/mechanics/present_shape.h>

#include <algorithm>

namespace Arenite
{
/// Eigenvalues of a symmetric matrix, left on the diagonal of @p a, and its orthonormal eigenvectors, the columns of @p s: cyclic Jacobi
/// rotations (Golub & Van Loan), one is exact in two dimensions, four rounds leave round-off in three.
template <int dim, typename V>
ARENITE_INLINE void principal_directions(V (&a)[dim][dim], V (&s)[dim][dim])
{
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      s[i][j] = V(i == j ? 1. : 0.);
  constexpr int rounds = dim == 3 ? 4 : 1;
  for (int round = 0; round < rounds; ++round)
    for (int p = 0; p < dim; ++p)
      for (int q = p + 1; q < dim; ++q)
        {
          // tan of the rotation: the smaller root of t^2 + 2 t (a_qq - a_pp)/(2 a_pq) - 1
          const V across = V(2.) * a[p][q], difference = a[q][q] - a[p][p];
          const V length = square_root(V(difference * difference + across * across));
          const V sign   = Arenite::select<V>(difference < V(0.), V(-1.), V(1.));
          const V t      = sign * across / (Arenite::absolute<V>(difference) + length + V(1e-200));
          const V c = V(1.) / square_root(V(V(1.) + t * t)), sine = t * c;
          a[p][p] -= t * a[p][q];
          a[q][q] += t * a[p][q];
          a[p][q] = a[q][p] = V(0.);
          for (int k = 0; k < dim; ++k)
            {
              if (k != p && k != q)
                {
                  const V at_p = a[k][p], at_q = a[k][q];
                  a[k][p] = a[p][k] = c * at_p - sine * at_q;
                  a[k][q] = a[q][k] = sine * at_p + c * at_q;
                }
              const V s_p = s[k][p], s_q = s[k][q];
              s[k][p] = c * s_p - sine * s_q;
              s[k][q] = sine * s_p + c * s_q;
            }
        }
}

/// Bulk viscosity of a point (von Neumann & Richtmyer; Landshoff) over strain increments d of a step:
///
///   volumetric    q = rho l (b2^2 l |D| + b1 c) |D|   in compression (D = tr d/dt < 0);   - rho l b1 c D in expansion where that is wanted
///   directional   - sigma_q = sum_k q_k s_k s_k^T,   q_k the same of the principal rates D_k in the directions s_k of the mesh, psi b1 for b1
///
/// with the length l of a cell, over its degree, in the direction of straining: l = |d|/|A d|, A = d xi/d x, in the directional form with
/// what is compressed of d. Straining of a brick along a side finds its side, and both forms are one there. The linear term takes
/// sqrt(dim)/|A| where that is shorter: with l alone it would be steered by the smallest motions across slender cells, which it then
/// excites. psi = min(1, |tr d|/max |d_k|) leaves the first order of motions alone that keep the volume, such as shear.
///
/// What the directional form does not see: compression in the directions around an axis or a centre, which no mesh resolves. One length
/// and sums over principal directions make it an isotropic function of d, continuous where rates are equal. Tensor forms: Campbell &
/// Shashkov, J. Comput. Phys. 172 (2001) 739-765; Kolev & Rieben, J. Comput. Phys. 228 (2009) 8336-8366, whose lengths are of each direction.
template <int dim, typename V>
struct BulkViscosity
{
  using Shape = PresentShape<dim, V>;

  const ElementChoice &element;
  V                    density, wave_speed;
  double               length_of_unit;  ///< of the reference coordinate between neighbouring nodes
  V                    largest = V(0.); ///< kinematic viscosity for small changes of the rates so far [m^2/s]

  ARENITE_INLINE V volumetric(const SymTensor<V> &strain, const V &D, const V (&A)[dim][dim])
  {
    return pressure(D, V(V(length_of_unit) * Shape::length_along(strain, A)),
                    V(V(length_of_unit) * Shape::mean_length(A)), V(1.));
  }

  /// Not inline: blocks with the other form would pay for its registers, 6 % of a step of a cheap law.
  __attribute__((noinline)) SymTensor<V> directional(const SymTensor<V> &strain, const double dt,
                                                     const V (&A)[dim][dim])
  {
    V d[dim][dim], s[dim][dim], acting[dim], q[dim];
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        d[i][j] = strain[index(i, j)];
    principal_directions(d, s);
    V steepest = V(1e-200);
    for (int k = 0; k < dim; ++k)
      {
        steepest  = Arenite::max<V>(steepest, Arenite::absolute<V>(d[k][k]));
        acting[k] = element.viscosity_in_expansion ? d[k][k] : Arenite::min<V>(d[k][k], V(0.));
      }
    const V psi      = Arenite::min<V>(V(1.), V(Arenite::absolute<V>(trace(strain)) / steepest)),
            l        = V(length_of_unit) * Shape::length_along(composed(acting, s), A),
            shortest = V(length_of_unit) * Shape::mean_length(A);
    for (int k = 0; k < dim; ++k)
      q[k] = pressure(V(acting[k] * V(1. / dt)), l, shortest, psi);
    return composed(q, s);
  }

private:
  static constexpr int index(const int i, const int j) { return i == j ? i : 2 + i + j; } ///< component of SymTensor

  /// sum_k of_k s_k s_k^T
  static ARENITE_INLINE SymTensor<V> composed(const V (&of)[dim], const V (&s)[dim][dim])
  {
    SymTensor<V> result;
    for (int k = 0; k < dim; ++k)
      for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j)
          result[index(i, j)] += of[k] * s[i][k] * s[j][k];
    return result;
  }

  /// Over a rate D, for the length l of a cell whose shorter ones are @p shortest, with @p part of the linear term.
  ARENITE_INLINE V pressure(const V &D, const V &l, const V &shortest, const V &part)
  {
    const double b1 = element.linear_viscosity, b2 = element.quadratic_viscosity;
    const auto   compression = D < V(0.);
    const V      linear      = density * Arenite::min<V>(l, shortest) * V(b1) * wave_speed,
            quadratic        = density * V(b2 * b2) * l * l;
    const V limit            = (linear + Arenite::select<V>(compression, V(V(-2.) * quadratic * D), V(0.))) / density;
    largest                  = Arenite::max<V>(largest, limit);
    return Arenite::select<V>(compression, V((quadratic * -D + part * linear) * -D),
                              V(V(element.viscosity_in_expansion ? -1. : 0.) * part * linear * D));
  }
};

/// - sigma_q of the point at @p at, its place times the lanes, of which PointData keep @p n numbers: q I, or the tensor.
template <typename V>
ARENITE_INLINE SymTensor<V> viscous_stress(const PointData &points, const unsigned int n, const std::size_t at)
{
  if (n == 1)
    return spherical(load<V>(&points.bulk_viscosity[at]));
  SymTensor<V> result;
  for (int k = 0; k < 6; ++k)
    result[k] = load<V>(&points.bulk_viscosity[6 * at + k * n_lanes<V>()]);
  return result;
}

/// What is shown of a point: q, or - tr sigma_q, which is q where one direction is compressed.
inline double shown_viscosity(const PointData &points, const unsigned int n, const std::size_t point,
                              const unsigned int lanes, const unsigned int lane)
{
  double sum = 0.;
  for (unsigned int k = 0; k < std::min(n, 3u); ++k)
    sum += points.bulk_viscosity[(n * point + k) * lanes + lane];
  return sum;
}
} // namespace Arenite
