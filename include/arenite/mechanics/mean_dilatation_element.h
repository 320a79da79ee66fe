#pragma once

#include <arenite/mechanics/multilinear_element.h>

namespace Arenite
{
/// FullElement whose points all have the mean volume strain of the cell, theta = (1/V) sum_q w_q tr(eps_q): it does not lock in motions
/// that keep the volume. Hughes, Int. J. Numer. Meth. Eng. 15 (1980) 1413-1418. The pressure K theta is uniform and works on the mean
/// gradient:  f = - sum_q w_q (2 G dev(eps_q) : grad N + K theta div N).
template <int dim_, int n_hoop_ = 0>
struct MeanDilatationElement : FullElement<dim_, n_hoop_>
{
  using Full = FullElement<dim_, n_hoop_>;
  using Full::dim, Full::n_hoop, Full::n_nodes, Full::n_lines;
  static constexpr bool mean_dilatation = true;

  template <bool with_energy, typename V>
  static ARENITE_INLINE void internal_force(const V (&x)[dim][n_nodes], V (&u)[dim][n_nodes],
                                            const ElasticModuli &moduli, ElementEnergy<V> &energy)
  {
    const typename Full::template PointGeometry<V> geometry(x);
    V                                              gu[dim][dim][n_lines], gf[dim][dim][n_lines], u_r[n_nodes];
    for (int i = 0; i < dim; ++i)
      {
        Full::Modes::transform(u[i]);
        Full::reference_gradient(u[i], gu[i]);
        if constexpr (n_hoop > 0)
          if (i == 0)
            Full::point_values(u[i], u_r);
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < n_lines; ++l)
            gf[i][k][l] = V(0.);
      }
    // gradients times det(J), and the mean
    V gradient[n_nodes][dim][dim], C[n_nodes][dim][dim], det[n_nodes], hoop[n_nodes], w[n_nodes], theta = V(0.),
                                                                                                  volume = V(0.);
    for (int q = 0; q < n_nodes; ++q)
      {
        int o[dim];
        Full::point_index(q, o);
        det[q]  = geometry.cofactors_at(q, C[q]);
        hoop[q] = V(0.);
        w[q]    = measure<n_hoop>(geometry.r[q]);
        V trace = V(0.);
        for (int i = 0; i < dim; ++i)
          {
            for (int j = 0; j < dim; ++j)
              {
                gradient[q][i][j] = gu[i][0][o[0]] * C[q][j][0];
                for (int d = 1; d < dim; ++d)
                  gradient[q][i][j] += gu[i][d][o[d]] * C[q][j][d];
              }
            trace += gradient[q][i][i];
          }
        if constexpr (n_hoop > 0)
          {
            hoop[q] = det[q] * u_r[q] / geometry.r[q];
            trace += V(double(n_hoop)) * hoop[q];
          }
        theta += w[q] * trace;
        volume += w[q] * det[q];
      }
    theta *= V(1.) / volume;
    const V mean_stress = V(moduli.lambda + 2. / 3. * moduli.mu) * theta;
    if constexpr (with_energy)
      energy.strain += V(0.5) * mean_stress * theta * volume;
    for (int q = 0; q < n_nodes; ++q)
      {
        int o[dim];
        Full::point_index(q, o);
        const V two_mu = V(2. * moduli.mu) * w[q] / det[q], mean = mean_stress * w[q];
        V       third = V(0.), stress[dim][dim];
        for (int i = 0; i < dim; ++i)
          third += gradient[q][i][i];
        third     = V(1. / 3.) * (third + V(double(n_hoop)) * hoop[q]);
        V squares = V(3. - dim - n_hoop) * third * third; // of the deviator, of directions without strain
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            {
              const V deviator = V(0.5) * (gradient[q][i][j] + gradient[q][j][i]) - (i == j ? third : V(0.));
              stress[i][j]     = two_mu * deviator + (i == j ? mean : V(0.));
              if constexpr (with_energy)
                squares += deviator * deviator;
            }
        const V hoop_deviator = hoop[q] - third;
        if constexpr (with_energy)
          energy.strain += V(0.5) * two_mu * (squares + V(double(n_hoop)) * hoop_deviator * hoop_deviator);
        if constexpr (n_hoop > 0)
          u_r[q] = V(-double(n_hoop)) * (two_mu * hoop_deviator + mean) * det[q] / geometry.r[q];
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            {
              V sum = stress[i][0] * C[q][0][k];
              for (int j = 1; j < dim; ++j)
                sum += stress[i][j] * C[q][j][k];
              gf[i][k][o[k]] -= sum;
            }
      }
    for (int i = 0; i < dim; ++i)
      {
        Full::reference_gradient_transpose(gf[i], u[i]);
        if constexpr (n_hoop > 0)
          if (i == 0)
            Full::add_point_values_transpose(u_r, u[0]);
        Full::Modes::transpose(u[i]);
      }
  }
};
} // namespace Arenite
