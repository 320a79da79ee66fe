#pragma once

#include <arenite/base/tensor_tools.h>
#include <arenite/base/two_derivatives.h>
#include <arenite/materials/cap_return.h>

namespace Arenite
{
/// Algorithmic tangent of the return mapping of the cap surface, C = d sigma_{n+1}/d eps, from the derivatives of the
/// invariants at the end of the step with respect to those of the elastic trial,
///
///   a11 = dI1/dI1_t,  a12 = dI1/dj_t,  a21 = dj/dI1_t,  a22 = dj/dj_t,
///   C = K a11 1(x)1 - (sqrt2 G/3) a12 1(x)m - 3 sqrt2 K a21 m(x)1 + 2 G (j/j_t) P_dev + 2 G (a22 - j/j_t) m(x)m,
///
/// m = s_t/(sqrt2 j_t). Symmetric (G a12 = 9 K a21) where the cap does not harden. The derivatives are those of the converged
/// equations, which CapReturn finds for numbers with two derivatives by one more Newton step: no second set of formulas.
///
///   using D = TwoDerivatives<V>;
///   CapReturn<D> step(surface, flow, D(K), D(G));
///   step.solve(D(I1_t, 1, 0), D(j_t, 0, 1), D(xi_n));       // stress and tangent of one solution
///   CapTangent<V> C(s_t, K, G, j_t, step.I1, step.j);
///
/// The mixture of Duvaut-Lions, I1_t + w (I1 - I1_t) with w = dt/(tau + dt), is part of CapReturn, so that its tangent is the same mixture
/// of 2 G P_dev + K 1(x)1 and the rate-independent one. For one undivided step with constant moduli in which no gap closes.
template <typename V>
class CapTangent
{
public:
  CapTangent(const SymTensor<V> &s_trial, const V &K, const V &G, const V &j_trial, const TwoDerivatives<V> &I1,
             const TwoDerivatives<V> &j)
    : a11(I1.d[0])
    , a12(I1.d[1])
    , a21(j.d[0])
    , a22(j.d[1])
    , direction(s_trial * V(V(1.) / j_trial))
    , ratio(j.value / j_trial)
    , K(K)
    , G(G)
  {}

  const V a11, a12, a21, a22;

  /// C : strain
  SymTensor<V> apply(const SymTensor<V> &strain) const
  {
    const SymTensor<V> e    = deviator(strain);
    const V            dI_t = V(-3.) * K * trace(strain), dj_t = G * contract(direction, e);
    const V            dI = a11 * dI_t + a12 * dj_t, dj = a21 * dI_t + a22 * dj_t;
    return e * V(V(2.) * G * ratio) + direction * V(dj - ratio * dj_t) - spherical(V(dI * V(1. / 3.)));
  }

private:
  const SymTensor<V> direction; ///< s_t/j_t
  const V            ratio, K, G;
};
} // namespace Arenite
