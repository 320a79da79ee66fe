#pragma once

#include <string>

namespace Arenite
{
// Gas in a cavity: its pressure as a function of its volume alone, for the load on the wall. Pure functions of doubles; volumes may
// be the whole cavity or the modelled sector of it, energies then belong to the same part.

/// Ideal gas that expands without exchange of heat: p = p_i (V_i/V)^gamma.
struct AdiabaticGas
{
  double initial_pressure = 0.;  ///< p_i [Pa], absolute
  double initial_volume   = 0.;  ///< V_i [m^3]
  double gamma            = 1.4; ///< air 1.4; detonation products at low density 1.2 to 1.3

  double pressure(double volume) const;
  /// E = p V/(gamma - 1) [J]; dE = -p dV.
  double energy(double volume) const;

  /// The rule that is broken, or nothing.
  std::string complaint() const;
};

/// Detonation products on the isentrope of Jones, Wilkins and Lee, with v = V/V_charge and energies per volume of the charge:
///
///   p_s = A e^(-R1 v) + B e^(-R2 v) + C v^-(1+w)
///   E_s = (A/R1) e^(-R1 v) + (B/R2) e^(-R2 v) + (C/w) v^-w
///
/// C follows from E_0: the isentrope passes through the Chapman-Jouguet state, or through (v = 1, E_0) if the charge is replaced by
/// products of its own volume at rest, which is how a cavity is filled. Source: Lee, Hornig and Kury (1968).
struct DetonationProducts
{
  double charge_density      = 0.; ///< rho_0 [kg/m^3]
  double A                   = 0.; ///< [Pa]
  double B                   = 0.; ///< [Pa]
  double R1                  = 0.;
  double R2                  = 0.;
  double omega               = 0.; ///< w
  double detonation_speed    = 0.; ///< D [m/s]
  double detonation_pressure = 0.; ///< p_CJ [Pa]
  double specific_energy     = 0.; ///< E_0 [J/m^3], per volume of the charge
  double charge_volume       = 0.; ///< [m^3]

  /// Of any state (v, E), not only on the isentrope [Pa].
  double pressure_of_energy(double relative_volume, double energy) const;

  /// C of the isentrope through (v, E) [Pa].
  double isentrope_constant(double relative_volume, double energy) const;

  /// C of the constant-volume fill, through (v = 1, E_0) [Pa].
  double fill_constant() const { return isentrope_constant(1., specific_energy); }

  /// p_s, -dp_s/dv [Pa] and E_s [J/m^3] on the isentrope C.
  double isentrope_pressure(double relative_volume, double C) const;
  double isentrope_slope(double relative_volume, double C) const;
  double isentrope_energy(double relative_volume, double C) const;

  /// p [Pa] and E [J] of the products of the charge in the volume [m^3], from the constant-volume fill.
  double pressure(double volume) const;
  double energy(double volume) const;

  /// v_CJ = 1 - p_CJ/(rho_0 D^2),  E_CJ = E_0 + p_CJ (1 - v_CJ)/2 (Chapman-Jouguet).
  double detonation_volume() const;
  double detonation_energy() const;

  /// How far the constants miss the detonation state: the larger relative error of p(v_CJ, E_CJ) = p_CJ and of tangency,
  /// -dp_s/dv = rho_0 D^2 on the isentrope through that state.
  double inconsistency() const;

  /// A warning with the numbers if inconsistency() exceeds 2 %, or nothing.
  std::string warning() const;

  /// The rule that is broken, or nothing: 0 < R2 < R1, w > 0, E_0, rho_0 > 0; p > 0 and dp_s/dv < 0 from v = 1 to
  /// @p largest_relative_volume.
  std::string complaint(double largest_relative_volume = 1e4) const;
};
} // namespace Arenite
