#pragma once

#include <arenite/base/parameters.h>
#include <arenite/materials/linear_elastic.h>

#include <string>

namespace Arenite
{
/// Entries of `law = linear elastic`: the density and any two independent elastic constants.
class ElasticConstants
{
public:
  void declare_parameters(Parameters &);

  /// Bulk and shear modulus from the two constants that were set; refuses fewer, more, and combinations without a stable solid.
  LinearElastic finalize(const Parameters &) const;

private:
  double density       = std::numeric_limits<double>::quiet_NaN();
  double young_modulus = 0., poisson_ratio = 0., bulk_modulus = 0., shear_modulus = 0., lame_lambda = 0.,
         p_wave_speed = 0., s_wave_speed = 0.;
  std::string path;
};
} // namespace Arenite
