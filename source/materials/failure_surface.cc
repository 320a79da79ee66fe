#include <arenite/materials/failure_surface.h>

#include <sstream>

namespace Arenite
{
void FailureSurface::declare_failure(Parameters &parameters)
{
  parameters.add_quantity("Failure alpha", alpha, "Pa", positive,
                          "Shear strength sqrt(J2) = alpha - gamma exp(-beta I1) + theta I1. Larger: stronger.");
  parameters.add_quantity("Failure gamma", gamma, "Pa", non_negative,
                          "Strength that is missing at I1 = 0; below alpha. Larger: weaker at low pressure.");
  parameters.add_quantity("Failure beta", beta, "1/Pa", non_negative,
                          "Decay of gamma with I1. Larger: full strength at lower pressure.");
  parameters.add_quantity("Failure theta", theta, "-", non_negative,
                          "Friction: slope of the failure surface at high I1. Larger: more strength under pressure.");
}

std::string FailureSurface::finalize_failure()
{
  std::ostringstream problem;
  F0       = alpha - gamma;
  F0_slope = beta * gamma + theta;
  if (!(alpha > gamma && gamma >= 0.))
    problem << "failure surface: alpha = " << alpha << " Pa must exceed gamma = " << gamma
            << " Pa; a cohesionless apex is not supported, use a small alpha - gamma";
  return problem.str();
}
} // namespace Arenite
