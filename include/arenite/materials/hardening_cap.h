#pragma once

#include <arenite/materials/cap_regions.h>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace Arenite
{
/// Backward Euler of the flow rule on a cap that hardens by its own compaction: the equations of CapRegions and
///
///   3 K (k(X) - k_n) = I1_trial - I1.
///
/// Newton's method for t of CapFlow and xi of the surface, kept inside of 0 < t <= upper and xi_n <= xi <= I1_trial. The few
/// states where it leaves them are solved by a bracket in xi around a bracket in t.
template <typename Number, typename Surface = CapSurface>
class HardeningCap
{
public:
  using V   = Value<Number>;
  using M   = Mask<Number>;
  using Cap = typename Surface::template Cap<Number>;
  struct Point
  {
    Number I1, j, xi;
  };

  HardeningCap(const Surface &surface, const CapFlow &flow, const Number &K, const Number &G)
    : surface(surface)
    , flow(flow)
    , K(K)
    , G(G)
  {}

  Iterations   iterations;
  unsigned int fallbacks = 0; ///< to brackets inside of brackets

  /// For the lanes in @p wanted, from the trial invariants and the cap at t_n.
  Point solve(const M &wanted, const Number &I1_trial, const Number &j_trial, const Number &xi_n, const Cap &cap_n)
  {
    const V I_t = value_of(I1_trial), j_t = value_of(j_trial), x_n = value_of(xi_n), X_n = value_of(cap_n.X),
            K_v = value_of(K), G_v = value_of(G), scale = V(surface.smallest_position);
    // start: one Newton step from the trial state
    const V cap_M = value_of(cap_n.M), cap_R = value_of(cap_n.R), cap_b = value_of(cap_n.b);
    const V v = (I_t - cap_M) / cap_R, Q = max(square_root(V(j_t * j_t + v * v)), cap_b), f = Q - cap_b;
    const V f_I = v / (cap_R * Q), f_j = j_t / Q;
    const V f_x = -v / Q * (value_of(cap_n.dM) + v * value_of(cap_n.dR)) / cap_R - value_of(cap_n.db);
    const V k_x = surface.compaction_slope(X_n) * value_of(cap_n.dX);
    V       t   = flow.start(f, V(V(9.) * K_v * f_I * f_I + G_v * f_j * f_j - f_x * V(3.) * f_I / k_x));
    V       x   = x_n + min(V(V(3.) * flow.rates(t).multiplier * f_I / k_x), V(V(0.999) * max(V(I_t - x_n), V(0.))));
    const V t_upper = flow.upper(f, min(G_v, V(V(9.) * K_v / V(surface.axis_ratio * surface.axis_ratio))));
    M       active = wanted, good = M(V(0.) > V(1.));
    for (unsigned int i = 0; i < 30 && any_of(active); ++i)
      {
        iterations.count(active);
        const auto h           = hardening_state<V>(t, x, I_t, j_t, X_n, K_v, G_v);
        const V    determinant = h.a11 * h.a22 - h.a12 * h.a21;
        const V    inverse     = V(1.) / determinant;
        const V    dt = (h.r2 * h.a12 - h.r1 * h.a22) * inverse, dx = (h.r1 * h.a21 - h.r2 * h.a11) * inverse;
        const M    converged =
          (absolute(h.r1) < V(1e-15) * h.size && absolute(h.r2) < V(1e-15) * absolute(I_t)) ||
          (!(absolute(dt) > V(1e-13) * absolute(t)) && !(absolute(dx) > V(1e-15) * (absolute(x) + scale)));
        V next_t = t + dt, next_x = x + dx;
        next_t = select(M(!(next_t > V(0.)) && !converged), V(V(0.5) * t), next_t);
        next_t = select(M(next_t > t_upper && !converged), V(V(0.5) * (t + t_upper)), next_t);
        next_x = select(M(next_x < x_n && !converged), V(V(0.5) * (x + x_n)), next_x);
        next_x = select(M(next_x > I_t && !converged), V(V(0.5) * (x + I_t)), next_x);
        t      = select(active, next_t, t);
        x      = select(active, next_x, x);
        good =
          good || (active && converged && !(t < V(0.)) && !(x < x_n - V(1e-12) * scale - V(1e-14) * absolute(x_n)));
        active = active && !converged && absolute(determinant) > V(0.);
      }
    if (any_of(M(wanted && !good)))
      for (int l = 0; l < n_lanes<V>(); ++l)
        if (mask_lane(M(wanted && !good), l))
          {
            ++fallbacks;
            const auto root = by_brackets(lane(I_t, l), lane(j_t, l), lane(x_n, l), lane(K_v, l), lane(G_v, l));
            set_lane(t, l, root.first);
            set_lane(x, l, root.second);
          }
    x = max(x, x_n); // rounding must not soften the cap

    Number t_n1 = Number(t), xi_n1 = Number(x);
    if constexpr (!std::is_same_v<Number, V>)
      {
        const auto h   = hardening_state<Number>(t_n1, xi_n1, I1_trial, j_trial, cap_n.X, K, G);
        const V    a11 = value_of(h.a11), a12 = value_of(h.a12), a21 = value_of(h.a21), a22 = value_of(h.a22),
                determinant = a11 * a22 - a12 * a21;
        t_n1                = t_n1 + (h.r2 * Number(a12) - h.r1 * Number(a22)) / Number(determinant);
        xi_n1               = xi_n1 + (h.r1 * Number(a21) - h.r2 * Number(a11)) / Number(determinant);
      }
    const auto h = hardening_state<Number>(t_n1, xi_n1, I1_trial, j_trial, cap_n.X, K, G);
    return {h.I1, h.j, xi_n1};
  }

private:
  template <typename, typename>
  friend class HardeningCap;

  const Surface &surface;
  const CapFlow &flow;
  const Number   K, G;

  template <typename N>
  struct HardeningState
  {
    N I1, j, size;        ///< size: b + f
    N r1, r2;             ///< overstress, compaction
    N a11, a12, a21, a22; ///< derivatives of r1 and r2 with respect to t and xi
  };

  template <typename N>
  HardeningState<N> hardening_state(const N &t, const N &xi_n1, const N &I1_trial, const N &j_trial, const N &X_n,
                                    const N &K_n, const N &G_n) const
  {
    // divisions are what this costs: one for each denominator
    const auto cap  = surface.cap(xi_n1);
    const auto rate = flow.rates(t);
    const N    size = cap.b + rate.f, per_size = N(1.) / size, mu = rate.multiplier * per_size;
    const N    mu_t = (rate.d_multiplier - mu * rate.df) * per_size, mu_x = -mu * per_size * cap.db;
    const N    per_R = N(1.) / cap.R, kappa = N(9.) * K_n * per_R * per_R, kappa_x = N(-2.) * kappa * cap.dR * per_R;
    const N    per_s = N(1.) / (N(1.) + kappa * mu), g = N(1.) / (N(1.) + G_n * mu);
    const N    j = j_trial * g, v = (I1_trial - cap.M) * per_R * per_s, Q = square_root(N(j * j + v * v)),
            per_Q = N(1.) / Q;
    const N j_mu = -j * G_n * g, v_mu = -v * kappa * per_s;
    const N v_x  = -(cap.dM * per_R + v * kappa_x * mu) * per_s - v * cap.dR * per_R;
    const N Q_mu = (j * j_mu + v * v_mu) * per_Q;

    HardeningState<N> h;
    h.I1   = cap.M + cap.R * v;
    h.j    = j;
    h.size = size;
    h.r1   = Q - size;
    h.r2   = N(3.) * K_n * surface.compaction(cap.X, X_n) - (I1_trial - h.I1);
    h.a11  = Q_mu * mu_t - rate.df;
    h.a12  = Q_mu * mu_x + v * v_x * per_Q - cap.db;
    h.a21  = cap.R * v_mu * mu_t;
    h.a22  = N(3.) * K_n * surface.compaction_slope(cap.X) * cap.dX + cap.dM + cap.dR * v + cap.R * (v_mu * mu_x + v_x);
    return h;
  }

  /// Root of the compaction equation over xi, which increases, with the ellipse solved for every xi. @return t and xi
  std::pair<double, double> by_brackets(const double I1_trial, const double j_trial, const double xi_n,
                                        const double K_l, const double G_l)
  {
    CapRegions<double, Surface>         ellipse(surface, flow, K_l, G_l);
    const HardeningCap<double, Surface> one(surface, flow, K_l, G_l);
    const double                        X_n = surface.cap(xi_n).X;
    const auto t_of       = [&](const double x) { return ellipse.multiplier_on(surface.cap(x), I1_trial, j_trial); };
    const auto compaction = [&](const double &x) {
      const auto h = one.template hardening_state<double>(t_of(x), x, I1_trial, j_trial, X_n, K_l, G_l);
      return ValueAndSlope<double>{h.r2, h.a22 - h.a21 * h.a12 / h.a11}; // t follows xi
    };
    Bracket<double> bracket{xi_n, std::max(I1_trial, xi_n + 1e-9 * surface.smallest_position)};
    bracket.tolerance          = 1e-16 * surface.smallest_position;
    bracket.relative_tolerance = 4e-16;
    const bool   moves         = compaction(xi_n).value < 0.;
    const double x = root_in_bracket<double>(compaction, bracket, xi_n, moves, iterations), t = t_of(x);
    iterations += ellipse.iterations;
    return {t, x};
  }
};
} // namespace Arenite
