#pragma once

#include <arenite/base/number.h>

namespace Arenite
{
/// Symmetric tensor of second order in three dimensions. Laws always see three dimensions; reductions embed theirs.
///
/// Components xx, yy, zz, xy, xz, yz: the order of deal.II's SymmetricTensor<2,3> and of the receivers' columns.
template <typename Number>
struct SymTensor
{
  Number v[6] = {Number(0.), Number(0.), Number(0.), Number(0.), Number(0.), Number(0.)};

  Number       &operator[](const int k) { return v[k]; }
  const Number &operator[](const int k) const { return v[k]; }

  ARENITE_INLINE SymTensor &operator+=(const SymTensor &b)
  {
    for (int k = 0; k < 6; ++k)
      v[k] += b.v[k];
    return *this;
  }
  ARENITE_INLINE SymTensor &operator-=(const SymTensor &b)
  {
    for (int k = 0; k < 6; ++k)
      v[k] -= b.v[k];
    return *this;
  }
  ARENITE_INLINE SymTensor &operator*=(const Number &s)
  {
    for (int k = 0; k < 6; ++k)
      v[k] *= s;
    return *this;
  }
};

template <typename Number>
ARENITE_INLINE SymTensor<Number> operator+(SymTensor<Number> a, const SymTensor<Number> &b)
{
  return a += b;
}
template <typename Number>
ARENITE_INLINE SymTensor<Number> operator-(SymTensor<Number> a, const SymTensor<Number> &b)
{
  return a -= b;
}
template <typename Number>
ARENITE_INLINE SymTensor<Number> operator*(SymTensor<Number> a, const Number &s)
{
  return a *= s;
}

/// p times the identity.
template <typename Number>
ARENITE_INLINE SymTensor<Number> spherical(const Number &p)
{
  SymTensor<Number> result;
  result[0] = result[1] = result[2] = p;
  return result;
}

template <typename Number>
ARENITE_INLINE Number trace(const SymTensor<Number> &a)
{
  return a[0] + a[1] + a[2];
}

/// Mean stress, compression positive: -tr(sigma)/3.
template <typename Number>
ARENITE_INLINE Number pressure(const SymTensor<Number> &stress)
{
  return trace(stress) * Number(-1. / 3.);
}

template <typename Number>
ARENITE_INLINE SymTensor<Number> deviator(SymTensor<Number> a)
{
  const Number mean = trace(a) * Number(1. / 3.);
  for (int k = 0; k < 3; ++k)
    a[k] -= mean;
  return a;
}

/// a : b
template <typename Number>
ARENITE_INLINE Number contract(const SymTensor<Number> &a, const SymTensor<Number> &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + Number(2.) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// J2 = s : s / 2 of a deviator s.
template <typename Number>
ARENITE_INLINE Number second_invariant(const SymTensor<Number> &s)
{
  return Number(0.5) * contract(s, s);
}

/// J3 = det s of a deviator s.
template <typename Number>
ARENITE_INLINE Number third_invariant(const SymTensor<Number> &s)
{
  return s[0] * (s[1] * s[2] - s[5] * s[5]) - s[3] * (s[3] * s[2] - s[5] * s[4]) + s[4] * (s[3] * s[5] - s[1] * s[4]);
}

/// Q a Q^T for a rotation Q.
template <typename Number>
SymTensor<Number> rotate(const SymTensor<Number> &a, const double (&Q)[3][3])
{
  const int         index[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  SymTensor<Number> result;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          result[index[i][j]] += Number(Q[i][k] * Q[j][l]) * a[index[k][l]];
  return result;
}
} // namespace Arenite
