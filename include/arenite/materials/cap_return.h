#pragma once

#include <arenite/materials/cap_regions.h>
#include <arenite/materials/hardening_cap.h>

namespace Arenite
{
/// Backward Euler of the flow rule in the two invariants (I1, j): the tensor equations reduce to them because the stress
/// deviator keeps the direction of the trial state.
///
/// The trial state's region is tried first; flow moves I1 upwards on the cut-off, the failure surface and the left half of the
/// cap, so that tension -> failure -> cap are the only transitions. Where neither failure surface nor cap has a solution the state
/// slides along I1 = L (the rate of flow jumps there). Lane by lane with masks.
template <typename Number>
class CapReturn
{
public:
  using M = Mask<Number>;

  CapReturn(const CapSurface &surface, const CapFlow &flow, const Number &K, const Number &G)
    : surface(surface)
    , flow(flow)
    , regions(surface, flow, K, G)
    , moving_cap(surface, flow, K, G)
  {}

  Number I1, j; ///< after solve() [Pa]
  Number xi;    ///< junction of the cap

  Iterations iterations() const
  {
    Iterations sum = regions.iterations;
    sum += moving_cap.iterations;
    return sum += of_junction;
  }
  unsigned int fallbacks() const { return moving_cap.fallbacks; }

  /// From the trial invariants and the junction at t_n.
  void solve(const Number &I1_trial, const Number &j_trial, const Number &xi_n)
  {
    I1                = I1_trial;
    j                 = j_trial;
    xi                = xi_n;
    const auto cap    = surface.cap(xi_n);
    const M    yields = surface.yield_function(I1_trial, j_trial, cap) > Number(0.);
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
        const Point  p      = regions.on_ellipse(both, I1_trial, j_trial, center, ratio, axis);
        const M      done   = both && (frozen || !(p.I1 > Number(0.)));
        accept(done, p);
        open = open && !done;
      }
    const M on_surface = open && I1_trial < cap.L && cap.L > Number(0.);
    if (any_of(on_surface))
      {
        const Point p    = regions.on_failure_surface(on_surface, I1_trial, j_trial);
        const M     done = on_surface && !(p.I1 > cap.L);
        accept(done, p);
        open = open && !done;
      }
    if (any_of(open))
      {
        const Point p    = regions.on_ellipse(open, I1_trial, j_trial, cap.M, cap.R, cap.b);
        const M     done = open && !(p.I1 < cap.L);
        accept(done, p);
        open = open && !done;
      }
    if (any_of(open))
      accept(open, regions.sliding(open, I1_trial, j_trial, xi_n, cap));
    if (any_of(hardens))
      {
        const auto p = moving_cap.solve(hardens, I1_trial, j_trial, xi_n, cap);
        accept(hardens, {p.I1, p.j});
        xi = select(hardens, p.xi, xi);
      }
    if (flow.part_of_way < 1.)
      go_a_part_of_the_way(I1_trial, j_trial, xi_n, cap.X);
  }

private:
  using Point = Invariants<Number>;

  /// The invariants and X of Duvaut-Lions, from the trial state towards the rate-independent one.
  void go_a_part_of_the_way(const Number &I1_trial, const Number &j_trial, const Number &xi_n, const Number &X_n)
  {
    const Number w(flow.part_of_way);
    I1 = I1_trial + w * (I1 - I1_trial);
    j  = j_trial + w * (j - j_trial);
    if (any_of(xi > xi_n))
      xi = surface.junction(Number(X_n + w * (surface.cap(xi).X - X_n)), xi_n, xi, of_junction);
  }

  void accept(const M &where, const Point &p)
  {
    I1 = select(where, p.I1, I1);
    j  = select(where, p.j, j);
  }

  const CapSurface    &surface;
  const CapFlow       &flow;
  CapRegions<Number>   regions;
  HardeningCap<Number> moving_cap;
  Iterations           of_junction;
};
} // namespace Arenite
