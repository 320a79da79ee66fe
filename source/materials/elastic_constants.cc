#include <arenite/base/names.h>
#include <arenite/materials/elastic_constants.h>

#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace Arenite
{
namespace
{
constexpr const char *constant_names[] = {"Young modulus", "Poisson ratio", "Bulk modulus", "Shear modulus",
                                          "Lame lambda",   "P-wave speed",  "S-wave speed"};
} // namespace

void ElasticConstants::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  soil.declare_parameters(parameters);
  const bool has_state = soil.is_set(parameters);
  if (has_state)
    density = 1.; // not required then
  parameters.add_quantity("Density", density, "kg/m^3", positive,
                          "Mass density. Soils: 1400 to 2300. Not needed with a soil state.");
  if (has_state)
    parameters.leave_out_if_unset("Density");
  const std::string two = " Set two of the seven elastic constants.";
  parameters.add_quantity("Young modulus", young_modulus, "Pa", non_negative, "E." + two);
  parameters.add_quantity("Poisson ratio", poisson_ratio, "-", {-1., 0.5, true, true}, "nu, below 0.5." + two);
  parameters.add_quantity("Bulk modulus", bulk_modulus, "Pa", non_negative, "K." + two);
  parameters.add_quantity("Shear modulus", shear_modulus, "Pa", non_negative, "G." + two);
  parameters.add_quantity("Lame lambda", lame_lambda, "Pa", any_value, "lambda = K - 2G/3." + two);
  parameters.add_quantity("P-wave speed", p_wave_speed, "m/s", non_negative, "cp." + two);
  parameters.add_quantity("S-wave speed", s_wave_speed, "m/s", non_negative, "cs." + two);
  for (const char *name : constant_names)
    parameters.leave_out_if_unset(name);
}

LinearElastic ElasticConstants::finalize(const Parameters &parameters)
{
  if (soil.is_set(parameters))
    {
      density = soil.density_of_block(parameters, density);
      state   = soil.finalize(parameters);
    }
  const std::vector<std::string> names(std::begin(constant_names), std::end(constant_names));
  std::vector<std::string>       set;
  for (const auto &name : names)
    if (parameters.is_set(path + "/" + name))
      set.push_back(name);
  if (set.size() != 2)
    parameters.refuse(path, "needs exactly two elastic constants of " + join(names) + "; " +
                              (set.empty() ? "none is set" : "set: " + join(set)));
  const auto has = [&](const std::string &name) { return set[0] == name || set[1] == name; };

  // Every pair is brought to K and G. G is known directly, from cs, or follows from the partner of E, nu, K, lambda or the
  // P-wave modulus M.
  const double M         = density * p_wave_speed * p_wave_speed;
  const bool   has_shear = has("Shear modulus") || has("S-wave speed");
  double       G = has("Shear modulus") ? shear_modulus : density * s_wave_speed * s_wave_speed, K = 0.;
  const double E = young_modulus, nu = poisson_ratio, lambda = lame_lambda;
  if (has("Shear modulus") && has("S-wave speed"))
    parameters.refuse(path,
                      "'Shear modulus' and 'S-wave speed' say the same thing; set one of them and another constant");
  if (has_shear)
    {
      if (has("Young modulus"))
        K = E * G / (3. * (3. * G - E));
      else if (has("Poisson ratio"))
        K = 2. * G * (1. + nu) / (3. * (1. - 2. * nu));
      else if (has("Bulk modulus"))
        K = bulk_modulus;
      else if (has("Lame lambda"))
        K = lambda + 2. / 3. * G;
      else
        K = M - 4. / 3. * G;
    }
  else if (has("Poisson ratio"))
    {
      if (has("Young modulus"))
        G = E / (2. * (1. + nu));
      else if (has("Bulk modulus"))
        G = 3. * bulk_modulus * (1. - 2. * nu) / (2. * (1. + nu));
      else if (has("Lame lambda"))
        G = lambda * (1. - 2. * nu) / (2. * nu);
      else
        G = M * (1. - 2. * nu) / (2. * (1. - nu));
      K = 2. * G * (1. + nu) / (3. * (1. - 2. * nu));
    }
  else if (has("Bulk modulus"))
    {
      K = bulk_modulus;
      if (has("Young modulus"))
        G = 3. * K * E / (9. * K - E);
      else if (has("Lame lambda"))
        G = 1.5 * (K - lambda);
      else
        G = 0.75 * (M - K);
    }
  else if (has("Young modulus") && has("Lame lambda"))
    {
      const double R = std::sqrt(E * E + 9. * lambda * lambda + 2. * E * lambda);
      G              = (E - 3. * lambda + R) / 4.;
      K              = lambda + 2. / 3. * G;
    }
  else if (has("Young modulus")) // and the P-wave modulus; the root with positive Poisson ratio
    {
      const double S = std::sqrt(E * E + 9. * M * M - 10. * E * M);
      G              = (3. * M + E - S) / 8.;
      K              = M - 4. / 3. * G;
    }
  else // lambda and M
    {
      G = 0.5 * (M - lambda);
      K = lambda + 2. / 3. * G;
    }

  LinearElastic law;
  law.density       = density;
  law.bulk_modulus  = K;
  law.shear_modulus = G;
  if (!(K > 0. && G > 0. && std::isfinite(K) && std::isfinite(G)))
    {
      std::ostringstream reason;
      reason << "'" << set[0] << "' and '" << set[1] << "' give K = " << K << " Pa and G = " << G
             << " Pa; both must be positive";
      parameters.refuse(path, reason.str());
    }
  if (law.p_wave_speed() < 10. || law.p_wave_speed() > 20000.)
    {
      std::ostringstream reason;
      reason << "gives a P-wave speed of " << law.p_wave_speed()
             << " m/s. Soils and rocks: 100 to 7000 m/s. Were moduli in MPa or the density in g/cm^3?";
      parameters.refuse(path, reason.str());
    }
  return law;
}
} // namespace Arenite
