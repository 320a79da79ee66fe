#pragma once

#include <arenite/materials/equation_of_state.h>
#include <arenite/materials/strength.h>

#include <cmath>

namespace Arenite
{
/// An equation of state for the pressure and a strength for the deviator, as one law: sigma = s - p I.
///
/// Energy: the deviatoric work of the step per mass, (s_n + s_{n+1})/2 : d eps_dev (1/rho_n + 1/rho_{n+1})/2, heats the equation of
/// state. Where the strength depends on pressure or modulus and these on the energy, a first pass with the work of s_n gives both;
/// the second pass of the equation of state has the exact work. The strength then belongs to a pressure that misses the final one
/// by Gamma rho times the change of the work, which is of second order in the step.
///
/// The answer's stored energy is that of the volume change, as the equation of state gives it, and J2/(2 G). What the step dissipates
/// is its work with the mean stress less what is stored in addition: both together are always the work of the step.
template <typename EOS, typename Strength = SelectedStrength>
struct EquationOfStateWithStrength
{
  static constexpr const char *name        = EOS::name;
  static constexpr const char *description = EOS::description;

  template <typename Number>
  struct History
  {
    typename EOS::template History<Number>      volume;
    typename Strength::template History<Number> shear;
    Number                                      stored = Number(0.); ///< [J/kg]

    template <typename F>
    void for_each(F &&f)
    {
      volume.for_each(f);
      shear.for_each(f);
      f("stored energy", stored);
    }
  };

  EOS      equation_of_state;
  Strength strength;

  void declare_parameters(Parameters &parameters)
  {
    equation_of_state.declare_parameters(parameters);
    strength.declare_parameters(parameters);
  }
  void finalize(const Parameters &parameters)
  {
    equation_of_state.finalize(parameters);
    strength.finalize(parameters);
  }

  double          density() const { return equation_of_state.reference_density(); }
  History<double> initial_history() const
  {
    History<double> history;
    history.volume = equation_of_state.initial_history();
    history.shear  = strength.initial_history();
    return history;
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const SymTensor<Number> s_n = deviator(stress_n), strain = deviator(increment.strain);
    const Number            p_n = pressure(stress_n), volume_n = Number(1.) / increment.density_old,
                 volume = Number(1.) / increment.density, mean_volume = Number(.5) * (volume_n + volume);

    // (i) pressure and modulus for the strength
    VolumeChange<Number>            change{increment.density_old, increment.density, p_n, Number(0.)};
    ShearIncrement<Number>          shear{s_n, strain, p_n, Number(0.), increment.dt};
    EquationOfStateResponse<Number> volumetric{p_n, Number(0.), Number(0.)};
    if constexpr (!EOS::uses_energy)
      volumetric = equation_of_state.update(change, history.volume);
    else if (strength.uses_equation_of_state())
      {
        auto trial        = history.volume;
        change.other_work = contract(s_n, strain) * mean_volume;
        volumetric        = equation_of_state.update(change, trial);
      }
    shear.pressure     = volumetric.pressure;
    shear.bulk_modulus = volumetric.bulk_modulus;

    // (ii) deviator, (iii) its work heats
    const ShearResponse<Number> deviatoric    = strength.update(shear, history.shear);
    const Number                work_of_shear = Number(.5) * contract(s_n + deviatoric.stress, strain) * mean_volume;
    if constexpr (EOS::uses_energy)
      {
        change.other_work = work_of_shear;
        volumetric        = equation_of_state.update(change, history.volume);
      }

    Response<Number> response;
    response.stress = deviatoric.stress - spherical(volumetric.pressure);
    response.wave_speed =
      Arenite::square_root<Number>((volumetric.bulk_modulus + Number(4. / 3.) * deviatoric.shear_modulus) * volume);

    const Number stored = volumetric.stored + deviatoric.stored * volume;
    const Number work   = work_of_shear - Number(.5) * (p_n + volumetric.pressure) * (volume - volume_n);
    response.stored     = stored * increment.density;
    response.dissipated = (work - (stored - history.stored)) * increment.density;
    history.stored      = stored;
    return response;
  }

  double wave_speed_bound() const
  {
    const double c = equation_of_state.bulk_sound_speed_bound(), rho = density();
    return std::sqrt(c * c + 4. / 3. * strength.modulus_bound(rho * c * c) / rho);
  }

  /// The deviator returns to the strength at the pressure that the point has; the pressure follows from density and history in the next
  /// step.
  template <typename Number>
  void after_transfer(SymTensor<Number> &stress, History<Number> &history) const
  {
    const Number      p = pressure(stress);
    SymTensor<Number> s = deviator(stress);
    strength.after_transfer(s, p, history.shear);
    stress = s - spherical(p);
  }
};
} // namespace Arenite
