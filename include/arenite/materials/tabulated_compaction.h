#pragma once

#include <arenite/materials/equation_of_state.h>

#include <deal.II/base/point.h>

#include <limits>
#include <string>
#include <vector>

namespace Arenite
{
/// Measured compaction curve with unloading that depends on the density:
///
///   first loading           p = p_c(rho), linear between the rows, c(rho)^2 drho beyond the last one
///   unloading, reloading    p = p_c(rho_m) - int_rho^{rho_m} c(r)^2 dr,    p >= -T
///
/// with the largest density rho_m of the point and the bulk sound speed c(rho) of unloading, linear between its rows and constant
/// outside. Refused: rows that do not increase; a loading slope above c^2, which would return more energy than was spent.
///
/// Form of the tables: Laine and Sandvik (2001), dry sand.
struct TabulatedCompaction
{
  static constexpr const char *name = "tabulated compaction";
  static constexpr const char *description =
    "Measured pressure against density, with stiffer unloading; dry and moist soils without shock heating.";
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

  std::vector<dealii::Point<2>> loading;            ///< rows (rho [kg/m^3], p_c [Pa]); the first has p_c = 0
  std::vector<dealii::Point<2>> unloading;          ///< rows (rho [kg/m^3], c [m/s])
  double                        tension_limit = 0.; ///< T [Pa]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  History<double> initial_history() const { return {reference_density()}; }
  double          reference_density() const { return loading.front()[0]; }

  /// p_c(rho) [Pa]
  template <typename Number>
  Number first_loading(const Number &rho) const
  {
    Number p = Number(segments.front().slope) * (rho - Number(segments.front().density));
    for (const Segment &segment : segments)
      p = Arenite::select<Number>(rho > Number(segment.density),
                                  Number(Number(segment.pressure) +
                                         Number(segment.slope) * (rho - Number(segment.density))),
                                  p);
    const Number end(loading.back()[0]);
    return Arenite::select<Number>(
      rho > end, Number(Number(loading.back()[1]) + stiff_pressure<Number>(rho) - stiff_pressure<Number>(end)), p);
  }

  /// c(rho) of unloading [m/s]
  template <typename Number>
  Number sound_speed(const Number &rho) const
  {
    Number c(unloading.front()[1]);
    for (const Segment &segment : speeds)
      c = Arenite::select<Number>(rho > Number(segment.density),
                                  Number(Number(segment.pressure) +
                                         Number(segment.slope) * (rho - Number(segment.density))),
                                  c);
    return c;
  }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, History<Number> &history) const
  {
    const Number density_max = history.density_max;
    history.density_max      = Arenite::max<Number>(density_max, change.density);
    const Number        &rho = change.density, &rho_m = history.density_max;
    const Branch<Number> branch = unloading_branch<Number>(rho_m);
    const Number rho_t = density_of<Number>(Number(-tension_limit) - branch.shift), c = sound_speed<Number>(rho),
                 c_t = sound_speed<Number>(rho_t);
    EquationOfStateResponse<Number> response{branch.shift + stiff_pressure<Number>(rho), rho * c * c,
                                             elastic_energy<Number>(branch.relaxed, Arenite::max<Number>(rho, rho_t))};
    limit_tension<Number>(response, tension_limit, rho, Number((rho_t - rho) / rho_t), Number(c_t * c_t));

    // dD = (c^2 - dp_c/drho) (1/rho_z - 1/rho_m) drho_m = -(1/rho_z - 1/rho_m) dshift, not negative; the mean of both ends
    if (any_of(rho_m > density_max))
      {
        const Branch<Number> before = unloading_branch<Number>(density_max);
        const Number         one(1.);
        response.dissipated = Number(.5) * (before.shift - branch.shift) *
                              (one / before.relaxed - one / density_max + one / branch.relaxed - one / rho_m);
      }
    return response;
  }

  double bulk_sound_speed_bound() const { return speed_bound; }
  double hugoniot_pressure(const double rho) const { return first_loading<double>(rho); }

  /// Derived constants and checks; the reason of a refusal, or nothing.
  std::string prepare();

private:
  struct Segment
  {
    double density, pressure, slope,
      integral; ///< value (pressure or speed) and slope from `density` on; int c^2 up to there
  };
  std::vector<Segment> segments, speeds;
  double               speed_bound = 0.;
  std::string          path;

  /// int c^2 drho from the first row of the speeds: in a segment, with y = rho - rho_j, c_j^2 y + c_j c' y^2 + c'^2 y^3/3.
  template <typename Number>
  Number stiff_pressure(const Number &rho) const
  {
    const double c0       = unloading.front()[1];
    Number       integral = Number(c0 * c0) * (rho - Number(unloading.front()[0]));
    for (const Segment &segment : speeds)
      {
        const Number y = rho - Number(segment.density), c(segment.pressure), d(segment.slope);
        integral       = Arenite::select<Number>(y > Number(0.),
                                           Number(Number(segment.integral) +
                                                        y * (c * c + y * (c * d + y * d * d * Number(1. / 3.)))),
                                           integral);
      }
    return integral;
  }

  /// The density where that integral is @p pressure: with w the rest beyond a row, c^3 = c_j^3 + 3 c' w and
  /// y = 3 w/(c^2 + c c_j + c_j^2), which holds for c' = 0, too.
  template <typename Number>
  Number density_of(const Number &pressure) const
  {
    Number rho(unloading.front()[0]), w = pressure, c(unloading.front()[1]), d(0.);
    for (const Segment &segment : speeds)
      {
        const auto beyond = pressure > Number(segment.integral);
        rho               = Arenite::select<Number>(beyond, Number(segment.density), rho);
        w                 = Arenite::select<Number>(beyond, Number(pressure - Number(segment.integral)), w);
        c                 = Arenite::select<Number>(beyond, Number(segment.pressure), c);
        d                 = Arenite::select<Number>(beyond, Number(segment.slope), d);
      }
    const Number there = Arenite::power<Number>(c * c * c + Number(3.) * d * w, 1. / 3.);
    return rho + Number(3.) * w / (there * there + there * c + c * c);
  }

  /// Unloading from rho_m: p = shift + int c^2 drho, without pressure at the density `relaxed`.
  template <typename Number>
  struct Branch
  {
    Number shift, relaxed;
  };
  template <typename Number>
  Branch<Number> unloading_branch(const Number &density_max) const
  {
    const Number shift = first_loading<Number>(density_max) - stiff_pressure<Number>(density_max);
    return {shift, density_of<Number>(Number(-shift))};
  }

  /// int_{rho_z}^{rho} p dr/r^2 = int_{rho_z}^{rho} c^2 (1/r - 1/rho) dr on one branch [J/kg], by Gauss' rule with three points in each
  /// segment: relative error 1e-9 in a segment of 20 % of density.
  template <typename Number>
  Number elastic_energy(const Number &relaxed, const Number &rho) const
  {
    Number sum(0.);
    for (std::size_t j = 0; j <= speeds.size(); ++j)
      {
        const double lower = j == 0 ? 0. : speeds[j - 1].density, slope = j == 0 ? 0. : speeds[j - 1].slope,
                     speed = speeds[j == 0 ? 0 : j - 1].pressure,
                     upper = j == speeds.size() ? std::numeric_limits<double>::max() : speeds[j].density;
        const auto inside  = [&](const Number &x) {
          return Arenite::min<Number>(Arenite::max<Number>(x, Number(lower)), Number(upper));
        };
        const Number a = inside(relaxed), b = inside(rho), middle = Number(.5) * (a + b), half = Number(.5) * (b - a);
        if (!any_of(Arenite::absolute<Number>(half) > Number(0.)))
          continue;
        const auto integrand = [&](const double x) {
          const Number r = middle + Number(x) * half, c = Number(speed) + Number(slope) * (r - Number(lower));
          return c * c * (rho - r) / (r * rho);
        };
        const double x = 0.77459666924148338;
        sum = sum + half * (Number(5. / 9.) * (integrand(-x) + integrand(x)) + Number(8. / 9.) * integrand(0.));
      }
    return sum;
  }
};
} // namespace Arenite
