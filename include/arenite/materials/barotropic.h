#pragma once

#include <arenite/materials/equation_of_state.h>

#include <cmath>
#include <limits>
#include <string>

namespace Arenite
{
/// Constant bulk modulus: p = K ln(rho / rho_0), the volumetric part of linear elasticity in logarithmic strain. Reversible.
struct LinearCompression
{
  static constexpr const char *name = "linear compression";
  static constexpr const char *description =
    "Constant bulk modulus in logarithmic strain; small compressions of solids and fluids.";
  static constexpr bool uses_energy = false;

  template <typename Number>
  using History = NoHistory<Number>;

  double density       = std::numeric_limits<double>::quiet_NaN(); ///< rho_0 [kg/m^3]
  double bulk_modulus  = std::numeric_limits<double>::quiet_NaN(); ///< K [Pa]
  double tension_limit = no_tension_limit;                         ///< p >= -T [Pa]

  void              declare_parameters(Parameters &);
  void              finalize(const Parameters &) const {}
  NoHistory<double> initial_history() const { return {}; }
  double            reference_density() const { return density; }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, NoHistory<Number> &) const
  {
    const Number strain =
      Arenite::logarithm_one_plus<Number>((change.density - Number(density)) * Number(1. / density));
    const double                    limit_strain = -tension_limit / bulk_modulus;
    const Number                    K(bulk_modulus), density_at_limit(density * std::exp(limit_strain));
    const Number                    closed = Arenite::max<Number>(strain, Number(limit_strain));
    EquationOfStateResponse<Number> response{
      K * strain, K, logarithmic_energy<Number>(K, closed, Arenite::max<Number>(change.density, density_at_limit))};
    limit_tension<Number>(response, tension_limit, change.density,
                          Number((density_at_limit - change.density) / density_at_limit), Number(K / density_at_limit));
    return response;
  }

  /// Down to the tension limit, or to an expansion of 10 % if there is none.
  double bulk_sound_speed_bound() const
  {
    return std::sqrt(bulk_modulus / (density * std::exp(std::max(-tension_limit / bulk_modulus, -0.1))));
  }
  double hugoniot_pressure(const double rho) const { return bulk_modulus * std::log(rho / density); }
};

/// Polynomial in mu = rho/rho_0 - 1 without energy:
///
///   p = K1 mu + K2 mu^2 + K3 mu^3   (mu > 0),      p = K_t mu   (mu < 0)      [Pa]
///
/// Reversible. Refused if dp/dmu <= 0 somewhere up to the largest pressure.
struct PolynomialCompression
{
  static constexpr const char *name = "polynomial compression";
  static constexpr const char *description =
    "Pressure as a cubic polynomial of the compression; fits of static or shock data.";
  static constexpr bool uses_energy = false;

  template <typename Number>
  using History = NoHistory<Number>;

  double density          = std::numeric_limits<double>::quiet_NaN(); ///< rho_0 [kg/m^3]
  double K1               = std::numeric_limits<double>::quiet_NaN(); ///< [Pa]
  double K2               = 0.;                                       ///< [Pa]
  double K3               = 0.;                                       ///< [Pa]
  double tension_modulus  = 0.;                                       ///< K_t [Pa]; 0 stands for K1
  double tension_limit    = no_tension_limit;                         ///< p >= -T [Pa]
  double largest_pressure = 1e10;                                     ///< end of the valid range [Pa]

  void              declare_parameters(Parameters &);
  void              finalize(const Parameters &);
  NoHistory<double> initial_history() const { return {}; }
  double            reference_density() const { return density; }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, NoHistory<Number> &) const
  {
    const Number mu  = (change.density - Number(density)) * Number(1. / density);
    const double K_t = tension_modulus > 0. ? tension_modulus : K1;
    const Number a = Number(K1), b = Number(K2), c = Number(K3);
    const auto   compressed = mu > Number(0.);
    const Number ratio      = mu + Number(1.);
    const Number pressure =
      Arenite::select<Number>(compressed, Number(mu * (a + mu * (b + mu * c))), Number(Number(K_t) * mu));
    const Number slope =
      Arenite::select<Number>(compressed, Number(a + mu * (Number(2.) * b + Number(3.) * mu * c)), Number(K_t));
    const Number mu_limit(std::max(-tension_limit / K_t, -0.99)),
      density_at_limit = Number(density) * (Number(1.) + mu_limit);

    EquationOfStateResponse<Number> response{pressure, slope * ratio,
                                             stored<Number>(Arenite::max<Number>(mu, mu_limit), K_t)};
    limit_tension<Number>(response, tension_limit, change.density,
                          Number((density_at_limit - change.density) / density_at_limit), Number(K_t / density));
    return response;
  }

  double bulk_sound_speed_bound() const { return speed_bound; }
  double hugoniot_pressure(const double rho) const
  {
    const double mu = rho / density - 1.;
    return mu * (K1 + mu * (K2 + mu * K3));
  }

private:
  double      speed_bound = 0.;
  std::string path;

  /// int p drho/rho^2 = (1/rho_0) int_0^mu p / (1+y)^2 dy [J/kg], by integrating y^k/(1+y)^2 with L = ln(1+mu):
  ///   k = 1: L - mu/(1+mu),   k = 2: mu + mu/(1+mu) - 2 L,   k = 3: mu^2/2 - 2 mu - mu/(1+mu) + 3 L
  /// and their series near mu = 0, where the terms cancel.
  template <typename Number>
  Number stored(const Number &mu, const double K_t) const
  {
    const Number r = Number(1.) + mu, L = Arenite::logarithm<Number>(r), f = mu / r, two(2.), three(3.);
    const auto   small = Arenite::absolute<Number>(mu) < Number(1e-2);
    const auto   near  = [&mu](const int k) { // sum_j (-1)^j (j+1) mu^(k+1+j)/(k+1+j)
      Number sum(0.), power_of_mu(1.);
      for (int i = 0; i < k + 1; ++i)
        power_of_mu = power_of_mu * mu;
      for (int j = 0; j < 8; ++j)
        {
             sum         = sum + Number((j % 2 ? -1. : 1.) * (j + 1.) / (k + 1. + j)) * power_of_mu;
             power_of_mu = power_of_mu * mu;
        }
      return sum;
    };
    const Number I1 = Arenite::select<Number>(small, near(1), Number(L - f));
    const Number I2 = Arenite::select<Number>(small, near(2), Number(mu + f - two * L));
    const Number I3 = Arenite::select<Number>(small, near(3), Number(Number(.5) * mu * mu - two * mu - f + three * L));
    return Number(1. / density) * Arenite::select<Number>(mu > Number(0.),
                                                          Number(Number(K1) * I1 + Number(K2) * I2 + Number(K3) * I3),
                                                          Number(Number(K_t) * I1));
  }
};
} // namespace Arenite
