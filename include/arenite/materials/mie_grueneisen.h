#pragma once

#include <arenite/materials/equation_of_state.h>

#include <cmath>
#include <limits>
#include <string>

namespace Arenite
{
/// Solid or liquid with the linear Hugoniot U_s = c_0 + s u_p and constant rho Gamma (Mie-Grueneisen):
///
///   chi = 1 - rho_0/rho,   p_H = rho_0 c_0^2 chi/(1 - s chi)^2  (chi > 0),   p_H = rho_0 c_0^2 chi  (chi < 0)
///   p   = p_H (1 - Gamma_0 chi/2) + rho_0 Gamma_0 e                                     e [J/kg], zero at rest
///   c^2 = [ dp_H/dchi (1 - Gamma_0 chi/2) - Gamma_0 p_H/2 ] rho_0/rho^2 + rho_0 Gamma_0 p/rho^2
///
/// The energy balance of a step e_1 = e_0 - (p_0 + p_1)/2 (1/rho_1 - 1/rho_0) + w is linear in p_1: no iteration, and one step from
/// rest to any density gives the Hugoniot exactly.
///
/// A linear Hugoniot has no state beyond chi = 1/s. From 0.95/s on, the curve continues along its tangent and the point is flagged
/// in the history: results there are wrong but finite.
struct MieGrueneisen
{
  static constexpr const char *name = "mie grueneisen";
  static constexpr const char *description =
    "Shock compression and heating of solids and liquids with a linear Hugoniot.";
  static constexpr bool uses_energy = true;

  template <typename Number>
  struct History
  {
    Number energy   = Number(0.); ///< e [J/kg]
    Number at_limit = Number(0.); ///< 1 once the point was compressed beyond the range of the Hugoniot
    template <typename F>
    void for_each(F &&f)
    {
      f("internal energy", energy);
      f("beyond Hugoniot", at_limit);
    }
  };

  double density          = std::numeric_limits<double>::quiet_NaN(); ///< rho_0 [kg/m^3]
  double sound_speed      = std::numeric_limits<double>::quiet_NaN(); ///< c_0 [m/s]
  double slope            = std::numeric_limits<double>::quiet_NaN(); ///< s
  double gamma            = 0.;                                       ///< Gamma_0
  double tension_limit    = no_tension_limit;                         ///< T [Pa]
  double largest_pressure = 1e10;                                     ///< end of the valid range [Pa]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  History<double> initial_history() const { return {}; }
  double          reference_density() const { return density; }

  /// Pressure at zero energy, p = cold + rho_0 Gamma_0 e [Pa], and its slope over density at constant e [m^2/s^2].
  template <typename Number>
  struct Cold
  {
    Number pressure, slope;
  };
  template <typename Number>
  Cold<Number> cold(const Number &rho) const
  {
    const double modulus = density * sound_speed * sound_speed, limit = largest_chi();
    const double at_limit = 1. - slope * limit, p_limit = modulus * limit / (at_limit * at_limit),
                 slope_limit = modulus * (1. + slope * limit) / (at_limit * at_limit * at_limit);
    const Number one(1.), chi = one - Number(density) / rho;
    const Number x    = Arenite::min<Number>(Arenite::max<Number>(chi, Number(0.)), Number(limit)),
                 d    = one / (one - Number(slope) * x);
    const auto beyond = chi > Number(limit), expanded = chi < Number(0.);
    Number     p_H  = Number(modulus) * x * d * d;
    Number     dp_H = Number(modulus) * (one + Number(slope) * x) * d * d * d;
    p_H  = Arenite::select<Number>(beyond, Number(Number(p_limit) + Number(slope_limit) * (chi - Number(limit))), p_H);
    dp_H = Arenite::select<Number>(beyond, Number(slope_limit), dp_H);
    p_H  = Arenite::select<Number>(expanded, Number(Number(modulus) * chi), p_H);
    dp_H = Arenite::select<Number>(expanded, Number(modulus), dp_H);
    const Number factor = one - Number(.5 * gamma) * chi;
    return {p_H * factor, (dp_H * factor - Number(.5 * gamma) * p_H) * Number(density) / (rho * rho)};
  }
  /// dp/de at constant density [kg/m^3]
  double thermal() const { return density * gamma; }
  double largest_chi() const { return slope > 0. ? .95 / slope : 1.; }

  /// rho c^2 [Pa], not below a hundredth of that at rest: hot expanded states may lose theirs
  template <typename Number>
  Number modulus(const Number &rho, const Number &cold_slope, const Number &pressure) const
  {
    const Number c2 = cold_slope + Number(thermal()) * pressure / (rho * rho);
    return rho * Arenite::max<Number>(c2, Number(.01 * sound_speed * sound_speed));
  }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, History<Number> &history) const
  {
    const Number      &rho     = change.density;
    const Cold<Number> curve   = cold<Number>(rho);
    const Number       half_dv = Number(.5) * (Number(1.) / rho - Number(1.) / change.density_old), T(thermal()),
                 limit(-tension_limit);
    // max(): a step that expands or compresses several times over is out of range, but must not change the sign of the pressure
    const Number implicit = Arenite::max<Number>(Number(1.) + T * half_dv, Number(.1));
    const Number energy = (history.energy + change.heat - (change.pressure_old + curve.pressure) * half_dv) / implicit;
    const Number closed = curve.pressure + T * energy, p = Arenite::max<Number>(closed, limit);
    history.energy =
      Arenite::select<Number>(closed < limit,
                              Number(history.energy + change.heat - (change.pressure_old + limit) * half_dv), energy);
    history.at_limit =
      Arenite::select<Number>(Number(1.) - Number(density) / rho > Number(largest_chi()), Number(1.), history.at_limit);

    const Number K = modulus<Number>(rho, curve.slope, p);
    return {p, Arenite::select<Number>(closed < limit, Number(rho * Number(sound_speed * sound_speed)), K),
            history.energy};
  }

  /// Behind a shock of the largest pressure, or at the end of tension.
  double bulk_sound_speed_bound() const { return speed_bound; }

  /// rho_0 c_0^2 chi/(1 - s chi)^2
  double hugoniot_pressure(const double rho) const
  {
    const double chi = 1. - density / rho;
    return density * sound_speed * sound_speed * chi / ((1. - slope * chi) * (1. - slope * chi));
  }

  /// Derived constants and checks; the reason of a refusal, or nothing.
  std::string prepare();

private:
  double      speed_bound = 0.;
  std::string path;
};
} // namespace Arenite
