#pragma once

#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/cap_flow.h>
#include <arenite/materials/cap_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace Arenite
{
/// The invariants of a stress [Pa]: I1 = -tr(sigma), j = sqrt(J2).
template <typename Number>
struct Invariants
{
  Number I1, j;
};

/// Backward Euler of the flow rule on the parts of a cap surface that do not move,
///
///   I1 = I1_trial - 9 K dlambda f_I,   j = j_trial - G dlambda f_j,
///
/// each from the trial invariants of the lanes in `wanted`. One scalar equation for the variable t of CapFlow, with a strictly
/// decreasing residual. Which part a trial state belongs to is not known here.
///
/// @tparam Number double, lanes, or a differentiable number: values are then found without derivatives, and one more Newton step
/// brings those of the implicit function.
template <typename Number, typename Surface = CapSurface>
class CapRegions
{
public:
  using V     = Value<Number>;
  using M     = Mask<Number>;
  using Cap   = typename Surface::template Cap<Number>;
  using Point = Invariants<Number>;

  CapRegions(const Surface &surface, const CapFlow &flow, const Number &K, const Number &G)
    : surface(surface)
    , flow(flow)
    , K(K)
    , G(G)
  {}

  Iterations iterations;

  /// On the ellipse sqrt(j^2 + ((I1 - center)/ratio)^2) = b + f.
  Point on_ellipse(const M &wanted, const Number &I1_trial, const Number &j_trial, const Number &center,
                   const Number &ratio, const Number &b)
  {
    const Number kappa = Number(9.) * K / (ratio * ratio), v_trial = (I1_trial - center) / ratio;
    const V      v_v = value_of(v_trial), j_v = value_of(j_trial), b_v = value_of(b), k_v = value_of(kappa),
            G_v     = value_of(G);
    const V Q_trial = max(square_root(V(j_v * j_v + v_v * v_v)), b_v), f = Q_trial - b_v;
    const V decrease = (G_v * j_v * j_v + k_v * v_v * v_v) / (Q_trial * Q_trial);
    const V t_value =
      root(M(wanted && f > V(0.)), flow.start(max(f, V(0.)), decrease), flow.upper(f, min(G_v, k_v)), [&](const V &t) {
        const auto s = ellipse_state<V>(flow, t, v_v, j_v, b_v, G_v, k_v);
        return ValueAndSlope<V>{V(-s.residual), V(-s.slope), V(V(4e-16) * s.axis_and_f)};
      });
    Number     t = with_derivatives(t_value, [&](const Number &x) {
      return ellipse_state<Number>(flow, x, v_trial, j_trial, b, G, kappa);
    });
    const auto s = ellipse_state<Number>(flow, t, v_trial, j_trial, b, G, kappa);
    return {center + (I1_trial - center) / (Number(1.) + kappa * s.mu), j_trial / (Number(1.) + G * s.mu)};
  }

  /// On the failure surface j = Fe(I1) + f.
  Point on_failure_surface(const M &wanted, const Number &I1_trial, const Number &j_trial)
  {
    const V    I_v = value_of(I1_trial), j_v = value_of(j_trial), K_v = value_of(K), G_v = value_of(G);
    const auto F        = surface.failure(I_v);
    const V    f        = j_v - F.value;
    const V    decrease = G_v + V(9.) * K_v * F.slope * F.slope;
    const V    t_value =
      root(M(wanted && f > V(0.)), flow.start(max(f, V(0.)), decrease), flow.upper(f, G_v), [&](const V &t) {
        const auto s = failure_state<V>(t, I_v, j_v, K_v, G_v);
        return ValueAndSlope<V>{V(-s.residual), V(-s.slope), V(V(3e-16) * s.size)};
      });
    Number t =
      with_derivatives(t_value, [&](const Number &x) { return failure_state<Number>(x, I1_trial, j_trial, K, G); });
    return {failure_state<Number>(t, I1_trial, j_trial, K, G).I1, j_trial - G * flow.rates(t).multiplier};
  }

  /// Where neither side of I1 = L has a solution: I1 = L and flow = w cap + (1 - w) other, 0 <= w <= 1; the other side is the
  /// failure surface, or the tension cut-off where the cap begins at I1 = 0. One equation in j, by bisection; rare, so lane by
  /// lane.
  Point sliding(const M &wanted, const Number &I1_trial, const Number &j_trial, const Number &xi, const Cap &cap)
  {
    V root = value_of(j_trial), slope = V(-1.);
    for (int l = 0; l < n_lanes<V>(); ++l)
      {
        if (!mask_lane(wanted, l))
          continue;
        const double I_l = lane(value_of(I1_trial), l), j_l = lane(value_of(j_trial), l), K_l = lane(value_of(K), l),
                     G_l = lane(value_of(G), l);
        const auto cap_l = surface.template cap<double>(lane(value_of(xi), l));
        const auto r     = [&](const double x) {
          return sliding_residual<double>(surface, flow, x, I_l, j_l, cap_l, K_l, G_l);
        };
        double j_root = surface.failure(cap_l.L).value; // rate independent
        if (!flow.rate_independent)
          {
            Bracket<double> bracket{cap_l.L > 0. ? j_root : 0., j_l};
            bracket.relative_tolerance = 1e-15;
            const auto rises           = [&](const double &x) {
              return ValueAndSlope<double>{-r(x), std::numeric_limits<double>::quiet_NaN()};
            };
            j_root = root_in_bracket<double>(rises, bracket, 0.5 * (bracket.lower + j_l), true, iterations);
          }
        const double h = 1e-6 * j_root;
        set_lane(root, l, j_root);
        if (!std::is_same_v<Number, V>)
          set_lane(slope, l, (r(j_root + h) - r(j_root - h)) / (2. * h));
      }
    if constexpr (std::is_same_v<Number, V>)
      return {cap.L, root};
    else
      return {cap.L,
              Number(root) -
                sliding_residual<Number>(surface, flow, Number(root), I1_trial, j_trial, cap, K, G) / Number(slope)};
  }

  /// t where the ellipse of an arbitrary cap, for doubles, has its solution.
  double multiplier_on(const typename Surface::template Cap<double> &cap, const double I1_trial, const double j_trial)
  {
    const double v = (I1_trial - cap.M) / cap.R, kappa = 9. * K / (cap.R * cap.R);
    const double Q = std::sqrt(j_trial * j_trial + v * v), f = Q - cap.b;
    if (!(f > 0.))
      return 0.;
    return root(true, flow.start(f, (G * j_trial * j_trial + kappa * v * v) / (Q * Q)),
                flow.upper(f, std::min<double>(G, kappa)), [&](const double &t) {
                  const auto s = ellipse_state<double>(flow, t, v, j_trial, cap.b, G, kappa);
                  return ValueAndSlope<double>{-s.residual, -s.slope, 4e-16 * s.axis_and_f};
                });
  }

private:
  const Surface &surface;
  const CapFlow &flow;
  const Number   K, G;

  template <typename N>
  struct EllipseState
  {
    N mu, Q, axis_and_f, residual, slope;
  };

  /// Residual sqrt(j^2 + v^2) - b - f(t) and its derivative; mu = dlambda/Q is explicit in t.
  template <typename N>
  static EllipseState<N> ellipse_state(const CapFlow &flow, const N &t, const N &v_trial, const N &j_trial, const N &b,
                                       const N &G, const N &kappa)
  {
    const auto      r = flow.rates(t);
    EllipseState<N> s;
    s.axis_and_f     = b + r.f;
    const N per_axis = N(1.) / s.axis_and_f;
    s.mu             = r.multiplier * per_axis;
    const N dmu      = (r.d_multiplier - s.mu * r.df) * per_axis;
    const N gj = N(1.) / (N(1.) + G * s.mu), gv = N(1.) / (N(1.) + kappa * s.mu);
    const N j = j_trial * gj, v = v_trial * gv;
    s.Q        = square_root(N(j * j + v * v));
    s.residual = s.Q - s.axis_and_f;
    s.slope    = -(j * j * G * gj + v * v * kappa * gv) / s.Q * dmu - r.df;
    return s;
  }

  template <typename N>
  struct FailureState
  {
    N I1, residual, slope, size;
  };

  /// I1 - 9 K dlambda Fe'(I1) = I1_trial: increasing and concave, so Newton's method from the left is monotone.
  V pressure_on_failure_surface(const V &I1_trial, const V &multiplier, const V &K_v) const
  {
    const V       push   = V(9.) * K_v * multiplier;
    const V       linear = I1_trial + push * V(surface.F0_slope);
    V             I      = max(I1_trial, V(0.));
    const Mask<V> stays  = I1_trial < V(0.) && !(linear > V(0.));
    Mask<V>       active = !stays;
    for (unsigned int i = 0; i < 60 && any_of(active); ++i)
      {
        const auto F    = surface.failure(I);
        const V    step = (I1_trial + push * F.slope - I) / (V(1.) - push * F.curvature);
        I               = select(active, V(I + step), I);
        active          = active && absolute(step) > V(2e-16) * (absolute(I) + absolute(I1_trial));
      }
    return select(stays, linear, I);
  }

  template <typename N>
  FailureState<N> failure_state(const N &t, const N &I1_trial, const N &j_trial, const N &K_n, const N &G_n) const
  {
    const auto r      = flow.rates(t);
    const V    I_root = pressure_on_failure_surface(value_of(I1_trial), value_of(r.multiplier), value_of(K_n));
    N          I      = N(I_root);
    if constexpr (!std::is_same_v<N, V>)
      {
        const auto F = surface.failure(I);
        I            = I +
            (I1_trial + N(9.) * K_n * r.multiplier * F.slope - I) / (N(1.) - N(9.) * K_n * r.multiplier * F.curvature);
      }
    const auto      F = surface.failure(I);
    FailureState<N> s;
    s.I1       = I;
    s.residual = j_trial - G_n * r.multiplier - F.value - r.f;
    const N dI = N(9.) * K_n * F.slope / (N(1.) - N(9.) * K_n * r.multiplier * F.curvature);
    s.slope    = -(G_n + F.slope * dI) * r.d_multiplier - r.df;
    s.size     = j_trial + absolute(F.value);
    return s;
  }

  /// t in (0, upper] where the residual, here with its sign changed, is zero.
  template <typename Function>
  V root(const Mask<V> &wanted, const V &guess, const V &upper, const Function &function)
  {
    const V    start = select(wanted, min(guess, upper), V(0.));
    Bracket<V> bracket{V(0.), upper};
    bracket.relative_tolerance = 1e-14;
    bracket.many_scales        = true;
    return root_in_bracket<V>(function, bracket, start, wanted, iterations);
  }

  /// The Newton step that carries the derivatives of the implicit function, for differentiable numbers.
  template <typename Function>
  Number with_derivatives(const V &t, const Function &function) const
  {
    if constexpr (std::is_same_v<Number, V>)
      {
        (void)function;
        return t;
      }
    else
      {
        const auto s = function(Number(t));
        return select(t > V(0.), Number(Number(t) - s.residual / Number(value_of(s.slope))), Number(t)); // 0: no flow
      }
  }

  template <typename N>
  static N sliding_residual(const Surface &surface, const CapFlow &flow, const N &j, const N &I1_trial,
                            const N &j_trial, const typename Surface::template Cap<N> &cap, const N &K_n, const N &G_n)
  {
    const auto multiplier = [&](const N &f) {
      // for a rate-independent material the sliding state lies on the surface, where both sides agree
      return N(flow.fluidity_dt) * power(max(N(f / N(flow.f0)), N(0.)), flow.exponent);
    };
    const N v = (cap.L - cap.M) / cap.R, Q = square_root(N(j * j + v * v));
    const N on_cap = multiplier(N(Q - cap.b));
    // on the other side: the failure surface, or the cut-off where the cap begins at I1 = 0
    const auto    F  = surface.failure(cap.L);
    const N       v3 = N(-surface.tension_center / surface.tension_ratio), Q3 = square_root(N(j * j + v3 * v3));
    const Mask<N> above = cap.L > N(0.);
    const N       f     = select(above, N(j - F.value), N(Q3 - N(surface.tension_axis)));
    const N       f_I   = select(above, N(-F.slope), N(v3 / (N(surface.tension_ratio) * Q3)));
    const N       f_j   = select(above, N(1.), N(j / Q3));
    const N       other = multiplier(f);
    const N       p_cap = N(-9.) * K_n * on_cap * v / (cap.R * Q), p_other = N(-9.) * K_n * other * f_I; // rise of I1
    const N       demand = cap.L - I1_trial;
    const N       w      = min(N(1.), max(N(0.), N((p_other - demand) / (p_other - p_cap))));
    return j_trial - G_n * (w * on_cap * j / Q + (N(1.) - w) * other * f_j) - j;
  }
};
} // namespace Arenite
