#pragma once

#include <arenite/materials/cap_return.h>
#include <arenite/materials/elastic_constants.h>
#include <arenite/materials/material_law.h>

#include <array>
#include <string>
#include <vector>

namespace Arenite
{
/// Moduli of one step [Pa]: the step is integrated with K and G, stored energies are those of the unloading moduli at its ends. A
/// stiffness that changes counts shear per reference volume: G_old, G_mean and G_new belong to the Kirchhoff stress, G = G_mean/J to the
/// Cauchy stress at the end of the step.
template <typename Number>
struct StepModuli
{
  Number K, G, K_old, K_new, G_old, G_mean, G_new;
};

/// Elastic stiffness that does not change.
struct ConstantStiffness
{
  static constexpr const char *law_name = "viscoplastic cap";
  static constexpr bool        changes  = false;

  template <typename Number>
  using History = NoHistory<Number>;

  void declare_parameters(Parameters &parameters) { constants.declare_parameters(parameters); }
  void finalize(const Parameters &parameters) { elastic = constants.finalize(parameters); }

  double          density() const { return elastic.density; }
  History<double> initial_history() const { return {}; }
  double          wave_speed_bound() const { return elastic.p_wave_speed(); }

  template <typename Number>
  StepModuli<Number> moduli(const PointIncrement<Number> &, History<Number> &) const
  {
    const Number K = Number(elastic.bulk_modulus), G = Number(elastic.shear_modulus);
    return {K, G, K, K, G, G, G};
  }
  std::string adopt_hardening_limit(double &, bool) { return ""; }
  template <typename Number>
  void after_transfer(History<Number> &) const
  {}
  template <typename F>
  void for_each_constant(F &&f) const
  {
    elastic.for_each_constant(f);
    constants.for_each_constant(f);
  }
  /// End of the valid range [Pa]; 0 if the law does not say.
  double largest_pressure() const { return 0.; }

  ElasticConstants constants;
  LinearElastic    elastic;
};

/// Soil with a smooth cap (CapSurface) and overstress viscosity: the cap model of Roger (2015), sections 2.2 and 2.3.
///
///   eps_dot = eps_e_dot + eps_vp_dot,   sigma_dot = E : eps_e_dot,   eps_vp_dot = eta <f/f0>^N df/dsigma     (Perzyna)
///
/// eta is a fluidity: 0 is elastic, infinity is rate independent. `Duvaut-Lions` relaxes towards the rate-independent state with one
/// time, sigma = (sigma_trial + (dt/tau) sigma_inf)/(1 + dt/tau), X alike. Only compaction hardens the cap. Backward Euler,
/// first order in the step; a step whose strain is large against the surface is divided.
///
/// Tension opens a gap: the volume strain of the tension cut-off is kept as `separation` and must be closed, without pressure, before
/// the pores can be compressed again.
template <typename Stiffness>
struct ViscoplasticCap
{
  static constexpr const char *name                      = Stiffness::law_name;
  static constexpr bool        energy_per_present_volume = !Stiffness::changes;
  static constexpr const char *description =
    "Soil: failure surface, hardening cap and tension cut-off with overstress viscosity.";

  template <typename Number>
  struct History
  {
    Number                                       cap_junction = Number(0.); ///< xi [Pa], see CapSurface
    Number                                       separation   = Number(0.); ///< open gap [-]
    typename Stiffness::template History<Number> stiffness;

    template <typename F>
    void for_each(F &&f)
    {
      f("cap junction", cap_junction);
      f("separation", separation);
      stiffness.for_each(f);
    }
  };

  enum class Viscosity
  {
    perzyna,
    duvaut_lions,
    none
  };

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  double density() const { return stiffness.density(); }
  double wave_speed_bound() const { return stiffness.wave_speed_bound(); }

  History<double> initial_history() const
  {
    History<double> history;
    history.cap_junction = surface.junction(surface.initial_position);
    history.stiffness    = stiffness.initial_history();
    return history;
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const auto        moduli = stiffness.moduli(increment, history.stiffness);
    Response<Number>  response;
    SymTensor<Number> stress = stress_n;
    if constexpr (Stiffness::changes)
      stress = with_kirchhoff_deviator(stress_n, increment);
    Dissipation<Number> dissipation;
    const Trial<Number> t = trial(stress, increment.strain, moduli.K, moduli.G, history);
    Number              p, J2;
    if (stays_elastic(t, history))
      {
        dissipation.volume = accept(t, stress, moduli.K, history);
        p                  = t.I1 * Number(1. / 3.);
        J2                 = t.J2;
      }
    else
      {
        const auto              wanted = parts(t, stress, increment.strain, moduli.K, moduli.G, history);
        const SymTensor<Number> start  = stress;
        const History<Number>   past   = history;
        // lanes with equal numbers of parts go together: what a point does must not depend on its neighbours
        for (int first = 0; first < n_lanes<Number>(); ++first)
          {
            const double n      = lane(wanted, first);
            bool         is_new = true;
            for (int l = 0; l < first; ++l)
              is_new = is_new && lane(wanted, l) != n;
            if (!is_new)
              continue;
            SymTensor<Number>   now    = start;
            History<Number>     record = past;
            const auto          strain = n == 1. ? increment.strain : increment.strain * Number(1. / n);
            Dissipation<Number> sum;
            for (double part = 0.; part < n; ++part)
              {
                const Trial<Number> next = n == 1. ? t : trial(now, strain, moduli.K, moduli.G, record);
                sum += step(next, now, increment.dt / n, moduli.K, moduli.G, record, response.iterations);
              }
            response.substeps = std::max(response.substeps, n);
            if (first == 0)
              {
                stress      = now;
                history     = record;
                dissipation = sum;
              }
            else
              take(wanted == decltype(wanted)(n), now, record, sum, stress, history, dissipation);
          }
        p  = pressure(stress);
        J2 = second_invariant(deviator(stress));
      }

    response.stress = stress;
    if constexpr (Stiffness::changes)
      count_energies(response, dissipation, moduli, pressure(stress_n), second_invariant(deviator(stress_n)), p, J2,
                     increment);
    else
      {
        response.wave_speed = square_root(Number((moduli.K + Number(4. / 3.) * moduli.G) / increment.density));
        response.stored     = stiffness.elastic.stored_energy(p, J2);
        response.dissipated = dissipation.volume + dissipation.shear;
      }
    return response;
  }

  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &history) const
  {
    // overstress is admissible; a cap in front of its start, or a negative gap, is not
    history.cap_junction = max(history.cap_junction, Number(surface.junction(surface.initial_position)));
    history.separation   = max(history.separation, Number(0.));
    stiffness.after_transfer(history.stiffness);
  }

  /// The cap goes through the past stress if that lies beyond its initial position.
  std::string begin_under(const SymTensor<double> &stress, const double overconsolidation,
                          History<double> &history) const
  {
    const double I1 = -trace(stress), j = std::sqrt(second_invariant(deviator(stress)));
    history.cap_junction = surface.junction(surface.position_through(overconsolidation * I1, overconsolidation * j));
    return surface.complaint_about(I1, j);
  }

  /// f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    stiffness.for_each_constant(f);
    const auto cap = surface.cap(surface.junction(surface.initial_position));
    f("Strength at I1 = 0", surface.F0, "Pa");
    f("Strength q = sqrt(3 J2) at p = 1 GPa", surface.strength_q(1e9), "Pa");
    f("Largest tension limit T_max", surface.F0 / (2. * surface.F0_slope), "Pa");
    f("Smallest cap position X_min", surface.smallest_position, "Pa");
    f("Initial junction of cap and failure surface L", cap.L, "Pa");
    f("Initial centre of the cap M", cap.M, "Pa");
    f("Initial height of the cap b", cap.b, "Pa");
  }

  /// Sentences with the numbers, for the log.
  std::vector<std::string> warnings() const;

  /// Of a small overstress at rest on the cap, for N = 1: f0/(eta (9 K/R^2 + G)), or the tau of Duvaut-Lions [s]
  double relaxation_time_at_rest() const;

  /// The flow rule of a step.
  CapFlow flow(const double dt) const
  {
    const bool relaxes = viscosity == Viscosity::duvaut_lions && relaxation_time > 0.;
    return {viscosity != Viscosity::perzyna, fluidity * dt, overstress, exponent,
            relaxes ? dt / (relaxation_time + dt) : 1.};
  }

  Stiffness   stiffness;
  CapSurface  surface;
  std::string viscosity_name  = "Perzyna";
  Viscosity   viscosity       = Viscosity::perzyna;
  double      fluidity        = 0.;  ///< eta [1/s]
  double      overstress      = 1e6; ///< f0 [Pa]
  double      exponent        = 1.;  ///< N
  double      relaxation_time = 0.;  ///< tau of Duvaut-Lions [s]
  double      substep_size = 0.5; ///< largest strain of one part, over that which crosses the surface; 0: never divide
  bool        gap_closure  = true;

private:
  std::string path;

  /// Inelastic work of a step [J/m^3]: pressure times volume strain, deviator times distortion.
  template <typename Number>
  struct Dissipation
  {
    Number       volume = Number(0.), shear = Number(0.);
    Dissipation &operator+=(const Dissipation &other)
    {
      volume += other.volume;
      shear += other.shear;
      return *this;
    }
  };

  /// e^z - 1 - z of the logarithmic spring, z = p/K. Beyond z = 10, a compression by a factor of 22000, by its tangent: no density
  /// leads there, but a stress that a transfer or a user gives may, and must not overflow.
  template <typename Number>
  static Number spring_energy(const Number &p, const Number &K)
  {
    const Number z = p / K, reached = min(z, Number(10.)), remainder = exponential_remainder(reached);
    return remainder + (remainder + reached) * (z - reached);
  }

  /// The lanes of a mask take another state.
  template <typename M, typename Number>
  static void take(const M &mask, const SymTensor<Number> &stress, History<Number> &history,
                   const Dissipation<Number> &dissipation, SymTensor<Number> &to_stress, History<Number> &to_history,
                   Dissipation<Number> &to_dissipation)
  {
    for (int k = 0; k < 6; ++k)
      to_stress[k] = select<Number>(mask, stress[k], to_stress[k]);
    std::array<Number *, 16> entries; // more than any history has
    auto                     entry = entries.begin();
    to_history.for_each([&](const char *, Number &value) { *entry++ = &value; });
    entry = entries.begin();
    history.for_each([&](const char *, Number &value) {
      **entry = select<Number>(mask, value, **entry);
      ++entry;
    });
    to_dissipation.volume = select<Number>(mask, dissipation.volume, to_dissipation.volume);
    to_dissipation.shear  = select<Number>(mask, dissipation.shear, to_dissipation.shear);
  }

  /// What an inelastic volume strain dissipates per unit [Pa]: p, and where stored energy is that of the reference volume, the elastic
  /// energy of the present volume, which the strain takes from or adds to the body: d(J U) = J U d eps_vp.
  template <typename Number>
  Number pressure_of_flow(const Number &p, const Number &K) const
  {
    if constexpr (Stiffness::changes)
      return p + K * spring_energy(p, K);
    else
      return p;
  }

  /// The pressure of @p stress_n and its deviator times rho_{n+1}/rho_n: the Kirchhoff deviator tau = J s goes through the step.
  template <typename Number>
  SymTensor<Number> with_kirchhoff_deviator(const SymTensor<Number>      &stress_n,
                                            const PointIncrement<Number> &increment) const
  {
    return deviator(stress_n) * Number(increment.density / increment.density_old) - spherical(pressure(stress_n));
  }

  /// Energies with moduli that grow. Per reference volume, U = J K (e^{p/K} - 1 - p/K) + tau:tau/(4 G): the work that the logarithmic
  /// spring p = K ln(rho/rho_z) and the shear of the reference volume give back, whatever the volume does. Moduli that grow keep the
  /// stress and lose stored energy, which is dissipated. Everything divided by J for what is stored, by the mean J for what is dissipated.
  template <typename Number>
  void count_energies(Response<Number> &response, const Dissipation<Number> &dissipation,
                      const StepModuli<Number> &moduli, const Number &p_n, const Number &J2_n, const Number &p,
                      const Number &J2, const PointIncrement<Number> &increment) const
  {
    const Number J_n = Number(density()) / increment.density_old, J = Number(density()) / increment.density,
                 per_mean_J = Number(2.) / (J_n + J);
    const auto volume       = [](const Number &pressure, const Number &K) { return K * spring_energy(pressure, K); };
    const auto shear        = [](const Number &invariant, const Number &volume_ratio, const Number &G) {
      return Number(0.5) * invariant * volume_ratio * volume_ratio / G;
    };
    const Number lost = J_n * (volume(p_n, moduli.K_old) - volume(p_n, moduli.K)) +
                        J * (volume(p, moduli.K) - volume(p, moduli.K_new)) + shear(J2_n, J_n, moduli.G_old) -
                        shear(J2_n, J_n, moduli.G_mean) + shear(J2, J, moduli.G_mean) - shear(J2, J, moduli.G_new);
    response.dissipated = dissipation.volume + (J * dissipation.shear + lost) * per_mean_J;
    response.stored     = volume(p, moduli.K_new) + shear(J2, J, moduli.G_new) / J;
    response.wave_speed =
      square_root(Number(moduli.K_new / increment.density + Number(4. / 3.) * moduli.G_new * Number(1. / density())));
  }

  /// The step without flow. An open gap carries no pressure: tension is unloaded first, then the gap closes, and only what is left
  /// of the volume strain compresses.
  template <typename Number>
  struct Trial
  {
    SymTensor<Number> s;
    Number            I1, J2, closing;
  };
  template <typename Number>
  Trial<Number> trial(const SymTensor<Number> &stress, const SymTensor<Number> &strain, const Number &K,
                      const Number &G, const History<Number> &history) const
  {
    Trial<Number> t;
    Number        volume_strain = trace(strain);
    t.closing                   = Number(0.);
    if (gap_closure && any_of(history.separation > Number(0.)))
      {
        const Number unloading = max(Number(trace(stress)), Number(0.)) / (Number(3.) * K);
        t.closing              = min(max(Number(-volume_strain - unloading), Number(0.)), history.separation);
        volume_strain += t.closing;
      }
    t.s  = deviator(stress) + deviator(strain) * Number(Number(2.) * G);
    t.I1 = -trace(stress) - Number(3.) * K * volume_strain;
    t.J2 = second_invariant(t.s);
    return t;
  }

  /// True if no lane comes near its surface.
  template <typename Number>
  bool stays_elastic(const Trial<Number> &t, const History<Number> &history) const
  {
    return !any_of(!surface.surely_inside(value_of(t.I1), value_of(t.J2), value_of(history.cap_junction)));
  }

  /// The trial state becomes the state. @return dissipated energy [J/m^3], of the gap
  template <typename Number>
  Number accept(const Trial<Number> &t, SymTensor<Number> &stress, const Number &K, History<Number> &history) const
  {
    const Number p_n = pressure(stress), p = t.I1 * Number(1. / 3.);
    stress = t.s - spherical(p);
    history.separation -= t.closing;
    return pressure_of_flow(Number(Number(0.5) * (p_n + p)), K) * t.closing;
  }

  /// Number of parts of a step: strains above `substep_size` times those that cross the surface, |dev| > F/G, |vol| > X/(3K), are
  /// divided where the state yields; per lane, a power of two, so that few groups of lanes differ.
  template <typename Number>
  Value<Number> parts(const Trial<Number> &t, const SymTensor<Number> &stress, const SymTensor<Number> &strain,
                      const Number &K, const Number &G, const History<Number> &history) const
  {
    constexpr double most = 1024.;
    using V               = Value<Number>;
    if (substep_size == 0.)
      return V(1.);
    const V volume = V(3.) * absolute(value_of(trace(strain))) * value_of(K);
    const V shear =
      V(2.) * value_of(square_root(Number(second_invariant(deviator(strain)) + Number(1e-60)))) * value_of(G);
    // bounds of strength and X from below that cost nothing, before the surface is asked
    const V xi = value_of(history.cap_junction), c = V(substep_size);
    const V near_X =
      select(xi < V(0.), V(V(surface.smallest_position) + xi), V(V(surface.axis_ratio * surface.F0) + xi));
    if (!any_of(shear > c * V(surface.F0) || volume > c * near_X))
      return V(1.);
    const V    strength = max(surface.failure(value_of(Number(-trace(stress)))).value, V(surface.F0));
    const auto cap      = surface.cap(xi);
    const V    needed   = max(V(shear / strength), V(volume / cap.X));
    if (!any_of(needed > c))
      return V(1.);
    const Mask<V> yields = surface.yield_function(value_of(t.I1), square_root(value_of(t.J2)), cap) > V(0.);
    V             n      = V(1.);
    for (double half = 1.; half < most && any_of(yields && needed > V(c * V(half))); half *= 2.)
      n = select(yields && needed > V(c * V(half)), V(2. * half), n);
    return n;
  }

  /// One part. @return what it dissipates with the mean stress, so that stored and dissipated energy add up to the work.
  template <typename Number>
  Dissipation<Number> step(const Trial<Number> &t, SymTensor<Number> &stress, const double dt, const Number &K,
                           const Number &G, History<Number> &history, Iterations &iterations) const
  {
    history.separation -= t.closing;
    const SymTensor<Number> old = stress;
    // J2 carries a floor below round-off so that its root can be differentiated
    const Number j_trial = square_root(Number(t.J2 + Number(1e-32 * surface.F0 * surface.F0)));

    const CapFlow     rule = flow(dt);
    CapReturn<Number> result(surface, rule, K, G);
    result.solve(t.I1, j_trial, history.cap_junction);
    iterations += result.iterations();
    history.cap_junction = result.xi;

    const Number ratio  = result.j / j_trial;
    stress              = t.s * ratio;
    const Number mean   = result.I1 * Number(1. / 3.);
    const Number opened = (result.I1 - t.I1) / (Number(3.) * K); // inelastic volume strain
    for (int k = 0; k < 3; ++k)
      stress[k] -= mean;
    if (gap_closure)
      history.separation += select(Mask<Number>(result.I1 < Number(0.) && opened > Number(0.)), opened, Number(0.));

    // mean stress : inelastic strain
    const Number p_mean = Number(0.5) * (pressure(old) + mean);
    const auto   s_mean = (deviator(old) + t.s * ratio) * Number(0.5);
    return {-pressure_of_flow(p_mean, K) * (opened - t.closing),
            contract(s_mean, t.s) * (Number(1.) - ratio) / (Number(2.) * G)};
  }
};

} // namespace Arenite
