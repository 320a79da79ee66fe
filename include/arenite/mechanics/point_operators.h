#pragma once

#include <arenite/mechanics/mean_dilatation_element.h>
#include <arenite/mechanics/spectral_element.h>

#include <deal.II/base/quadrature_lib.h>

#include <vector>

namespace Arenite
{
/// Displacement gradients at the points of a batch of elements, and their transpose: what kernels with a separate law need of an
/// element. Built from the reference positions of the nodes,
///
///   H_ij(q) = d u_i / d X_j,   h(q) = u_r/R,        f_iI = - sum_q w_q (sum_j P_ij d N_I / d X_j + H P_tt N_I/R [i = r])
///
/// with w_q = det(J) m(R) times the weight of the rule, P the first Piola-Kirchhoff stress (any stress at small strain) and P_tt that
/// of the hoop directions.
///
///   n_points, weight[q] [m^3], metric[q][k][j] = d xi_k/d X_j [1/m]
///   lines(places, weights)  of the points, a tensor product, the first direction fastest
///   length_of_unit      length of the reference coordinate between neighbouring nodes, the same in all directions on average
///   gradients(u, H, h)  of nodal values u, which are overwritten
///   forces(P, P_tt, f)  P and P_tt are overwritten
template <typename Element, typename V>
struct PointOperators;

template <int dim, int n_hoop, typename V>
struct PointOperators<FullElement<dim, n_hoop>, V>
{
  using Element                    = FullElement<dim, n_hoop>;
  static constexpr int    n_points = Element::n_nodes, n_nodes = Element::n_nodes, n_lines = Element::n_lines;
  static constexpr double length_of_unit = 2.; ///< the reference cell is [-1,1]^dim

  V weight[n_points], metric[n_points][dim][dim], inverse_r[n_hoop > 0 ? n_points : 1];

  /// Places and weights of the points along each direction of [0,1].
  static void lines(std::vector<double> &places, std::vector<double> &weights)
  {
    const double at = 0.5 / 1.7320508075688772935;
    places          = {0.5 - at, 0.5 + at};
    weights         = {0.5, 0.5};
  }

  explicit ARENITE_INLINE PointOperators(const V (&x)[dim][n_nodes])
  {
    Element::for_each_gauss_point(x, [&](const int q, const V &det, const V(&C)[dim][dim], const V &r) {
      const V inverse = V(1.) / det;
      for (int k = 0; k < dim; ++k)
        for (int j = 0; j < dim; ++j)
          metric[q][k][j] = C[j][k] * inverse;
      weight[q] = det * measure<n_hoop>(r);
      if constexpr (n_hoop > 0)
        inverse_r[q] = V(1.) / r;
    });
  }

  ARENITE_INLINE void gradients(V (&u)[dim][n_nodes], V (&H)[n_points][dim][dim], V (&h)[n_points]) const
  {
    for (int i = 0; i < dim; ++i)
      {
        V g[dim][n_lines];
        Element::Modes::transform(u[i]);
        Element::reference_gradient(u[i], g);
        for (int q = 0; q < n_points; ++q)
          {
            int o[dim];
            Element::point_index(q, o);
            for (int j = 0; j < dim; ++j)
              {
                V sum = g[0][o[0]] * metric[q][0][j];
                for (int k = 1; k < dim; ++k)
                  sum += g[k][o[k]] * metric[q][k][j];
                H[q][i][j] = sum;
              }
          }
      }
    if constexpr (n_hoop > 0)
      {
        Element::point_values(u[0], h);
        for (int q = 0; q < n_points; ++q)
          h[q] *= inverse_r[q];
      }
    else
      (void)h;
  }

  ARENITE_INLINE void forces(V (&P)[n_points][dim][dim], V (&hoop)[n_points], V (&f)[dim][n_nodes]) const
  {
    for (int i = 0; i < dim; ++i)
      {
        V g[dim][n_lines];
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < n_lines; ++l)
            g[k][l] = V(0.);
        for (int q = 0; q < n_points; ++q)
          {
            int o[dim];
            Element::point_index(q, o);
            for (int k = 0; k < dim; ++k)
              {
                V sum = P[q][i][0] * metric[q][k][0];
                for (int j = 1; j < dim; ++j)
                  sum += P[q][i][j] * metric[q][k][j];
                g[k][o[k]] -= weight[q] * sum;
              }
          }
        Element::reference_gradient_transpose(g, f[i]);
        if constexpr (n_hoop > 0)
          if (i == 0)
            {
              for (int q = 0; q < n_points; ++q)
                hoop[q] *= V(-double(n_hoop)) * weight[q] * inverse_r[q];
              Element::add_point_values_transpose(hoop, f[0]);
            }
        Element::Modes::transpose(f[i]);
      }
    (void)hoop;
  }
};

template <int dim, int n_hoop, typename V>
struct PointOperators<MeanDilatationElement<dim, n_hoop>, V> : PointOperators<FullElement<dim, n_hoop>, V>
{
  using PointOperators<FullElement<dim, n_hoop>, V>::PointOperators;
};

template <int dim, int degree, int n_hoop, typename V>
struct PointOperators<SpectralElement<dim, degree, n_hoop>, V>
{
  using Element             = SpectralElement<dim, degree, n_hoop>;
  static constexpr int    N = degree + 1, n_nodes = Element::n_nodes, n_points = n_nodes;
  static constexpr double length_of_unit = 1. / degree; ///< the reference cell is [0,1]^dim

  V weight[n_points], metric[n_points][dim][dim], inverse_r[n_hoop > 0 ? n_points : 1];

  static void lines(std::vector<double> &places, std::vector<double> &weights)
  {
    const dealii::QGaussLobatto<1> rule(N);
    places.clear();
    for (const auto &point : rule.get_points())
      places.push_back(point[0]);
    weights = rule.get_weights();
  }

  explicit ARENITE_INLINE PointOperators(const V (&x)[dim][n_nodes])
  {
    Element::for_each_node([&](const int n, const int *c) {
      V J[dim][dim], C[dim][dim];
      Element::reference_gradient(x, n, c, J);
      const V det     = cofactors(J, C);
      const V inverse = V(1.) / det;
      for (int k = 0; k < dim; ++k)
        for (int j = 0; j < dim; ++j)
          metric[n][k][j] = C[j][k] * inverse;
      weight[n] = V(Element::weight(c)) * det;
      if constexpr (n_hoop > 0)
        {
          weight[n] *= measure<n_hoop>(x[0][n]);
          inverse_r[n] = inverse_radius(x[0][n]);
        }
    });
  }

  ARENITE_INLINE void gradients(const V (&u)[dim][n_nodes], V (&H)[n_points][dim][dim], V (&h)[n_points]) const
  {
    Element::for_each_node([&](const int n, const int *c) {
      V g[dim][dim];
      Element::reference_gradient(u, n, c, g);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            V sum = g[i][0] * metric[n][0][j];
            for (int k = 1; k < dim; ++k)
              sum += g[i][k] * metric[n][k][j];
            H[n][i][j] = sum;
          }
      if constexpr (n_hoop > 0)
        h[n] = Arenite::select<V>(inverse_r[n] > V(1e50), H[n][0][0],
                                  V(u[0][n] * inverse_r[n])); // on the axis u_r/R is du_r/dR
    });
    (void)h;
  }

  ARENITE_INLINE void forces(V (&P)[n_points][dim][dim], V (&hoop)[n_points], V (&f)[dim][n_nodes]) const
  {
    for (int n = 0; n < n_points; ++n) // P becomes the flux along the reference directions
      for (int i = 0; i < dim; ++i)
        {
          V flux[dim];
          for (int k = 0; k < dim; ++k)
            {
              V sum = P[n][i][0] * metric[n][k][0];
              for (int j = 1; j < dim; ++j)
                sum += P[n][i][j] * metric[n][k][j];
              flux[k] = weight[n] * sum;
            }
          for (int k = 0; k < dim; ++k)
            P[n][i][k] = flux[k];
        }
    Element::for_each_node([&](const int n, const int *c) {
      for (int i = 0; i < dim; ++i)
        {
          V sum = V(0.);
          if constexpr (n_hoop > 0)
            if (i == 0)
              sum = V(-double(n_hoop)) * hoop[n] * weight[n] * inverse_r[n];
          for (int d = 0; d < dim; ++d)
            {
              const int stride = d == 0 ? 1 : (d == 1 ? N : N * N), first = n - c[d] * stride;
              for (int m = 0; m < N; ++m)
                sum -= Element::basis.derivative[m][c[d]] * P[first + m * stride][i][d];
            }
          f[i][n] = sum;
        }
    });
    (void)hoop;
  }
};

/// One point with the mean gradient. The hourglass patterns are those of OnePointElement: amplitudes of what a linear motion leaves, and
/// forces on them that a linear motion does not feel.
template <int dim, int n_hoop, typename V>
struct PointOperators<OnePointElement<dim, n_hoop>, V>
{
  using Element                    = OnePointElement<dim, n_hoop>;
  using Own                        = OnePointModes<dim>;
  static constexpr int    n_points = 1, n_nodes = Element::n_nodes, n_patterns = Element::n_patterns;
  static constexpr double s              = 1. / n_nodes; ///< modes carry a factor 2^dim
  static constexpr double length_of_unit = 2.;
  using Amplitudes                       = V[dim][n_patterns];

  V weight[1], metric[1][dim][dim];
  V x[dim][n_nodes], g[Own::n][dim],
    t[n_nodes]; ///< coordinate modes; integrals of the gradients and of 1/R of the modes

  static void lines(std::vector<double> &places, std::vector<double> &weights)
  {
    places  = {0.5};
    weights = {1.};
  }

  explicit ARENITE_INLINE PointOperators(const V (&nodes)[dim][n_nodes])
  {
    V J[dim][dim], C[dim][dim];
    for (int d = 0; d < dim; ++d)
      {
        for (int n = 0; n < n_nodes; ++n)
          x[d][n] = nodes[d][n];
        Element::M::transform(x[d]);
        for (int k = 0; k < dim; ++k)
          J[d][k] = V(s) * x[d][1 << k];
      }
    Element::uniform_gradient(nodes, x, g, t, weight[0]);
    const V inverse = V(1.) / cofactors(J, C);
    for (int k = 0; k < dim; ++k)
      for (int j = 0; j < dim; ++j)
        metric[0][k][j] = C[j][k] * inverse;
  }

  /// @p u becomes its modes.
  ARENITE_INLINE void gradients(V (&u)[dim][n_nodes], V (&H)[1][dim][dim], V (&h)[1]) const
  {
    const V scale = V(s) / weight[0];
    for (int i = 0; i < dim; ++i)
      {
        Element::M::transform(u[i]);
        for (int j = 0; j < dim; ++j)
          {
            V sum = u[i][Own::mode[0]] * g[0][j];
            for (int m = 1; m < Own::n; ++m)
              sum += u[i][Own::mode[m]] * g[m][j];
            H[0][i][j] = sum * scale;
          }
      }
    if constexpr (n_hoop > 0)
      {
        h[0] = t[0] * u[0][0];
        for (int m = 1; m < n_nodes; ++m)
          h[0] += t[m] * u[0][m];
        h[0] *= scale;
      }
    else
      (void)h;
  }

  /// Amplitudes of the patterns in the modes @p u with the mean gradient @p H.
  ARENITE_INLINE void patterns(const V (&u)[dim][n_nodes], const V (&H)[1][dim][dim], Amplitudes &q) const
  {
    for (int i = 0; i < dim; ++i)
      for (int a = 0; a < n_patterns; ++a)
        {
          V sum = H[0][i][0] * x[0][Own::pattern[a]];
          for (int d = 1; d < dim; ++d)
            sum += H[0][i][d] * x[d][Own::pattern[a]];
          q[i][a] = u[i][Own::pattern[a]] - sum;
        }
  }

  /// Stiffness of a pattern per P-wave modulus for a coefficient of 1 (Flanagan & Belytschko).
  ARENITE_INLINE V pattern_stiffness() const { return V(s * s) * squared_gradients() / weight[0]; }

  /// Viscosity of a pattern per impedance for a coefficient of 1, on the shape whose areas are @p N times those of the reference.
  ARENITE_INLINE V pattern_viscosity(const V (&N)[dim][dim]) const
  {
    V sum = V(0.);
    for (int k = 0; k < dim; ++k)
      for (int i = 0; i < dim; ++i)
        {
          V area = N[i][0] * g[k][0];
          for (int j = 1; j < dim; ++j)
            area += N[i][j] * g[k][j];
          sum += area * area;
        }
    return V(16. * s * s) * square_root(V(sum * V(1. / (4. * dim))));
  }

  /// @p Q: forces on the patterns; ignored in one dimension.
  ARENITE_INLINE void forces(const V (&P)[1][dim][dim], const V (&hoop)[1], const Amplitudes &Q,
                             V (&f)[dim][n_nodes]) const
  {
    const V inverse = V(1.) / weight[0];
    for (int i = 0; i < dim; ++i)
      {
        for (int n = 0; n < n_nodes; ++n)
          f[i][n] = V(0.);
        V p[dim]; // per unit g: the stress and the reaction of the pattern forces on the mean gradient
        for (int j = 0; j < dim; ++j)
          {
            p[j] = P[0][i][j];
            if constexpr (Element::has_hourglass_control)
              for (int a = 0; a < n_patterns; ++a)
                p[j] -= inverse * Q[i][a] * x[j][Own::pattern[a]];
          }
        for (int m = 0; m < Own::n; ++m)
          {
            V sum = p[0] * g[m][0];
            for (int j = 1; j < dim; ++j)
              sum += p[j] * g[m][j];
            f[i][Own::mode[m]] = V(-s) * sum;
          }
        if constexpr (Element::has_hourglass_control)
          for (int a = 0; a < n_patterns; ++a)
            f[i][Own::pattern[a]] -= Q[i][a];
        if constexpr (n_hoop > 0)
          if (i == 0)
            for (int m = 0; m < n_nodes; ++m)
              f[0][m] -= V(s * n_hoop) * hoop[0] * t[m];
        Element::M::transpose(f[i]);
      }
    (void)Q, (void)hoop;
  }

private:
  ARENITE_INLINE V squared_gradients() const
  {
    V sum = V(0.); // 12 h^4 for a cube of side h, 8 h^2 for a square
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        sum += g[k][l] * g[k][l];
    return sum;
  }
};

/// Values at the nodes, [node][value], of the polynomial through the points of an element, [point][value]: the points themselves, the
/// multilinear one through 2^dim Gauss points, or a constant.
template <typename Element>
void points_to_nodes(const std::vector<double> &at_points, const unsigned int n_values, std::vector<double> &values)
{
  constexpr int n_nodes  = Element::n_nodes;
  const int     n_points = static_cast<int>(at_points.size() / n_values);
  values.assign(n_nodes * n_values, 0.);
  for (int n = 0; n < n_nodes; ++n)
    for (int q = 0; q < n_points; ++q)
      {
        double factor = n_points == 1 || n == q ? 1. : 0.;
        if (Element::has_gauss_points)
          {
            factor = 1.;
            for (int b = 1; b < n_nodes; b *= 2) // nodes at 1, points at 1/sqrt(3)
              factor *= 0.5 * (1. + ((n & b) == (q & b) ? 1. : -1.) * 1.7320508075688772935);
          }
        for (unsigned int k = 0; factor != 0. && k < n_values; ++k)
          values[n * n_values + k] += factor * at_points[q * n_values + k];
      }
}
} // namespace Arenite
