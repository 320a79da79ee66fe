#pragma once

#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/cap_parameters.h>

#include <string>

namespace Arenite
{
/// Smooth yield surface of soils in the invariants I1 = -tr(sigma) (compression positive) and j = sqrt(J2): a failure surface, an
/// elliptic cap in front of it and an elliptic tension cut-off behind it, joined with a continuous normal.
///
///   failure, 0 <= I1 < L:  f = j - Fe(I1),                              Fe = alpha - gamma exp(-beta I1) + theta I1
///   cap, I1 >= L:          f = sqrt(j^2 + ((I1 - M)/R)^2) - b,          b = (X - M)/R
///   tension, I1 < 0:       f = sqrt(j^2 + ((I1 - C)/r)^2) - B,          ends at I1 = -T
///
/// Hardening moves the cap: X(k) = X0 + (1/D) [1/(1 - k/W) - 1] with the compactive viscoplastic volume strain k. The stored
/// variable is the junction xi: L for xi >= 0, X - X_min for xi < 0, because X, M and b are explicit in it:
///
///   X = L + R Fe (h + c),  M = L + R Fe h,  b = Fe c,   h = R Fe'(L),  c = sqrt(1 + h^2).
///
/// Below X_min = X(L = 0) the cap would begin inside the tension cut-off. The small-cap rule keeps L = 0 there and reduces the axis
/// ratio, R^2 = X^2/(F0^2 + 2 X F0 F0'), so that the ellipse still meets the cut-off with a continuous normal at (0, F0).
///
/// Roger (2015), equations (2.3.7)-(2.3.29); the explicit form in L and the small-cap rule are our own.
struct CapSurface : CapParameters
{
  double tension_limit  = 0.; ///< T on the I1 axis [Pa]
  bool   small_cap_rule = false;

  // derived by finalize()
  double tension_center = 0., tension_axis = 0., tension_ratio = 1.; ///< C [Pa], B [Pa], r [-]
  double smallest_position = 0.;                                     ///< X_min [Pa]
  double inner_ratio       = 0.;                                     ///< R e with the smallest slope of Fe
  double first_ratio = 0., per_F0 = 0.;                              ///< X_min/F0 [-], 1/F0 [1/Pa]

  /// Derived constants. @return the rule that the parameters break, with the numbers; empty if all is well.
  std::string finalize();

  /// The cap and its derivatives with respect to xi.
  template <typename Number>
  struct Cap
  {
    Number X, L, M, b, R;
    Number dX, dM, db, dR;
  };

  template <typename Number>
  Cap<Number> cap(const Number &xi) const
  {
    const Mask<Number>    small = xi < Number(0.);
    const Number          L     = select(small, Number(0.), xi);
    const Failure<Number> F     = failure(L);
    const Number          R = Number(axis_ratio), h = R * F.slope, c = square_root(Number(Number(1.) + h * h));
    const Number          e = h + c, per_c = Number(1.) / c;
    const Number          D1 = Number(1.) + h * h + R * R * F.value * F.curvature;
    Cap<Number>           cap;
    cap.X  = L + R * F.value * e;
    cap.L  = L;
    cap.M  = L + R * F.value * h;
    cap.b  = F.value * c;
    cap.R  = R;
    cap.dX = e * per_c * D1;
    cap.dM = D1;
    cap.db = F.slope * per_c * D1;
    cap.dR = Number(0.);
    if (any_of(small))
      {
        const double F0F = F0 * F0_slope;
        const Number X   = select(small, Number(Number(smallest_position) + xi), Number(smallest_position));
        const Number n = Number(F0 * F0) + Number(2. * F0F) * X, R2 = X * X / n, Rs = square_root(R2);
        const Number dR2 = Number(2.) * X * (Number(F0 * F0) + Number(F0F) * X) / (n * n);
        const Number b   = square_root(Number(Number(F0 * F0) + Number(F0F * F0F) * R2));
        cap.X            = select(small, X, cap.X);
        cap.M            = select(small, Number(Number(F0F) * R2), cap.M);
        cap.b            = select(small, b, cap.b);
        cap.R            = select(small, Rs, cap.R);
        cap.dX           = select(small, Number(1.), cap.dX);
        cap.dM           = select(small, Number(Number(F0F) * dR2), cap.dM);
        cap.db           = select(small, Number(Number(F0F * F0F) * dR2 / (Number(2.) * b)), cap.db);
        cap.dR           = select(small, Number(dR2 / (Number(2.) * Rs)), cap.dR);
      }
    return cap;
  }

  /// f in the region of I1 [Pa]; @p cap belongs to the present xi.
  template <typename Number>
  Number yield_function(const Number &I1, const Number &j, const Cap<Number> &cap) const
  {
    const Mask<Number> tension = I1 < Number(0.), on_cap = !(I1 < cap.L);
    const Number       center  = select(tension, Number(tension_center), cap.M);
    const Number       ratio   = select(tension, Number(tension_ratio), cap.R);
    const Number       axis    = select(tension, Number(tension_axis), cap.b);
    const Number       v       = (I1 - center) / ratio;
    const Number       ellipse = square_root(Number(j * j + v * v)) - axis;
    const Mask<Number> between = !(tension || on_cap);
    if (!any_of(between))
      return ellipse;
    return select(between, Number(j - failure(I1).value), ellipse);
  }

  /// True only where f < 0: the state lies inside of a simpler surface that lies inside of this one. No exponential, root or
  /// division, because this is what most points of a mesh are asked in every step.
  ///
  ///   j^2 + ((I1 - C)/r)^2 < B^2                                I1 < 0, the cut-off itself
  ///   j^2 + (<I1 - L>/r_i)^2 < F(min(I1, L))^2                  else, with F <= Fe and r_i F(L) <= X - L
  ///
  /// The quarter of an ellipse with its top at (L, Fe(L)) and its end at (X, 0) is inside of the cap because X - L = R Fe e with
  /// e >= 1: both j^2 are parabolas in I1 that meet at L and X, and the cap's has the smaller curvature.
  template <typename Number>
  Mask<Number> surely_inside(const Number &I1, const Number &J2, const Number &xi) const
  {
    const Number zero(0.);
    const Number ratio = select(xi < zero, Number(Number(first_ratio) + xi * Number(per_F0)), Number(inner_ratio));
    const Number v     = I1 - Number(tension_center), r(tension_ratio), rB(tension_ratio * tension_axis);
    const Mask<Number> tension = I1 < zero, inside_of_tension = r * r * J2 + v * v < rB * rB;
    return (tension && inside_of_tension) || (!tension && surely_below<Number>(I1, J2, max(xi, zero), ratio));
  }

  /// k(X) - k(X_n) without cancellation, and dk/dX.
  template <typename Number>
  Number compaction(const Number &X, const Number &X_n) const
  {
    const Number y = stiffened(X), y_n = stiffened(X_n);
    return Number(hardening_limit * hardening_rate) * (X - X_n) / (y * y_n);
  }
  template <typename Number>
  Number compaction_slope(const Number &X) const
  {
    const Number y = stiffened(X);
    return Number(hardening_limit * hardening_rate) / (y * y);
  }
  /// k(X) [-]
  template <typename Number>
  Number compaction(const Number &X) const
  {
    return compaction<Number>(X, Number(initial_position));
  }

  /// xi of a cap that ends at X >= X0; Newton's method inside of a bracket, for a start or a transfer.
  double junction(double X) const;

  /// X of the smallest cap that holds the state (I1, j), but not below X0; where j is beyond the failure surface, of one that ends at I1.
  double position_through(double I1, double j) const;

  /// Why a soil cannot be at rest with the state (I1, j), or nothing.
  std::string complaint_about(double I1, double j) const;

  /// The same on lanes, inside of [low, high] with X(low) <= X <= X(high).
  template <typename Number>
  Number junction(const Number &X, const Number &low, const Number &high, Iterations &iterations) const
  {
    Bracket<Number> bracket{low, high};
    bracket.tolerance          = Number(1e-15 * smallest_position);
    bracket.relative_tolerance = 1e-15;
    const auto excess          = [&](const Number &xi) {
      const Cap<Number> c = cap(xi);
      return ValueAndSlope<Number>{c.X - X, c.dX};
    };
    return root_in_bracket<Number>(excess, bracket, high, high > low, iterations);
  }

private:
  /// 1 + D (X - X0)
  template <typename Number>
  Number stiffened(const Number &X) const
  {
    return Number(1.) + Number(hardening_rate) * (X - Number(initial_position));
  }
};
} // namespace Arenite
