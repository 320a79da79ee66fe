#pragma once

#include <arenite/materials/three_phase_mixture.h>
#include <arenite/materials/viscoplastic_cap.h>

#include <cmath>
#include <string>
#include <vector>

namespace Arenite
{
/// Wet soil under loads that are faster than drainage: skeleton and pores share the volume change and add up their stresses
/// (Terzaghi's effective stress),
///
///   sigma = sigma' - p_f I,      sigma' = cap model of the skeleton (d eps),      p_f = three-phase mixture of air, water, grains (rho)
///
/// so that friction and compaction see sigma' only. While there is air the skeleton carries the load and the air pressure is small;
/// once the air is closed the volume hardly changes any more, p_f takes the load, and the strength stays what sigma' has reached: a wet
/// soil under a strong shock is nearly a fluid. At rest the bulk modulus is that of the skeleton and Wood's of the suspension, K' + K_W;
/// Gassmann's is smaller by nearly 2 K'K_W/K_s, because his grains are squeezed by the skeleton, too.
///
/// The skeleton keeps constant moduli: the stiffening by closed air comes from the mixture, a stiffening skeleton would count it twice.
/// W is bounded by all pores, ln(1 + e), because the water in them is the business of the mixture. The mixture is reversible: all
/// dissipation is the skeleton's. The mixture's energy is that of its mass; the skeleton with its moduli of the Cauchy stress stores per
/// present volume, and what a change of the volume does to that is no work: stored_by_volume says it.
struct UndrainedCap
{
  static constexpr const char *name = "undrained cap";
  static constexpr const char *description =
    "Wet soil, faster than drainage: cap model on effective stress beside air, water and grains.";

  using Skeleton = ViscoplasticCap<ConstantStiffness>;

  template <typename Number>
  struct History
  {
    Number                             pore_pressure = Number(0.); ///< p_f above that at rest [Pa]
    typename Skeleton::History<Number> skeleton;

    template <typename F>
    void for_each(F &&f)
    {
      f("pore pressure", pore_pressure);
      skeleton.for_each(f);
    }
  };

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  double density() const { return skeleton.density(); }

  History<double> initial_history() const
  {
    History<double> history;
    history.skeleton = skeleton.initial_history();
    return history;
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const Number      p_n = history.pore_pressure;
    NoHistory<Number> none;
    const auto        pore_change = VolumeChange<Number>{increment.density_old, increment.density, p_n};
    const auto        mixture     = pores.update(pore_change, none);
    history.pore_pressure         = mixture.pressure;

    const SymTensor<Number> effective_n = stress_n + spherical(p_n);
    Response<Number>        response    = skeleton.update(effective_n, increment, history.skeleton);
    // the mean of U' times dJ over the mean J
    response.stored_by_volume =
      (response.stored +
       skeleton.stiffness.elastic.stored_energy(pressure(effective_n), second_invariant(deviator(effective_n)))) *
      (increment.density_old - increment.density) / (increment.density_old + increment.density);
    response.stress = response.stress - spherical(mixture.pressure);
    response.stored = response.stored + increment.density * mixture.stored;
    response.wave_speed =
      square_root(Number(response.wave_speed * response.wave_speed + mixture.bulk_modulus / increment.density));
    return response;
  }

  bool limits_volume_change() const { return pores.fraction[0] > 0.; }

  /// The volume strain over which the pores stiffen by half of their modulus: a fifth of what is left of the air, more than any step takes
  /// when that is closed. The mean pressure of a step that closes it is not the work of the step.
  template <typename Number>
  Number volume_limit(const History<Number> &history) const
  {
    return Number(0.5) / pores.stiffening(history.pore_pressure);
  }

  double wave_speed_bound() const { return std::hypot(skeleton.wave_speed_bound(), pores.bulk_sound_speed_bound()); }

  template <typename Number>
  void after_transfer(SymTensor<Number> &stress, History<Number> &history) const
  {
    const Number p         = max(history.pore_pressure, Number(-pores.tension_limit));
    auto         effective = SymTensor<Number>(stress + spherical(history.pore_pressure));
    skeleton.after_transfer(effective, history.skeleton);
    history.pore_pressure = p;
    stress                = effective - spherical(p);
  }

  /// The stress at rest is carried by the skeleton: above the water table.
  std::string begin_under(const SymTensor<double> &stress, const double overconsolidation,
                          History<double> &history) const
  {
    return skeleton.begin_under(stress, overconsolidation, history.skeleton);
  }

  /// f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    skeleton.for_each_constant(f);
    f("Undrained bulk modulus at rest", undrained_modulus(), "Pa");
    f("Undrained P-wave speed at rest",
      std::sqrt((undrained_modulus() + 4. / 3. * skeleton.stiffness.elastic.shear_modulus) / density()), "m/s");
  }
  std::vector<std::string> warnings() const { return skeleton.warnings(); }

  /// K' + Wood's modulus [Pa]
  double undrained_modulus() const;

  Skeleton          skeleton;
  ThreePhaseMixture pores;

private:
  std::string path;
};
} // namespace Arenite
