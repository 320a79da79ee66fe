#include <arenite/materials/viscoelastic.h>

namespace Arenite
{
void Viscoelastic::declare_parameters(Parameters &parameters)
{
  constants.declare_parameters(parameters);
  parameters.add_choice(
    "Model", model_name, {"Maxwell", "Kelvin-Voigt", "standard linear solid"},
    "Maxwell flows for ever, Kelvin-Voigt creeps to the spring, the standard linear solid does both.");
  parameters.add_quantity(
    "Relaxation time", relaxation_time, "s", positive,
    "tau. Larger: the branch holds its stress longer; Kelvin-Voigt: more damping and smaller steps.");
  parameters.add_quantity(
    "Branch ratio", branch_ratio, "-", positive,
    "Standard linear solid: stiffness of the branch over that of the spring. Larger: stiffer at first.");
}

void Viscoelastic::finalize(const Parameters &parameters)
{
  spring = constants.finalize(parameters);
  model =
    model_name == "Maxwell" ? Model::maxwell : (model_name == "Kelvin-Voigt" ? Model::kelvin_voigt : Model::standard);
}

static_assert(IsMaterialLaw<Viscoelastic>::value);
static_assert(IsMaterialLaw<Viscoelastic, Lanes<native_lanes>>::value);
} // namespace Arenite
