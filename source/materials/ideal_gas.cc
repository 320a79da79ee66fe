#include <arenite/materials/ideal_gas.h>

namespace Arenite
{
void IdealGas::declare_parameters(Parameters &parameters)
{
  parameters.add_quantity("Density", density, "kg/m^3", positive, "rho_0 at rest.");
  parameters.add_quantity("Ratio of specific heats", gamma, "-", {1., 5., true, false},
                          "gamma. Stiffens the gas; air 1.4, detonation products at low density 1.2 to 1.3.");
  parameters.add_quantity("Initial pressure", initial_pressure, "Pa", positive,
                          "p_0 at rest, absolute. Stresses are counted from it.");
  parameters.add_quantity("Largest pressure", largest_pressure, "Pa", positive,
                          "End of the valid range, absolute; a larger one asks for a smaller time step.");
}
} // namespace Arenite
