#pragma once

#include <arenite/base/parameters.h>
#include <arenite/base/tensor_tools.h>
#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/material_law.h>

#include <limits>
#include <string>

namespace Arenite
{
/// What a strength is told about one step. The pressure and the modulus come from the equation of state.
template <typename Number>
struct ShearIncrement
{
  SymTensor<Number> stress_old;   ///< deviator at t_n [Pa]
  SymTensor<Number> strain;       ///< deviatoric strain increment [-]
  Number            pressure;     ///< at t_{n+1}, compression positive [Pa]
  Number            bulk_modulus; ///< rho c^2 of the equation of state [Pa]
  double            dt;           ///< [s]
};

/// What it answers.
template <typename Number>
struct ShearResponse
{
  SymTensor<Number> stress;        ///< deviator at t_{n+1} [Pa]
  Number            shear_modulus; ///< G [Pa]
  Number            stored;        ///< J2/(2 G) [J/m^3], per present volume
};

/// Equivalent plastic strain, for the strengths that yield.
template <typename Number>
struct PlasticHistory
{
  Number plastic_strain = Number(0.); ///< int sqrt(2/3 de_p : de_p)
  template <typename F>
  void for_each(F &&f)
  {
    f("plastic strain", plastic_strain);
  }
};

/// 1 + c ln(max(1, rate/rate_0)) with the effective rate sqrt(2/3 e:e) of the deviatoric strain: Johnson and Cook (1983) and, for
/// soils, Roger (2015), (2.2.16)-(2.2.17). As printed there the factor falls below 1, and at last below 0, for slow loading; the
/// static strength is kept instead. One rate per lane.
template <typename Number>
Number rate_factor(const SymTensor<Number> &strain, const double dt, const double coefficient,
                   const double reference_rate)
{
  if (!(coefficient > 0. && dt > 0.))
    return Number(1.);
  const Number rate =
    Arenite::square_root<Number>(Number(2. / 3.) * contract(strain, strain)) * Number(1. / (dt * reference_rate));
  return Number(1.) + Number(coefficient) * Arenite::logarithm<Number>(Arenite::max<Number>(rate, Number(1.)));
}

/// J2/(2 G), zero where G is.
template <typename Number>
ARENITE_INLINE Number shear_energy(const SymTensor<Number> &deviator, const Number &shear_modulus)
{
  const Number J2 = second_invariant(deviator);
  return Arenite::select<Number>(shear_modulus > Number(0.), Number(J2 / (Number(2.) * shear_modulus)), Number(0.));
}

/// The elastic shear that all strengths share: a constant modulus, or a constant Poisson ratio with the bulk modulus K of the equation
/// of state, G = 3 K (1 - 2 nu)/(2 (1 + nu)).
struct ElasticShear
{
  static constexpr const char *name = "elastic";

  template <typename Number>
  using History = NoHistory<Number>;

  double shear_modulus = 0.; ///< [Pa]; used if positive
  double poisson_ratio = 0.; ///< used otherwise

  void declare_parameters(Parameters &);
  void finalize(const Parameters &) const;

  NoHistory<double> initial_history() const { return {}; }
  bool              uses_equation_of_state() const { return !(shear_modulus > 0.); }
  double            ratio() const { return 1.5 * (1. - 2. * poisson_ratio) / (1. + poisson_ratio); } ///< G/K

  template <typename Number>
  Number modulus(const Number &bulk_modulus) const
  {
    return shear_modulus > 0. ? Number(shear_modulus) : Number(Number(ratio()) * bulk_modulus);
  }
  /// G of a material whose bulk modulus is at most @p bulk_modulus [Pa]
  double modulus_bound(const double bulk_modulus) const { return modulus<double>(bulk_modulus); }

  template <typename Number>
  SymTensor<Number> trial(const ShearIncrement<Number> &increment, const Number &G) const
  {
    return increment.stress_old + increment.strain * Number(Number(2.) * G);
  }
  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, NoHistory<Number> &) const
  {
    const Number            G = modulus<Number>(increment.bulk_modulus);
    const SymTensor<Number> s = trial<Number>(increment, G);
    return {s, G, shear_energy<Number>(s, G)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &, const Number &, NoHistory<Number> &) const
  {}
};

/// No shear at all: a fluid.
struct NoStrength
{
  static constexpr const char *name = "none";

  template <typename Number>
  using History = NoHistory<Number>;

  void              declare_parameters(Parameters &) {}
  void              finalize(const Parameters &) const {}
  NoHistory<double> initial_history() const { return {}; }
  bool              uses_equation_of_state() const { return false; }
  double            modulus_bound(double) const { return 0.; }

  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &, NoHistory<Number> &) const
  {
    return {SymTensor<Number>(), Number(0.), Number(0.)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &deviator, const Number &, NoHistory<Number> &) const
  {
    deviator = SymTensor<Number>();
  }
};

/// Metal-like plasticity: sqrt(3 J2) <= Y = (Y_0 + H ep^n) (1 + C ln(rate/rate_0)), Johnson and Cook (1983) without softening by heat;
/// n = 1 is linear hardening. Radial return s = s_trial (1 - 3 G d ep/q_trial), where d ep solves
///
///   3 G d ep + Y(ep_n + d ep) = q_trial          (closed form for n = 1, else Newton's method in a bracket)
struct MisesStrength
{
  static constexpr const char *name = "mises";

  template <typename Number>
  using History = PlasticHistory<Number>;

  ElasticShear elastic;
  double       yield_stress = std::numeric_limits<double>::quiet_NaN(); ///< Y_0 [Pa], uniaxial
  double       hardening = 0., hardening_exponent = 1.;                 ///< H [Pa], n
  double       rate_coefficient = 0., reference_rate = 1.;              ///< C, [1/s]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &parameters) const { elastic.finalize(parameters); }

  PlasticHistory<double> initial_history() const { return {}; }
  bool                   uses_equation_of_state() const { return elastic.uses_equation_of_state(); }
  double                 modulus_bound(const double bulk_modulus) const { return elastic.modulus_bound(bulk_modulus); }

  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, PlasticHistory<Number> &history) const
  {
    const Number      G      = elastic.modulus<Number>(increment.bulk_modulus);
    SymTensor<Number> s      = elastic.trial<Number>(increment, G);
    const Number      factor = rate_factor<Number>(increment.strain, increment.dt, rate_coefficient, reference_rate);
    const Number      q      = Arenite::square_root<Number>(Number(3.) * second_invariant(s) + Number(tiny()));
    const Number      Y      = factor * yield<Number>(history.plastic_strain), shear(Number(3.) * G);
    const auto        yields = q > Y;

    Number step = Arenite::max<Number>(Number(0.), q - Y) / (shear + Number(hardening) * factor);
    if (hardening > 0. && hardening_exponent != 1. && any_of(yields))
      {
        const auto excess = [&](const Number &x) {
          // not at 0, where the slope of ep^n is infinite for n < 1
          const Number ep = Arenite::max<Number>(history.plastic_strain + x, Number(1e-12));
          return ValueAndSlope<Number>{shear * x + factor * yield<Number>(history.plastic_strain + x) - q,
                                       shear + factor * Number(hardening * hardening_exponent) *
                                                 Arenite::power<Number>(ep, hardening_exponent - 1.)};
        };
        const Number largest = (q - Y) / shear; // without hardening
        const Number root =
          bracketed_root<Number>(excess, Number(0.), largest, Number(Number(.5) * largest), Number(1e-14));
        step = Arenite::select<Number>(yields, root, Number(0.));
      }
    s *= Number(Number(1.) - Number(3.) * G * step / q);
    history.plastic_strain = history.plastic_strain + step;
    return {s, G, shear_energy<Number>(s, G)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &s, const Number &, PlasticHistory<Number> &history) const
  {
    history.plastic_strain = Arenite::max<Number>(Number(0.), history.plastic_strain);
    const Number Y         = Number(yield_stress) + Number(hardening) * history.plastic_strain;
    const Number q         = Arenite::square_root<Number>(Number(3.) * second_invariant(s) + Number(tiny()));
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

/// Friction: sqrt(J2) <= F = min(k + alpha I1, F_max) (1 + beta ln(rate/rate_0)), I1 = 3 p in compression, not below 0. Radial return
/// at constant pressure: no dilatancy, the pressure is that of the equation of state.
///
/// Source: Wang et al. (2004) as in Roger (2015), (2.2.15)-(2.2.17); the bound F_max is ours: sands saturate above some
/// hundred MPa (Laine and Sandvik (2001): sqrt(3) F_max = 226 MPa).
struct FrictionStrength
{
  static constexpr const char *name = "drucker prager";

  template <typename Number>
  using History = PlasticHistory<Number>;

  ElasticShear elastic;
  double       cohesion         = 0.;                                       ///< k [Pa]
  double       slope            = std::numeric_limits<double>::quiet_NaN(); ///< alpha
  double       largest_strength = 1.3e8;                                    ///< F_max [Pa], of sqrt(J2)
  double       rate_coefficient = 0., reference_rate = 1.;                  ///< beta, [1/s]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &) const;

  PlasticHistory<double> initial_history() const { return {}; }
  bool                   uses_equation_of_state() const { return true; }
  double                 modulus_bound(const double bulk_modulus) const { return elastic.modulus_bound(bulk_modulus); }

  /// F without the rate factor [Pa]
  template <typename Number>
  Number limit(const Number &pressure) const
  {
    return Arenite::max<Number>(Number(0.), Arenite::min<Number>(Number(largest_strength),
                                                                 Number(cohesion) + Number(3. * slope) * pressure));
  }

  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, PlasticHistory<Number> &history) const
  {
    const Number      G = elastic.modulus<Number>(increment.bulk_modulus);
    SymTensor<Number> s = elastic.trial<Number>(increment, G);
    const Number      F = limit<Number>(increment.pressure) *
                     rate_factor<Number>(increment.strain, increment.dt, rate_coefficient, reference_rate);
    const Number root  = Arenite::square_root<Number>(second_invariant(s) + Number(tiny()));
    const Number scale = Arenite::min<Number>(Number(1.), F / root);
    history.plastic_strain =
      history.plastic_strain + Number(0.57735026918962576) * (Number(1.) - scale) * root / G; // q/(3 G)
    s *= scale;
    return {s, G, shear_energy<Number>(s, G)};
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &s, const Number &pressure, PlasticHistory<Number> &history) const
  {
    history.plastic_strain = Arenite::max<Number>(Number(0.), history.plastic_strain);
    const Number root      = Arenite::square_root<Number>(second_invariant(s) + Number(tiny()));
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
  using History = PlasticHistory<Number>;

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

  PlasticHistory<double> initial_history() const { return {}; }

  bool uses_equation_of_state() const
  {
    return kind == Kind::friction || (kind == Kind::elastic && elastic.uses_equation_of_state()) ||
           (kind == Kind::mises && mises.uses_equation_of_state());
  }
  double modulus_bound(const double bulk_modulus) const
  {
    return kind == Kind::none      ? 0.
           : kind == Kind::elastic ? elastic.modulus_bound(bulk_modulus)
           : kind == Kind::mises   ? mises.modulus_bound(bulk_modulus)
                                   : friction.modulus_bound(bulk_modulus);
  }
  template <typename Number>
  ShearResponse<Number> update(const ShearIncrement<Number> &increment, PlasticHistory<Number> &history) const
  {
    NoHistory<Number> none;
    switch (kind)
      {
      case Kind::elastic:
        return elastic.update<Number>(increment, none);
      case Kind::mises:
        return mises.update<Number>(increment, history);
      case Kind::friction:
        return friction.update<Number>(increment, history);
      default:
        return NoStrength().update<Number>(increment, none);
      }
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &deviator, const Number &pressure, PlasticHistory<Number> &history) const
  {
    NoHistory<Number> none;
    if (kind == Kind::mises)
      mises.after_transfer<Number>(deviator, pressure, history);
    else if (kind == Kind::friction)
      friction.after_transfer<Number>(deviator, pressure, history);
    else if (kind == Kind::none)
      NoStrength().after_transfer<Number>(deviator, pressure, none);
  }

private:
  std::string word = "none";
};
} // namespace Arenite
