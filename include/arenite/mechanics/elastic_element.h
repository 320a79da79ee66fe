#pragma once

#include <arenite/mechanics/kinematics.h>

namespace Arenite
{
/// What the fused small-strain elastic kernels need of a material, and the stabilisation of under-integrated elements.
struct ElasticModuli
{
  double lambda, mu;               ///< Lame's constants [Pa]
  double hourglass_stiffness = 0.; ///< multiple of the P-wave modulus, dimensionless
  double hourglass_viscosity = 0.; ///< impedance: coefficient times rho c_p [Pa s/m]
};

/// Energies of one batch of elements, lane by lane [J].
template <typename V>
struct ElementEnergy
{
  V strain    = V(0.); ///< integral of sigma:epsilon/2 from the points, independent of the nodal forces
  V hourglass = V(0.); ///< stored in the stiffness form of the hourglass control
  V viscous   = V(0.); ///< power that the mean of the last two viscous forces takes out at the velocity given [W]
};

/// Cofactors C_jd = det(J) d xi_d / d x_j of the Jacobian J_jd = d x_j / d xi_d; returns det(J).
template <typename V>
ARENITE_INLINE V cofactors(const V (&J)[3][3], V (&C)[3][3])
{
  for (int j = 0; j < 3; ++j)
    for (int d = 0; d < 3; ++d)
      {
        const int j1 = (j + 1) % 3, j2 = (j + 2) % 3, d1 = (d + 1) % 3, d2 = (d + 2) % 3;
        C[j][d] = J[j1][d1] * J[j2][d2] - J[j1][d2] * J[j2][d1];
      }
  return J[0][0] * C[0][0] + J[0][1] * C[0][1] + J[0][2] * C[0][2];
}
template <typename V>
ARENITE_INLINE V cofactors(const V (&J)[2][2], V (&C)[2][2])
{
  C[0][0] = J[1][1];
  C[0][1] = -J[1][0];
  C[1][0] = -J[0][1];
  C[1][1] = J[0][0];
  return J[0][0] * J[1][1] - J[0][1] * J[1][0];
}
template <typename V>
ARENITE_INLINE V cofactors(const V (&J)[1][1], V (&C)[1][1])
{
  C[0][0] = V(1.);
  return J[0][0];
}

/// sigma = scale (lambda tr(eps) 1 + 2 mu eps), eps the symmetric part of @p gradient with @p hoop in the hoop directions; other
/// strains beyond dim are zero.
template <int n_hoop, int dim, typename V>
ARENITE_INLINE void elastic_stress(const V (&gradient)[dim][dim], const V &hoop, const V &scale,
                                   const ElasticModuli &moduli, V (&stress)[dim][dim], V &hoop_stress)
{
  const V lambda = V(moduli.lambda) * scale, mu = V(moduli.mu) * scale;
  V       trace = gradient[0][0];
  for (int i = 1; i < dim; ++i)
    trace += gradient[i][i];
  if constexpr (n_hoop > 0)
    trace += V(double(n_hoop)) * hoop;
  const V pressure_part = lambda * trace;
  for (int i = 0; i < dim; ++i)
    {
      stress[i][i] = pressure_part + (mu + mu) * gradient[i][i];
      for (int j = i + 1; j < dim; ++j)
        stress[i][j] = stress[j][i] = mu * (gradient[i][j] + gradient[j][i]);
    }
  if constexpr (n_hoop > 0)
    hoop_stress = pressure_part + (mu + mu) * hoop;
  else
    (void)hoop, (void)hoop_stress;
}
template <int dim, typename V>
ARENITE_INLINE void elastic_stress(const V (&gradient)[dim][dim], const V &scale, const ElasticModuli &moduli,
                                   V (&stress)[dim][dim])
{
  V unused = V(0.);
  elastic_stress<0>(gradient, unused, scale, moduli, stress, unused);
}

template <int dim, typename V>
ARENITE_INLINE V contract(const V (&a)[dim][dim], const V (&b)[dim][dim])
{
  V sum = a[0][0] * b[0][0];
  for (int i = 0; i < dim; ++i)
    for (int j = (i == 0 ? 1 : 0); j < dim; ++j)
      sum += a[i][j] * b[i][j];
  return sum;
}
} // namespace Arenite
