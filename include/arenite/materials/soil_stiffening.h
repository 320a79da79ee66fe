#pragma once

#include <arenite/materials/equation_of_state.h>
#include <arenite/materials/soil_state.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace Arenite
{
/// Elastic stiffening of a soil whose air closes: the bulk modulus grows from that of the loose skeleton, K_0, to that of grains
/// and water, K_wg, with the largest density rho_m that the point has reached, and further as in a compressed solid:
///
///   x = (rho_m - rho_0)/(rho_L - rho_0),    K = K_0 + (K_wg - K_0) x^m           rho_m < rho_L,   m = 1, 2, 3, 4
///                                           K = K_wg (rho_m/rho_L)^K'            beyond           (Murnaghan)
///   first loading   p = P(rho) = int_{rho_0}^{rho} K drho/rho,    unloading, reloading   p = P(rho_m) + K(rho_m) ln(rho/rho_m)
///
/// rho_m and not rho: a modulus that followed the density both ways would, with a shear modulus in proportion, return more energy
/// in a cycle of compression and shear than it received. Since rho_m only grows, the dissipation
/// p^2 K_dot/(2 K^2) + J2 G_dot/(2 G^2) is never negative.
///
/// A saturated soil (rho_L = rho_0) has K_wg from the start. Roger (2015), section 2.3.1, names elastic stiffening without
/// giving the relation in the parts that we have; this one is ours. Murnaghan (1944) for the solid, K' = 4 to 7.
struct SoilStiffening
{
  static constexpr const char *name = "soil stiffening";
  static constexpr const char *description =
    "Soil that stiffens irreversibly while its air closes, up to grains and water.";
  static constexpr bool uses_energy = false;

  template <typename Number>
  struct History
  {
    Number density_max = Number(0.); ///< rho_m [kg/m^3]
    template <typename F>
    void for_each(F &&f)
    {
      f("largest density", density_max);
    }
  };

  double       density              = 0.;                                       ///< rho_0 [kg/m^3]
  double       compacted_density    = 0.;                                       ///< rho_L [kg/m^3]
  double       bulk_modulus         = std::numeric_limits<double>::quiet_NaN(); ///< K_0 [Pa]
  double       compacted_modulus    = 0.;                                       ///< K_wg [Pa]
  unsigned int exponent             = 3;                                        ///< m
  double       compacted_stiffening = 5.;                                       ///< K'
  double       tension_limit        = 0.;                                       ///< p >= -T [Pa]
  double       largest_pressure     = 1e10;                                     ///< end of the valid range [Pa]

  void declare_parameters(Parameters &);

  /// Takes densities and K_wg from `subsection Soil state` where they are not set; refuses K_0 > K_wg and rho_L < rho_0.
  void finalize(const Parameters &);

  History<double> initial_history() const { return {density}; }
  double          reference_density() const { return density; }
  bool            porous() const { return compacted_density > density; }

  /// After finalize(): the soil, if `subsection Soil state` describes it.
  const std::optional<SoilState> &soil_state() const { return state; }

  /// K(rho_m) of unloading and of the next bit of first loading [Pa].
  template <typename Number>
  Number modulus(const Number &density_max) const
  {
    const Number beyond =
      Number(compacted_modulus) *
      Arenite::power<Number>(Arenite::max<Number>(Number(1.), density_max * Number(1. / compacted_density)),
                             compacted_stiffening);
    if (!porous())
      return beyond;
    const Number x =
      Arenite::min<Number>(Number(1.), Arenite::max<Number>(Number(0.), (density_max - Number(density)) *
                                                                          Number(1. / (compacted_density - density))));
    const Number before = Number(bulk_modulus) + Number(compacted_modulus - bulk_modulus) * raised(x, exponent);
    return Arenite::select<Number>(x < Number(1.), before, beyond);
  }

  /// P(rho) of first loading [Pa]; K ln(rho/rho_0) with the modulus at rest below rho_0.
  ///
  ///   P = K_0 ln q + (K_wg - K_0)/D^m P_m(q),   q = rho/rho_0, D = rho_L/rho_0 - 1,
  ///   P_m = int_1^q (y-1)^m/y dy = (-1)^m ln q + sum_{i=1}^m (-1)^(m-i) (q-1)^i/i
  ///
  /// near q = 1 by the series sum_j (-1)^j (q-1)^(m+1+j)/(m+1+j), because the terms of P_m cancel there.
  template <typename Number>
  Number first_loading(const Number &rho) const
  {
    Number pressure(0.);
    if (porous())
      {
        const Number mu =
          (Arenite::min<Number>(rho, Number(compacted_density)) - Number(density)) * Number(1. / density);
        const Number y = Arenite::max<Number>(Number(0.), mu), log_q = Arenite::logarithm_one_plus<Number>(mu);
        const int    m      = exponent;
        Number       closed = Number(m % 2 ? -1. : 1.) * log_q, series(0.), power_of_y = y;
        for (int i = 1; i <= m; ++i)
          {
            closed     = closed + Number(((m - i) % 2 ? -1. : 1.) / i) * power_of_y;
            power_of_y = power_of_y * y;
          }
        for (int j = 12; j >= 0; --j) // Horner; y < 0.1: the next term is below 1e-13 of the first
          series = Number(1. / (m + 1. + j)) - y * series;
        const Number P_m = Arenite::select<Number>(y < Number(0.1), Number(series * power_of_y), closed);
        const double D   = compacted_density / density - 1.;
        pressure         = Number(bulk_modulus) * log_q + Number((compacted_modulus - bulk_modulus) / std::pow(D, m)) *
                                                    Arenite::select<Number>(y > Number(0.), P_m, Number(0.));
      }
    const Number ratio = rho * Number(1. / compacted_density), above = Arenite::max<Number>(Number(1.), ratio);
    pressure = pressure + solid(above);
    if (!porous()) // below rho_0 the modulus stays K_wg
      pressure =
        pressure + Number(compacted_modulus) * Arenite::logarithm<Number>(Arenite::min<Number>(Number(1.), ratio));
    return pressure;
  }

  /// The constant modulus of one step, for a law that integrates the step with constant elasticity [Pa]:
  ///
  ///   K = [ p(rho_{n+1}) - p(rho_n) ] / ln(rho_{n+1}/rho_n)    on first loading,     K(rho_m) otherwise
  ///
  /// the mean of K over the logarithm of density, so that a purely elastic compression is exact for any step. The difference
  /// of pressures loses its digits in small steps; the mean is therefore integrated by Gauss' rule (three points on each side
  /// of rho_L; exact to 1e-10 up to 5 % compression). @p density_max is rho_m at t_n; the caller takes the larger of it and rho_{n+1}.
  template <typename Number>
  Number stiffness(const Number &density_old, const Number &rho, const Number &density_max) const
  {
    const Number K_m   = modulus<Number>(density_max);
    const auto   loads = rho > density_max;
    if (!any_of(loads))
      return K_m;

    // reloading up to rho_m with K_m, then first loading in one piece on each side of rho_L
    const Number start = Arenite::min<Number>(density_old, density_max),
                 end   = Arenite::select<Number>(loads, rho, density_max);
    const Number lock(std::max(compacted_density, density));
    const Number reload = Arenite::select<Number>(start < density_max, K_m * log_ratio(start, density_max), Number(0.));
    Number       sum    = reload;
    if (any_of(density_max < lock))
      sum = sum + gauss(Arenite::min<Number>(density_max, lock), Arenite::min<Number>(end, lock));
    if (any_of(end > lock))
      sum = sum + gauss(Arenite::max<Number>(density_max, lock), Arenite::max<Number>(end, lock));
    const Number total = log_ratio(start, end);
    return Arenite::select<Number>(loads && total > Number(0.), Number(sum / total), K_m);
  }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, History<Number> &history) const
  {
    const Number density_max = history.density_max;
    history.density_max      = Arenite::max<Number>(history.density_max, change.density);
    const Number K_m = modulus<Number>(history.density_max), p_m = first_loading<Number>(history.density_max);

    // the branch is a spring of length rho_z without pressure
    const Number                    from_max = log_ratio(history.density_max, change.density);
    const Number                    strain   = from_max + p_m / K_m; // ln(rho/rho_z)
    const Number                    strain_t = Number(-tension_limit) / K_m;
    const Number                    rho_t    = change.density * Arenite::exponential<Number>(strain_t - strain);
    EquationOfStateResponse<Number> response{p_m + K_m * from_max, K_m,
                                             logarithmic_energy<Number>(K_m, Arenite::max<Number>(strain, strain_t),
                                                                        Arenite::max<Number>(change.density, rho_t))};
    limit_tension<Number>(response, tension_limit, change.density,
                          Number(-Arenite::exponential_minus_one<Number>(strain - strain_t)), Number(K_m / rho_t));
    if (any_of(history.density_max > density_max))
      {
        const Number K_n    = modulus<Number>(density_max);
        response.dissipated = Number(.5) * (K_m - K_n) *
                              (loss<Number>(p_m / K_m, history.density_max) +
                               loss<Number>(first_loading<Number>(density_max) / K_n, density_max));
      }
    return response;
  }

  /// At the largest pressure on first loading, or at the end of tension after it.
  double bulk_sound_speed_bound() const { return speed_bound; }
  double hugoniot_pressure(const double rho) const { return first_loading<double>(rho); }

  /// Derived constants and checks; the reason of a refusal, or nothing. finalize() calls it; so do programs that set the members.
  std::string prepare();

private:
  double                   speed_bound = 0.;
  SoilStateEntries         soil;
  std::optional<SoilState> state;
  std::string              path;

  template <typename Number>
  static Number raised(const Number &x, const unsigned int m)
  {
    const Number square = x * x;
    return m == 1 ? x : m == 2 ? square : m == 3 ? Number(square * x) : Number(square * square);
  }

  /// What stiffening takes from the spring of the branch, per mass and growth of K: with l = P(rho_m)/K(rho_m)
  ///
  ///   dD/dK = (1 + (l - 1) e^l)/rho_m = l^2/(2 rho_m) + ...                                        [J/(kg Pa)], not negative
  ///
  /// from dD = P drho/rho^2 - d[K (e^l - 1 - l)/rho] along first loading. A step takes the mean of both ends: second order.
  template <typename Number>
  static Number loss(const Number &l, const Number &density_max)
  {
    // l e^l - (e^l - 1) = l (e^l - 1 - l) + l^2 - (e^l - 1 - l)
    const Number remainder = Arenite::exponential_remainder<Number>(l);
    return (l * remainder + l * l - remainder) / density_max;
  }

  /// (K_wg/K') (r^K' - 1)
  template <typename Number>
  Number solid(const Number &r) const
  {
    return Number(compacted_modulus / compacted_stiffening) *
           (Arenite::power<Number>(r, compacted_stiffening) - Number(1.));
  }

  /// ln(b/a) to full relative accuracy for b near a.
  template <typename Number>
  static Number log_ratio(const Number &a, const Number &b)
  {
    const Number u = (b - a) / a;
    Number       series(0.);
    for (int j = 6; j >= 0; --j)
      series = Number(1. / (j + 1.)) - u * series;
    return Arenite::select<Number>(Arenite::absolute<Number>(u) < Number(1e-2), Number(u * series),
                                   Arenite::logarithm<Number>(b / a));
  }

  /// int_a^b K(rho) drho/rho with K smooth between a and b.
  template <typename Number>
  Number gauss(const Number &a, const Number &b) const
  {
    const Number middle = Number(.5) * (a + b), half = Number(.5) * (b - a),
                 offset = half * Number(0.77459666924148338);
    const Number left = middle - offset, right = middle + offset;
    return half * (Number(5. / 9.) * (modulus<Number>(left) / left + modulus<Number>(right) / right) +
                   Number(8. / 9.) * modulus<Number>(middle) / middle);
  }
};
} // namespace Arenite
