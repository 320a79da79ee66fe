#pragma once

#include <arenite/materials/equation_of_state.h>

#include <deal.II/base/point.h>

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
    history.density_max = Arenite::max<Number>(history.density_max, change.density);
    const Number &rho = change.density, &rho_m = history.density_max;
    const Number  c = sound_speed<Number>(rho), K = rho * c * c;
    Number        p = first_loading<Number>(rho_m) - (stiff_pressure<Number>(rho_m) - stiff_pressure<Number>(rho));
    // where the gap opens, to first order in the excess of tension: enough for the stored energy, which is of second order
    const Number rho_t   = rho * (Number(1.) + Arenite::max<Number>(Number(0.), Number(-tension_limit) - p) / K);
    const Number elastic = Arenite::max<Number>(p, Number(-tension_limit));
    EquationOfStateResponse<Number> response{p, K, Number(.5) * elastic * elastic / (K * rho)};
    limit_tension<Number>(response, tension_limit, rho, rho_t, bulk_sound_speed_bound());
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
};
} // namespace Arenite
