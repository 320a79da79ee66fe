#pragma once

#include <arenite/materials/elastic_constants.h>
#include <arenite/materials/material_law.h>

#include <cmath>

namespace Arenite
{
/// Compressible neo-Hookean solid, hyperelastic: per reference volume and with b = F F^T, J = det F,
///
///   W = mu/2 (tr b - 3 - 2 ln J) + lambda/2 (ln J)^2,      J sigma = mu (b - I) + lambda ln J I
///
/// b follows the steps, b_{n+1} = exp(d eps) b_n exp(d eps) in the frame that turns with the point: exact for a stretch without rotation, of
/// second order otherwise. A closed cycle leaves nothing, unlike that of moduli of the Cauchy stress. Small strains are those of linear
/// elasticity. Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (1997), section 5.4.
///
/// No disturbance is faster than c^2 = (lambda (1 - ln J) + mu (2 + |b - I|))/rho_0: of the acoustic tensor, with b_nn <= 1 + |b - I|.
struct NeoHookean
{
  static constexpr const char *name           = "neo hookean";
  static constexpr const char *description    = "Hyperelastic solid for large elastic strains.";
  static constexpr int         tensor_history = 0;

  template <typename Number>
  struct History
  {
    SymTensor<Number> stretch; ///< b - I

    template <typename F>
    void for_each(F &&f)
    {
      constexpr const char *names[] = {"stretch b-I xx", "stretch b-I yy", "stretch b-I zz",
                                       "stretch b-I xy", "stretch b-I xz", "stretch b-I yz"};
      for (int k = 0; k < 6; ++k)
        f(names[k], stretch[k]);
    }
  };

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  double          density() const { return elastic.density; }
  History<double> initial_history() const { return {}; }

  /// Up to logarithmic strains of `Largest strain`.
  double wave_speed_bound() const
  {
    const double most = std::sqrt(3.) * std::expm1(2. * largest_strain);
    return std::sqrt((elastic.lame_lambda() * (1. + 3. * largest_strain) + elastic.shear_modulus * (2. + most)) /
                     elastic.density);
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    // exp(d eps) - I = (exp(tr/3) - 1) I + exp(tr/3) Z, Z the series of the deviator
    const SymTensor<Number> e = deviator(increment.strain);
    SymTensor<Number>       Z = e, power = e;
    for (int k = 2; k < 9; ++k)
      {
        power = product(power, e) * Number(1. / k);
        Z += power;
      }
    const Number m = trace(increment.strain) * Number(1. / 3.), g = m + exponential_remainder(m); // exp(m) - 1
    const SymTensor<Number> X = Z * Number(g + Number(1.)) + spherical(g);                        // exp(d eps) - I
    // b' - I = (2 X + X X) + h + X h + h X + X h X
    const SymTensor<Number> &h = history.stretch;
    history.stretch            = X * Number(2.) + product(X, X) + h + symmetric_twice(X, h) + congruent(X, h);

    const double lambda = elastic.lame_lambda(), mu = elastic.shear_modulus;
    const Number J     = Number(elastic.density) / increment.density,
                 log_J = logarithm_one_plus(Number((Number(elastic.density) - increment.density) / increment.density)),
                 per_J = Number(1.) / J;
    Response<Number> response;
    response.stress = (history.stretch * Number(mu) + spherical(Number(Number(lambda) * log_J))) * per_J;
    response.stored =
      (Number(mu) * shape_energy(history.stretch, log_J) + Number(0.5 * lambda) * log_J * log_J) * per_J;
    const Number size   = square_root(Number(contract(history.stretch, history.stretch) + Number(1e-60)));
    response.wave_speed = square_root(Number(
      (Number(lambda) * (Number(1.) - log_J) + Number(mu) * (Number(2.) + size)) * Number(1. / elastic.density)));
    return response;
  }

  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &) const
  {}

  template <typename F>
  void for_each_constant(F &&f) const
  {
    elastic.for_each_constant(f);
    constants.for_each_constant(f);
  }

  ElasticConstants constants;
  LinearElastic    elastic;
  double           largest_strain = 0.5; ///< end of the valid range, logarithmic

private:
  /// (tr h - 2 ln J)/2 with h = b - I. Its terms cancel in small strains: there the series of (tr h - ln det(I + h))/2, whose first
  /// term that is left out is |h|^9.
  template <typename Number>
  static Number shape_energy(const SymTensor<Number> &h, const Number &log_J)
  {
    const SymTensor<Number> h2 = product(h, h), h3 = product(h2, h), h4 = product(h2, h2);
    const Number series = Number(1. / 2.) * trace(h2) - Number(1. / 3.) * trace(h3) + Number(1. / 4.) * trace(h4) -
                          Number(1. / 5.) * contract(h2, h3) + Number(1. / 6.) * contract(h3, h3) -
                          Number(1. / 7.) * contract(h3, h4) + Number(1. / 8.) * contract(h4, h4);
    return Number(0.5) *
           Arenite::select<Number>(trace(h2) < Number(1e-4), series, Number(trace(h) - Number(2.) * log_J));
  }

  template <typename Number>
  using Matrix = Number[3][3];

  template <typename Number>
  static ARENITE_INLINE void unfold(const SymTensor<Number> &a, Matrix<Number> &m)
  {
    m[0][0] = a[0], m[1][1] = a[1], m[2][2] = a[2];
    m[0][1] = m[1][0] = a[3], m[0][2] = m[2][0] = a[4], m[1][2] = m[2][1] = a[5];
  }

  /// a b of two that commute, hence symmetric.
  template <typename Number>
  static ARENITE_INLINE SymTensor<Number> product(const SymTensor<Number> &a, const SymTensor<Number> &b)
  {
    return symmetric_twice(a, b) * Number(0.5);
  }

  /// a b + b a
  template <typename Number>
  static ARENITE_INLINE SymTensor<Number> symmetric_twice(const SymTensor<Number> &a, const SymTensor<Number> &b)
  {
    Matrix<Number> A, B;
    unfold(a, A);
    unfold(b, B);
    SymTensor<Number> c;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        {
          Number sum = A[i][0] * B[0][j] + B[i][0] * A[0][j];
          for (int k = 1; k < 3; ++k)
            sum += A[i][k] * B[k][j] + B[i][k] * A[k][j];
          c[i == j ? i : 2 + i + j] = sum;
        }
    return c;
  }

  /// a b a
  template <typename Number>
  static ARENITE_INLINE SymTensor<Number> congruent(const SymTensor<Number> &a, const SymTensor<Number> &b)
  {
    Matrix<Number> A, B, AB;
    unfold(a, A);
    unfold(b, B);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        AB[i][j] = A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
    SymTensor<Number> c;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        c[i == j ? i : 2 + i + j] = AB[i][0] * A[0][j] + AB[i][1] * A[1][j] + AB[i][2] * A[2][j];
    return c;
  }
};
} // namespace Arenite
