#pragma once

#include <arenite/materials/batch_law.h>

#include <array>
#include <string>
#include <vector>

namespace Arenite
{
/// One point between two steps.
///
/// Energies are per reference volume: work is the integral of J sigma : d eps with the mean stress and the mean J of each step,
/// stored is J times the law's recoverable energy, dissipated the sum of J times what the law reports. A law that keeps its energy
/// balance per present volume (constant moduli of the Cauchy stress) leaves work - stored - dissipated = - sum of stored dJ / J,
/// which is of the order of the strain; a law that does so in one part says what it is of that. Any other difference is an error of the law.
struct PointState
{
  double              time = 0.;                  ///< [s]
  SymTensor<double>   strain, stress;             ///< total logarithmic strain; Cauchy stress [Pa]; tension positive
  double              density    = 0.;            ///< rho_0 exp(-tr strain) [kg/m^3]
  double              wave_speed = 0.;            ///< [m/s]
  std::vector<double> history;                    ///< in the order of BatchLaw::history_names()
  double              work = 0., dissipated = 0.; ///< [J/m^3]
  double              stored           = 0.;      ///< [J/m^3]
  double              stored_by_volume = 0.;      ///< sum of (stored/J) dJ where that is no work, see above [J/m^3]
  double              substeps         = 0.;      ///< calls of the law times its parts, since the start

  double volume_ratio() const; ///< J
};

/// A linear combination of the components of strain or stress that a test prescribes.
struct Condition
{
  enum class On
  {
    strain,
    stress
  };
  On                    on = On::strain;
  std::array<double, 6> weights{};       ///< of xx, yy, zz, xy, xz, yz
  double                target   = 0.;   ///< at the end [-] or [Pa]
  bool                  relative = true; ///< target counts from the value at the start

  double value(const SymTensor<double> &tensor) const;
};
using Conditions = std::array<Condition, 6>;

/// One point of a law, driven by strain increments or by a mix of prescribed strains and stresses.
class MaterialPoint
{
public:
  /// At rest, without stress. The law runs on one lane and must outlive the point.
  explicit MaterialPoint(const BatchLaw &);

  PointState state;

  /// One step of the law.
  void advance(const SymTensor<double> &strain_increment, double dt);

  /// One step that ends where the six conditions hold, by Newton's method for the strain increment with the tangent by
  /// differences of the law. Where it does not converge the step is divided, at most 2^10 times; PhysicsAlarm when that does not
  /// help either, for example because no state carries the prescribed stress.
  void advance(const Conditions &, double dt);

  static constexpr double tolerance = 1e-10; ///< of a prescribed stress, relative to the stress and its change

private:
  /// The state after a step; the present one stays.
  PointState after(const SymTensor<double> &strain_increment, double dt) const;

  /// The increment that fulfils the conditions (with absolute targets). @return false if none is found.
  bool solve(const Conditions &, double dt, SymTensor<double> &strain_increment) const;
  void advance_parts(const Conditions &, double dt, unsigned int depth);

  const BatchLaw &law;
  double          stiffness; ///< rho c^2 of the wave speed bound, the scale of tangents [Pa]
};
} // namespace Arenite
