#include <arenite/materials/strength.h>

namespace Arenite
{
namespace
{
void add_rate(Parameters &parameters, const char *name, RateFactor &rate)
{
  parameters.add_quantity(
    name, rate.coefficient, "-", non_negative,
    "Raises the strength by this part for each e-fold of plastic strain rate above the reference.");
  parameters.add_quantity("Reference strain rate", rate.reference_rate, "1/s", positive,
                          "Below it the strength is the static one.");
}
} // namespace

void ElasticShear::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_quantity(
    "Shear modulus", shear_modulus, "Pa", non_negative,
    "G of the Kirchhoff stress, constant; sets the shear wave speed sqrt(G/rho_0). Or 'Poisson ratio'.");
  parameters.add_quantity(
    "Poisson ratio", poisson_ratio, "-", {-1., 0.5, true, true},
    "nu on first loading. Lowers G = 3 K (1 - 2 nu)/(2 (1 + nu)), which grows with the bulk modulus and never falls.");
}

void ElasticShear::finalize(const Parameters &parameters) const
{
  const std::string prefix = path.empty() ? "" : path + "/";
  const bool        G = parameters.is_set(prefix + "Shear modulus"), nu = parameters.is_set(prefix + "Poisson ratio");
  if (G && nu)
    parameters.refuse(
      path, "both 'Shear modulus' [Pa] and 'Poisson ratio' are set. Leave one out: the first is a constant G, with "
            "the second G grows with the bulk modulus.");
  if (!G && !nu)
    parameters.refuse(
      path, "the strength needs 'Shear modulus' [Pa], or 'Poisson ratio'. Set one; 'Strength = none' has no shear.");
  if (G && !(shear_modulus > 0.))
    parameters.refuse(path,
                      "Shear modulus = 0 Pa: a strength needs shear. Set a positive one, 'Poisson ratio' instead, or "
                      "'Strength = none'.");
}

void MisesStrength::declare_parameters(Parameters &parameters)
{
  elastic.declare_parameters(parameters);
  parameters.add_quantity("Yield stress", yield_stress, "Pa", positive, "Y_0 in uniaxial stress.");
  parameters.add_quantity("Hardening modulus", hardening, "Pa", non_negative, "H. Raises the yield stress by H ep^n.");
  parameters.add_quantity("Hardening exponent", hardening_exponent, "-", {0., 1., true, false},
                          "n. 1 is linear; a smaller one hardens early.");
  add_rate(parameters, "Rate coefficient", rate);
}

void FrictionStrength::declare_parameters(Parameters &parameters)
{
  elastic.declare_parameters(parameters);
  parameters.add_quantity("Cohesion", cohesion, "Pa", non_negative, "k, the limit of sqrt(J2) without pressure.");
  parameters.add_quantity(
    "Friction slope", slope, "-", non_negative,
    "alpha in sqrt(J2) = k + alpha I1, I1 = 3 p: growth of strength with pressure. Sands 0.1 to 0.25.");
  parameters.add_quantity("Largest strength", largest_strength, "Pa", positive,
                          "Limit of sqrt(J2) at high pressure. Sands 1e8 to 3e8.");
  add_rate(parameters, "Rate coefficient", rate);
}

void FrictionStrength::finalize(const Parameters &parameters) const { elastic.finalize(parameters); }

void SelectedStrength::declare_parameters(Parameters &parameters)
{
  const std::vector<std::string> words = {NoStrength::name, ElasticShear::name, MisesStrength::name,
                                          FrictionStrength::name};
  parameters.add_choice(
    "Strength", word, words,
    "Shear: none (a fluid), elastic, with the yield stress of Mises, or with the friction of Drucker and Prager.");
  const std::string path   = parameters.current_path();
  const std::string chosen = parameters.peek_choice(path.empty() ? "Strength" : path + "/Strength", word, words);
  kind                     = chosen == words[1]   ? Kind::elastic
                             : chosen == words[2] ? Kind::mises
                             : chosen == words[3] ? Kind::friction
                                                  : Kind::none;
  if (kind == Kind::elastic)
    elastic.declare_parameters(parameters);
  else if (kind == Kind::mises)
    mises.declare_parameters(parameters);
  else if (kind == Kind::friction)
    friction.declare_parameters(parameters);
}

void SelectedStrength::finalize(const Parameters &parameters)
{
  visit([&](const auto &strength) { strength.finalize(parameters); });
}
} // namespace Arenite
