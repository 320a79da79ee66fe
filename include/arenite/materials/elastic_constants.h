#pragma once

#include <arenite/base/parameters.h>
#include <arenite/materials/linear_elastic.h>
#include <arenite/materials/soil_state.h>

#include <limits>
#include <optional>
#include <string>

namespace Arenite
{
/// Entries of `law = linear elastic`: the density, or the state of the soil, and any two independent elastic constants.
class ElasticConstants
{
public:
  void declare_parameters(Parameters &);

  /// Bulk and shear modulus from the two constants that were set; refuses fewer, more, and combinations without a stable solid.
  LinearElastic finalize(const Parameters &);

  /// After finalize(): the soil, if `subsection Soil state` describes it.
  const std::optional<SoilState> &soil_state() const { return state; }

  /// f(name, value, unit) for the log: of the soil, if it is described.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    if (state)
      state->for_each_constant(f);
  }

private:
  double density       = std::numeric_limits<double>::quiet_NaN();
  double young_modulus = 0., poisson_ratio = 0., bulk_modulus = 0., shear_modulus = 0., lame_lambda = 0.,
         p_wave_speed = 0., s_wave_speed = 0.;
  SoilStateEntries         soil;
  std::optional<SoilState> state;
  std::string              path;
};
} // namespace Arenite
