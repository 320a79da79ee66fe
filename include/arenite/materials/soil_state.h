#pragma once

#include <arenite/base/parameters.h>

#include <optional>
#include <string>

namespace Arenite
{
/// A soil as grains, water and air: what the phases fill and weigh, and how stiff they are once the air is gone.
///
/// Source: Roger (2015), section 1.1.1, equations (1.1.1)-(1.1.13); the mixture moduli are Reuss' and Wood's.
struct SoilState
{
  double void_ratio       = 0.;     ///< e = V_v / V_s (1.1.1)
  double water_content    = 0.;     ///< w = M_w / M_s, a fraction, not per cent (1.1.7)
  double specific_gravity = 2.65;   ///< G_s = rho_s / rho_w (1.1.6)
  double water_density    = 1000.;  ///< rho_w [kg/m^3]
  double grain_modulus    = 36.6e9; ///< K_s [Pa]
  double water_modulus    = 2.2e9;  ///< K_w [Pa]
  double air_pressure     = 101e3;  ///< p_a [Pa], absolute

  double porosity() const { return void_ratio / (1. + void_ratio); }                  ///< n (1.1.3)
  double saturation() const { return water_content * specific_gravity / void_ratio; } ///< S_r (1.1.4), (1.1.10)
  double grain_density() const { return specific_gravity * water_density; }           ///< rho_s [kg/m^3]
  double dry_density() const { return grain_density() / (1. + void_ratio); }          ///< rho_d [kg/m^3] (1.1.9)
  double density() const { return dry_density() * (1. + water_content); }             ///< rho [kg/m^3] (1.1.13)
  double solid_fraction() const { return 1. - porosity(); }                           ///< a_s, of the volume
  double water_fraction() const { return porosity() * saturation(); }                 ///< a_w
  double air_fraction() const { return porosity() * (1. - saturation()); }            ///< a_a
  double compacted_density() const { return density() / (1. - air_fraction()); }      ///< rho_L: no air, phases rigid
  double locking_strain() const;                                                      ///< -ln(1 - a_a), positive
  double compacted_solid_fraction() const { return 1. / (1. + water_content * specific_gravity); } ///< phi_s

  /// K_wg of grains and water under one pressure, 1/K_wg = phi_s/K_s + (1 - phi_s)/K_w [Pa]. Reuss
  double compacted_modulus() const;
  /// c_wg = sqrt(K_wg / rho_L) [m/s]
  double compacted_speed() const;
  /// 1/K = a_s/K_s + a_w/K_w + a_a/(1.4 p_a) [Pa]: grains that do not touch. Wood
  double suspension_modulus() const;
  /// sqrt(K / rho) of the suspension [m/s]
  double suspension_speed() const;

  /// All of the above: f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    f("Moist density", density(), "kg/m^3");
    f("Dry density", dry_density(), "kg/m^3");
    f("Density of the grains", grain_density(), "kg/m^3");
    f("Water content", water_content, "-");
    f("Void ratio", void_ratio, "-");
    f("Porosity", porosity(), "-");
    f("Saturation", saturation(), "-");
    f("Volume fraction of grains", solid_fraction(), "-");
    f("Volume fraction of water", water_fraction(), "-");
    f("Volume fraction of air", air_fraction(), "-");
    f("Density without air rho_L", compacted_density(), "kg/m^3");
    f("Locking strain ln(rho_L/rho)", locking_strain(), "-");
    f("Bulk modulus of grains and water K_wg", compacted_modulus(), "Pa");
    f("Wave speed of grains and water", compacted_speed(), "m/s");
    f("Wave speed of the suspension", suspension_speed(), "m/s");
  }
};

/// What was measured of a soil; any sufficient part of it makes a SoilState.
///
/// Two independent quantities and G_s determine the state (e, w); a third one may take the place of G_s, which otherwise is 2.65.
struct SoilMeasurements
{
  std::optional<double> density, dry_density, water_content, void_ratio, porosity, saturation, relative_density,
    specific_gravity;
  double smallest_void_ratio = 0., largest_void_ratio = 0.; ///< both positive when relative_density is set (1.1.2)
  double water_density = 1000., grain_modulus = 36.6e9, water_modulus = 2.2e9, air_pressure = 101e3;

  /// Raises InputError with the numbers if the state is undetermined, impossible (S_r > 1, n outside (0,1), w < 0), or if a
  /// quantity disagrees with what the others say by more than 0.1 %. Water content is compared as 1 + w, saturation as a part
  /// of 1: rounded values of both are small differences of large numbers.
  SoilState state() const;
};

/// Entries of `subsection Soil state` in the block of a material.
class SoilStateEntries
{
public:
  void declare_parameters(Parameters &);

  /// True if the scene describes the soil by its phases at all.
  bool is_set(const Parameters &) const;

  /// Refuses the section with the reason that SoilMeasurements::state() gives.
  SoilState finalize(const Parameters &) const;

  /// The density of a block that has an entry `Density` beside this section: that of the state. Refuses an entry that the scene sets
  /// to something else (0.1 %).
  double density_of_block(const Parameters &, double entry) const;

private:
  double density = 0., dry_density = 0., water_content = 0., void_ratio = 0., porosity = 0., saturation = 0.,
         relative_density = 0., specific_gravity = 0.;
  SoilMeasurements constants;
  std::string      path;
};
} // namespace Arenite
