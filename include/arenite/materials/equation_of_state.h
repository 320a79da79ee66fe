#pragma once

#include <arenite/base/parameters.h>
#include <arenite/materials/material_law.h>

#include <type_traits>

namespace Arenite
{
/// What an equation of state is told about one step.
template <typename Number>
struct VolumeChange
{
  Number density_old;       ///< at t_n [kg/m^3]
  Number density;           ///< at t_{n+1} [kg/m^3]
  Number pressure_old;      ///< at t_n, compression positive [Pa]
  Number heat = Number(0.); ///< plastic and viscous work of the step [J/kg]
};

/// What it answers, at t_{n+1}.
template <typename Number>
struct EquationOfStateResponse
{
  Number pressure;     ///< compression positive, zero at rest [Pa]
  Number bulk_modulus; ///< rho c^2 of the fastest small disturbance, which is unloading where that is stiffer [Pa]
  Number
    stored; ///< energy of the volume change, zero at rest: recoverable; with uses_energy all of it, heat included [J/kg]
  Number dissipated = Number(0.); ///< by the compaction of the step [J/kg]; nothing with uses_energy, where it is heat
};

// An equation of state is a struct without a base class that knows no mesh:
//
//   static constexpr const char *name, *description;
//   static constexpr bool uses_energy;                              // energy is a variable: VolumeChange::heat raises the pressure
//   template <typename Number> struct History { ...; for_each(f); };
//   void declare_parameters(Parameters &);
//   void finalize(const Parameters &);                              // checks and derived constants
//   History<double> initial_history() const;
//   double reference_density() const;                               // at rest [kg/m^3]
//   template <typename Number>
//   EquationOfStateResponse<Number> update(const VolumeChange<Number> &, History<Number> &) const;
//   double bulk_sound_speed_bound() const;                          // up to the largest pressure of the valid range [m/s]
//   double hugoniot_pressure(double density) const;                 // behind one shock into the soil at rest [Pa]
//
// All of them give the pressure as a function of density and history, not as a sum of increments: the opening of a gap at the
// tension limit is remembered by the density, and the pressure returns only when the gap has closed.

/// Default of a tension limit [Pa]: none.
constexpr double no_tension_limit = 1e300;

/// True if @p EOS offers all of the above.
template <typename EOS, typename Number = double, typename = void>
struct IsEquationOfState : std::false_type
{};
template <typename EOS, typename Number>
struct IsEquationOfState<
  EOS, Number,
  std::void_t<decltype(EOS::name), decltype(EOS::description), std::enable_if_t<(EOS::uses_energy || true)>,
              decltype(std::declval<EOS &>().declare_parameters(std::declval<Parameters &>())),
              decltype(std::declval<EOS &>().finalize(std::declval<const Parameters &>())),
              std::enable_if_t<std::is_same_v<decltype(std::declval<const EOS &>().initial_history()),
                                              typename EOS::template History<double>>>,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const EOS &>().reference_density()), double>>,
              std::enable_if_t<std::is_same_v<
                decltype(std::declval<const EOS &>().update(std::declval<const VolumeChange<Number> &>(),
                                                            std::declval<typename EOS::template History<Number> &>())),
                EquationOfStateResponse<Number>>>,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const EOS &>().bulk_sound_speed_bound()), double>>,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const EOS &>().hugoniot_pressure(1.)), double>>>>
  : std::true_type
{};

/// State behind a steady shock that compresses material at rest from rho_0 to rho at the pressure p (Rankine-Hugoniot, p_0 = 0).
struct ShockState
{
  double shock_speed;    ///< U_s = sqrt(p / (rho_0 (1 - rho_0/rho))) [m/s]
  double particle_speed; ///< u_p = sqrt(p (1 - rho_0/rho) / rho_0) [m/s]
  double energy;         ///< e - e_0 = p (1 - rho_0/rho) / (2 rho_0) [J/kg]
};

ShockState shock_state(double reference_density, double density, double pressure);

/// Energy per mass that a logarithmic spring p = K ln(rho / rho_z) gives back until p = 0 [J/kg]:
///
///   int_{rho_z}^{rho} p drho / rho^2 = K (q - 1 - ln q) / rho,   q = rho / rho_z
template <typename Number>
ARENITE_INLINE Number logarithmic_energy(const Number &bulk_modulus, const Number &log_q, const Number &density)
{
  return bulk_modulus / density * Arenite::exponential_remainder<Number>(log_q);
}

/// Spall: the pressure does not fall below -T. While the gap is open the modulus is that of the bulk sound speed with which it closes,
/// so that the time step keeps the stiffness that returns, and the work against T is stored: the gap gives it back on closing.
/// @p opening is 1 - rho/rho_t with the density rho_t at p = -T, @p speed_squared the c^2 there.
template <typename Number>
ARENITE_INLINE void limit_tension(EquationOfStateResponse<Number> &response, const double tension_limit,
                                  const Number &density, const Number &opening, const Number &speed_squared)
{
  const auto   open     = response.pressure < Number(-tension_limit);
  const Number opened   = Number(tension_limit) / density * opening;
  response.bulk_modulus = Arenite::select<Number>(open, Number(density * speed_squared), response.bulk_modulus);
  response.stored       = Arenite::select<Number>(open, Number(response.stored + opened), response.stored);
  response.pressure     = Arenite::select<Number>(open, Number(-tension_limit), response.pressure);
}
} // namespace Arenite
