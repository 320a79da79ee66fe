#pragma once

#include <cmath>
#include <experimental/simd>

namespace Arenite
{
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

/// W doubles that are processed side by side; a plain double for W = 1. No kernel and no law names the SIMD library.
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

inline double lane(const double x, const int) { return x; }
template <typename V>
inline double lane(const V &x, const int l)
{
  return x[l];
}

/// Consecutive doubles in memory, one per lane.
inline void load_lanes(const double *from, double &x) { x = *from; }
inline void store_lanes(const double x, double *to) { *to = x; }
template <typename V>
inline void load_lanes(const double *from, V &x)
{
  x.copy_from(from, std::experimental::element_aligned);
}
template <typename V>
inline void store_lanes(const V &x, double *to)
{
  x.copy_to(to, std::experimental::element_aligned);
}

/// Larger of two numbers, lane by lane. Qualified calls only: argument dependent look-up finds slower functions.
inline double max(const double a, const double b) { return a < b ? b : a; }
template <typename V>
inline V max(const V &a, const V &b)
{
  return std::experimental::max(a, b);
}

inline double square_root(const double a) { return std::sqrt(a); }
template <typename V>
inline V square_root(const V &a)
{
  return std::experimental::sqrt(a);
}

#define ARENITE_INLINE inline __attribute__((always_inline))
} // namespace Arenite
