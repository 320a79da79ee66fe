#pragma once

#include <arenite/mechanics/elastic_element.h>

namespace Arenite
{
constexpr int power(const int base, const int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

/// Multilinear cells in mode space: the 2^dim nodal values of a field become 2^dim times the coefficients of 1, x, y, xy, z, xz, yz,
/// xyz in the reference coordinates of [-1,1]^dim (a Walsh-Hadamard transform, 24 additions in three dimensions). Nodes are
/// lexicographic, index = ix + 2 iy + 4 iz, and bit d of the number of a mode says whether it contains coordinate d.
template <int dim>
struct MultilinearModes
{
  static constexpr int n = power(2, dim);

  template <typename V>
  static ARENITE_INLINE void transform(V *f)
  {
    for (int s = 1; s < n; s *= 2)
      for (int i = 0; i < n; ++i)
        if (!(i & s))
          {
            const V a = f[i], b = f[i | s];
            f[i]     = a + b;
            f[i | s] = b - a;
          }
  }

  /// Nodal forces from modal forces: f_I = sum_m phi_m(xi_I) f_m.
  template <typename V>
  static ARENITE_INLINE void transpose(V *f)
  {
    for (int s = 1; s < n; s *= 2)
      for (int i = 0; i < n; ++i)
        if (!(i & s))
          {
            const V a = f[i], b = f[i | s];
            f[i]     = a - b;
            f[i | s] = a + b;
          }
  }
};
using TrilinearModes = MultilinearModes<3>;

template <typename V>
ARENITE_INLINE void add_cross(const V *a, const V *b, const V &s, V *c)
{
  c[0] += s * (a[1] * b[2] - a[2] * b[1]);
  c[1] += s * (a[2] * b[0] - a[0] * b[2]);
  c[2] += s * (a[0] * b[1] - a[1] * b[0]);
}

/// Hexahedron, quadrilateral or segment with 2^dim Gauss points.
template <int dim_, int n_hoop_ = 0>
struct FullElement
{
  static constexpr int  dim = dim_, degree = 1, n_hoop = n_hoop_, n_nodes = power(2, dim), n_patterns = 1;
  static constexpr int  n_lines               = n_nodes / 2; ///< of Gauss points, along one direction
  static constexpr bool has_hourglass_control = false, mean_dilatation = false, has_gauss_points = true;
  using Modes = MultilinearModes<dim>;

  /// 3^(-k/2) 2^-dim for a mode with k coordinates that are taken at Gauss points.
  static constexpr double scale_of(const int mode)
  {
    const int    k = (mode & 1) + (mode >> 1 & 1) + (mode >> 2 & 1);
    const double s = 1. / n_nodes, root = 1.7320508075688772935;
    return k == 0 ? s : (k == 1 ? s / root : (k == 2 ? s / 3. : s / (3. * root)));
  }

  /// Number with the bits of @p line at all places but @p k, where there is a zero.
  static constexpr int without(const int k, const int line)
  {
    const int below = (1 << k) - 1;
    return (line & below) | ((line & ~below) << 1);
  }

  /// d field / d xi_k on [-1,1]^dim at the Gauss points; along k it is constant, so one value per line of points does, in the order of
  /// the other directions.
  template <typename V>
  static ARENITE_INLINE void reference_gradient(const V *m, V (&g)[dim][n_lines])
  {
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k)
      {
#pragma GCC unroll 4
        for (int line = 0; line < n_lines; ++line)
          g[k][line] = scale_of(without(k, line)) * m[without(k, line) | 1 << k];
#pragma GCC unroll 2
        for (int s = 1; s < n_lines; s *= 2)
#pragma GCC unroll 4
          for (int i = 0; i < n_lines; ++i)
            if (!(i & s))
              {
                const V a = g[k][i], b = g[k][i | s];
                g[k][i]     = a - b;
                g[k][i | s] = a + b;
              }
      }
  }
  template <typename V>
  static ARENITE_INLINE void reference_gradient_transpose(const V (&g)[dim][n_lines], V *m)
  {
    m[0] = V(0.);
#pragma GCC unroll 3
    for (int k = 0; k < dim; ++k)
      {
        V h[n_lines];
#pragma GCC unroll 4
        for (int line = 0; line < n_lines; ++line)
          h[line] = g[k][line];
#pragma GCC unroll 2
        for (int s = n_lines / 2; s > 0; s /= 2)
#pragma GCC unroll 4
          for (int i = 0; i < n_lines; ++i)
            if (!(i & s))
              {
                const V a = h[i], b = h[i | s];
                h[i]     = a + b;
                h[i | s] = b - a;
              }
#pragma GCC unroll 4
        for (int line = 0; line < n_lines; ++line)
          {
            const int mode = without(k, line) | 1 << k;
            const V   part = scale_of(without(k, line)) * h[line];
            if ((mode & ((1 << k) - 1)) == 0) // the first direction in this mode
              m[mode] = part;
            else
              m[mode] += part;
          }
      }
  }

  /// Values of a field at the Gauss points, and their transpose, which adds.
  template <typename V>
  static ARENITE_INLINE void point_values(const V *m, V (&v)[n_nodes])
  {
    for (int i = 0; i < n_nodes; ++i)
      v[i] = scale_of(i) * m[i];
    Modes::transpose(v);
  }
  template <typename V>
  static ARENITE_INLINE void add_point_values_transpose(V (&v)[n_nodes], V *m)
  {
    Modes::transform(v);
    for (int i = 0; i < n_nodes; ++i)
      m[i] += scale_of(i) * v[i];
  }

  /// Which of the values of each direction belongs to Gauss point q = ix + 2 iy + 4 iz.
  static ARENITE_INLINE void point_index(const int q, int (&o)[dim])
  {
    for (int k = 0; k < dim; ++k)
      o[k] = (q & ((1 << k) - 1)) | (q >> (k + 1) << k);
  }

  /// Derivatives of the coordinates along the lines of Gauss points, and the first coordinate at the points.
  template <typename V>
  struct PointGeometry
  {
    V gx[dim][dim][n_lines], r[n_nodes];

    explicit ARENITE_INLINE PointGeometry(const V (&x)[dim][n_nodes])
    {
      for (int i = 0; i < dim; ++i)
        {
          V modes[n_nodes];
          for (int n = 0; n < n_nodes; ++n)
            modes[n] = x[i][n];
          Modes::transform(modes);
          reference_gradient(modes, gx[i]);
          if (i == 0)
            point_values(modes, r);
        }
    }

    /// Cofactors of the Jacobian at point @p q; returns det(J).
    ARENITE_INLINE V cofactors_at(const int q, V (&C)[dim][dim]) const
    {
      int o[dim];
      point_index(q, o);
      V J[dim][dim];
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          J[i][k] = gx[i][k][o[k]];
      return cofactors(J, C);
    }
  };

  template <bool with_energy, typename V>
  static ARENITE_INLINE void internal_force(const V (&x)[dim][n_nodes], V (&u)[dim][n_nodes],
                                            const ElasticModuli &moduli, ElementEnergy<V> &energy)
  {
    const PointGeometry<V> geometry(x);
    V                      gu[dim][dim][n_lines], gf[dim][dim][n_lines];
    V                      u_r[n_nodes]; // at the points; then the hoop force there
    for (int i = 0; i < dim; ++i)
      {
        Modes::transform(u[i]);
        reference_gradient(u[i], gu[i]);
        if constexpr (n_hoop > 0)
          if (i == 0)
            point_values(u[i], u_r);
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < n_lines; ++l)
            gf[i][k][l] = V(0.);
      }
#pragma GCC unroll 8
    for (int q = 0; q < n_nodes; ++q)
      {
        int o[dim];
        point_index(q, o);
        V       C[dim][dim];
        const V det   = geometry.cofactors_at(q, C);
        V       scale = V(1.) / det;
        if constexpr (n_hoop > 0)
          scale *= measure<n_hoop>(geometry.r[q]);
        V gradient[dim][dim], stress[dim][dim], hoop = V(0.),
                                                hoop_stress = V(0.); // gradient and hoop strain carry det(J)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              gradient[i][j] = gu[i][0][o[0]] * C[j][0];
              for (int d = 1; d < dim; ++d)
                gradient[i][j] += gu[i][d][o[d]] * C[j][d];
            }
        if constexpr (n_hoop > 0)
          hoop = det * u_r[q] / geometry.r[q];
        elastic_stress<n_hoop>(gradient, hoop, scale, moduli, stress, hoop_stress);
        if constexpr (with_energy)
          energy.strain += V(0.5) * contract(stress, gradient);
        if constexpr (n_hoop > 0)
          {
            if constexpr (with_energy)
              energy.strain += V(0.5 * n_hoop) * hoop_stress * hoop;
            u_r[q] = V(-double(n_hoop)) * hoop_stress * det / geometry.r[q];
          }
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            {
              V sum = stress[i][0] * C[0][k];
              for (int j = 1; j < dim; ++j)
                sum += stress[i][j] * C[j][k];
              gf[i][k][o[k]] -= sum;
            }
      }
    for (int i = 0; i < dim; ++i)
      {
        reference_gradient_transpose(gf[i], u[i]);
        if constexpr (n_hoop > 0)
          if (i == 0)
            add_point_values_transpose(u_r, u[0]);
        Modes::transpose(u[i]);
      }
  }

  /// visit(q, det, C, r) at the Gauss points: det(J), the cofactors C_id = det(J) d xi_d / d x_i of the Jacobian, and the first
  /// coordinate.
  template <typename V, typename Visit>
  static void for_each_gauss_point(const V (&x)[dim][n_nodes], const Visit &visit)
  {
    const PointGeometry<V> geometry(x);
    for (int q = 0; q < n_nodes; ++q)
      {
        V       C[dim][dim];
        const V det = geometry.cofactors_at(q, C);
        visit(q, det, C, geometry.r[q]);
      }
  }

  /// Row sums of the consistent mass over the density: integral of m N_i [m^3], by Gauss quadrature (exact).
  template <typename V>
  static void nodal_volume(const V (&x)[dim][n_nodes], V (&volume)[n_nodes])
  {
    const double near = 0.5 + 0.5 / 1.7320508075688772935, far = 1. - near;
    for (int n = 0; n < n_nodes; ++n)
      volume[n] = V(0.);
    for_each_gauss_point(x, [&](const int q, const V &det, const V(&)[dim][dim], const V &r) {
      for (int n = 0; n < n_nodes; ++n)
        {
          double N = 1.;
          for (int b = 1; b < n_nodes; b *= 2)
            N *= ((n & b) == (q & b)) ? near : far;
          volume[n] += N * det * measure<n_hoop>(r);
        }
    });
  }

  /// Largest squared Frobenius norm of the inverse Jacobian over the Gauss points [1/m^2]: how small the cell is.
  template <typename V>
  static V inverse_size_squared(const V (&x)[dim][n_nodes])
  {
    V largest = V(0.);
    for_each_gauss_point(x, [&](const int, const V &det, const V(&C)[dim][dim], const V &) {
      V sum = V(0.);
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k)
          sum += C[i][k] * C[i][k];
      largest = max(largest, sum / (det * det));
    });
    return largest;
  }
};
using FullHexahedron = FullElement<3>;

/// Modes that carry a mean gradient, and patterns that do not and need control.
template <int dim>
struct OnePointModes;
template <>
struct OnePointModes<1>
{
  static constexpr int n = 1, n_patterns = 1, mode[n] = {1};
  static constexpr int pattern[n_patterns] = {1}; ///< none: the only mode is controlled by its strain
};
template <>
struct OnePointModes<2>
{
  static constexpr int n = 3, n_patterns = 1, mode[n] = {1, 2, 3};
  static constexpr int pattern[n_patterns] = {3};
};
template <>
struct OnePointModes<3>
{
  static constexpr int n = 6, n_patterns = 4,
                       mode[n]             = {1, 2, 4, 6, 5, 3}; ///< x, y, z, and each the product of the others
  static constexpr int pattern[n_patterns] = {6, 5, 3, 7};
};

/// Cell with one stress point: the uniform (volume-averaged) gradient, integrated exactly, and hourglass control that is
/// orthogonal to linear fields. Flanagan & Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679-706.
///
/// In mode space the derivative of the volume with respect to the linear modes a_k and bilinear modes h_k of the coordinates of a
/// hexahedron (k,i,j cyclic) is closed:  g(a_k) = 8 [a_i x a_j + (1/3) h_j x h_i],  g(h_k) = (8/3) [a_j x h_i - a_i x h_j],
/// g(xyz) = 0. In fewer dimensions the Gauss points of FullElement average exactly, gradients and the hoop strain
/// (1/V) integral of m u_r/r dx. A segment has no patterns.
template <int dim_, int n_hoop_ = 0>
struct OnePointElement
{
  using Full                = FullElement<dim_, n_hoop_>;
  using M                   = MultilinearModes<dim_>;
  using Own                 = OnePointModes<dim_>;
  static constexpr int  dim = dim_, degree = 1, n_hoop = n_hoop_, n_nodes = M::n;
  static constexpr int  n_patterns            = Own::n_patterns; ///< without a mean gradient, in each direction
  static constexpr bool has_hourglass_control = dim > 1, mean_dilatation = false, has_gauss_points = false;

  /// g[m][j] = integral of d phi_m/d x_j dV for the modes that carry a gradient, t[m] = integral of phi_m/r dV for all modes.
  template <typename V>
  static ARENITE_INLINE void uniform_gradient(const V (&nodes)[dim][n_nodes], const V (&x)[dim][n_nodes],
                                              V (&g)[Own::n][dim], V (&t)[n_nodes], V &volume)
  {
    if constexpr (dim == 3)
      {
        V a[3][3], h[3][3];
        for (int d = 0; d < 3; ++d)
          for (int k = 0; k < 3; ++k)
            {
              a[k][d] = x[d][Own::mode[k]];
              h[k][d] = x[d][Own::mode[3 + k]];
            }
        const V third = V(1. / 3.);
        for (int k = 0; k < 3; ++k)
          {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            for (int l = 0; l < 3; ++l)
              g[k][l] = g[3 + k][l] = V(0.);
            add_cross(a[i], a[j], V(1.), g[k]);
            add_cross(h[j], h[i], third, g[k]);
            add_cross(a[j], h[i], third, g[3 + k]);
            add_cross(a[i], h[j], V(-1. / 3.), g[3 + k]);
          }
        volume = V(0.);
        for (int k = 0; k < 6; ++k)
          for (int l = 0; l < 3; ++l)
            g[k][l] = g[k][l] * V(0.125); // coordinate modes carry a factor 8: 8/64
        for (int k = 0; k < 3; ++k)
          volume += a[k][0] * g[k][0] + h[k][0] * g[3 + k][0];
        volume = volume * V(0.125);
        (void)nodes, (void)t;
      }
    else
      {
        volume = V(0.);
        for (int m = 0; m < Own::n; ++m)
          for (int j = 0; j < dim; ++j)
            g[m][j] = V(0.);
        for (int m = 0; m < n_nodes; ++m)
          t[m] = V(0.);
        const double at = 1. / 1.7320508075688772935;
        Full::for_each_gauss_point(nodes, [&](const int q, const V &det, const V(&C)[dim][dim], const V &r) {
          const V      w     = measure<n_hoop>(r);
          const double xi[2] = {q & 1 ? at : -at, q & 2 ? at : -at};
          volume += w * det;
          for (int j = 0; j < dim; ++j)
            {
              for (int k = 0; k < dim; ++k)
                g[k][j] += w * C[j][k];
              if constexpr (dim == 2)
                g[2][j] += w * (xi[1] * C[j][0] + xi[0] * C[j][1]);
            }
          if constexpr (n_hoop > 0)
            {
              const V over_r = w * det / r;
              for (int m = 0; m < n_nodes; ++m)
                t[m] += ((m & 1 ? xi[0] : 1.) * (m & 2 ? xi[1] : 1.)) * over_r;
            }
        });
        (void)x;
      }
  }

  /// In addition to FullElement::internal_force, @p v: the velocities, consumed, and @p Q: the force amplitude on each pattern,
  /// those of the last call in, those of this call out. Both are read only with a viscous hourglass control.
  template <bool with_energy, bool viscous, typename V>
  static ARENITE_INLINE void internal_force(const V (&nodes)[dim][n_nodes], V (&u)[dim][n_nodes], V (&v)[dim][n_nodes],
                                            V (&Q)[dim][n_patterns], const ElasticModuli &moduli,
                                            ElementEnergy<V> &energy)
  {
    constexpr double s = 1. / n_nodes; // modes carry a factor 2^dim
    V                x[dim][n_nodes], g[Own::n][dim], t[n_nodes], volume;
    for (int d = 0; d < dim; ++d)
      {
        for (int n = 0; n < n_nodes; ++n)
          x[d][n] = nodes[d][n];
        M::transform(x[d]);
        M::transform(u[d]);
        if constexpr (viscous)
          M::transform(v[d]);
      }
    uniform_gradient(nodes, x, g, t, volume);
    const V inverse_volume = V(1.) / volume;

    const auto mean_gradient = [&](const V(&w)[dim][n_nodes], V(&G)[dim][dim]) {
      const V scale = V(s) * inverse_volume;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            V sum = w[i][Own::mode[0]] * g[0][j];
            for (int m = 1; m < Own::n; ++m)
              sum += w[i][Own::mode[m]] * g[m][j];
            G[i][j] = sum * scale;
          }
    };
    // amplitude of hourglass pattern a: the mode less what a linear field has in it on this cell's shape
    const auto hourglass = [&](const V(&w)[dim][n_nodes], const V(&G)[dim][dim], const int i, const int a) {
      const int m   = Own::pattern[a];
      V         sum = G[i][0] * x[0][m];
      for (int d = 1; d < dim; ++d)
        sum += G[i][d] * x[d][m];
      return w[i][m] - sum;
    };

    V gradient[dim][dim], stress[dim][dim], hoop = V(0.), hoop_stress = V(0.);
    mean_gradient(u, gradient);
    if constexpr (n_hoop > 0)
      {
        hoop = t[0] * u[0][0];
        for (int m = 1; m < n_nodes; ++m)
          hoop += t[m] * u[0][m];
        hoop *= V(s) * inverse_volume;
      }
    elastic_stress<n_hoop>(gradient, hoop, V(1.), moduli, stress, hoop_stress);
    if constexpr (with_energy)
      energy.strain += V(0.5) * volume * contract(stress, gradient);
    if constexpr (with_energy && n_hoop > 0)
      energy.strain += V(0.5 * n_hoop) * volume * hoop_stress * hoop;

    // stabilisation: force amplitude Q_ia on pattern a in direction i
    if constexpr (has_hourglass_control)
      {
        V sum = V(0.); // 12 h^4 for a cube of side h, 8 h^2 for a square
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            sum += g[k][l] * g[k][l];
        if constexpr (viscous)
          {
            V G[dim][dim];
            mean_gradient(v, G);
            const V c = V(16. * s * s * moduli.hourglass_viscosity) * square_root(sum * V(1. / (4. * dim)));
            for (int i = 0; i < dim; ++i)
              for (int a = 0; a < n_patterns; ++a)
                {
                  const V rate = hourglass(v, G, i, a), force = c * rate;
                  energy.viscous += V(0.5) * (Q[i][a] + force) * rate;
                  Q[i][a] = force;
                }
          }
        else
          {
            const V k = V(moduli.hourglass_stiffness * (moduli.lambda + 2. * moduli.mu) * s * s) * sum * inverse_volume;
            for (int i = 0; i < dim; ++i)
              for (int a = 0; a < n_patterns; ++a)
                {
                  const V q = hourglass(u, gradient, i, a);
                  Q[i][a]   = k * q;
                  if constexpr (with_energy)
                    energy.hourglass += V(0.5) * Q[i][a] * q;
                }
          }
      }

    V P[dim][dim]; // modal force per unit g: stress and the reaction of the hourglass force on the mean gradient
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        if constexpr (has_hourglass_control)
          {
            V reaction = Q[i][0] * x[j][Own::pattern[0]];
            for (int a = 1; a < n_patterns; ++a)
              reaction += Q[i][a] * x[j][Own::pattern[a]];
            P[i][j] = V(-s) * (stress[i][j] - inverse_volume * reaction);
          }
        else
          P[i][j] = V(-s) * stress[i][j];
    for (int i = 0; i < dim; ++i)
      {
        for (int n = 0; n < n_nodes; ++n)
          u[i][n] = V(0.);
        for (int m = 0; m < Own::n; ++m)
          {
            V sum = P[i][0] * g[m][0];
            for (int j = 1; j < dim; ++j)
              sum += P[i][j] * g[m][j];
            u[i][Own::mode[m]] = sum;
          }
        if constexpr (has_hourglass_control)
          for (int a = 0; a < n_patterns; ++a)
            u[i][Own::pattern[a]] -= Q[i][a];
        if constexpr (n_hoop > 0)
          if (i == 0)
            for (int m = 0; m < n_nodes; ++m)
              u[0][m] -= V(s * n_hoop) * hoop_stress * t[m];
        M::transpose(u[i]);
      }
    (void)v, (void)Q;
  }
  template <bool with_energy, typename V>
  static ARENITE_INLINE void internal_force(const V (&nodes)[dim][n_nodes], V (&u)[dim][n_nodes],
                                            const ElasticModuli &moduli, ElementEnergy<V> &energy)
  {
    static_assert(!has_hourglass_control);
    V unused_v[dim][n_nodes], unused_Q[dim][n_patterns];
    internal_force<with_energy, false>(nodes, u, unused_v, unused_Q, moduli, energy);
  }

  template <typename V>
  static void nodal_volume(const V (&x)[dim][n_nodes], V (&volume)[n_nodes])
  {
    Full::nodal_volume(x, volume);
  }
  template <typename V>
  static V inverse_size_squared(const V (&x)[dim][n_nodes])
  {
    return Full::inverse_size_squared(x);
  }
};
using OnePointHexahedron = OnePointElement<3>;
} // namespace Arenite
