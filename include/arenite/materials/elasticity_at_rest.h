#pragma once

#include <arenite/materials/batch_law.h>
#include <arenite/materials/linear_elastic.h>

namespace Arenite
{
/// Linear elasticity of a law for small disturbances of the state at rest: M = rho_0 c^2 from its wave speed, K from unloading after a
/// volume strain of 1e-7, G = 3/4 (M - K). What borders, resolution and the stable step need before there is a motion. A gas or
/// liquid has G = 0.
LinearElastic elasticity_at_rest(const BatchLaw &);
} // namespace Arenite
