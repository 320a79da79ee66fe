#pragma once

#include <arenite/base/parameters.h>
#include <arenite/base/tensor_tools.h>
#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/material_law.h>

#include <limits>
#include <string>

namespace Arenite
{
// Shear in Kirchhoff stress, tau = J s with J = rho_0/rho and the Cauchy deviator s: forces per reference volume. With a constant modulus
// G, tau_dot = 2 G e_dot is elasticity with the energy U = tau:tau/(4 G) per reference volume, whatever the volume does meanwhile, so
// that it adds nothing to the pressure and no cycle gives energy. (The same with the Cauchy stress per present volume would: U changes
// with the volume that it is spread over.) The wave speed sqrt(G/rho_0) is that of the body at rest.

/// What a strength is told about one step. The pressure and the modulus come from the equation of state.
template <typename Number>
struct ShearIncrement
{
  SymTensor<Number> stress_old;   ///< Kirchhoff deviator tau at t_n [Pa]
  SymTensor<Number> strain;       ///< deviatoric strain increment [-]
  Number            pressure;     ///< at t_{n+1}, compression positive [Pa]
  Number            bulk_modulus; ///< rho_0 c^2 of the equation of state, per reference volume, at t_{n+1} [Pa]
  Number            volume_ratio; ///< J at t_{n+1}
  double            dt;           ///< [s]
};

/// What it answers.
template <typename Number>
struct ShearResponse
{
  SymTensor<Number> stress;        ///< Kirchhoff deviator at t_{n+1} [Pa]
  Number            shear_modulus; ///< with which the step was computed [Pa]
  Number            dissipated; ///< plastic work (tau_n + tau_{n+1})/2 : de_p of the step, per reference volume [J/m^3]
};

/// Memory of the shear.
template <typename Number>
struct ShearHistory
{
  Number plastic_strain = Number(0.); ///< int sqrt(2/3 de_p : de_p)
  Number shear_modulus  = Number(0.); ///< G, which never falls [Pa]
  template <typename F>
  void for_each(F &&f)
  {
    f("plastic strain", plastic_strain);
    f("shear modulus", shear_modulus);
  }
};

/// Y and dY/d ep [Pa], of the Cauchy stress q = sqrt(3 J2).
template <typename Number>
struct YieldStress
{
  Number value, slope;
};

/// Equivalent plastic strain x >= 0 of a step that begins with the trial stress q (Kirchhoff):
///
///   3 G x + J Y(ep_n + x) (1 + c ln max(1, x/(dt rate_0))) = q          or 0 if q <= J Y(ep_n)
///
/// The left side rises with x: one root. The rate is the plastic one, x/dt: without time nothing flows, and a stress that fast loading
/// has left above the static strength relaxes. Johnson and Cook (1983); for soils Roger (2015), (2.2.16)-(2.2.17), with the rate of the
/// whole deviatoric strain, to which the plastic one comes close once it flows. As printed there the factor falls below 1, and at last
/// below 0, for slow loading; the static strength is kept instead.
struct RateFactor
{
  double coefficient = 0., reference_rate = 1.; ///< c, rate_0 [1/s]

  template <typename Number, typename Yield>
  Number plastic_step(const Yield &yield, const bool linear, const Number &q, const Number &G, const Number &J,
                      const double dt) const
  {
    const YieldStress<Number> at_start        = yield(Number(0.));
    const Number              excess_at_start = q - J * at_start.value, three_G = Number(3.) * G;
    const auto                yields = excess_at_start > Number(0.);
    const bool                rated  = coefficient > 0. && dt > 0.;
    if (!any_of(yields))
      return Number(0.);
    if (linear && !rated)
      return Arenite::select<Number>(yields, Number(excess_at_start / (three_G + J * at_start.slope)), Number(0.));

    const auto excess = [&](const Number &x) {
      const YieldStress<Number> Y = yield(x);
      Number                    factor(1.), slope_of_factor(0.);
      if (rated)
        {
          const Number threshold(dt * reference_rate), beyond = Arenite::max<Number>(x, threshold);
          factor          = Number(1.) + Number(coefficient) * Arenite::logarithm<Number>(beyond / threshold);
          slope_of_factor = Arenite::select<Number>(x > threshold, Number(Number(coefficient) / beyond), Number(0.));
        }
      return ValueAndSlope<Number>{three_G * x + J * Y.value * factor - q,
                                   three_G + J * (Y.slope * factor + Y.value * slope_of_factor)};
    };
    // no more than without hardening and rate, and the digits of q
    const Number largest = Arenite::max<Number>(Number(0.), Number((excess_at_start + Number(1e-15) * q) / three_G));
    Number       x       = bracketed_root<Number>(excess, Number(0.), largest, Number(Number(.5) * largest),
                                      Number(Number(1e-13) * largest));
    // a slow flow, far below `largest`, by x = dt rate_0 exp(((q - 3 G x)/(J Y) - 1)/c): each time 3 G x/(J Y c) of the error stays
    if (rated)
      for (int i = 0; i < 2; ++i)
        {
          const Number stress = J * yield(x).value;
          const auto   slow   = three_G * x < Number(.01 * coefficient) * stress;
          if (!any_of(slow && yields))
            break;
          const Number overstress = (q - three_G * x) / stress - Number(1.);
          const Number flow =
            Number(dt * reference_rate) * Arenite::exponential<Number>(overstress * Number(1. / coefficient));
          x = Arenite::select<Number>(slow && overstress > Number(0.), Arenite::min<Number>(flow, largest), x);
        }
    return Arenite::select<Number>(yields, x, Number(0.));
  }
};

/// The trial stress scaled back: tau = scale tau_trial, de_p = (tau_trial - tau)/(2 G).
template <typename Number>
ARENITE_INLINE ShearResponse<Number> scaled_back(const ShearIncrement<Number> &increment,
                                                 const SymTensor<Number> &trial, const Number &scale, const Number &G)
{
  const SymTensor<Number> tau = trial * scale;
  return {tau, G, Number(.25) * (Number(1.) - scale) / G * contract(increment.stress_old + tau, trial)};
}

/// The elastic shear that all strengths share: a constant modulus, or a constant Poisson ratio on first loading,
///
///   G = r rho_0 c_m^2,   r = 3 (1 - 2 nu)/(2 (1 + nu)),   c_m the largest bulk sound speed that the point has had
///
/// c_m and not c: a modulus that followed the sound speed both ways would return more energy in a cycle of compression and shear than it
/// received. What G > G_n costs is dissipated: tau:tau/4 (1/G_n - 1/G).
struct ElasticShear
{
  static constexpr const char *name = "elastic";

  template <typename Number>
  using History = ShearHistory<Number>;

  double shear_modulus = 0.; ///< [Pa]; used if positive
  double poisson_ratio = 0.; ///< used otherwise

  void declare_parameters(Parameters &);
  void finalize(const Parameters &) const; ///< refuses both entries, and none

  /// At rest, with the bulk modulus of the equation of state there.
  ShearHistory<double> initial_history(const double bulk_modulus) const
  {
    return {0., grown_modulus<double>(0., bulk_modulus)};
  }
  bool   uses_equation_of_state() const { return !(shear_modulus > 0.); }
  double ratio() const { return 1.5 * (1. - 2. * poisson_ratio) / (1. + poisson_ratio); } ///< G/K

  /// G at the end of a step that began with @p G, or was computed with it.
  template <typename Number>
  Number grown_modulus(const Number &G, const Number &bulk_modulus) const
  {
    return shear_modulus > 0. ? Number(shear_modulus) : Arenite::max<Number>(G, Number(Number(ratio()) * bulk_modulus));
  }
  /// G of the step: the mean of both ends.
  template <typename Number>
  Number mean_modulus(const ShearIncrement<Number> &increment, const ShearHistory<Number> &history) const
  {
    return shear_modulus > 0.
             ? Number(shear_modulus)
             : Number(Number(.5) *
                      (history.shear_modulus + grown_modulus<Number>(history.shear_modulus, increment.bulk_modulus)));
  }
  /// G of a material whose bulk modulus is at most @p bulk_modulus [Pa]
  double modulus_bound(const double bulk_modulus) const { return grown_modulus<double>(0., bulk_modulus); }

  template <typename Number>
  SymTensor<Number> trial(const ShearIncrement<Number> &increment, const Number &G) const
  {
    return increment.stress_old + increment.strain * Number(Number(2.) * G);
  }
  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, ShearHistory<Number> &history) const
  {
    const Number G = mean_modulus<Number>(increment, history);
    return {trial<Number>(increment, G), G, Number(0.)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &, const Number &, ShearHistory<Number> &) const
  {}

private:
  std::string path;
};

/// No shear at all: a fluid.
struct NoStrength
{
  static constexpr const char *name = "none";

  template <typename Number>
  using History = ShearHistory<Number>;

  void                 declare_parameters(Parameters &) {}
  void                 finalize(const Parameters &) const {}
  ShearHistory<double> initial_history(double) const { return {}; }
  bool                 uses_equation_of_state() const { return false; }
  double               modulus_bound(double) const { return 0.; }

  template <typename Number>
  Number grown_modulus(const Number &, const Number &) const
  {
    return Number(0.);
  }
  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &, ShearHistory<Number> &) const
  {
    return {SymTensor<Number>(), Number(0.), Number(0.)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &deviator, const Number &, ShearHistory<Number> &) const
  {
    deviator = SymTensor<Number>();
  }
};

/// Metal-like plasticity: sqrt(3 J2) <= Y = (Y_0 + H ep^n) (1 + C ln max(1, rate/rate_0)), Johnson and Cook (1983) without softening by heat;
/// n = 1 is linear hardening. Radial return tau = tau_trial (1 - 3 G d ep/q_trial), q = sqrt(3/2 tau:tau), see RateFactor.
struct MisesStrength
{
  static constexpr const char *name = "mises";

  template <typename Number>
  using History = ShearHistory<Number>;

  ElasticShear elastic;
  double       yield_stress = std::numeric_limits<double>::quiet_NaN(); ///< Y_0 [Pa], uniaxial
  double       hardening = 0., hardening_exponent = 1.;                 ///< H [Pa], n
  RateFactor   rate;

  void declare_parameters(Parameters &);
  void finalize(const Parameters &parameters) const { elastic.finalize(parameters); }

  ShearHistory<double> initial_history(const double K) const { return elastic.initial_history(K); }
  bool                 uses_equation_of_state() const { return elastic.uses_equation_of_state(); }
  double               modulus_bound(const double bulk_modulus) const { return elastic.modulus_bound(bulk_modulus); }
  template <typename Number>
  Number grown_modulus(const Number &G, const Number &bulk_modulus) const
  {
    return elastic.grown_modulus<Number>(G, bulk_modulus);
  }

  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, ShearHistory<Number> &history) const
  {
    const Number            G = elastic.mean_modulus<Number>(increment, history), ep = history.plastic_strain;
    const SymTensor<Number> s = elastic.trial<Number>(increment, G);
    const Number            q = Arenite::square_root<Number>(Number(3.) * second_invariant(s) + Number(tiny()));
    const auto              Y = [&](const Number &x) {
      // the slope not at 0, where that of ep^n is infinite for n < 1
      const Number away = Arenite::max<Number>(ep + x, Number(1e-12));
      return YieldStress<Number>{yield<Number>(ep + x), Number(hardening * hardening_exponent) *
                                                          Arenite::power<Number>(away, hardening_exponent - 1.)};
    };
    const Number step      = rate.plastic_step<Number>(Y, hardening == 0. || hardening_exponent == 1., q, G,
                                                  increment.volume_ratio, increment.dt);
    history.plastic_strain = history.plastic_strain + step;
    return scaled_back<Number>(increment, s, Number(Number(1.) - Number(3.) * G * step / q), G);
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &s, const Number &, ShearHistory<Number> &history) const
  {
    history.plastic_strain = Arenite::max<Number>(Number(0.), history.plastic_strain);
    if (rate.coefficient > 0.)
      return; // fast loading may have left a stress above the static strength
    const Number Y = yield<Number>(history.plastic_strain);
    const Number q = Arenite::square_root<Number>(Number(3.) * second_invariant(s) + Number(tiny()));
    s *= Arenite::min<Number>(Number(1.), Y / q);
  }

private:
  /// Y_0 + H ep^n
  template <typename Number>
  Number yield(const Number &plastic_strain) const
  {
    return Number(yield_stress) + Number(hardening) * Arenite::power<Number>(plastic_strain, hardening_exponent);
  }

  /// Keeps the derivative of the root finite without stress: (1e-12 Y_0)^2.
  double tiny() const { return 1e-24 * yield_stress * yield_stress; }
};

/// Friction: sqrt(J2) <= F = min(k + alpha I1, F_max) (1 + beta ln max(1, rate/rate_0)), I1 = 3 p in compression, not below 0, with the Cauchy
/// stress. Radial return at constant pressure: no dilatancy, the pressure is that of the equation of state.
///
/// Source: Wang et al. (2004) as in Roger (2015), (2.2.15)-(2.2.17); the bound F_max is ours: sands saturate above some
/// hundred MPa (Laine and Sandvik (2001): sqrt(3) F_max = 226 MPa).
struct FrictionStrength
{
  static constexpr const char *name = "drucker prager";

  template <typename Number>
  using History = ShearHistory<Number>;

  ElasticShear elastic;
  double       cohesion         = 0.;                                       ///< k [Pa]
  double       slope            = std::numeric_limits<double>::quiet_NaN(); ///< alpha
  double       largest_strength = 1.3e8;                                    ///< F_max [Pa], of sqrt(J2)
  RateFactor   rate;                                                        ///< beta

  void declare_parameters(Parameters &);
  void finalize(const Parameters &) const;

  ShearHistory<double> initial_history(const double K) const { return elastic.initial_history(K); }
  bool                 uses_equation_of_state() const { return true; }
  double               modulus_bound(const double bulk_modulus) const { return elastic.modulus_bound(bulk_modulus); }
  template <typename Number>
  Number grown_modulus(const Number &G, const Number &bulk_modulus) const
  {
    return elastic.grown_modulus<Number>(G, bulk_modulus);
  }

  /// F without the rate factor [Pa]
  template <typename Number>
  Number limit(const Number &pressure) const
  {
    return Arenite::max<Number>(Number(0.), Arenite::min<Number>(Number(largest_strength),
                                                                 Number(cohesion) + Number(3. * slope) * pressure));
  }

  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, ShearHistory<Number> &history) const
  {
    const Number            G        = elastic.mean_modulus<Number>(increment, history);
    const SymTensor<Number> s        = elastic.trial<Number>(increment, G);
    const Number            three_J2 = Number(3.) * second_invariant(s),
                 q                   = Arenite::square_root<Number>(three_J2 + Number(tiny())),
                 Y                   = Number(1.7320508075688772) * limit<Number>(increment.pressure);
    const Number step                = rate.plastic_step<Number>(
      [&](const Number &) {
        return YieldStress<Number>{Y, Number(0.)};
      },
      true, q, G, increment.volume_ratio, increment.dt);
    // where neither strength nor stress is left, q is the tiny number alone
    history.plastic_strain = history.plastic_strain + step * three_J2 / (q * q);
    const Number scale     = Arenite::max<Number>(Number(0.), Number(Number(1.) - Number(3.) * G * step / q));
    return scaled_back<Number>(increment, s, scale, G);
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &s, const Number &pressure, ShearHistory<Number> &history) const
  {
    history.plastic_strain = Arenite::max<Number>(Number(0.), history.plastic_strain);
    if (rate.coefficient > 0.)
      return; // as for Mises
    const Number root = Arenite::square_root<Number>(second_invariant(s) + Number(tiny()));
    s *= Arenite::min<Number>(Number(1.), limit<Number>(pressure) / root);
  }

private:
  double tiny() const { return 1e-24 * largest_strength * largest_strength; }
};

/// The strength that the scene chooses: one history and one code for all, a branch that is the same for all points. So a law is
/// compiled once per equation of state, not once per pair.
struct SelectedStrength
{
  static constexpr const char *name = "selected";

  template <typename Number>
  using History = ShearHistory<Number>;

  enum class Kind
  {
    none,
    elastic,
    mises,
    friction
  };
  Kind             kind = Kind::none;
  ElasticShear     elastic;
  MisesStrength    mises;
  FrictionStrength friction;

  /// Declares `Strength` and the entries of the choice.
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// The one in use.
  template <typename F>
  decltype(auto) visit(F &&f) const
  {
    switch (kind)
      {
      case Kind::elastic:
        return f(elastic);
      case Kind::mises:
        return f(mises);
      case Kind::friction:
        return f(friction);
      default:
        return f(NoStrength());
      }
  }

  ShearHistory<double> initial_history(const double bulk_modulus) const
  {
    return visit([&](const auto &strength) { return strength.initial_history(bulk_modulus); });
  }
  bool uses_equation_of_state() const
  {
    return visit([](const auto &strength) { return strength.uses_equation_of_state(); });
  }
  double modulus_bound(const double bulk_modulus) const
  {
    return visit([&](const auto &strength) { return strength.modulus_bound(bulk_modulus); });
  }
  template <typename Number>
  Number grown_modulus(const Number &G, const Number &bulk_modulus) const
  {
    return visit([&](const auto &strength) { return strength.template grown_modulus<Number>(G, bulk_modulus); });
  }
  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, ShearHistory<Number> &history) const
  {
    return visit([&](const auto &strength) { return strength.template update<Number>(increment, history); });
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &deviator, const Number &pressure, ShearHistory<Number> &history) const
  {
    visit([&](const auto &strength) { strength.template after_transfer<Number>(deviator, pressure, history); });
  }

private:
  std::string word = "none";
};
} // namespace Arenite
