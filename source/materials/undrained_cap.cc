#include <arenite/materials/undrained_cap.h>

#include <sstream>

namespace Arenite
{
void UndrainedCap::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  skeleton.declare_parameters(parameters);
  pores.declare_phases(parameters);
  parameters.add_quantity("Pore tension limit", pores.tension_limit, "Pa", non_negative,
                          "Tension that water and air carry below their pressure at rest; then they cavitate. With air "
                          "below the air pressure.");
}

void UndrainedCap::finalize(const Parameters &parameters)
{
  skeleton.finalize(parameters);
  const auto &state = skeleton.stiffness.constants.soil_state();
  if (!state)
    parameters.refuse(path,
                      "needs 'subsection Soil state', for example with Porosity and Saturation: the pore pressure "
                      "follows from what fills the pores");
  const double all_pores = std::log1p(state->void_ratio);
  if (skeleton.surface.hardening_limit > all_pores)
    {
      std::ostringstream reason;
      reason << "is more than all pores, a volume strain of ln(1 + e) = " << all_pores
             << " with the void ratio e = " << state->void_ratio;
      parameters.refuse(path + "/Hardening limit W", reason.str());
    }
  pores.set(*state);
  if (const std::string reason = pores.prepare(); !reason.empty())
    parameters.refuse(path, reason);
}

double UndrainedCap::undrained_modulus() const
{
  return skeleton.stiffness.elastic.bulk_modulus + skeleton.stiffness.constants.soil_state()->suspension_modulus();
}

static_assert(IsMaterialLaw<UndrainedCap>::value);
static_assert(IsMaterialLaw<UndrainedCap, Lanes<native_lanes>>::value);
} // namespace Arenite
