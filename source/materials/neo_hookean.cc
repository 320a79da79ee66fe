#include <arenite/materials/neo_hookean.h>

namespace Arenite
{
void NeoHookean::declare_parameters(Parameters &parameters)
{
  constants.declare_parameters(parameters);
  parameters.add_quantity("Largest strain", largest_strain, "-", {0., 2., true, false},
                          "Logarithmic; end of the valid range, for the bound of the wave speed.");
}

void NeoHookean::finalize(const Parameters &parameters) { elastic = constants.finalize(parameters); }

static_assert(IsMaterialLaw<NeoHookean>::value);
static_assert(IsMaterialLaw<NeoHookean, Lanes<native_lanes>>::value);
} // namespace Arenite
