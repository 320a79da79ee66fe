#pragma once

#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/equation_of_state.h>
#include <arenite/materials/soil_state.h>

#include <cmath>
#include <limits>
#include <string>

namespace Arenite
{
/// Nearly saturated soil as air, water and grains under one pressure, without a skeleton:
///
///   V = rho_0/rho = sum_i a_i [ 1 + g_i (p - p_a)/K_i ]^(-1/g_i),     i = air, water, grains,   a_i at p_a,   sum a_i = 1
///   K = V / sum_i (a_i/K_i) [..]^(-1/g_i - 1),    rho c^2 = K;        at p_a Wood's modulus of a suspension
///
/// with absolute p inside; the answer counts pressure from p_a, because bodies at rest carry no stress. K_air = g_air p_a, so that
/// air follows p V^g = const. Reversible. Valid for little air (below about 5 %) and waves faster than drainage.
///
/// V(p) falls, hence one root: Newton's method for ln p, in a bracket. Source: Lyakhov (1964), Henrych (1979).
struct ThreePhaseMixture
{
  static constexpr const char *name = "three phase mixture";
  static constexpr const char *description =
    "Nearly saturated soil as air, water and grains under one pressure; no skeleton.";
  static constexpr bool uses_energy = false;

  template <typename Number>
  using History = NoHistory<Number>;

  double density          = 0.;                           ///< rho_0 [kg/m^3]
  double fraction[3]      = {0., 0., 0.};                 ///< a_i of air, water, grains
  double modulus_of[3]    = {1.4 * 101e3, 2.2e9, 36.6e9}; ///< K_i = rho_i c_i^2 [Pa]
  double exponent[3]      = {1.4, 7., 3.};                ///< g_i
  double air_pressure     = 101e3;                        ///< p_a [Pa], absolute
  double tension_limit    = 0.;                           ///< T [Pa], below p_a where there is air
  double largest_pressure = 1e10;                         ///< end of the valid range [Pa]

  void declare_parameters(Parameters &);
  /// The entries without the soil state and the tension limit.
  void declare_phases(Parameters &);
  /// Refuses a soil without a state, T >= p_a with air, and V(p) that is not defined at -T.
  void finalize(const Parameters &);

  /// Densities, fractions and moduli of a soil.
  void set(const SoilState &);

  NoHistory<double> initial_history() const { return {}; }
  double            reference_density() const { return density; }

  /// Volume of one phase per volume of soil at rest, and its tangent modulus K_i + g_i p.
  template <typename Number>
  struct Phase
  {
    Number volume, modulus;
  };
  template <typename Number>
  Phase<Number> phase_at(const int i, const Number &p) const
  {
    const Number base = Number(1.) + Number(exponent[i] / modulus_of[i]) * p;
    return {Number(fraction[i]) *
              Arenite::exponential<Number>(Number(-1. / exponent[i]) * Arenite::logarithm<Number>(base)),
            base * Number(modulus_of[i])};
  }

  /// V at the pressure p above p_a, and -dV/dp.
  template <typename Number>
  struct Volume
  {
    Number volume, compliance;
  };
  template <typename Number>
  Volume<Number> volume(const Number &p) const
  {
    Volume<Number> result{Number(0.), Number(0.)};
    for (int i = 0; i < 3; ++i)
      if (fraction[i] > 0.)
        {
          const Phase<Number> phase = phase_at<Number>(i, p);
          result.volume             = result.volume + phase.volume;
          result.compliance         = result.compliance + phase.volume / phase.modulus;
        }
    return result;
  }

  /// dK/dp = V V''/V'^2 - 1 at the pressure p above p_a: (1 + g)/(part of air) at rest with little air, some 7 without.
  template <typename Number>
  Number stiffening(const Number &p) const
  {
    Number volume(0.), compliance(0.), fall(0.); // V, -dV/dp, d^2V/dp^2
    for (int i = 0; i < 3; ++i)
      if (fraction[i] > 0.)
        {
          const Phase<Number> phase = phase_at<Number>(i, p);
          const Number        by    = Number(1.) / phase.modulus;
          volume                    = volume + phase.volume;
          compliance                = compliance + phase.volume * by;
          fall                      = fall + Number(1. + exponent[i]) * phase.volume * by * by;
        }
    return volume * fall / (compliance * compliance) - Number(1.);
  }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, NoHistory<Number> &) const
  {
    // (i) V(p) = V in z = ln(p + p_a + T'), between the tension limit and ten times the valid range
    const Number target = Number(density) / change.density, shift(log_shift);
    // a little below the limit: rounded, V of the limit itself may be smaller than the wanted one
    const Number lower(std::log(log_shift - tension_limit) - 1e-9), upper(std::log(log_shift + 10. * largest_pressure));
    const Number open_volume(volume_at_limit);
    const auto   open   = target >= open_volume;
    const Number within = Arenite::select<Number>(open, Number(1.), target); // open lanes solve for rest instead
    const auto   excess = [&](const Number &z) {
      const Number         shifted = Arenite::exponential<Number>(z);
      const Volume<Number> V       = volume<Number>(shifted - shift);
      return ValueAndSlope<Number>{within - V.volume, V.compliance * shifted};
    };
    const Number guess =
      Arenite::logarithm<Number>(Arenite::max<Number>(change.pressure_old, Number(-tension_limit)) + shift);
    const Number z    = bracketed_root<Number>(excess, lower, upper, guess, Number(1e-9));
    const Number root = Arenite::exponential<Number>(z) - shift;
    // a last step in p itself, on 1 - V: neither the logarithm nor the difference of volumes leaves digits where p is small
    const Number strain  = (change.density - Number(density)) / change.density;
    const Number refined = root - (compaction<Number>(root) - strain) / volume<Number>(root).compliance;
    const Number p       = Arenite::select<Number>(open, Number(-tension_limit), refined);

    // (ii) modulus and energy on the curve; while the gap is open those of the limit, with the speed that a closed gap has
    const Volume<Number>            V = volume<Number>(p);
    const Number                    K = V.volume / V.compliance;
    EquationOfStateResponse<Number> response{p, K, stored<Number>(p)};
    const Number                    opened = Number(tension_limit / density) * (target - open_volume);
    response.stored = Arenite::select<Number>(open, Number(response.stored + opened), response.stored);
    response.bulk_modulus =
      Arenite::select<Number>(open, Number(change.density * Number(limit_speed * limit_speed)), K);
    return response;
  }

  double bulk_sound_speed_bound() const { return speed_bound; }

  /// NaN beyond ten times the largest pressure.
  double hugoniot_pressure(const double rho) const
  {
    NoHistory<double> none;
    return update(VolumeChange<double>{density, rho, 0.}, none).pressure;
  }

  /// Derived constants and checks; the reason of a refusal, or nothing.
  std::string prepare();

private:
  double           log_shift = 0., volume_at_limit = 1., limit_speed = 0., speed_bound = 0.;
  SoilStateEntries soil;
  std::string      path;

  /// 1 - V(p) [-], every phase to full relative accuracy.
  template <typename Number>
  Number compaction(const Number &p) const
  {
    Number sum(0.);
    for (int i = 0; i < 3; ++i)
      if (fraction[i] > 0.)
        {
          const Number z =
            Number(-1. / exponent[i]) * Arenite::logarithm_one_plus<Number>(Number(exponent[i] / modulus_of[i]) * p);
          sum = sum - Number(fraction[i]) * (z + Arenite::exponential_remainder<Number>(z));
        }
    return sum;
  }

  /// (1/rho_0) int_0^p p (-dV/dp) dp [J/kg]: with L = ln(1 + g p/K) and R(x) = e^x - 1 - x each phase has
  ///
  ///   a K/g^2 [ g/(g-1) R((1 - 1/g) L) + g R(-L/g) ]
  ///
  /// two positive terms.
  template <typename Number>
  Number stored(const Number &p) const
  {
    Number sum(0.);
    for (int i = 0; i < 3; ++i)
      if (fraction[i] > 0.)
        {
          const double g = exponent[i];
          const Number L = Arenite::logarithm_one_plus<Number>(Number(g / modulus_of[i]) * p);
          sum            = sum + Number(fraction[i] * modulus_of[i] / g) *
                        (Number(1. / (g - 1.)) * Arenite::exponential_remainder<Number>(Number(1. - 1. / g) * L) +
                         Arenite::exponential_remainder<Number>(Number(-1. / g) * L));
        }
    return Number(1. / density) * sum;
  }
};
} // namespace Arenite
