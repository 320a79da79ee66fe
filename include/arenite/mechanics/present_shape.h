#pragma once

#include <arenite/base/tensor_tools.h>
#include <arenite/mechanics/elastic_element.h>

namespace Arenite
{
/// Size and shape of a cell at a point, from the metric d xi/d X of its reference position and the displacement gradient H there.
template <int dim, typename V>
struct PresentShape
{
  /// F = I + H
  static ARENITE_INLINE void deformation(const V (&H)[dim][dim], V (&F)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        F[i][j] = H[i][j] + V(i == j ? 1. : 0.);
  }

  /// A = d xi/d x on the deformed shape, d xi/d X at small strain.
  static ARENITE_INLINE void metric(const V (&reference)[dim][dim], const V (&H)[dim][dim], const bool finite,
                                    V (&A)[dim][dim])
  {
    if (!finite)
      {
        for (int k = 0; k < dim; ++k)
          for (int j = 0; j < dim; ++j)
            A[k][j] = reference[k][j];
        return;
      }
    V F[dim][dim], C[dim][dim];
    deformation(H, F);
    const V inverse = V(1.) / cofactors(F, C);
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j)
        {
          V sum = reference[k][0] * C[j][0]; // F^-1_Jj = C_jJ/det
          for (int i = 1; i < dim; ++i)
            sum += reference[k][i] * C[j][i];
          A[k][j] = sum * inverse;
        }
  }

  /// N = J F^-T, which turns areas of the reference shape into present ones, dA = N dA_0, with the @p n_hoop directions around the
  /// axis or centre, whose displacement gradient is @p h; I at small strain.
  static ARENITE_INLINE void turned_areas(const V (&H)[dim][dim], const V &h, const int n_hoop, const bool finite,
                                          V (&N)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        N[i][j] = V(i == j ? 1. : 0.);
    if (!finite)
      return;
    V F[dim][dim];
    deformation(H, F);
    cofactors(F, N);
    for (int k = 0; k < n_hoop; ++k)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          N[i][j] = N[i][j] * (V(1.) + h);
  }

  static ARENITE_INLINE V square_norm(const V (&a)[dim][dim])
  {
    V sum = V(0.);
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j)
        sum += a[k][j] * a[k][j];
    return sum;
  }

  /// sqrt(dim)/|A|: the side of a cube, the shorter ones of a slender cell.
  static ARENITE_INLINE V mean_length(const V (&A)[dim][dim])
  {
    return square_root(V(V(double(dim)) / square_norm(A)));
  }

  /// |d|/|A d| of the reference coordinate's unit: how long the cell is in the direction of straining. Uniaxial straining along an edge
  /// of a brick gives that edge.
  static ARENITE_INLINE V length_along(const SymTensor<V> &strain, const V (&A)[dim][dim])
  {
    const auto d = [&](const int i, const int j) { return strain[i == j ? i : 2 + i + j]; };
    V straining = V(1e-200), across = V(1e-200) * square_norm(A); // without any strain the direction does not matter
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j)
        {
          V sum = A[k][0] * d(0, j);
          for (int i = 1; i < dim; ++i)
            sum += A[k][i] * d(i, j);
          straining += d(k, j) * d(k, j);
          across += sum * sum;
        }
    return square_root(V(straining / across));
  }
};
} // namespace Arenite
