#pragma once

#include <arenite/loads/geostatic_stress.h>
#include <arenite/time/dynamics.h>

namespace Arenite
{
/// All points begin under the geostatic stress, with the history that goes with it. InputError with the block and the place where a
/// law cannot. Collective. @p block_names in the order of the blocks
template <int dim>
void begin_under_stress(const GeostaticStress<dim> &, Dynamics<dim> &, State<dim> &,
                        const std::vector<std::string> &block_names);

/// Largest force of stress, weight and held boundaries, or of @p all_loads, on a free node over its weight: how far the start is from
/// equilibrium. Symmetry planes and fixed boundaries hold what they want. Collective.
template <int dim>
double unbalanced_part(const GeostaticStress<dim> &, bool all_loads, Dynamics<dim> &, State<dim> &);
} // namespace Arenite
