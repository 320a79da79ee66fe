#pragma once

#include <arenite/base/number.h>

namespace Arenite
{
/// A double, or lanes, with its derivatives with respect to two variables: what a return mapping in two invariants needs for its
/// tangent, small enough for registers. Comparisons and select() look at the value.
template <typename V>
struct TwoDerivatives
{
  V value = V(0.), d[2] = {V(0.), V(0.)};

  TwoDerivatives() = default;
  explicit TwoDerivatives(const V &value)
    : value(value)
  {}
  template <typename T, typename = std::enable_if_t<std::is_arithmetic_v<T> && !std::is_same_v<T, V>>>
  explicit TwoDerivatives(const T &constant)
    : value(V(constant))
  {}
  TwoDerivatives(const V &value, const V &d0, const V &d1)
    : value(value)
    , d{d0, d1}
  {}

  /// f(value) with the slope f'(value).
  ARENITE_INLINE TwoDerivatives chain(const V &f, const V &slope) const { return {f, slope * d[0], slope * d[1]}; }

  static TwoDerivatives select(const Mask<V> &mask, const TwoDerivatives &a, const TwoDerivatives &b)
  {
    return {Arenite::select<V>(mask, a.value, b.value), Arenite::select<V>(mask, a.d[0], b.d[0]),
            Arenite::select<V>(mask, a.d[1], b.d[1])};
  }

  ARENITE_INLINE TwoDerivatives &operator+=(const TwoDerivatives &b) { return *this = *this + b; }
  ARENITE_INLINE TwoDerivatives &operator-=(const TwoDerivatives &b) { return *this = *this - b; }
  ARENITE_INLINE TwoDerivatives &operator*=(const TwoDerivatives &b) { return *this = *this * b; }

  friend TwoDerivatives operator-(const TwoDerivatives &a) { return {-a.value, -a.d[0], -a.d[1]}; }
  friend TwoDerivatives operator+(const TwoDerivatives &a, const TwoDerivatives &b)
  {
    return {a.value + b.value, a.d[0] + b.d[0], a.d[1] + b.d[1]};
  }
  friend TwoDerivatives operator-(const TwoDerivatives &a, const TwoDerivatives &b)
  {
    return {a.value - b.value, a.d[0] - b.d[0], a.d[1] - b.d[1]};
  }
  friend TwoDerivatives operator*(const TwoDerivatives &a, const TwoDerivatives &b)
  {
    return {a.value * b.value, a.d[0] * b.value + a.value * b.d[0], a.d[1] * b.value + a.value * b.d[1]};
  }
  friend TwoDerivatives operator/(const TwoDerivatives &a, const TwoDerivatives &b)
  {
    const V r = V(1.) / b.value, q = a.value * r;
    return {q, (a.d[0] - q * b.d[0]) * r, (a.d[1] - q * b.d[1]) * r};
  }
  friend Mask<V> operator<(const TwoDerivatives &a, const TwoDerivatives &b) { return a.value < b.value; }
  friend Mask<V> operator>(const TwoDerivatives &a, const TwoDerivatives &b) { return a.value > b.value; }
  friend Mask<V> operator<=(const TwoDerivatives &a, const TwoDerivatives &b) { return a.value <= b.value; }
  friend Mask<V> operator>=(const TwoDerivatives &a, const TwoDerivatives &b) { return a.value >= b.value; }
};

template <typename V>
struct NumberFunctions<TwoDerivatives<V>>
{
  using D = TwoDerivatives<V>;
  static V value(const D &a) { return a.value; }
  static D square_root(const D &a)
  {
    const V root = Arenite::square_root<V>(a.value);
    return a.chain(root, V(0.5) / root);
  }
  static D exponential(const D &a)
  {
    const V e = Arenite::exponential<V>(a.value);
    return a.chain(e, e);
  }
  static D exponential_minus_one(const D &a)
  {
    const V e = Arenite::exponential_minus_one<V>(a.value);
    return a.chain(e, e + V(1.));
  }
  static D logarithm(const D &a) { return a.chain(Arenite::logarithm<V>(a.value), V(1.) / a.value); }
  static D power(const D &a, const double n)
  {
    return a.chain(Arenite::power<V>(a.value, n), V(n) * Arenite::power<V>(a.value, n - 1.));
  }
};
} // namespace Arenite
