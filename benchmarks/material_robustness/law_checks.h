#pragma once

#include <arenite/materials/law_types.h>

#include <algorithm>
#include <string>

#include "random_updates.h"

namespace Arenite
{
/// For laws without corners or equations of their own: states are reached from rest in a few random steps.
///
/// The volume strain stays within 10 %, because equations of state end somewhere. Dissipation is asked as the law reports it, with the
/// mean stress; see LawRun for what happens where that is negative.
template <typename Law>
struct LawChecks
{
  static constexpr bool has_corners = false;

  static void   state(const Law &, RandomTensors &, Update<Law> &) {}
  static double smallest_modulus(const Law &law) { return 1e-3 * law.density() * std::pow(law.wave_speed_bound(), 2); }

  static Verdict check(const Law &law, const Update<Law> &u, const double scale)
  {
    Verdict verdict;
    verdict.dissipation = u.dissipated * smallest_modulus(law) / (scale * scale);
    // what only grows, by name
    auto                h = u.history, h_n = u.history_n;
    std::vector<double> now;
    h.for_each([&](const char *, const double &value) { now.push_back(value); });
    unsigned int i = 0;
    h_n.for_each([&](const char *name, const double &value) {
      const std::string variable = name;
      if (variable == "plastic strain" || variable == "largest density")
        verdict.history = std::max(verdict.history, (value - now[i]) / (std::abs(value) + 1e-12));
      ++i;
    });
    return verdict;
  }
};

inline Invariants<double> invariants(const SymTensor<double> &stress)
{
  return {-trace(stress), std::sqrt(second_invariant(deviator(stress)))};
}

inline SymTensor<double> elastic_trial(const SymTensor<double> &stress, const SymTensor<double> &strain, const double K,
                                       const double G)
{
  return stress + deviator(strain) * (2. * G) + spherical(K * trace(strain));
}

/// sigma : (strain - C^-1 : change of stress)
inline double end_dissipation(const SymTensor<double> &stress, const SymTensor<double> &trial, const double K,
                              const double G)
{
  const SymTensor<double> d = trial - stress;
  return contract(deviator(stress), deviator(d)) / (2. * G) + trace(stress) * trace(d) / (9. * K);
}

/// How far the change of the invariants is from the direction (9 K f_I, G f_j), in stress.
inline double off_direction(const Invariants<double> &trial, const Invariants<double> &now, const double a,
                            const double b)
{
  const double dI = trial.I1 - now.I1, dj = trial.j - now.j, m = (dI * a + dj * b) / (a * a + b * b);
  return std::max(std::abs(dI - m * a), std::abs(dj - m * b)) + std::max(0., -m) * std::hypot(a, b);
}

/// A stress with its invariants.
inline SymTensor<double> stress_of(RandomTensors &random, const double I1, const double j)
{
  return random.direction() * (std::sqrt(2.) * j) + spherical(-I1 / 3.);
}

/// Cap anywhere between X0 and 99.7 % of its compaction.
template <typename Surface>
double random_position(const Surface &surface, RandomTensors &random)
{
  return random.uniform() < 0.9 ? surface.initial_position + (random.logarithmic(1., 2.5) - 1.) / surface.hardening_rate
                                : surface.initial_position * (1. + 1e-7);
}

template <typename Stiffness>
struct LawChecks<ViscoplasticCap<Stiffness>>
{
  using Law                         = ViscoplasticCap<Stiffness>;
  static constexpr bool has_corners = true;

  static double smallest_modulus(const Law &law)
  {
    auto       history = law.initial_history();
    const auto m =
      law.stiffness.moduli(PointIncrement<double>{{}, law.density(), law.density(), 0.}, history.stiffness);
    return std::min(m.K, m.G);
  }

  /// At random or within 1e-3 of -T, 0, L, M, X; inside, on the axis or on the surface; the gap closed or open.
  static void state(const Law &law, RandomTensors &random, Update<Law> &u)
  {
    const CapSurface &surface = law.surface;
    u.history_n               = law.initial_history();
    u.history_n.cap_junction  = surface.junction(random_position(surface, random));
    const auto   cap          = surface.cap(u.history_n.cap_junction);
    const double T            = surface.tension_limit;
    const double corners[]    = {-T, 0., cap.L, cap.M, cap.X};
    double       I1           = random.uniform() < 0.5 ? random.uniform(-T, cap.X)
                                                       : corners[random.one_of(5)] * (1. + 1e-3 * random.uniform(-1., 1.));
    I1                        = std::min(std::max(I1, -T), cap.X);
    const double height       = I1 < 0. ? surface.tension_axis * surface.tension_axis -
                                      std::pow((I1 - surface.tension_center) / surface.tension_ratio, 2)
                                        : (I1 < cap.L ? std::pow(surface.failure(I1).value, 2)
                                                      : cap.b * cap.b - std::pow((I1 - cap.M) / cap.R, 2));
    const double part         = random.uniform();
    u.stress_n =
      stress_of(random, I1,
                std::sqrt(std::max(height, 0.)) * (part < 0.25 ? 0. : (part < 0.75 ? random.uniform() : 1.)));
    if (law.gap_closure && random.uniform() < 0.3)
      u.history_n.separation = random.logarithmic(1e-10, 8.);
    // a stiffened state: up to the compaction of its cap
    u.increment.density_old = law.density() * std::exp(random.uniform() * surface.compaction<double>(cap.X));
    raise_density(u.history_n.stiffness, u.increment.density_old);
  }

  static Verdict check(const Law &law, const Update<Law> &u, const double scale)
  {
    const CapSurface &surface = law.surface;
    Verdict           verdict;
    const double      xi_n = u.history_n.cap_junction, xi = u.history.cap_junction;
    const auto        cap_n = surface.cap(xi_n), cap = surface.cap(xi);
    const double      k = surface.compaction<double>(cap.X);
    verdict.history =
      std::max({(xi_n - xi) / scale, k >= 0. && k < surface.hardening_limit ? 0. : 1., -u.history.separation, 0.});
    auto              stiffness = u.history_n.stiffness;
    const auto        m         = law.stiffness.moduli(u.increment, stiffness);
    SymTensor<double> strain    = u.increment.strain;
    const auto        now       = invariants(u.stress);
    if (law.viscosity == Law::Viscosity::none)
      verdict.residual = std::max(surface.yield_function(now.I1, now.j, cap), 0.) / scale;
    verdict.checked = u.substeps == 1.;
    if (!verdict.checked)
      return verdict;

    // moduli that grow carry the Kirchhoff deviator J s through the step
    const SymTensor<double> carried =
      Stiffness::changes
        ? deviator(u.stress_n) * (u.increment.density / u.increment.density_old) + spherical(trace(u.stress_n) / 3.)
        : u.stress_n;
    const SymTensor<double> whole_trial = elastic_trial(carried, strain, m.K, m.G);
    const double            unloading   = std::max(trace(u.stress_n), 0.) / (3. * m.K);
    if (law.gap_closure) // what closed the gap did not compress
      strain += spherical(std::min(std::max(-trace(strain) - unloading, 0.), u.history_n.separation) / 3.);
    const SymTensor<double> trial_stress = elastic_trial(carried, strain, m.K, m.G);
    const auto              trial        = invariants(trial_stress);
    verdict.dissipation = end_dissipation(u.stress, whole_trial, m.K, m.G) * std::min(m.K, m.G) / (scale * scale);

    CapFlow flow = law.flow(u.increment.dt);
    if (law.viscosity == Law::Viscosity::duvaut_lions)
      {
        // the rate-independent state, and the part of the way to it
        Law inviscid         = law;
        inviscid.viscosity   = Law::Viscosity::none;
        auto         history = u.history_n;
        const auto   end     = inviscid.update(u.stress_n, u.increment, history).stress;
        const double w       = u.increment.dt / (law.relaxation_time + u.increment.dt);
        const auto   off     = trial_stress + (end - trial_stress) * w - u.stress;
        verdict.residual     = std::max(std::sqrt(contract(off, off)),
                                        std::abs(cap_n.X + w * (surface.cap(history.cap_junction).X - cap_n.X) - cap.X)) /
                           (scale + cap.X);
        return verdict;
      }
    const bool plastic =
      surface.yield_function(trial.I1, trial.j, cap_n) > 0. && (flow.rate_independent || flow.fluidity_dt > 0.);
    if (!plastic)
      {
        verdict.residual = (std::abs(now.I1 - trial.I1) + std::abs(now.j - trial.j)) / scale;
        return verdict;
      }
    double compaction = 0.;
    if (trial.I1 > cap_n.M && !(trial.I1 < cap_n.L))
      compaction = std::abs(3. * m.K * surface.compaction<double>(cap.X, cap_n.X) - (trial.I1 - now.I1)) / scale;
    else if (xi != xi_n)
      compaction = 1.;
    verdict.residual = std::max(verdict.residual, compaction);
    verdict.corner   = std::abs(now.I1 - cap.L) < 1e-9 * scale || std::abs(now.I1) < 1e-9 * scale;
    if (verdict.corner)
      return verdict;

    double f_I = 0., f_j = 1.;
    if (now.I1 >= 0. && now.I1 < cap.L)
      f_I = -surface.failure(now.I1).slope;
    else
      {
        const double ratio = now.I1 < 0. ? surface.tension_ratio : cap.R;
        const double v = (now.I1 - (now.I1 < 0. ? surface.tension_center : cap.M)) / ratio, Q = std::hypot(now.j, v);
        f_I = v / (ratio * Q);
        f_j = now.j / Q;
      }
    // The overstress gives the multiplier, or the multiplier the overstress: the one that loses no digits is the measure.
    const double a = 9. * m.K * f_I, b = m.G * f_j, f = surface.yield_function(now.I1, now.j, cap);
    const double found = ((trial.I1 - now.I1) * a + (trial.j - now.j) * b) / (a * a + b * b);
    const double wanted =
      flow.rate_independent ? 0. : flow.f0 * std::pow(std::max(found, 0.) / flow.fluidity_dt, 1. / flow.exponent);
    double rule = std::max(off_direction(trial, now, a, b) / scale, std::abs(f - wanted) / (scale + wanted + cap.X));
    if (!flow.rate_independent)
      {
        const double multiplier = flow.fluidity_dt * std::pow(std::max(f, 0.) / flow.f0, flow.exponent);
        rule                    = std::min(rule, std::max(std::abs(now.I1 - trial.I1 + a * multiplier),
                                                          std::abs(now.j - trial.j + b * multiplier)) /
                                                   scale);
      }
    verdict.residual = std::max(verdict.residual, rule);
    return verdict;
  }

private:
  static void raise_density(NoHistory<double> &, double) {}
  static void raise_density(SoilStiffening::History<double> &history, const double density)
  {
    history.density_max = std::max(history.density_max, density);
  }
};

template <>
struct LawChecks<GeologicCap>
{
  using Law                         = GeologicCap;
  static constexpr bool has_corners = true;

  static double smallest_modulus(const Law &law)
  {
    return std::min(law.elastic.bulk_modulus, law.elastic.shear_modulus);
  }

  /// At random or within 1e-3 of -T, 0, L, X; inside, on the axis or on the surface.
  static void state(const Law &law, RandomTensors &random, Update<Law> &u)
  {
    const GeologicCapSurface &surface = law.surface;
    u.history_n.kappa      = std::max(surface.junction(random_position(surface, random)), law.smallest_kappa);
    const auto   cap       = surface.cap(u.history_n.kappa);
    const double T         = law.tension_cutoff;
    const double corners[] = {-T, 0., cap.L, cap.X};
    double       I1        = random.uniform() < 0.5 ? random.uniform(-T, cap.X)
                                                    : corners[random.one_of(4)] * (1. + 1e-3 * random.uniform(-1., 1.));
    I1                     = std::min(std::max(I1, -T), cap.X);
    const double height =
      I1 < cap.L ? std::pow(surface.failure(I1).value, 2) : cap.b * cap.b - std::pow((I1 - cap.L) / cap.R, 2);
    const double part = random.uniform();
    u.stress_n =
      stress_of(random, I1,
                std::sqrt(std::max(height, 0.)) * (part < 0.25 ? 0. : (part < 0.75 ? random.uniform() : 1.)));
    u.increment.density_old = law.density();
  }

  static Verdict check(const Law &law, const Update<Law> &u, const double scale)
  {
    const GeologicCapSurface &surface = law.surface;
    const double              K = law.elastic.bulk_modulus, G = law.elastic.shear_modulus;
    const double              kappa_n = u.history_n.kappa, kappa = u.history.kappa;
    const auto                cap_n = surface.cap(kappa_n), cap = surface.cap(kappa);
    const SymTensor<double>   trial_stress = elastic_trial(u.stress_n, u.increment.strain, K, G);
    const auto                trial = invariants(trial_stress), now = invariants(u.stress);
    Verdict                   verdict;
    const double k = surface.compaction<double>(cap.X), lowest = law.type == "rock" ? kappa_n : law.smallest_kappa;
    verdict.history = std::max({(lowest - kappa) / scale, k > -1e-15 && k <= surface.hardening_limit ? 0. : 1., 0.});
    verdict.dissipation = end_dissipation(u.stress, trial_stress, K, G) * std::min(K, G) / (scale * scale);

    const double T = law.tension_cutoff;
    const double f =
      now.I1 < cap.L ? now.j - surface.failure(now.I1).value : std::hypot(now.j, (now.I1 - cap.L) / cap.R) - cap.b;
    verdict.residual = std::max({f, -T - now.I1, 0.}) / scale;
    // what the cap moved is what the soil was compacted or dilated by, unless the cap stopped at its start
    if (kappa != kappa_n && kappa > law.smallest_kappa + 1e-12 * surface.smallest_position)
      verdict.residual =
        std::max(verdict.residual,
                 std::abs(3. * K * surface.compaction<double>(cap.X, cap_n.X) - (trial.I1 - now.I1)) / scale);
    verdict.corner = std::abs(now.I1 - cap.L) < 1e-9 * scale || std::abs(now.I1 + T) < 1e-9 * scale;
    if (verdict.corner || (now.I1 == trial.I1 && now.j == trial.j))
      return verdict;
    double f_I = -surface.failure(now.I1).slope, f_j = 1.;
    if (now.I1 > cap.L)
      {
        const double v = (now.I1 - cap.L) / cap.R, Q = std::hypot(now.j, v);
        f_I = v / (cap.R * Q);
        f_j = now.j / Q;
      }
    verdict.residual = std::max(verdict.residual, off_direction(trial, now, 9. * K * f_I, G * f_j) / scale);
    return verdict;
  }
};
} // namespace Arenite
