#pragma once

#include <arenite/materials/cap_surface.h>

#include <algorithm>
#include <utility>

namespace Arenite
{
/// Viscoplastic multiplier of one step as a function of the overstress variable t:
///
///   Perzyna            f = f0 t,  dlambda = eta dt t^N    (t = f/f0; the fluidity eta -> infinity is rate independent)
///   rate independent   f = 0,     dlambda = t
///
/// With t as unknown the equations of the step are well scaled for every eta dt and N: no division by eta dt, no root.
struct CapFlow
{
  bool   rate_independent = false;
  double fluidity_dt      = 0.; ///< eta dt [-]
  double f0               = 1.; ///< [Pa]
  double exponent         = 1.; ///< N

  template <typename Number>
  struct Rates
  {
    Number f, df, multiplier, d_multiplier; ///< and derivatives with respect to t
  };
  template <typename Number>
  Rates<Number> rates(const Number &t) const
  {
    if (rate_independent)
      return {Number(0.), Number(0.), t, Number(1.)};
    const Number q = power(t, exponent - 1.);
    return {Number(f0) * t, Number(f0), Number(fluidity_dt) * q * t, Number(fluidity_dt * exponent) * q};
  }

  /// First guess from f at the trial state and the decrease of f per multiplier.
  template <typename Number>
  Number start(const Number &f, const Number &decrease) const
  {
    if (rate_independent)
      return f / decrease;
    if (exponent == 1.)
      return f / (Number(f0) + decrease * Number(fluidity_dt));
    return min(Number(f / Number(f0)), power(Number(f / (decrease * Number(fluidity_dt))), 1. / exponent));
  }

  /// Above this t there is no solution; @p stiffness is the smallest elastic modulus of the invariants.
  template <typename Number>
  Number upper(const Number &f, const Number &stiffness) const
  {
    return rate_independent ? f / stiffness : f / Number(f0);
  }
};

/// Backward Euler of the flow rule in the two invariants (I1, j): the tensor equations reduce to them because the stress
/// deviator keeps the direction of the trial state.
///
///   I1 = I1_trial - 9 K dlambda f_I,   j = j_trial - G dlambda f_j,   3 K (k - k_n) = <I1_trial - I1> where the cap hardens.
///
/// Each region has one scalar equation with a strictly decreasing residual (the hardening cap: two), solved by Newton's method
/// inside of a bracket, lane by lane with masks. The trial state's region is tried first; flow moves I1 upwards on the cut-off,
/// the failure surface and the left half of the cap, so that tension -> failure -> cap are the only transitions. Where neither
/// failure surface nor cap has a solution the state slides along I1 = L (the rate of flow jumps there).
///
/// @tparam Number double, lanes, or a differentiable number: values are then found with doubles, and one more Newton step brings
/// the derivatives of the implicit function.
/// @tparam Surface  CapSurface; GeologicCapSurface uses the pieces on_failure_surface() and harden() only
template <typename Number, typename Surface = CapSurface>
class CapReturn
{
public:
  using V = Value<Number>;
  using M = Mask<Number>;

  CapReturn(const Surface &surface, const CapFlow &flow, const Number &K, const Number &G)
    : surface(surface)
    , flow(flow)
    , K(K)
    , G(G)
  {}

  Number I1, j; ///< after solve() [Pa]
  Number xi;    ///< junction of the cap

  unsigned int iterations = 0, fallbacks = 0; ///< of all lanes together

  /// From the trial invariants and the junction at t_n.
  void solve(const Number &I1_trial, const Number &j_trial, const Number &xi_n)
  {
    I1               = I1_trial;
    j                = j_trial;
    xi               = xi_n;
    const Cap cap    = surface.cap(xi_n);
    const M   yields = surface.yield_function(I1_trial, j_trial, cap) > Number(0.);
    if (!any_of(yields) || !(flow.rate_independent || flow.fluidity_dt > 0.))
      return;

    const M tension = yields && I1_trial < Number(0.);
    const M failure = yields && I1_trial < cap.L; // with the lanes of `tension`
    const M frozen  = yields && !(I1_trial < cap.L) && !(I1_trial > cap.M);
    const M hardens = yields && !(I1_trial < cap.L) && I1_trial > cap.M;

    M open = failure; // lanes whose trial region has not given the solution yet
    if (any_of(tension) || any_of(frozen))
      {
        const M      both   = tension || frozen;
        const Number center = select(tension, Number(surface.tension_center), cap.M);
        const Number ratio  = select(tension, Number(surface.tension_ratio), cap.R);
        const Number axis   = select(tension, Number(surface.tension_axis), cap.b);
        const Point  p      = on_ellipse(both, I1_trial, j_trial, center, ratio, axis);
        const M      done   = both && (frozen || !(p.I1 > Number(0.)));
        accept(done, p);
        open = open && !done;
      }
    const M on_surface = open && I1_trial < cap.L && cap.L > Number(0.);
    if (any_of(on_surface))
      {
        const Point p    = on_failure_surface(on_surface, I1_trial, j_trial);
        const M     done = on_surface && !(p.I1 > cap.L);
        accept(done, p);
        open = open && !done;
      }
    if (any_of(open))
      {
        const Point p    = on_ellipse(open, I1_trial, j_trial, cap.M, cap.R, cap.b);
        const M     done = open && !(p.I1 < cap.L);
        accept(done, p);
        open = open && !done;
      }
    if (any_of(open))
      slide(open, I1_trial, j_trial, cap);
    if (any_of(hardens))
      harden(hardens, I1_trial, j_trial, xi_n, cap);
  }

  using Cap = typename Surface::template Cap<Number>;
  struct Point
  {
    Number I1, j;
  };

  void accept(const M &where, const Point &p)
  {
    I1 = select(where, p.I1, I1);
    j  = select(where, p.j, j);
  }

  // --- one ellipse that does not harden ---------------------------------------------------------------------------------
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
        return Evaluation{s.residual, s.slope, V(V(4e-16) * s.axis_and_f)};
      });
    Number     t = derivative_step(t_value, [&](const Number &x) {
      return ellipse_state<Number>(flow, x, v_trial, j_trial, b, G, kappa);
    });
    const auto s = ellipse_state<Number>(flow, t, v_trial, j_trial, b, G, kappa);
    return {center + (I1_trial - center) / (Number(1.) + kappa * s.mu), j_trial / (Number(1.) + G * s.mu)};
  }

  // --- failure surface ---------------------------------------------------------------------------------------------------
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

  Point on_failure_surface(const M &wanted, const Number &I1_trial, const Number &j_trial)
  {
    const V    I_v = value_of(I1_trial), j_v = value_of(j_trial), K_v = value_of(K), G_v = value_of(G);
    const auto F        = surface.failure(I_v);
    const V    f        = j_v - F.value;
    const V    decrease = G_v + V(9.) * K_v * F.slope * F.slope;
    const V    t_value =
      root(M(wanted && f > V(0.)), flow.start(max(f, V(0.)), decrease), flow.upper(f, G_v), [&](const V &t) {
        const auto s = failure_state<V>(t, I_v, j_v, K_v, G_v);
        return Evaluation{s.residual, s.slope, V(V(3e-16) * s.size)};
      });
    Number t =
      derivative_step(t_value, [&](const Number &x) { return failure_state<Number>(x, I1_trial, j_trial, K, G); });
    return {failure_state<Number>(t, I1_trial, j_trial, K, G).I1, j_trial - G * flow.rates(t).multiplier};
  }

  // --- scalar equations ----------------------------------------------------------------------------------------------------
  struct Evaluation
  {
    V residual, slope, tolerance;
  };

  /// Root of a decreasing function in (0, upper]: Newton's method inside of the bracket, each lane until its own end.
  template <typename Function>
  V root(const M &wanted, const V &guess, const V &upper, const Function &function)
  {
    M active = wanted;
    V t = select(wanted, guess, V(0.)), low = V(0.), high = select(wanted, upper, V(1.));
    for (unsigned int i = 0; i < 100 && any_of(active); ++i)
      {
        ++iterations;
        const Evaluation e = function(t);
        low                = select(M(active && e.residual > V(0.)), t, low);
        high               = select(M(active && !(e.residual > V(0.))), t, high);
        const V newton     = t - e.residual / e.slope;
        const M inside     = !(newton < low) && !(newton > high);
        const M converged =
          !(absolute(e.residual) > e.tolerance) || !(absolute(V(newton - t)) > V(1e-14) * absolute(t));
        // outside of the bracket: its middle, or a geometric mean while nothing is known about the lower end
        const V middle =
          select(M(low > V(0.)), V(V(0.5) * (low + high)), V(high * square_root(max(V(V(1e-300) / high), V(1e-6)))));
        const M strictly = newton > low && newton < high;
        V       next     = select(strictly, newton, middle);
        const M stuck    = !(absolute(V(next - t)) > V(2e-16) * absolute(t));
        next             = select(converged, select(inside, newton, t), next);
        t                = select(active, next, t);
        active           = active && !(converged || stuck);
      }
    return t;
  }

  /// t for doubles and lanes; for differentiable numbers the Newton step that carries the derivatives of the implicit function.
  template <typename Function>
  Number derivative_step(const V &t, const Function &function) const
  {
    if constexpr (std::is_same_v<Number, V>)
      {
        (void)function;
        return t;
      }
    else
      {
        if (!(t > 0.)) // no flow
          return Number(t);
        const auto s = function(Number(t));
        return Number(t) - s.residual / Number(value_of(s.slope));
      }
  }

  // --- sliding along I1 = L ------------------------------------------------------------------------------------------------
  /// Where neither side has a solution: I1 = L and flow = w cap + (1 - w) other, 0 <= w <= 1; the other side is the failure
  /// surface, or the tension cut-off where the cap begins at I1 = 0. One equation in j, by bisection; rare, so lane by lane.
  template <typename N>
  static N slide_residual(const Surface &surface, const CapFlow &flow, const N &j, const N &I1_trial, const N &j_trial,
                          const typename Surface::template Cap<N> &cap, const N &K_n, const N &G_n)
  {
    const auto multiplier = [&](const N &f) {
      // for a rate-independent material the sliding state lies on the surface, where both sides agree
      return N(flow.fluidity_dt) * power(max(N(f / N(flow.f0)), N(0.)), flow.exponent);
    };
    const N v = (cap.L - cap.M) / cap.R, Q = square_root(N(j * j + v * v));
    const N on_cap = multiplier(N(Q - cap.b));
    N       f, f_I, f_j;
    if (cap.L > N(0.))
      {
        const auto F = surface.failure(cap.L);
        f            = j - F.value;
        f_I          = -F.slope;
        f_j          = N(1.);
      }
    else
      {
        const N w = N(-surface.tension_center / surface.tension_ratio), Q3 = square_root(N(j * j + w * w));
        f   = Q3 - N(surface.tension_axis);
        f_I = w / (N(surface.tension_ratio) * Q3);
        f_j = j / Q3;
      }
    const N other = multiplier(f);
    const N p_cap = N(-9.) * K_n * on_cap * v / (cap.R * Q), p_other = N(-9.) * K_n * other * f_I; // rise of I1
    const N demand = cap.L - I1_trial;
    const N w      = min(N(1.), max(N(0.), N((p_other - demand) / (p_other - p_cap))));
    return j_trial - G_n * (w * on_cap * j / Q + (N(1.) - w) * other * f_j) - j;
  }

  void slide(const M &wanted, const Number &I1_trial, const Number &j_trial, const Cap &cap)
  {
    for (int l = 0; l < n_lanes<V>(); ++l)
      {
        if (!mask_lane(wanted, l))
          continue;
        const double I_l = lane(value_of(I1_trial), l), j_l = lane(value_of(j_trial), l), K_l = lane(value_of(K), l),
                     G_l = lane(value_of(G), l);
        const auto cap_l = surface.template cap<double>(lane(value_of(xi), l));
        double     low   = cap_l.L > 0. ? surface.failure(cap_l.L).value : 0.;
        double     high  = j_l;
        const auto r     = [&](const double x) {
          return slide_residual<double>(surface, flow, x, I_l, j_l, cap_l, K_l, G_l);
        };
        if (flow.rate_independent)
          high = low = surface.failure(cap_l.L).value;
        for (unsigned int i = 0; i < 120 && high - low > 1e-15 * high; ++i)
          {
            ++iterations;
            const double middle           = 0.5 * (low + high);
            (r(middle) > 0. ? low : high) = middle;
          }
        const double root = 0.5 * (low + high);
        if constexpr (std::is_same_v<Number, V>)
          {
            set_lane(I1, l, cap_l.L);
            set_lane(j, l, root);
          }
        else
          {
            const double h     = 1e-6 * root;
            const double slope = (r(root + h) - r(root - h)) / (2. * h);
            I1                 = cap.L;
            j                  = Number(root) -
                slide_residual<Number>(surface, flow, Number(root), I1_trial, j_trial, cap, K, G) / Number(slope);
          }
      }
    (void)cap;
  }

  // --- cap with hardening ----------------------------------------------------------------------------------------------------
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

  void harden(const M &wanted, const Number &I1_trial, const Number &j_trial, const Number &xi_n, const Cap &cap_n)
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
        ++iterations;
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
            const auto root = harden_by_brackets(lane(I_t, l), lane(j_t, l), lane(x_n, l), lane(K_v, l), lane(G_v, l));
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
    accept(wanted, {h.I1, h.j});
    xi = select(wanted, xi_n1, xi);
  }

  /// Root of the compaction equation over xi, which increases, with the ellipse solved for every xi. For the few states where
  /// Newton's method in two unknowns leaves its bounds. @return t and xi
  std::pair<double, double> harden_by_brackets(const double I1_trial, const double j_trial, const double xi_n,
                                               const double K_l, const double G_l) const
  {
    CapReturn<double, Surface> scalar(surface, flow, K_l, G_l);
    const double               X_n   = surface.cap(xi_n).X;
    const auto                 solve = [&](const double x) { return scalar.multiplier_on_cap(x, I1_trial, j_trial); };
    const auto                 r2    = [&](const double x) {
      return scalar.template hardening_state<double>(solve(x), x, I1_trial, j_trial, X_n, K_l, G_l).r2;
    };
    double low = xi_n, high = std::max(I1_trial, xi_n + 1e-9 * surface.smallest_position), r_low = r2(low),
           r_high = r2(high);
    if (r_low >= 0.)
      return {solve(xi_n), xi_n};
    int side = 0; // regula falsi after Illinois, every third step a bisection
    for (unsigned int i = 0; i < 200 && high - low > 4e-16 * std::abs(high) + 1e-16 * surface.smallest_position; ++i)
      {
        double middle = (r_low * high - r_high * low) / (r_low - r_high);
        if (i % 3 == 2 || !(middle > low && middle < high))
          middle = 0.5 * (low + high);
        const double r = r2(middle);
        if (r == 0.)
          {
            low = high = middle;
            break;
          }
        if (r < 0.)
          {
            low   = middle;
            r_low = r;
            r_high *= side == -1 ? 0.5 : 1.;
            side = -1;
          }
        else
          {
            high   = middle;
            r_high = r;
            r_low *= side == 1 ? 0.5 : 1.;
            side = 1;
          }
      }
    const double x = 0.5 * (low + high);
    return {solve(x), x};
  }

  /// t on the cap of a given xi, for doubles.
  double multiplier_on_cap(const double x, const double I1_trial, const double j_trial)
  {
    const auto   cap = surface.cap(x);
    const double v = (I1_trial - cap.M) / cap.R, kappa = 9. * K / (cap.R * cap.R);
    const double Q = std::sqrt(j_trial * j_trial + v * v), f = Q - cap.b;
    if (!(f > 0.))
      return 0.;
    return root(true, flow.start(f, (G * j_trial * j_trial + kappa * v * v) / (Q * Q)),
                flow.upper(f, std::min<double>(G, kappa)), [&](const double &t) {
                  const auto s = ellipse_state<double>(flow, t, v, j_trial, cap.b, G, kappa);
                  return Evaluation{s.residual, s.slope, 4e-16 * s.axis_and_f};
                });
  }

  template <typename, typename>
  friend class CapReturn;

  const Surface &surface;
  const CapFlow &flow;
  const Number   K, G;
};
} // namespace Arenite
