#pragma once

#include <arenite/materials/bracketed_root.h>
#include <arenite/materials/mie_grueneisen.h>

#include <cmath>
#include <limits>
#include <string>

namespace Arenite
{
/// Porous solid by its distension alpha = rho_solid/rho >= 1 (P-alpha), on a Mie-Grueneisen solid p_s(rho, e):
///
///   p = p_s(alpha rho, e)/alpha
///   crush     alpha_c(p) = 1 + (alpha_e - 1) [(p_c - p)/(p_c - p_e)]^2     p_e < p < p_c,     alpha = 1 above p_c
///   elastic   alpha = alpha_y + (p - p_y) a(alpha_y),   a = alpha_y^2/K_s (1 - 1/h^2),
///             h = 1 + (alpha_y - 1)(c_e - c_0)/(c_0 (alpha_e - 1))
///
/// The history is alpha_y, the smallest distension reached on the crush curve; p_y is the pressure there. h is the ratio of the sound
/// speed to that of the solid: c_e in the soil at rest, c_0 when all pores are closed. Herrmann's differential equation
/// d alpha/dp = a(alpha) is integrated with a at alpha_y, which makes the elastic range reversible; alpha_e is where the elastic line
/// from alpha_0 = rho_s/rho_0 meets p_e. Constants whose crush curve is stiffer than the elastic range are refused: they would
/// create energy. Moist soil: alpha counts the air only, the solid is the mixture of grains and water.
///
/// The pressure of a step solves p alpha(p) - p_s(alpha(p) rho, e(p)) = 0 with the energy balance inside, which increases in p.
/// Source: Herrmann (1969); Carroll and Holt (1972) for the factor 1/alpha.
struct PorousCompaction
{
  static constexpr const char *name        = "porous compaction";
  static constexpr const char *description = "Crushing of pores and shock heating (P-alpha) above about 1 GPa.";
  static constexpr bool        uses_energy = true;

  template <typename Number>
  struct History
  {
    Number distension = Number(1.); ///< alpha_y, smallest on the crush curve
    Number energy     = Number(0.); ///< e [J/kg]
    Number at_limit   = Number(0.); ///< 1 once the solid was compressed beyond the range of its Hugoniot
    template <typename F>
    void for_each(F &&f)
    {
      f("distension", distension);
      f("internal energy", energy);
      f("beyond Hugoniot", at_limit);
    }
  };

  MieGrueneisen solid; ///< its density is rho_s, above that of the soil
  double        density       = std::numeric_limits<double>::quiet_NaN(); ///< rho_0 of the soil [kg/m^3]
  double        elastic_speed = std::numeric_limits<double>::quiet_NaN(); ///< c_e [m/s]
  double        crush_onset   = 1e6;                                      ///< p_e [Pa]
  double        crush_end     = 1e9;                                      ///< p_c [Pa]
  double        tension_limit = 0.;                                       ///< T [Pa]

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  History<double> initial_history() const { return {elastic_limit, 0., 0.}; }
  double          reference_density() const { return density; }

  /// p_y on the crush curve [Pa]
  template <typename Number>
  Number crush_pressure(const Number &alpha) const
  {
    const Number part = Arenite::max<Number>(Number(0.), (alpha - Number(1.)) * Number(1. / (elastic_limit - 1.)));
    return Number(crush_end) - Number(crush_end - crush_onset) * Arenite::square_root<Number>(part);
  }

  /// a(alpha_y) [1/Pa], not positive
  template <typename Number>
  Number elastic_slope(const Number &alpha) const
  {
    const double c_0 = solid.sound_speed;
    const Number h   = Number(1.) + (alpha - Number(1.)) * Number((elastic_speed - c_0) / (c_0 * (elastic_limit - 1.)));
    return alpha * alpha * Number(1. / (solid.density * c_0 * c_0)) * (Number(1.) - Number(1.) / (h * h));
  }

  template <typename Number>
  EquationOfStateResponse<Number> update(const VolumeChange<Number> &change, History<Number> &history) const
  {
    const Number &rho     = change.density, one(1.), thermal(solid.thermal()), limit(-tension_limit), end(crush_end);
    const Number  half_dv = Number(.5) * (one / rho - one / change.density_old);
    const Number  base    = history.energy + change.heat - change.pressure_old * half_dv; // e = base - p half_dv
    const Number  alpha_y = history.distension, p_y = crush_pressure<Number>(alpha_y),
                 a     = elastic_slope<Number>(alpha_y);
    const Number curve = Number((elastic_limit - 1.) / ((crush_end - crush_onset) * (crush_end - crush_onset)));

    // alpha(p) and its slope
    const auto distension = [&](const Number &p) {
      const Number rest    = Arenite::max<Number>(Number(0.), end - p);
      const auto   elastic = p < p_y;
      return ValueAndSlope<Number>{
        Arenite::max<Number>(one, Arenite::select<Number>(elastic, Number(alpha_y + (p - p_y) * a),
                                                          Number(one + curve * rest * rest))),
        Arenite::select<Number>(elastic, a, Number(Number(-2.) * curve * rest))};
    };
    const auto excess = [&](const Number &p) {
      const ValueAndSlope<Number>                alpha = distension(p);
      const MieGrueneisen::template Cold<Number> cold  = solid.template cold<Number>(alpha.value * rho);
      return ValueAndSlope<Number>{p * alpha.value - cold.pressure - thermal * (base - p * half_dv),
                                   alpha.value + p * alpha.slope - cold.slope * rho * alpha.slope + thermal * half_dv};
    };

    // (i) pores closed: linear in p, as in the solid; (ii) tension: the gap opens; (iii) between: the root
    const Number compact = (solid.template cold<Number>(rho).pressure + thermal * base) / (one + thermal * half_dv);
    const auto   closed  = compact >= end;
    const auto   open    = excess(limit).value >= Number(0.) && !closed;
    const auto   between = !closed && !open;
    Number       p       = Arenite::select<Number>(closed, compact, limit);
    if (any_of(between))
      {
        // lanes without a root there have no bracket, cost nothing and are not used
        const Number guess = Arenite::max<Number>(limit, change.pressure_old);
        const Number root  = bracketed_root<Number>(excess, limit, end, guess, Number(1e-9 * crush_onset));
        p                  = Arenite::select<Number>(between, root, p);
      }

    const ValueAndSlope<Number> alpha = distension(p);
    history.energy                    = base - p * half_dv;
    history.distension = Arenite::select<Number>(p > p_y, Arenite::min<Number>(alpha.value, alpha_y), alpha_y);
    history.at_limit =
      Arenite::select<Number>(one - Number(solid.density) / (alpha.value * rho) > Number(solid.largest_chi()), one,
                              history.at_limit);

    // (iv) rho dp/drho at constant entropy on the elastic branch
    const Number slope = elastic_slope<Number>(history.distension);
    const auto   cold  = solid.template cold<Number>(alpha.value * rho);
    const Number stiffness =
      (alpha.value * cold.slope + thermal * p / (rho * rho)) / (alpha.value + slope * (p - rho * cold.slope));
    const Number K = rho * Arenite::max<Number>(stiffness, Number(.01 * elastic_speed * elastic_speed));
    EquationOfStateResponse<Number> response{p, K, history.energy};
    response.bulk_modulus =
      Arenite::select<Number>(open, Arenite::min<Number>(K, rho * Number(elastic_speed * elastic_speed)), K);
    return response;
  }

  double bulk_sound_speed_bound() const { return speed_bound; }

  /// Behind a shock through all of the crushing: one step from rest.
  double hugoniot_pressure(const double rho) const
  {
    History<double> history = initial_history();
    return update(VolumeChange<double>{density, rho, 0., 0.}, history).pressure;
  }

  /// Derived constants and checks; the reason of a refusal, or nothing.
  std::string prepare();

private:
  double      elastic_limit = 1.; ///< alpha_e
  double      speed_bound   = 0.;
  std::string path;
};
} // namespace Arenite
