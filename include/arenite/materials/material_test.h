#pragma once

#include <arenite/materials/material_point.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace Arenite
{
/// A part of a test in which the prescribed strains and stresses change at constant rates.
struct TestLeg
{
  std::string  name;
  Conditions   conditions;    ///< at the end of the leg
  double       duration = 0.; ///< [s]
  unsigned int rows     = 1;
  bool         jumps    = false; ///< every row is one step from the beginning of the leg: a Hugoniot curve
};

/// `subsection Test`: what is done to the point.
///
///   strain path      rows of a CSV file                          isotropic        volume strain in all directions
///   uniaxial strain  oedometer                                   simple shear     gamma = 2 eps12
///   triaxial         axial strain, lateral stress or p constant  creep            stress up, then constant
///   relaxation       strain up, then constant                    strain cycle     0, A, A + B, B, 0
///   Hugoniot         uniaxial strain with the states of Rankine and Hugoniot
///
/// Strains and stresses are positive in tension. A test may begin with an isotropic confining pressure; strains then count from
/// there.
class MaterialTest
{
public:
  /// The entries of the test that the file chose.
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// The legs in order; none for a strain path.
  const std::vector<TestLeg> &legs() const { return all_legs; }

  static std::vector<std::string> names();
  static std::string              catalogue(); ///< one Markdown line per test

  std::string  type          = "strain path";
  std::string  strain_path   = ""; ///< file
  unsigned int steps_per_row = 1;

private:
  using On = Condition::On;

  bool                is(const std::string &name) const { return type == name; }
  void                add_ramp(const std::string &mode, const std::vector<double> &strains);
  void                add_cycle();
  std::vector<double> numbers(const Parameters &, const std::string &entry, const std::vector<std::string> &texts,
                              std::size_t least, std::size_t most) const;

  std::string              path;
  std::vector<std::string> strain_texts, first_strain, second_strain;
  std::string              mode = "uniaxial strain", lateral = "constant stress", states = "loading path";
  double                   strain_rate        = 1.;
  double                   confining_pressure = 0.;
  double                   confining_time     = 1.;
  double                   stress             = std::numeric_limits<double>::quiet_NaN();
  double                   loading_time       = 1.;
  double                   hold_time          = 1.;
  unsigned int             rows = 100, cycles = 1;

  std::vector<TestLeg> all_legs;
};

/// Drive @p point through the leg with @p steps_per_row steps per row; @p observe is called after every row.
void run_leg(MaterialPoint &point, const TestLeg &leg, unsigned int steps_per_row,
             const std::function<void()> &observe);

/// The same for the rows of a strain path.
struct StrainPath;
void run_path(MaterialPoint &point, const StrainPath &, unsigned int steps_per_row,
              const std::function<void()> &observe);

/// Shock from the state 0 (at rest) to the state 1: conservation of mass and momentum.
///
///   Us^2 = (sigma_0 - sigma_1)/(rho_0 (1 - rho_0/rho_1)),   up = (1 - rho_0/rho_1) Us      (sigma: 11, tension positive)
struct ShockJump
{
  double shock_speed = 0., particle_speed = 0.; ///< [m/s], relative to the material ahead
  /// Energy per reference volume that the shock adds, (sigma_0 + sigma_1)/2 (rho_0/rho_1 - 1) [J/m^3]
  double energy = 0.;
};
ShockJump shock_jump(const PointState &ahead, const PointState &behind);
} // namespace Arenite
