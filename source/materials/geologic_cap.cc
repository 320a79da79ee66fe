#include <arenite/materials/geologic_cap.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
std::string GeologicCapSurface::finalize()
{
  const std::string rule = finalize_failure();
  smallest_position      = axis_ratio * F0;
  return rule;
}

double GeologicCapSurface::junction(const double X) const
{
  // X(kappa) increases with a slope above one
  double high = X;
  while (cap(high).X < X)
    high += std::abs(X) + smallest_position;
  double low = high;
  while (cap(low).X > X)
    low -= std::abs(X) + smallest_position;
  for (unsigned int i = 0; i < 200 && high - low > 1e-16 * (std::abs(X) + smallest_position); ++i)
    {
      const double middle              = 0.5 * (low + high);
      (cap(middle).X > X ? high : low) = middle;
    }
  return 0.5 * (low + high);
}

void GeologicCap::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  constants.declare_parameters(parameters);
  surface.declare_failure(parameters);
  parameters.add_quantity("Cap axis ratio R", surface.axis_ratio, "-", positive,
                          "Length of the cap along I1 over its height. Larger: a flatter cap that begins earlier.");
  parameters.add_quantity("Initial cap position X0", surface.initial_position, "Pa", non_negative,
                          "I1 of first compaction: three times the yield pressure. Larger: stiffer at first.");
  parameters.add_quantity("Hardening rate D", surface.hardening_rate, "1/Pa", positive,
                          "Compaction per I1: k = W (1 - exp(-D (X - X0))). Larger: compacts at lower pressure.");
  parameters.add_quantity("Hardening limit W", surface.hardening_limit, "-", {0., 1., true, true},
                          "Largest compactive volume strain, of the closed pores. Larger: absorbs more.");
  parameters.add_quantity("Tension cutoff T", tension_cutoff, "Pa", non_negative,
                          "Tensile strength on the I1 axis: three times the mean tensile stress. Larger: later spall.");
  parameters.add_choice("Type", type, {"soil", "rock"},
                        "The cap of a soil contracts when it dilates, that of a rock never.");
}

void GeologicCap::finalize(const Parameters &parameters)
{
  elastic = constants.finalize(parameters);
  if (const std::string problem = surface.finalize(); !problem.empty())
    parameters.refuse(path, problem);
  if (!(surface.failure(-tension_cutoff).value >= 0.))
    {
      std::ostringstream problem;
      problem << "must not lie beyond the apex of the failure surface, T = " << surface.F0 / surface.F0_slope << " Pa";
      parameters.refuse(path + "/Tension cutoff T", problem.str());
    }
  derive();
}

void GeologicCap::derive() { smallest_kappa = surface.junction(surface.initial_position); }

static_assert(IsMaterialLaw<GeologicCap>::value);
static_assert(IsMaterialLaw<GeologicCap, Lanes<native_lanes>>::value);
} // namespace Arenite
