#pragma once

#include <arenite/time/dynamics.h>

#include <string>
#include <vector>

namespace Arenite
{
/// What became of the energy in each block, for the end of the log: stored, dissipated by the law, by bulk viscosity and on hourglass
/// patterns with the worst cell; relaxation time over the mean step and over the time that a wave needs for a cell. Whether a front is
/// the soil's or the viscosity's can be read off. Collective.
///
/// @param names   of the blocks
/// @param factor  full body over the modelled sector
template <int dim>
std::string describe_blocks(const Dynamics<dim> &, const State<dim> &, const std::vector<std::string> &names,
                            double factor);
} // namespace Arenite
