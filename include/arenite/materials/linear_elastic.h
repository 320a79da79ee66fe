#pragma once

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Arenite
{
/// Isotropic linear elasticity: sigma = lambda tr(epsilon) I + 2 G epsilon, tension positive.
struct LinearElastic
{
  double density       = 0.; ///< [kg/m^3]
  double bulk_modulus  = 0.; ///< K [Pa]
  double shear_modulus = 0.; ///< G [Pa]

  bool operator==(const LinearElastic &other) const
  {
    return density == other.density && bulk_modulus == other.bulk_modulus && shear_modulus == other.shear_modulus;
  }

  /// lambda = K - 2 G / 3 [Pa]
  constexpr double lame_lambda() const { return bulk_modulus - 2. / 3. * shear_modulus; }

  /// sqrt((K + 4 G / 3) / rho) [m/s]
  double p_wave_speed() const { return std::sqrt((bulk_modulus + 4. / 3. * shear_modulus) / density); }

  /// sqrt(G / rho) [m/s]
  double s_wave_speed() const { return std::sqrt(shear_modulus / density); }

  /// E = 9 K G / (3 K + G) [Pa]
  constexpr double young_modulus() const
  {
    return 9. * bulk_modulus * shear_modulus / (3. * bulk_modulus + shear_modulus);
  }

  /// nu = (3 K - 2 G) / (6 K + 2 G)
  constexpr double poisson_ratio() const
  {
    return (3. * bulk_modulus - 2. * shear_modulus) / (6. * bulk_modulus + 2. * shear_modulus);
  }

  /// p^2/(2 K) + J2/(2 G) [J/m^3], with one division of plain numbers
  template <typename Number>
  Number stored_energy(const Number &p, const Number &J2) const
  {
    return (p * p * Number(shear_modulus) + J2 * Number(bulk_modulus)) *
           Number(1. / (2. * bulk_modulus * shear_modulus));
  }

  /// f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    f("Density", density, "kg/m^3");
    f("Bulk modulus", bulk_modulus, "Pa");
    f("Shear modulus", shear_modulus, "Pa");
    f("Young modulus", young_modulus(), "Pa");
    f("Poisson ratio", poisson_ratio(), "-");
    f("P-wave speed", p_wave_speed(), "m/s");
    f("S-wave speed", s_wave_speed(), "m/s");
  }

  /// Stress [Pa] of the displacement gradient H[i][j] = d u_i / d x_j; with dim < 3 the missing strains are zero.
  template <int dim>
  dealii::SymmetricTensor<2, 3> stress(const dealii::Tensor<2, dim> &gradient) const
  {
    dealii::SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        result[i][j] = shear_modulus * (gradient[i][j] + gradient[j][i]);
    for (unsigned int i = 0; i < 3; ++i)
      result[i][i] += lame_lambda() * dealii::trace(gradient);
    return result;
  }
};
} // namespace Arenite
