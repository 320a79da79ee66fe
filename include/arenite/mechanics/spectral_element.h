#pragma once

#include <arenite/mechanics/elastic_element.h>
#include <arenite/mechanics/multilinear_element.h>

#include <deal.II/base/quadrature_lib.h>

namespace Arenite
{
/// Lagrange basis on N Gauss-Lobatto points of [0,1].
template <int N>
struct GaussLobattoBasis
{
  double point[N], weight[N];
  double derivative[N][N]; ///< [i][j] = l_j'(x_i)

  GaussLobattoBasis()
  {
    const dealii::QGaussLobatto<1> rule(N);
    double                         c[N]; // barycentric weights, inverted
    for (int i = 0; i < N; ++i)
      {
        point[i]  = rule.point(i)[0];
        weight[i] = rule.weight(i);
        c[i]      = 1.;
        for (int j = 0; j < N; ++j)
          if (j != i)
            c[i] *= rule.point(i)[0] - rule.point(j)[0];
      }
    for (int i = 0; i < N; ++i)
      {
        derivative[i][i] = 0.;
        for (int j = 0; j < N; ++j)
          if (j != i)
            {
              derivative[i][j] = c[i] / (c[j] * (point[i] - point[j]));
              derivative[i][i] += 1. / (point[i] - point[j]);
            }
      }
  }
};

/// Spectral element of degree p: nodes and quadrature points are the same (p+1)^dim Gauss-Lobatto points, so that the mass is
/// diagonal and derivatives are sums along lines of nodes (sum factorisation). Geometry is the polynomial through the nodes,
/// recomputed in every call: reading it back from memory would be slower.
///
///   f_i = - sum_q w_q m(r_q) det(J_q) sigma(q) . grad N_i(q),   and f_r -= H w_i m(r_i)/r_i det(J_i) sigma_tt(i)
///
/// with the measure m and the H hoop directions of kinematics.h. Nodes on the axis have no mass of their own, see
/// even_line_weights(); at degree 1, where these leave only a constant, the mass is that of FullElement.
template <int dim_, int degree_, int n_hoop_ = 0>
struct SpectralElement
{
  static constexpr int  dim = dim_, degree = degree_, n_hoop = n_hoop_;
  static constexpr int  N = degree + 1, n_nodes = power(N, dim_), n_patterns = 1;
  static constexpr bool has_hourglass_control = false, mean_dilatation = false, has_gauss_points = false;
  static inline const GaussLobattoBasis<N> basis{};

  /// Derivative along reference direction @p d of the nodal values f at node n = (c[0], c[1], ...).
  template <int d, typename V>
  static ARENITE_INLINE V derivative(const V *f, const int n, const int *c)
  {
    constexpr int stride = power(N, d);
    const double *row    = basis.derivative[c[d]];
    const V      *line   = f + n - c[d] * stride;
    V             sum    = row[0] * line[0];
    for (int m = 1; m < N; ++m)
      sum += row[m] * line[m * stride];
    return sum;
  }

  /// g[i][j] = d f_i / d xi_j at node n.
  template <typename V>
  static ARENITE_INLINE void reference_gradient(const V (&f)[dim][n_nodes], const int n, const int *c, V (&g)[dim][dim])
  {
    for (int i = 0; i < dim; ++i)
      {
        g[i][0] = derivative<0>(f[i], n, c);
        if constexpr (dim > 1)
          g[i][1] = derivative<1>(f[i], n, c);
        if constexpr (dim > 2)
          g[i][2] = derivative<2>(f[i], n, c);
      }
  }

  static ARENITE_INLINE double weight(const int *c)
  {
    double w = 1.;
    for (int d = 0; d < dim; ++d)
      w *= basis.weight[c[d]];
    return w;
  }

  /// visit(n, c) for every node n with line coordinates c; the fastest coordinate is unrolled.
  template <typename Visit>
  static ARENITE_INLINE void for_each_node(const Visit &visit)
  {
    for (int line = 0; line < n_nodes / N; ++line)
      {
        int c[3] = {0, line % N, line / N};
#pragma GCC unroll 8
        for (int i = 0; i < N; ++i)
          {
            c[0] = i;
            visit(line * N + i, c);
          }
      }
  }

  /// @param x node coordinates [m];  @param u nodal displacements in, nodal forces of the element out [N].
  template <bool with_energy, typename V>
  static ARENITE_INLINE void internal_force(const V (&x)[dim][n_nodes], V (&u)[dim][n_nodes],
                                            const ElasticModuli &moduli, ElementEnergy<V> &energy)
  {
    V flux[dim][dim][n_nodes]; // [component][direction]: weight det(J) sigma . grad xi
    V hoop_force[n_hoop > 0 ? n_nodes : 1];
    for_each_node([&](const int n, const int *c) {
      V gu[dim][dim], gx[dim][dim], cofactor[dim][dim];
      reference_gradient(u, n, c, gu);
      reference_gradient(x, n, c, gx);
      const V det   = cofactors(gx, cofactor);
      V       scale = V(weight(c)) / det; // the two cofactors below carry det^2, the volume element det
      if constexpr (n_hoop > 0)
        scale *= measure<n_hoop>(x[0][n]);
      V gradient[dim][dim], hoop = V(0.), hoop_stress = V(0.);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            gradient[i][j] = gu[i][0] * cofactor[j][0];
            for (int d = 1; d < dim; ++d)
              gradient[i][j] += gu[i][d] * cofactor[j][d];
          }
      if constexpr (n_hoop > 0)
        hoop = det * u[0][n] * inverse_radius(x[0][n]);
      V stress[dim][dim];
      elastic_stress<n_hoop>(gradient, hoop, scale, moduli, stress, hoop_stress);
      if constexpr (with_energy)
        energy.strain += V(0.5) * contract(stress, gradient); // one factor carries det, the other weight
      if constexpr (with_energy && n_hoop > 0)
        energy.strain += V(0.5 * n_hoop) * hoop_stress * hoop;
      if constexpr (n_hoop > 0)
        hoop_force[n] = V(double(n_hoop)) * hoop_stress * det * inverse_radius(x[0][n]);
      for (int i = 0; i < dim; ++i)
        for (int d = 0; d < dim; ++d)
          {
            V sum = stress[i][0] * cofactor[0][d];
            for (int j = 1; j < dim; ++j)
              sum += stress[i][j] * cofactor[j][d];
            flux[i][d][n] = sum;
          }
    });
    for_each_node([&](const int n, const int *c) {
      for (int i = 0; i < dim; ++i)
        {
          V sum = V(0.);
          if constexpr (n_hoop > 0)
            if (i == 0)
              sum = -hoop_force[n];
          for (int d = 0; d < dim; ++d)
            {
              const int stride = d == 0 ? 1 : (d == 1 ? N : N * N);
              const V  *line   = flux[i][d] + n - c[d] * stride;
              for (int m = 0; m < N; ++m)
                sum -= basis.derivative[m][c[d]] * line[m * stride];
            }
          u[i][n] = sum;
        }
    });
  }

  /// Volume that belongs to each node [m^3]: w_q m(r_q) det(J_q).
  template <typename V>
  static void nodal_volume(const V (&x)[dim][n_nodes], V (&volume)[n_nodes])
  {
    if constexpr (degree == 1 && n_hoop > 0)
      return FullElement<dim, n_hoop>::nodal_volume(x, volume);
    for_each_node([&](const int n, const int *c) {
      V gx[dim][dim], cofactor[dim][dim];
      reference_gradient(x, n, c, gx);
      volume[n] = V(weight(c)) * cofactors(gx, cofactor);
      if constexpr (n_hoop > 0)
        volume[n] *= measure<n_hoop>(x[0][n]);
    });
  }

  /// Largest squared Frobenius norm of the inverse Jacobian over the nodes [1/m^2]: how small the cell is.
  template <typename V>
  static V inverse_size_squared(const V (&x)[dim][n_nodes])
  {
    V largest = V(0.);
    for_each_node([&](const int n, const int *c) {
      V gx[dim][dim], cofactor[dim][dim];
      reference_gradient(x, n, c, gx);
      const V det = cofactors(gx, cofactor);
      V       sum = V(0.);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          sum += cofactor[i][j] * cofactor[i][j];
      largest = max(largest, sum / (det * det));
    });
    return largest;
  }
};
} // namespace Arenite
