#pragma once

#include <arenite/materials/equation_of_state.h>
#include <arenite/materials/strength.h>

#include <cmath>

namespace Arenite
{
/// An equation of state for the pressure and a strength for the deviator, as one law: sigma = tau/J - p I, J = rho_0/rho.
///
/// Energy per mass. Work of a step: -(p_n + p_{n+1})/2 (1/rho_{n+1} - 1/rho_n) + (tau_n + tau_{n+1})/2 : d eps_dev / rho_0, and
///
///   work = d(stored) + dissipated,     stored = E(rho, history) + tau:tau/(4 G rho_0)
///
/// The elastic shear energy does not depend on the volume, so that the pressure is that of the equation of state alone. Dissipated are
/// the plastic work (tau_n + tau_{n+1})/2 : d e_p, what the growth of G takes, tau:tau/4 (1/G_n - 1/G_{n+1}), and the compaction as the
/// equation of state gives it; none is defined as what is left of the others. The shear ledger closes to round-off, that of the volume to
/// second order in the step where E is an integral of the curve.
///
/// Equations of state with energy are adiabatic: E is their internal energy, which receives all work of the pressure (crushed pores and
/// shock heat included) to round-off, and the work of plastic flow and of artificial viscosity as heat. That heat is counted where it was
/// dissipated and not again as stored.
///
/// Where a strength needs the pressure or the modulus of an equation of state with energy, a first pass without the plastic heat gives
/// them; heat only raises both, by Gamma rho times the plastic work of the step, so that the stress stays inside of its surface.
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
    Number heat = Number(0.); ///< of plastic and viscous work [J/kg]; with energy only

    template <typename F>
    void for_each(F &&f)
    {
      volume.for_each(f);
      shear.for_each(f);
      if constexpr (EOS::uses_energy)
        f("heat", heat);
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
    auto rest      = history.volume;
    history.shear  = strength.initial_history(
       equation_of_state.update(VolumeChange<double>{density(), density(), 0., 0.}, rest).bulk_modulus);
    return history;
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const Number one(1.), per_mass(1. / density()), J_n = Number(density()) / increment.density_old,
                                                    J = Number(density()) / increment.density, p_n = pressure(stress_n),
                                                    G_n = history.shear.shear_modulus;
    const SymTensor<Number> tau_n = deviator(stress_n) * J_n, strain = deviator(increment.strain);

    // (i) pressure and modulus, as far as they are needed for the strength
    VolumeChange<Number>            change{increment.density_old, increment.density, p_n, increment.heat};
    EquationOfStateResponse<Number> volumetric{p_n, Number(0.), Number(0.)};
    if constexpr (!EOS::uses_energy)
      volumetric = equation_of_state.update(change, history.volume);
    else if (strength.uses_equation_of_state())
      {
        auto trial = history.volume;
        volumetric = equation_of_state.update(change, trial);
      }

    // (ii) deviator, (iii) its plastic work heats; a step that reverses the load may count it negative, by its mean stress
    const ShearResponse<Number> shear =
      strength.update(ShearIncrement<Number>{tau_n, strain, volumetric.pressure, Number(volumetric.bulk_modulus * J), J,
                                             increment.dt},
                      history.shear);
    if constexpr (EOS::uses_energy)
      {
        change.heat  = increment.heat + Arenite::max<Number>(Number(0.), Number(shear.dissipated * per_mass));
        history.heat = history.heat + change.heat;
        volumetric   = equation_of_state.update(change, history.volume);
      }

    // (iv) the modulus grows, the ledgers are written
    const Number tau_squared = contract(shear.stress, shear.stress);
    const Number G = strength.template grown_modulus<Number>(shear.shear_modulus, Number(volumetric.bulk_modulus * J));
    const auto   sheared = G > Number(0.);
    const Number growth =
      Arenite::select<Number>(sheared,
                              Number(Number(.25) * (contract(tau_n, tau_n) * (one / G_n - one / shear.shear_modulus) +
                                                    tau_squared * (one / shear.shear_modulus - one / G))),
                              Number(0.));
    const Number shear_energy   = Arenite::select<Number>(sheared, Number(Number(.25) * tau_squared / G), Number(0.));
    history.shear.shear_modulus = G;

    Response<Number> response;
    response.stress = shear.stress * Number(one / J) - spherical(volumetric.pressure);
    response.wave_speed =
      Arenite::square_root<Number>(volumetric.bulk_modulus / increment.density + Number(4. / 3.) * G * per_mass);
    response.stored = (volumetric.stored + shear_energy * per_mass - (EOS::uses_energy ? history.heat : Number(0.))) *
                      increment.density;
    response.dissipated = (volumetric.dissipated + (shear.dissipated + growth) * per_mass) *
                          Number(Number(2. * density()) / (J_n + J)); // per mean volume of the step
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
    history.shear.shear_modulus =
      Arenite::max<Number>(history.shear.shear_modulus, Number(initial_history().shear.shear_modulus));
    const Number      p = pressure(stress);
    SymTensor<Number> s = deviator(stress);
    strength.after_transfer(s, p, history.shear);
    stress = s - spherical(p);
  }
};
} // namespace Arenite
