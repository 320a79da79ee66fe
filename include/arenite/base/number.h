#pragma once

#include <cmath>
#include <experimental/simd>
#include <type_traits>

#define ARENITE_INLINE inline __attribute__((always_inline))

namespace Arenite
{
// One vocabulary for doubles, lanes and differentiable numbers, so that kernels and laws are written once. Nobody else names the
// SIMD library. A condition on a Number is a mask: bool for double, one bool per lane for lanes; select() takes the place of `if`.
//
// The functions below are called as they stand (exponential, power, ...): a plain `exp(x)` would find the lane-by-lane version of
// the SIMD library by argument-dependent look-up.

template <int W>
struct LanesOf
{
  using type = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, W>>;
};
template <>
struct LanesOf<1>
{
  using type = double;
};

/// W doubles that are processed side by side; a plain double for W = 1.
template <int W>
using Lanes = typename LanesOf<W>::type;

/// Lanes of one vector register of the machine that the executable is compiled for.
#if defined(__AVX512F__)
constexpr int native_lanes = 8;
#elif defined(__AVX__)
constexpr int native_lanes = 4;
#elif defined(__SSE2__) || defined(__ARM_NEON)
constexpr int native_lanes = 2;
#else
constexpr int native_lanes = 1;
#endif

template <typename V>
constexpr bool is_lanes = std::experimental::is_simd_v<V>;

/// Lanes of a Number: 1 for double and differentiable numbers.
template <typename V>
constexpr int n_lanes()
{
  if constexpr (is_lanes<V>)
    return V::size();
  else
    return 1;
}

/// Result of comparing two Numbers.
template <typename V>
using Mask = decltype(std::declval<V>() < std::declval<V>());

inline double lane(const double x, const int) { return x; }
template <typename V>
inline double lane(const V &x, const int l)
{
  return x[l];
}
inline bool mask_lane(const bool mask, const int) { return mask; }
template <typename M>
inline bool mask_lane(const M &mask, const int l)
{
  return mask[l];
}
inline void set_lane(double &x, const int, const double value) { x = value; }
template <typename V>
inline void set_lane(V &x, const int l, const double value)
{
  if constexpr (is_lanes<V>)
    x[l] = value;
  else
    x = value;
}

/// The W doubles that begin at @p p, which needs no alignment; and back.
template <typename V>
ARENITE_INLINE V load(const double *p)
{
  if constexpr (is_lanes<V>)
    return V(p, std::experimental::element_aligned);
  else
    return V(*p);
}
template <typename V>
ARENITE_INLINE void store(const V &a, double *p)
{
  if constexpr (is_lanes<V>)
    a.copy_to(p, std::experimental::element_aligned);
  else
    *p = a;
}

/// @p a where @p mask holds, @p b elsewhere.
template <typename V>
ARENITE_INLINE V select(const Mask<V> &mask, const V &a, const V &b)
{
  if constexpr (is_lanes<V>)
    {
      V result                               = b;
      std::experimental::where(mask, result) = a;
      return result;
    }
  else
    return mask ? a : b;
}

ARENITE_INLINE bool any_of(const bool mask) { return mask; }
template <typename M>
ARENITE_INLINE bool any_of(const M &mask)
{
  return std::experimental::any_of(mask);
}

// What the functions below do for a type of number. The primary template serves differentiable numbers, whose functions are found
// by argument-dependent look-up; their derivatives follow the branch that the value takes.
template <typename V, typename = void>
struct NumberFunctions
{
  /// The number without its derivatives.
  static double value(const V &a) { return a.val(); }
  static V      square_root(const V &a) { return sqrt(a); }
  static V      exponential(const V &a) { return exp(a); }
  static V      exponential_minus_one(const V &a)
  {
    // value without cancellation, derivative e^a
    return exp(a) + (std::expm1(value(a)) - std::exp(value(a)));
  }
  static V logarithm(const V &a) { return log(a); }
  static V power(const V &a, const double n) { return pow(a, n); }
};

template <>
struct NumberFunctions<double>
{
  static double value(const double a) { return a; }
  static double square_root(const double a) { return std::sqrt(a); }
  static double exponential(const double a) { return std::exp(a); }
  static double exponential_minus_one(const double a) { return std::expm1(a); }
  static double logarithm(const double a) { return std::log(a); }
  static double power(const double a, const double n) { return std::pow(a, n); }
};

#if defined(__x86_64__) && defined(__GLIBC__) && (defined(__AVX512F__) || defined(__AVX2__))
#  define ARENITE_LIBMVEC
#  if defined(__AVX512F__)
extern "C"
{
  __m512d _ZGVeN8v_exp(__m512d) __attribute__((const));
  __m512d _ZGVeN8v_expm1(__m512d) __attribute__((const));
  __m512d _ZGVeN8v_log(__m512d) __attribute__((const));
  __m512d _ZGVeN8vv_pow(__m512d, __m512d) __attribute__((const));
}
#  endif
extern "C"
{
  __m256d _ZGVdN4v_exp(__m256d) __attribute__((const));
  __m256d _ZGVdN4v_expm1(__m256d) __attribute__((const));
  __m256d _ZGVdN4v_log(__m256d) __attribute__((const));
  __m256d _ZGVdN4vv_pow(__m256d, __m256d) __attribute__((const));
}
#endif

template <typename V>
struct NumberFunctions<V, std::enable_if_t<is_lanes<V>>>
{
  static V value(const V &a) { return a; }
  static V square_root(const V &a) { return std::experimental::sqrt(a); }

  // glibc's vector functions (at most 4 units in the last place) where their registers fit, else lane by lane
  static V exponential(const V &a)
  {
#ifdef ARENITE_LIBMVEC
#  if defined(__AVX512F__)
    if constexpr (V::size() == 8)
      return V(_ZGVeN8v_exp(static_cast<__m512d>(a)));
    else
#  endif
      if constexpr (V::size() == 4)
      return V(_ZGVdN4v_exp(static_cast<__m256d>(a)));
    else
#endif
      return V([&](auto l) { return std::exp(double(a[l])); });
  }
  static V exponential_minus_one(const V &a)
  {
#ifdef ARENITE_LIBMVEC
#  if defined(__AVX512F__)
    if constexpr (V::size() == 8)
      return V(_ZGVeN8v_expm1(static_cast<__m512d>(a)));
    else
#  endif
      if constexpr (V::size() == 4)
      return V(_ZGVdN4v_expm1(static_cast<__m256d>(a)));
    else
#endif
      return V([&](auto l) { return std::expm1(double(a[l])); });
  }
  static V logarithm(const V &a)
  {
#ifdef ARENITE_LIBMVEC
#  if defined(__AVX512F__)
    if constexpr (V::size() == 8)
      return V(_ZGVeN8v_log(static_cast<__m512d>(a)));
    else
#  endif
      if constexpr (V::size() == 4)
      return V(_ZGVdN4v_log(static_cast<__m256d>(a)));
    else
#endif
      return V([&](auto l) { return std::log(double(a[l])); });
  }
  static V power(const V &a, const double n)
  {
#ifdef ARENITE_LIBMVEC
#  if defined(__AVX512F__)
    if constexpr (V::size() == 8)
      return V(_ZGVeN8vv_pow(static_cast<__m512d>(a), static_cast<__m512d>(V(n))));
    else
#  endif
      if constexpr (V::size() == 4)
      return V(_ZGVdN4vv_pow(static_cast<__m256d>(a), static_cast<__m256d>(V(n))));
    else
#endif
      return V([&](auto l) { return std::pow(double(a[l]), n); });
  }
};

/// The number without derivatives: itself for doubles and lanes.
template <typename V>
ARENITE_INLINE auto value_of(const V &a)
{
  return NumberFunctions<V>::value(a);
}
template <typename V>
using Value = decltype(value_of(std::declval<V>()));

template <typename V>
ARENITE_INLINE V square_root(const V &a)
{
  return NumberFunctions<V>::square_root(a);
}
template <typename V>
ARENITE_INLINE V exponential(const V &a)
{
  return NumberFunctions<V>::exponential(a);
}
/// e^a - 1 without cancellation near zero.
template <typename V>
ARENITE_INLINE V exponential_minus_one(const V &a)
{
  return NumberFunctions<V>::exponential_minus_one(a);
}
template <typename V>
ARENITE_INLINE V logarithm(const V &a)
{
  return NumberFunctions<V>::logarithm(a);
}
/// ln(1 + a) without cancellation near zero: ln(u) a/(u - 1) with the rounded u = 1 + a.
template <typename V>
ARENITE_INLINE V logarithm_one_plus(const V &a)
{
  const V u = V(1.) + a, rounded = u - V(1.);
  return Arenite::select<V>(rounded == V(0.), a, V(Arenite::logarithm<V>(u) * (a / rounded)));
}

/// a^n for a >= 0 with the same exponent in all lanes; cheap for n = 0, 1/2, 1, 3/2, 2, 3.
template <typename V>
ARENITE_INLINE V power(const V &a, const double n)
{
  if (n == 0.)
    return V(1.);
  if (n == 0.5)
    return NumberFunctions<V>::square_root(a);
  if (n == 1.)
    return a;
  if (n == 1.5)
    return a * NumberFunctions<V>::square_root(a);
  if (n == 2.)
    return a * a;
  if (n == 3.)
    return a * a * a;
  return NumberFunctions<V>::power(a, n);
}

/// Larger and smaller of two numbers, lane by lane.
template <typename V>
ARENITE_INLINE V max(const V &a, const V &b)
{
  return Arenite::select<V>(a < b, b, a);
}
template <typename V>
ARENITE_INLINE V min(const V &a, const V &b)
{
  return Arenite::select<V>(b < a, b, a);
}
template <typename V>
ARENITE_INLINE V absolute(const V &a)
{
  return Arenite::select<V>(a < V(0.), V(-a), a);
}

/// e^a - 1 - a to full relative accuracy: Taylor's series below 1/2, where the terms cancel.
template <typename V>
ARENITE_INLINE V exponential_remainder(const V &a)
{
  V series(1.);
  for (int k = 15; k > 2; --k)
    series = V(1.) + a * V(1. / k) * series;
  return Arenite::select<V>(Arenite::absolute<V>(a) < V(.5), V(V(.5) * a * a * series),
                            V(Arenite::exponential_minus_one<V>(a) - a));
}
} // namespace Arenite
