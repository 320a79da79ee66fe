#pragma once

#include <arenite/base/number.h>
#include <arenite/mechanics/elastic_element.h>

namespace Arenite
{
/// Trilinear hexahedra in mode space: the eight nodal values of a field become eight times the coefficients of
/// 1, x, y, xy, z, xz, yz, xyz in the reference coordinates of [-1,1]^3 (a Walsh-Hadamard transform, 24 additions).
/// Nodes are lexicographic: index = ix + 2 iy + 4 iz.
struct TrilinearModes
{
  enum : int
  {
    x   = 1,
    y   = 2,
    xy  = 3,
    z   = 4,
    xz  = 5,
    yz  = 6,
    xyz = 7
  };
  static constexpr int linear[3]    = {x, y, z};
  static constexpr int bilinear[3]  = {yz, xz, xy}; ///< the mode without the direction of linear[k]
  static constexpr int hourglass[4] = {yz, xz, xy, xyz};

  template <typename V>
  static ARENITE_INLINE void transform(V *n)
  {
    for (int s = 1; s < 8; s *= 2)
      for (int i = 0; i < 8; ++i)
        if (!(i & s))
          {
            const V a = n[i], b = n[i | s];
            n[i]     = a + b;
            n[i | s] = b - a;
          }
  }

  /// Nodal forces from modal forces: f_I = sum_m phi_m(xi_I) f_m.
  template <typename V>
  static ARENITE_INLINE void transpose(V *n)
  {
    for (int s = 1; s < 8; s *= 2)
      for (int i = 0; i < 8; ++i)
        if (!(i & s))
          {
            const V a = n[i], b = n[i | s];
            n[i]     = a - b;
            n[i | s] = a + b;
          }
  }
};

template <typename V>
ARENITE_INLINE void add_cross(const V *a, const V *b, const V &s, V *c)
{
  c[0] += s * (a[1] * b[2] - a[2] * b[1]);
  c[1] += s * (a[2] * b[0] - a[0] * b[2]);
  c[2] += s * (a[0] * b[1] - a[1] * b[0]);
}

/// Hexahedron with 2x2x2 Gauss points.
struct FullHexahedron
{
  static constexpr int  dim = 3, n_nodes = 8;
  static constexpr bool has_hourglass_control = false;

  /// d field / d xi_k on [-1,1]^3 at the Gauss points; along k it is constant, so four values do: point (i,j) of the two
  /// other directions in ascending order.
  template <typename V>
  static ARENITE_INLINE void reference_gradient(const V *m, V (&g)[3][4])
  {
    using M         = TrilinearModes;
    const double  s = 0.125, t = 0.125 / 1.7320508075688772935, t2 = 0.125 / 3.;
    constexpr int c0[3] = {M::x, M::y, M::z}, c1[3] = {M::xy, M::xy, M::xz}, c2[3] = {M::xz, M::yz, M::yz};
    for (int k = 0; k < 3; ++k)
      {
        const V a = s * m[c0[k]], b = t * m[c1[k]], c = t * m[c2[k]], e = t2 * m[M::xyz];
        const V am = a - b, ap = a + b, cm = c - e, cp = c + e;
        g[k][0] = am - cm;
        g[k][1] = ap - cp;
        g[k][2] = am + cm;
        g[k][3] = ap + cp;
      }
  }
  template <typename V>
  static ARENITE_INLINE void reference_gradient_transpose(const V (&g)[3][4], V *m)
  {
    using M        = TrilinearModes;
    const double s = 0.125, t = 0.125 / 1.7320508075688772935, t2 = 0.125 / 3.;
    V            A[3], B[3], C[3], E[3];
    for (int k = 0; k < 3; ++k)
      {
        const V p = g[k][0] + g[k][2], q = g[k][1] + g[k][3], r = g[k][2] - g[k][0], w = g[k][3] - g[k][1];
        A[k] = s * (p + q);
        B[k] = t * (q - p);
        C[k] = t * (w + r);
        E[k] = t2 * (w - r);
      }
    m[0]      = V(0.);
    m[M::x]   = A[0];
    m[M::y]   = A[1];
    m[M::z]   = A[2];
    m[M::xy]  = B[0] + B[1];
    m[M::xz]  = C[0] + B[2];
    m[M::yz]  = C[1] + C[2];
    m[M::xyz] = E[0] + E[1] + E[2];
  }

  /// Which of the four values of each direction belongs to Gauss point q = ix + 2 iy + 4 iz.
  static ARENITE_INLINE void point_index(const int q, int (&o)[3])
  {
    const int ix = q & 1, iy = (q >> 1) & 1, iz = q >> 2;
    o[0] = iy + 2 * iz;
    o[1] = ix + 2 * iz;
    o[2] = ix + 2 * iy;
  }

  template <bool with_energy, typename V>
  static ARENITE_INLINE void internal_force(const V (&x)[3][8], V (&u)[3][8], const ElasticModuli &moduli,
                                            ElementEnergy<V> &energy)
  {
    V gx[3][3][4], gu[3][3][4], gf[3][3][4];
    for (int i = 0; i < 3; ++i)
      {
        V modes[8];
        for (int n = 0; n < 8; ++n)
          modes[n] = x[i][n];
        TrilinearModes::transform(modes);
        reference_gradient(modes, gx[i]);
        TrilinearModes::transform(u[i]);
        reference_gradient(u[i], gu[i]);
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 4; ++l)
            gf[i][k][l] = V(0.);
      }
#pragma GCC unroll 8
    for (int q = 0; q < 8; ++q)
      {
        int o[3];
        point_index(q, o);
        V J[3][3], C[3][3];
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            J[i][k] = gx[i][k][o[k]];
        const V scale = V(1.) / cofactors(J, C);
        V       gradient[3][3], stress[3][3]; // gradient carries det(J)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            gradient[i][j] = gu[i][0][o[0]] * C[j][0] + gu[i][1][o[1]] * C[j][1] + gu[i][2][o[2]] * C[j][2];
        elastic_stress(gradient, scale, moduli, stress);
        if constexpr (with_energy)
          energy.strain += V(0.5) * contract(stress, gradient);
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            gf[i][k][o[k]] -= stress[i][0] * C[0][k] + stress[i][1] * C[1][k] + stress[i][2] * C[2][k];
      }
    for (int i = 0; i < 3; ++i)
      {
        reference_gradient_transpose(gf[i], u[i]);
        TrilinearModes::transpose(u[i]);
      }
  }

  /// visit(q, det, C) at the Gauss points: det(J) and the cofactors C_id = det(J) d xi_d / d x_i of the Jacobian.
  template <typename V, typename Visit>
  static void for_each_gauss_point(const V (&x)[3][8], const Visit &visit)
  {
    V gx[3][3][4];
    for (int i = 0; i < 3; ++i)
      {
        V modes[8];
        for (int n = 0; n < 8; ++n)
          modes[n] = x[i][n];
        TrilinearModes::transform(modes);
        reference_gradient(modes, gx[i]);
      }
    for (int q = 0; q < 8; ++q)
      {
        int o[3];
        point_index(q, o);
        V J[3][3], C[3][3];
        for (int i = 0; i < 3; ++i)
          for (int k = 0; k < 3; ++k)
            J[i][k] = gx[i][k][o[k]];
        const V det = cofactors(J, C);
        visit(q, det, C);
      }
  }

  /// Row sums of the consistent mass over the density: integral of N_i [m^3], 2x2x2 Gauss (exact).
  template <typename V>
  static void nodal_volume(const V (&x)[3][8], V (&volume)[8])
  {
    const double near = 0.5 + 0.5 / 1.7320508075688772935, far = 1. - near;
    for (int n = 0; n < 8; ++n)
      volume[n] = V(0.);
    for_each_gauss_point(x, [&](const int q, const V &det, const V(&)[3][3]) {
      for (int n = 0; n < 8; ++n)
        {
          double N = 1.;
          for (int b = 1; b < 8; b *= 2)
            N *= ((n & b) == (q & b)) ? near : far;
          volume[n] += N * det;
        }
    });
  }

  /// Largest squared Frobenius norm of the inverse Jacobian over the Gauss points [1/m^2]: how small the cell is.
  template <typename V>
  static V inverse_size_squared(const V (&x)[3][8])
  {
    V largest = V(0.);
    for_each_gauss_point(x, [&](const int, const V &det, const V(&C)[3][3]) {
      V sum = V(0.);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          sum += C[i][k] * C[i][k];
      largest = max(largest, sum / (det * det));
    });
    return largest;
  }
};

/// Hexahedron with one stress point: the uniform (volume-averaged) gradient, integrated exactly, and hourglass control that is
/// orthogonal to linear fields. Flanagan & Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679-706.
///
/// In mode space the derivative of the volume with respect to the linear modes a_k and bilinear modes h_k of the coordinates
/// (k,i,j cyclic) is closed:  g(a_k) = 8 [a_i x a_j + (1/3) h_j x h_i],  g(h_k) = (8/3) [a_j x h_i - a_i x h_j],  g(xyz) = 0.
struct OnePointHexahedron
{
  static constexpr int  dim = 3, n_nodes = 8;
  static constexpr bool has_hourglass_control = true;

  template <typename V>
  static ARENITE_INLINE void uniform_gradient(const V (&x)[3][8], V (&g)[6][3], V &volume)
  {
    V a[3][3], h[3][3];
    for (int d = 0; d < 3; ++d)
      for (int k = 0; k < 3; ++k)
        {
          a[k][d] = x[d][TrilinearModes::linear[k]];
          h[k][d] = x[d][TrilinearModes::bilinear[k]];
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
  }

  /// Patterns without a mean gradient, in each direction.
  static constexpr int n_patterns = 4;

  /// In addition to FullHexahedron::internal_force, @p v: the velocities, consumed, and @p Q: the force amplitude on each pattern,
  /// those of the last call in, those of this call out. Both are read only with a viscous hourglass control.
  template <bool with_energy, bool viscous, typename V>
  static ARENITE_INLINE void internal_force(const V (&nodes)[3][8], V (&u)[3][8], V (&v)[3][8], V (&Q)[3][n_patterns],
                                            const ElasticModuli &moduli, ElementEnergy<V> &energy)
  {
    using M = TrilinearModes;
    V x[3][8], g[6][3], volume;
    for (int d = 0; d < 3; ++d)
      {
        for (int n = 0; n < 8; ++n)
          x[d][n] = nodes[d][n];
        M::transform(x[d]);
        M::transform(u[d]);
        if constexpr (viscous)
          M::transform(v[d]);
      }
    uniform_gradient(x, g, volume);
    const V inverse_volume = V(1.) / volume;

    const auto mean_gradient = [&](const V(&w)[3][8], V(&G)[3][3]) {
      const V s = V(0.125) * inverse_volume;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            V t = w[i][M::linear[0]] * g[0][j] + w[i][M::linear[1]] * g[1][j] + w[i][M::linear[2]] * g[2][j];
            t += w[i][M::bilinear[0]] * g[3][j] + w[i][M::bilinear[1]] * g[4][j] + w[i][M::bilinear[2]] * g[5][j];
            G[i][j] = t * s;
          }
    };
    // amplitude of hourglass pattern a: the mode less what a linear field has in it on this cell's shape
    const auto hourglass = [&](const V(&w)[3][8], const V(&G)[3][3], const int i, const int a) {
      const int m = M::hourglass[a];
      return w[i][m] - (G[i][0] * x[0][m] + G[i][1] * x[1][m] + G[i][2] * x[2][m]);
    };

    V gradient[3][3], stress[3][3];
    mean_gradient(u, gradient);
    elastic_stress(gradient, V(1.), moduli, stress);
    if constexpr (with_energy)
      energy.strain += V(0.5) * volume * contract(stress, gradient);

    // stabilisation: force amplitude Q_ia on pattern a in direction i
    if constexpr (viscous)
      {
        V G[3][3];
        mean_gradient(v, G);
        V sum = V(0.); // 12 h^4 for a cube of side h
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            sum += g[k][l] * g[k][l];
        const V c = V(0.25 * moduli.hourglass_viscosity) * square_root(sum * V(1. / 12.));
        for (int i = 0; i < 3; ++i)
          for (int a = 0; a < 4; ++a)
            {
              const V rate = hourglass(v, G, i, a), force = c * rate;
              energy.viscous += V(0.5) * (Q[i][a] + force) * rate;
              Q[i][a] = force;
            }
      }
    else
      {
        V sum = V(0.);
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            sum += g[k][l] * g[k][l];
        const V k = V(moduli.hourglass_stiffness * (moduli.lambda + 2. * moduli.mu) / 64.) * sum * inverse_volume;
        for (int i = 0; i < 3; ++i)
          for (int a = 0; a < 4; ++a)
            {
              const V q = hourglass(u, gradient, i, a);
              Q[i][a]   = k * q;
              if constexpr (with_energy)
                energy.hourglass += V(0.5) * Q[i][a] * q;
            }
      }

    V P[3][3]; // modal force per unit g: stress and the reaction of the hourglass force on the mean gradient
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          V reaction = Q[i][0] * x[j][M::hourglass[0]];
          for (int a = 1; a < 4; ++a)
            reaction += Q[i][a] * x[j][M::hourglass[a]];
          P[i][j] = V(-0.125) * (stress[i][j] - inverse_volume * reaction);
        }
    for (int i = 0; i < 3; ++i)
      {
        u[i][0] = V(0.);
        for (int k = 0; k < 3; ++k)
          {
            u[i][M::linear[k]]   = P[i][0] * g[k][0] + P[i][1] * g[k][1] + P[i][2] * g[k][2];
            u[i][M::bilinear[k]] = P[i][0] * g[3 + k][0] + P[i][1] * g[3 + k][1] + P[i][2] * g[3 + k][2] - Q[i][k];
          }
        u[i][M::xyz] = -Q[i][3];
        M::transpose(u[i]);
      }
  }

  template <typename V>
  static void nodal_volume(const V (&x)[3][8], V (&volume)[8])
  {
    FullHexahedron::nodal_volume(x, volume);
  }
  template <typename V>
  static V inverse_size_squared(const V (&x)[3][8])
  {
    return FullHexahedron::inverse_size_squared(x);
  }
};
} // namespace Arenite
