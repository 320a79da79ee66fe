#pragma once

#include <arenite/materials/elastic_constants.h>
#include <arenite/materials/hardening_cap.h>
#include <arenite/materials/material_law.h>

#include <string>

namespace Arenite
{
/// Failure surface and cap of the geologic cap model in the form of LS-DYNA's MAT_025 (pressure and I1 positive in compression):
///
///   failure, I1 < L:   sqrt(J2) = Fe(I1) = alpha - gamma exp(-beta I1) + theta I1
///   cap, I1 >= L:      R sqrt(J2) = sqrt((X - L)^2 - (I1 - L)^2),    L = max(kappa, 0),  X = kappa + R Fe(kappa)
///   hardening          k = W (1 - exp(-D (X - X0)))
///
/// The stored variable xi is kappa. The cap meets the failure surface at I1 = L in a corner. For I1 < 0 the failure surface is
/// continued by its tangent.
///
/// Sandler & Rubin, Int. J. Numer. Anal. Meth. Geomech. 3 (1979) 173-186; Simo, Ju, Pister & Taylor, J. Eng. Mech. 114 (1988).
struct GeologicCapSurface : CapParameters
{
  double smallest_position = 0.; ///< X(kappa = 0) [Pa], a scale of stress

  std::string finalize();

  /// The cap as an ellipse with centre M = L, and its derivatives with respect to kappa.
  template <typename Number>
  struct Cap
  {
    Number X, L, M, b, R;
    Number dX, dM, db, dR;
  };
  template <typename Number>
  Cap<Number> cap(const Number &kappa) const
  {
    const Mask<Number>    negative = kappa < Number(0.);
    const Failure<Number> F        = failure_expression(kappa);
    const Number          R = Number(axis_ratio), per_R = Number(1. / axis_ratio);
    Cap<Number>           cap;
    cap.X  = kappa + R * F.value;
    cap.L  = select(negative, Number(0.), kappa);
    cap.M  = cap.L;
    cap.b  = (cap.X - cap.L) * per_R;
    cap.R  = R;
    cap.dX = Number(1.) + R * F.slope;
    cap.dM = select(negative, Number(0.), Number(1.));
    cap.db = (cap.dX - cap.dM) * per_R;
    cap.dR = Number(0.);
    return cap;
  }

  /// k(X) - k(X_n) without cancellation.
  template <typename Number>
  Number compaction(const Number &X, const Number &X_n) const
  {
    return Number(-hardening_limit) * decay(X_n) * exponential_minus_one(Number(Number(-hardening_rate) * (X - X_n)));
  }
  template <typename Number>
  Number compaction_slope(const Number &X) const
  {
    return Number(hardening_limit * hardening_rate) * decay(X);
  }
  template <typename Number>
  Number compaction(const Number &X) const
  {
    return Number(hardening_limit) * (Number(1.) - decay(X));
  }

  /// True only inside of failure surface and cap, for kappa not below its start: costs no exponential, root or division. For kappa < 0
  /// the cap begins at I1 = 0 and reaches X0 at least; else it is the quarter of an ellipse with the axes Fe(L) and R Fe(L).
  template <typename Number>
  Mask<Number> surely_inside(const Number &I1, const Number &J2, const Number &kappa) const
  {
    const Number       zero(0.), R(axis_ratio), line = Number(F0) + Number(F0_slope) * I1;
    const Mask<Number> tension = I1 < zero, negative = kappa < zero;
    const Mask<Number> below_line   = line > zero && J2 < line * line;
    const Mask<Number> in_first_cap = I1 * I1 + R * R * J2 < Number(initial_position * initial_position);
    return (tension && below_line) || (!tension && negative && in_first_cap) ||
           (!tension && !negative && surely_below<Number>(I1, J2, max(kappa, zero), R));
  }

  /// kappa of a cap that ends at X.
  double junction(double X) const;

private:
  /// exp(-D (X - X0))
  template <typename Number>
  Number decay(const Number &X) const
  {
    return exponential(Number(Number(-hardening_rate) * (X - Number(initial_position))));
  }
};

/// Rate-independent geologic cap, so that published decks and LS-DYNA input (MAT_025) carry over.
///
/// Backward Euler with closest-point projection: the cap hardens by its own compaction; on the failure surface and at its corner
/// with the cap the soil dilates, and the cap of a *soil* contracts by that, down to the stress point and not below its start.
/// The cap of a *rock* never contracts. Tension is cut off at I1 = -T; a point there keeps what shear the failure surface admits.
struct GeologicCap
{
  static constexpr const char *name                      = "geologic cap";
  static constexpr bool        energy_per_present_volume = true;
  static constexpr const char *description =
    "Failure surface and cap in the form of MAT_025 (Sandler-Rubin), soil or rock, rate independent.";

  template <typename Number>
  struct History
  {
    Number kappa = Number(0.); ///< position of the cap's centre on the I1 axis [Pa]

    template <typename F>
    void for_each(F &&f)
    {
      f("kappa", kappa);
    }
  };

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// What follows from the surface; part of finalize().
  void derive();

  double          density() const { return elastic.density; }
  double          wave_speed_bound() const { return elastic.p_wave_speed(); }
  History<double> initial_history() const { return {surface.junction(surface.initial_position)}; }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const Number            K = Number(elastic.bulk_modulus), G = Number(elastic.shear_modulus);
    const SymTensor<Number> s_n = deviator(stress_n), s_t = s_n + deviator(increment.strain) * Number(Number(2.) * G);
    const Number            I1_trial = -trace(stress_n) - Number(3.) * K * trace(increment.strain);
    const Number            J2_trial = second_invariant(s_t);
    Response<Number>        response;
    response.wave_speed = square_root(Number((K + Number(4. / 3.) * G) / increment.density));
    if (stays_elastic(I1_trial, J2_trial, history.kappa))
      {
        const Number p      = I1_trial * Number(1. / 3.);
        response.stress     = s_t - spherical(p);
        response.stored     = elastic.stored_energy(p, J2_trial);
        response.dissipated = Number(0.);
        return response;
      }
    const Number j_trial = square_root(Number(J2_trial + Number(1e-32 * surface.F0 * surface.F0)));
    Number       I1 = I1_trial, j = j_trial;
    project(K, G, I1, j, history.kappa, response.iterations);

    const Number ratio = j / j_trial, p = I1 * Number(1. / 3.), p_n = pressure(stress_n);
    response.stress = s_t * ratio;
    for (int k = 0; k < 3; ++k)
      response.stress[k] -= p;
    response.stored = elastic.stored_energy(p, Number(j * j));
    // mean stress : plastic strain
    response.dissipated = contract((s_n + s_t * ratio) * Number(0.5), s_t) * (Number(1.) - ratio) / (Number(2.) * G) -
                          Number(0.5) * (p + p_n) * (I1 - I1_trial) / (Number(3.) * K);
    return response;
  }

  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &history) const
  {
    history.kappa = max(history.kappa, Number(smallest_kappa));
  }

  /// f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    elastic.for_each_constant(f);
    constants.for_each_constant(f);
  }

  ElasticConstants   constants;
  LinearElastic      elastic;
  GeologicCapSurface surface;
  double             tension_cutoff = 0.; ///< T on the I1 axis [Pa]
  std::string        type           = "soil";
  double             smallest_kappa = 0.;

private:
  std::string path;

  /// True if no lane comes near its surface.
  template <typename Number>
  bool stays_elastic(const Number &I1, const Number &J2, const Number &kappa) const
  {
    const auto I1_v = value_of(I1);
    return !any_of(
      !(I1_v >= Value<Number>(-tension_cutoff) && surface.surely_inside(I1_v, value_of(J2), value_of(kappa))));
  }

  /// Trial invariants -> invariants at t_{n+1}; kappa in place.
  template <typename Number>
  void project(const Number &K, const Number &G, Number &I1, Number &j, Number &kappa, Iterations &iterations) const
  {
    CapFlow flow;
    flow.rate_independent       = true;
    const Number       I1_trial = I1, j_trial = j, kappa_n = kappa;
    const auto         cap_n   = surface.cap(kappa_n);
    const Mask<Number> on_side = !(I1_trial < cap_n.L);
    const Number       v       = (I1_trial - cap_n.L) / cap_n.R;
    const Mask<Number> on_cap  = on_side && square_root(Number(j_trial * j_trial + v * v)) > cap_n.b;
    if (any_of(on_cap))
      {
        HardeningCap<Number, GeologicCapSurface> cap(surface, flow, K, G);
        const auto                               p = cap.solve(on_cap, I1_trial, j_trial, kappa_n, cap_n);
        I1                                         = select(on_cap, p.I1, I1);
        j                                          = select(on_cap, p.j, j);
        kappa                                      = select(on_cap, p.xi, kappa);
        iterations += cap.iterations;
      }

    const Mask<Number> fails = !on_side && j_trial > surface.failure(I1_trial).value;
    if (any_of(fails))
      {
        CapRegions<Number, GeologicCapSurface> regions(surface, flow, K, G);
        const auto                             p = regions.on_failure_surface(fails, I1_trial, j_trial);
        iterations += regions.iterations;
        // the corner where the projection would pass the cap's centre, which comes to meet it in a soil
        const Number       kappa_c = contracted(fails, K, p.I1, I1_trial, kappa_n, cap_n.X, iterations);
        const Mask<Number> corner  = fails && p.I1 > max(kappa_c, Number(0.));
        I1                         = select(fails, p.I1, I1);
        j                          = select(fails, p.j, j);
        kappa                      = select(fails, kappa_c, kappa);
        if (any_of(corner))
          {
            const Number kappa_e =
              type == "rock" ? kappa_n : meeting(corner, K, I1_trial, kappa_n, cap_n.X, iterations);
            const Number L = max(kappa_e, Number(0.));
            kappa          = select(corner, kappa_e, kappa);
            I1             = select(corner, L, I1);
            // where the cap begins at I1 = 0 it is lower than the failure surface
            j = select(corner, min(min(surface.failure(L).value, surface.cap(kappa_e).b), j_trial), j);
          }
      }

    const Number       cut  = Number(-tension_cutoff);
    const Mask<Number> torn = I1 < cut;
    if (any_of(torn))
      {
        I1    = select(torn, cut, I1);
        j     = select(torn, min(j_trial, surface.failure(cut).value), j);
        kappa = select(torn, contracted(torn, K, cut, I1_trial, kappa_n, cap_n.X, iterations), kappa);
      }
  }

  /// kappa after the dilation (I1 - I1_trial)/(3 K) at fixed I1 [rock: unchanged].
  template <typename Number>
  Number contracted(const Mask<Number> &wanted, const Number &K, const Number &I1, const Number &I1_trial,
                    const Number &kappa_n, const Number &X_n, Iterations &iterations) const
  {
    if (type == "rock")
      return kappa_n;
    const Number dilation = (I1 - I1_trial) / (Number(3.) * K);
    const auto   excess   = [&](const Number &kappa) {
      const auto cap = surface.cap(kappa);
      return ValueAndSlope<Number>{surface.compaction(cap.X, X_n) + dilation, surface.compaction_slope(cap.X) * cap.dX};
    };
    return contraction(wanted, kappa_n, excess, iterations);
  }

  /// kappa = I1 where contraction and the dilation up to that point agree.
  template <typename Number>
  Number meeting(const Mask<Number> &wanted, const Number &K, const Number &I1_trial, const Number &kappa_n,
                 const Number &X_n, Iterations &iterations) const
  {
    const Number per_3K = Number(1.) / (Number(3.) * K);
    const auto   excess = [&](const Number &kappa) {
      const auto cap = surface.cap(kappa);
      return ValueAndSlope<Number>{surface.compaction(cap.X, X_n) + (cap.L - I1_trial) * per_3K,
                                   surface.compaction_slope(cap.X) * cap.dX + cap.dM * per_3K};
    };
    return contraction(wanted, kappa_n, excess, iterations);
  }

  /// Root in [smallest kappa, kappa_n]; the end where there is none.
  template <typename Number, typename Function>
  Number contraction(const Mask<Number> &wanted, const Number &kappa_n, const Function &excess,
                     Iterations &iterations) const
  {
    const Number       low  = min(Number(smallest_kappa), kappa_n);
    const Mask<Number> none = !(excess(low).value < Number(0.));
    Bracket<Number>    bracket{low, kappa_n};
    bracket.tolerance           = Number(1e-15 * surface.smallest_position);
    bracket.relative_tolerance  = 1e-15;
    const Mask<Number> searched = wanted && !none && excess(kappa_n).value > Number(0.);
    return select(none, low, root_in_bracket<Number>(excess, bracket, kappa_n, searched, iterations));
  }
};
} // namespace Arenite
