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
    m.K_old               = soil.modulus(history.density_max);
    m.K                   = soil.stiffness(increment.density_old, increment.density, history.density_max);
    history.density_max   = max(history.density_max, increment.density);
    m.K_new               = soil.modulus(history.density_max);
    const Number constant = Number(shear_modulus), ratio = Number(shear_ratio);
    m.G     = constant_shear ? constant : ratio * m.K;
    m.G_old = constant_shear ? constant : ratio * m.K_old;
    m.G_new = constant_shear ? constant : ratio * m.K_new;
    return m;
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
