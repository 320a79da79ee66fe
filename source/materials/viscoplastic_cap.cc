#include <arenite/materials/soil_stiffness.h>

#include <cmath>

namespace Arenite
{
template <typename Stiffness>
void ViscoplasticCap<Stiffness>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  stiffness.declare_parameters(parameters);
  surface.declare_cap(parameters, positive, "k = W D (X - X0)/(1 + D (X - X0))");
  if constexpr (Stiffness::changes)
    {
      parameters.add_quantity("Hardening limit W", surface.hardening_limit, "-", {0., 1., false, true},
                              "Largest compactive volume strain; by default that of all air. Larger: absorbs more.");
      parameters.leave_out_if_unset("Hardening limit W");
    }
  else
    surface.declare_hardening_limit(parameters);
  parameters.add_quantity("Tension limit T", surface.tension_limit, "Pa", positive,
                          "Tensile strength on the I1 axis: three times the mean tensile stress. Larger: later spall.");
  parameters.add_flag("Small cap rule", surface.small_cap_rule,
                      "Allow X0 below X_min, with a reduced axis ratio until the cap has grown.");
  parameters.add_choice("Viscosity", viscosity_name, {"Perzyna", "Duvaut-Lions", "none"},
                        "Overstress law; none is the rate-independent cap.");
  parameters.add_quantity("Fluidity eta", fluidity, "1/s", non_negative,
                          "Perzyna: rate of flow at the overstress f0. 0 is elastic; larger: less viscous.");
  parameters.add_quantity("Overstress scale f0", overstress, "Pa", positive,
                          "Perzyna: overstress at which flow has the rate eta. Larger: more viscous.");
  parameters.add_quantity("Overstress exponent N", exponent, "-", {1., 20., false, false},
                          "Perzyna: eta <f/f0>^N. Larger: slower below f0 and faster above.");
  parameters.add_quantity("Relaxation time", relaxation_time, "s", non_negative,
                          "Duvaut-Lions: time in which stress relaxes towards the rate-independent state.");
  parameters.add_quantity("Substep size", substep_size, "-", non_negative,
                          "Strain of a step, over that which crosses the surface, above which the step is divided. "
                          "Smaller: more accurate and slower; 0 never divides.");
  parameters.add_flag("Gap closure", gap_closure,
                      "Volume strain of the tension cut-off must be closed before the soil can be compressed again.");
}

template <typename Stiffness>
void ViscoplasticCap<Stiffness>::finalize(const Parameters &parameters)
{
  stiffness.finalize(parameters);
  viscosity = viscosity_name == "Perzyna" ? Viscosity::perzyna
                                          : (viscosity_name == "none" ? Viscosity::none : Viscosity::duvaut_lions);
  if (const std::string problem =
        stiffness.adopt_hardening_limit(surface.hardening_limit, parameters.is_set(path + "/Hardening limit W"));
      !problem.empty())
    parameters.refuse(path, problem);
  if (const std::string problem = surface.finalize(); !problem.empty())
    parameters.refuse(path, problem);
}

template <typename Stiffness>
std::vector<std::string> ViscoplasticCap<Stiffness>::warnings() const
{
  std::vector<std::string> sentences;
  if (const std::string strength = surface.strength_warning(stiffness.largest_pressure()); !strength.empty())
    sentences.push_back(strength);
  return sentences;
}

template <typename Stiffness>
double ViscoplasticCap<Stiffness>::relaxation_time_at_rest() const
{
  if (viscosity != Viscosity::perzyna || fluidity == 0.)
    return viscosity == Viscosity::duvaut_lions ? relaxation_time : 0.;
  PointIncrement<double> rest;
  rest.density_old = rest.density = density();
  auto         history            = stiffness.initial_history();
  const auto   moduli             = stiffness.moduli(rest, history);
  const double R                  = surface.axis_ratio;
  return overstress / (fluidity * (9. * moduli.K / (R * R) + moduli.G));
}

template struct ViscoplasticCap<ConstantStiffness>;
template struct ViscoplasticCap<SoilStiffness>;
static_assert(IsMaterialLaw<ViscoplasticCap<ConstantStiffness>>::value);
static_assert(IsMaterialLaw<ViscoplasticCap<ConstantStiffness>, Lanes<native_lanes>>::value);
static_assert(IsMaterialLaw<ViscoplasticCap<SoilStiffness>>::value);
static_assert(IsMaterialLaw<ViscoplasticCap<SoilStiffness>, Lanes<native_lanes>>::value);
} // namespace Arenite
