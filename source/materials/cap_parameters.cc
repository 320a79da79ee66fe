#include <arenite/materials/cap_parameters.h>

namespace Arenite
{
void CapParameters::declare_cap(Parameters &parameters, const Range &position, const std::string &hardening)
{
  declare_failure(parameters);
  parameters.add_quantity("Cap axis ratio R", axis_ratio, "-", positive,
                          "Length of the cap along I1 over its height. Larger: a flatter cap that begins earlier.");
  parameters.add_quantity("Initial cap position X0", initial_position, "Pa", position,
                          "I1 of first compaction: three times the yield pressure. Larger: stiffer at first.");
  parameters.add_quantity("Hardening rate D", hardening_rate, "1/Pa", positive,
                          "Compaction per I1: " + hardening + ". Larger: compacts at lower pressure.");
}

void CapParameters::declare_hardening_limit(Parameters &parameters)
{
  parameters.add_quantity("Hardening limit W", hardening_limit, "-", {0., 1., true, true},
                          "Largest compactive volume strain, of the closed pores. Larger: absorbs more.");
}
} // namespace Arenite
