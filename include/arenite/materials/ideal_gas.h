#pragma once

#include <arenite/materials/equation_of_state.h>

#include <cmath>
#include <limits>

namespace Arenite
{
/// Ideal gas: p_abs = (gamma - 1) rho e. The pressure p in the answer is above that at rest, p_0, because bodies at rest carry no stress,
/// and so is the energy: E = e - e_0 + p_0 (1/rho - 1/rho_0), with the work on the surroundings, dE = -p d(1/rho). In these
///
///   p = (gamma - 1) rho E + gamma p_0 (rho - rho_0)/rho_0
///
/// without differences of large numbers. The energy balance of a step is linear in the new pressure: no iteration, and one step from rest
/// gives the Hugoniot p_abs/p_0 = ((gamma+1) rho - (gamma-1) rho_0) / ((gamma+1) rho_0 - (gamma-1) rho). No shock compresses beyond
/// (gamma+1)/(gamma-1).
struct IdealGas
{
  static constexpr const char *name        = "ideal gas";
  static constexpr const char *description = "Air or expanded detonation products, with heating.";
  static constexpr bool        uses_energy = true;

  template <typename Number>
  struct History
  {
    Number energy = Number(0.); ///< E [J/kg]
    template <typename F>
    void for_each(F &&f)
    {
      f("internal energy", energy);
    }
  };

  double density          = 1.2;   ///< rho_0 [kg/m^3]
  double gamma            = 1.4;   ///< ratio of specific heats
  double initial_pressure = 101e3; ///< p_0, absolute [Pa]
  double largest_pressure = 1e8;   ///< end of the valid range, absolute [Pa]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &) const {}

  History<double> initial_history() const { return {}; }
  double          reference_density() const { return density; }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, History<Number> &history) const
  {
    const Number half_dv   = Number(.5) * (Number(1.) / change.density - Number(1.) / change.density_old);
    const Number stiffness = Number(gamma - 1.) * change.density,
                 cold      = Number(gamma * initial_pressure / density) * (change.density - Number(density)),
                 vacuum(-initial_pressure);
    // max(): a step beyond the largest shock compression is out of range, but must not turn the pressure negative
    const Number implicit = Arenite::max<Number>(Number(1.) + stiffness * half_dv, Number(1e-3));
    const Number energy   = history.energy + change.heat - change.pressure_old * half_dv;
    const Number p        = Arenite::max<Number>(vacuum, Number((stiffness * energy + cold) / implicit));
    history.energy        = energy - p * half_dv;
    return {p, Number(gamma) * (p - vacuum), history.energy};
  }

  /// Behind a shock of the largest pressure.
  double bulk_sound_speed_bound() const
  {
    const double ratio = std::max(1., largest_pressure / initial_pressure);
    const double rho   = density * ((gamma + 1.) * ratio + gamma - 1.) / ((gamma - 1.) * ratio + gamma + 1.);
    return std::sqrt(gamma * ratio * initial_pressure / rho);
  }
  double hugoniot_pressure(const double rho) const
  {
    return initial_pressure *
           (((gamma + 1.) * rho - (gamma - 1.) * density) / ((gamma + 1.) * density - (gamma - 1.) * rho) - 1.);
  }
};
} // namespace Arenite
