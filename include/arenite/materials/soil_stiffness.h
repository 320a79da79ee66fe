#pragma once

#include <arenite/materials/soil_stiffening.h>
#include <arenite/materials/viscoplastic_cap.h>

namespace Arenite
{
/// Elastic stiffness of the cap model that grows with the largest density of the point (SoilStiffening): while the air closes, up to
/// grains and water, and beyond as in a compressed solid.
///
/// The modulus of a step is the mean of K over ln rho, so that a purely elastic compression is exact for any step. The shear modulus
/// follows in proportion (constant Poisson ratio), or stays that of the skeleton, which is the default for a saturated soil: its K is
/// that of grains and water, its skeleton is not stiffer for that.
///
/// Shear is counted per reference volume: tau_dot = 2 G e_dot for the Kirchhoff deviator tau = J s, with
///
///   G = r rho_0 c_m^2,   rho_0 c_m^2 = max(K_0, K(rho_m) rho_0/rho_m),   r = 3 (1 - 2 nu)/(2 (1 + nu))
///
/// which never falls (K' >= 1). With a Cauchy stress per present volume, or a G that follows the density both ways, a cycle of
/// compression, shear, expansion and shear back gives energy.
struct SoilStiffness
{
  static constexpr const char *law_name = "viscoplastic cap with stiffening";
  static constexpr bool        changes  = true;

  template <typename Number>
  using History = SoilStiffening::History<Number>;

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// One budget of compaction for cap and stiffening: W is by default the locking strain ln(rho_L/rho_0) of all air; a smaller one
  /// locks the stiffening at rho_0 e^W. @return the rule that W breaks, or nothing.
  std::string adopt_hardening_limit(double &W, bool is_set);

  double          density() const { return soil.reference_density(); }
  History<double> initial_history() const { return soil.initial_history(); }

  /// Of the largest pressure of the valid range [m/s].
  double wave_speed_bound() const;

  template <typename Number>
  StepModuli<Number> moduli(const PointIncrement<Number> &increment, History<Number> &history) const
  {
    StepModuli<Number> m;
    m.K_old             = soil.modulus(history.density_max);
    m.G_old             = shear_modulus_of(m.K_old, history.density_max);
    m.K                 = soil.stiffness(increment.density_old, increment.density, history.density_max);
    history.density_max = max(history.density_max, increment.density);
    m.K_new             = soil.modulus(history.density_max);
    m.G_new             = shear_modulus_of(m.K_new, history.density_max);
    m.G_mean            = Number(0.5) * (m.G_old + m.G_new);
    m.G                 = m.G_mean * increment.density * Number(1. / soil.reference_density());
    return m;
  }

  /// G per reference volume [Pa]
  template <typename Number>
  Number shear_modulus_of(const Number &K, const Number &density_max) const
  {
    if (constant_shear)
      return Number(shear_modulus);
    return Number(shear_ratio) *
           max(Number(soil.bulk_modulus), Number(K * Number(soil.reference_density()) / density_max));
  }

  template <typename Number>
  void after_transfer(History<Number> &history) const
  {
    history.density_max = max(history.density_max, Number(soil.reference_density()));
  }

  template <typename F>
  void for_each_constant(F &&f) const
  {
    f("Density", soil.density, "kg/m^3");
    f("Compacted density", soil.compacted_density, "kg/m^3");
    f("Bulk modulus K_0", soil.bulk_modulus, "Pa");
    f("Compacted modulus K_wg", soil.compacted_modulus, "Pa");
    if (soil.soil_state())
      soil.soil_state()->for_each_constant(f);
  }
  double largest_pressure() const { return soil.largest_pressure; }

  SoilStiffening soil;
  std::string    shear_rule     = "auto";
  double         poisson_ratio  = 0.25;
  double         shear_modulus  = 0.; ///< of the skeleton at rest [Pa]
  double         shear_ratio    = 0.; ///< G/K at constant Poisson ratio
  bool           constant_shear = false;
};
} // namespace Arenite
