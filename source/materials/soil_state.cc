#include <arenite/materials/soil_state.h>

#include <cmath>
#include <sstream>

namespace Arenite
{
double SoilState::locking_strain() const { return -std::log1p(-air_fraction()); }

double SoilState::compacted_modulus() const
{
  const double phi_s = compacted_solid_fraction();
  return 1. / (phi_s / grain_modulus + (1. - phi_s) / water_modulus);
}

double SoilState::compacted_speed() const { return std::sqrt(compacted_modulus() / compacted_density()); }

double SoilState::suspension_modulus() const
{
  return 1. /
         (solid_fraction() / grain_modulus + water_fraction() / water_modulus + air_fraction() / (1.4 * air_pressure));
}

double SoilState::suspension_speed() const { return std::sqrt(suspension_modulus() / density()); }

namespace
{
using Optional = std::optional<double>;

constexpr double tolerance = 1e-3; // 0.1 %, the precision of laboratory values

/// The unknowns on their way from what was measured to (e, w, G_s).
struct Unknowns
{
  double   water_density;
  Optional density, dry_density, water_content, void_ratio, saturation, specific_gravity;

  /// Apply the relations (1.1.9)-(1.1.13) until they say nothing new.
  void propagate()
  {
    const auto fill = [](Optional &unknown, const bool known, const auto &value) {
      if (unknown || !known)
        return false;
      const double x = value();
      if (!std::isfinite(x))
        return false;
      unknown = x;
      return true;
    };
    const double &rho_w = water_density;
    Optional     &rho = density, &rho_d = dry_density, &w = water_content, &e = void_ratio, &S = saturation,
             &Gs = specific_gravity;
    while (fill(w, rho && rho_d, [&]() { return *rho / *rho_d - 1.; }) ||
           fill(rho_d, rho && w, [&]() { return *rho / (1. + *w); }) ||
           fill(rho, rho_d && w, [&]() { return *rho_d * (1. + *w); }) ||
           fill(e, rho_d && Gs, [&]() { return rho_w * *Gs / *rho_d - 1.; }) ||
           fill(rho_d, e && Gs, [&]() { return rho_w * *Gs / (1. + *e); }) ||
           fill(w, S && e && Gs, [&]() { return *S * *e / *Gs; }) ||
           fill(e, S && w && Gs, [&]() { return *S > 0. ? *w * *Gs / *S : NAN; }) ||
           fill(e, rho && S && Gs, [&]() { return (rho_w * *Gs - *rho) / (*rho - rho_w * *S); }) ||
           fill(Gs, rho_d && e, [&]() { return *rho_d * (1. + *e) / rho_w; }) ||
           fill(Gs, w && S && e, [&]() { return *w > 0. ? *S * *e / *w : NAN; }) ||
           fill(Gs, rho && S && e, [&]() { return *rho * (1. + *e) / rho_w - *S * *e; }) ||
           fill(Gs, rho_d && w && S, [&]() { return *S > 0. ? 1. / (rho_w / *rho_d - *w / *S) : NAN; }))
      {}
  }
  bool complete() const { return water_content && void_ratio && specific_gravity; }
};

template <typename... Parts>
[[noreturn]] void refuse(const Parts &...parts)
{
  std::ostringstream text;
  (text << ... << parts);
  throw InputError(text.str());
}
} // namespace

SoilState SoilMeasurements::state() const
{
  // (i) porosity and relative density are other words for the void ratio
  Optional void_ratio_of[3] = {void_ratio, {}, {}};
  if (porosity)
    {
      if (!(*porosity > 0. && *porosity < 1.))
        refuse("the porosity ", *porosity, " is not between 0 and 1. It is a fraction, not per cent.");
      void_ratio_of[1] = *porosity / (1. - *porosity);
    }
  if (relative_density)
    {
      if (!(smallest_void_ratio > 0. && largest_void_ratio > smallest_void_ratio))
        refuse("the relative density needs the smallest and the largest void ratio, 0 < e_min < e_max; they are ",
               smallest_void_ratio, " and ", largest_void_ratio, ".");
      void_ratio_of[2] = largest_void_ratio - *relative_density * (largest_void_ratio - smallest_void_ratio);
    }
  Optional e;
  for (const Optional &value : void_ratio_of)
    if (value && !e)
      e = value;

  // (ii) everything else; G_s has a usual value if nothing determines it
  Unknowns unknowns{water_density, density, dry_density, water_content, e, saturation, specific_gravity};
  unknowns.propagate();
  if (!unknowns.complete() && !unknowns.specific_gravity)
    {
      unknowns.specific_gravity = 2.65;
      unknowns.propagate();
    }
  if (!unknowns.complete())
    refuse(
      "the soil is not determined: set two independent quantities, for example the density and the water content, or "
      "the porosity and the saturation.");

  // (iii) possible?
  SoilState result;
  result.void_ratio       = *unknowns.void_ratio;
  result.water_content    = *unknowns.water_content;
  result.specific_gravity = *unknowns.specific_gravity;
  result.water_density    = water_density;
  result.grain_modulus    = grain_modulus;
  result.water_modulus    = water_modulus;
  result.air_pressure     = air_pressure;
  if (!(result.specific_gravity > 1.))
    refuse("the specific gravity of the grains is ", result.specific_gravity, "; it must exceed 1 (soils: 2.5 to 3).");
  if (!(result.void_ratio > 0.))
    refuse("the porosity is ", result.porosity(), " (void ratio ", result.void_ratio,
           "); it must be between 0 and 1. Is the density above that of the grains, ", result.grain_density(),
           " kg/m^3?");
  if (!(result.water_content > -tolerance))
    refuse("the water content is ", result.water_content, "; it cannot be negative. Is the density below the dry one?");
  result.water_content = std::max(result.water_content, 0.);
  if (result.saturation() > 1. + tolerance)
    refuse("the saturation is ", result.saturation(), ": the water does not fit into the voids (void ratio ",
           result.void_ratio, ", water content ", result.water_content, "). It cannot exceed 1.");
  if (result.saturation() > 1.) // by rounding of the input only
    result.water_content = result.void_ratio / result.specific_gravity;

  // (iv) what was given beyond need must agree
  const auto agree = [](const char *name, const Optional &given, const double derived, const double scale) {
    if (given && !(std::abs(*given - derived) <= tolerance * scale))
      refuse("contradiction: ", name, " = ", *given, ", but the other quantities give ", derived,
             ". Leave out what is not needed.");
  };
  agree("density", density, result.density(), result.density());
  agree("dry density", dry_density, result.dry_density(), result.dry_density());
  agree("water content", water_content, result.water_content, 1. + result.water_content);
  agree("void ratio", void_ratio, result.void_ratio, result.void_ratio);
  agree("porosity", porosity, result.porosity(), result.porosity());
  agree("saturation", saturation, result.saturation(), 1.);
  agree("void ratio by the relative density", void_ratio_of[2], result.void_ratio, result.void_ratio);
  agree("specific gravity", specific_gravity, result.specific_gravity, result.specific_gravity);
  return result;
}

void SoilStateEntries::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Soil state");
  path               = parameters.current_path();

  const Range       fraction{0., 1., false, false};
  const std::string two = " Two independent quantities suffice; more must agree.";
  const auto        add = [&](const char *name, double &value, const char *unit, const Range &range,
                       const std::string &sentence) {
    parameters.add_quantity(name, value, unit, range, sentence);
    parameters.leave_out_if_unset(name);
  };
  add("Density", density, "kg/m^3", non_negative, "rho, moist." + two);
  add("Dry density", dry_density, "kg/m^3", non_negative, "rho_d, grains alone." + two);
  add("Water content", water_content, "-", non_negative, "w, mass of water over mass of grains, a fraction." + two);
  add("Void ratio", void_ratio, "-", non_negative, "e, volume of voids over volume of grains." + two);
  add("Porosity", porosity, "-", fraction, "n, volume of voids over total volume." + two);
  add("Saturation", saturation, "-", fraction, "Sr, part of the voids that water fills." + two);
  add("Relative density", relative_density, "-", fraction,
      "Dr = (e_max - e)/(e_max - e_min), a fraction. Needs both void ratios below." + two);
  add("Smallest void ratio", constants.smallest_void_ratio, "-", non_negative, "e_min of the densest packing.");
  add("Largest void ratio", constants.largest_void_ratio, "-", non_negative, "e_max of the loosest packing.");
  add("Specific gravity", specific_gravity, "-", non_negative,
      "Gs, density of the grains over that of water. Without it 2.65, unless other quantities determine it.");
  parameters.add_quantity("Water density", constants.water_density, "kg/m^3", positive, "rho_w.");
  parameters.add_quantity("Grain bulk modulus", constants.grain_modulus, "Pa", positive,
                          "K_s. Stiffens the soil without air; quartz 36e9 to 38e9.");
  parameters.add_quantity("Water bulk modulus", constants.water_modulus, "Pa", positive,
                          "K_w. Stiffens the wet soil without air.");
  parameters.add_quantity("Air pressure", constants.air_pressure, "Pa", positive,
                          "p_a in the pores at rest. Stiffens nearly saturated soil.");
}

bool SoilStateEntries::is_set(const Parameters &parameters) const
{
  for (const char *name : {"Density", "Dry density", "Water content", "Void ratio", "Porosity", "Saturation",
                           "Relative density", "Specific gravity"})
    if (parameters.is_set(path + "/" + name))
      return true;
  return false;
}

SoilState SoilStateEntries::finalize(const Parameters &parameters) const
{
  SoilMeasurements measured = constants;
  const auto       take     = [&](const char *name, const double value, std::optional<double> &target) {
    if (parameters.is_set(path + "/" + name))
      target = value;
  };
  take("Density", density, measured.density);
  take("Dry density", dry_density, measured.dry_density);
  take("Water content", water_content, measured.water_content);
  take("Void ratio", void_ratio, measured.void_ratio);
  take("Porosity", porosity, measured.porosity);
  take("Saturation", saturation, measured.saturation);
  take("Relative density", relative_density, measured.relative_density);
  take("Specific gravity", specific_gravity, measured.specific_gravity);
  try
    {
      return measured.state();
    }
  catch (const InputError &reason)
    {
      parameters.refuse(path, reason.what());
    }
}

double SoilStateEntries::density_of_block(const Parameters &parameters, const double entry) const
{
  const double      density = finalize(parameters).density();
  const std::string name    = path.substr(0, path.rfind('/')) + "/Density";
  if (parameters.is_set(name) && std::abs(entry - density) > tolerance * density)
    {
      std::ostringstream reason;
      reason << "contradicts 'subsection Soil state', which gives " << density << " kg/m^3; leave one of them out";
      parameters.refuse(name, reason.str());
    }
  return density;
}
} // namespace Arenite
