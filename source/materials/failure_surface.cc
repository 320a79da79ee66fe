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
  parameters.add_quantity("Largest strength", largest_strength, "Pa", non_negative,
                          "Limit of sqrt(J2) at high pressure; sands 1e8 to 3e8. 0 does not bound the friction.");
}

std::string FailureSurface::finalize_failure()
{
  std::ostringstream problem;
  F0       = alpha - gamma;
  F0_slope = beta * gamma + theta;
  if (!(alpha > gamma && gamma >= 0.))
    problem << "failure surface: alpha = " << alpha << " Pa must exceed gamma = " << gamma
            << " Pa; a cohesionless apex is not supported, use a small alpha - gamma";
  else if (largest_strength > 0. && !(largest_strength > alpha))
    problem << "failure surface: the largest strength, " << largest_strength << " Pa, must exceed alpha = " << alpha
            << " Pa, the strength without friction; 0 does not bound the strength";
  friction_range = largest_strength > 0. && theta > 0. ? (largest_strength - alpha) / theta : 0.;
  return problem.str();
}

std::string FailureSurface::strength_warning(const double largest_pressure) const
{
  // Sands: q saturates at 226 MPa (Laine and Sandvik, 2001), reached at 0.3 to 0.5 GPa
  if (!(largest_pressure > 5e8 && friction_range == 0. && theta > 0.))
    return "";
  std::ostringstream sentence;
  sentence << "the strength grows without bound: q = " << strength_q(largest_pressure)
           << " Pa at the largest pressure, " << largest_pressure
           << " Pa, where sands carry some 2e8. Set 'Largest strength', or lower 'Largest pressure'.";
  return sentence.str();
}
} // namespace Arenite
