#pragma once

#include <arenite/loads/geostatic_stress.h>
#include <arenite/time/dynamics.h>

namespace Arenite
{
/// All points begin under the geostatic stress, with the history that goes with it. InputError with the block and the place where a
/// law cannot. Collective. @p block_names in the order of the blocks
/// @return largest force of stress, weight and held boundaries on a free node over its weight: how far the start is from equilibrium. Symmetry planes and fixed boundaries
/// hold what they want.
template <int dim>
double begin_under_stress(const GeostaticStress<dim> &, Dynamics<dim> &, State<dim> &,
                          const std::vector<std::string> &block_names);
} // namespace Arenite
