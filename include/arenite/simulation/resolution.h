#pragma once

#include <arenite/mechanics/internal_force.h>
#include <arenite/time/dynamics.h>

#include <array>
#include <string>

namespace Arenite
{
/// How finely a mesh resolves the waves of its loads.
///
/// Measured on Lamb's problem (benchmarks/surface_load): cells per S wave of the pulse's main frequency that let E_t of the surface's
/// displacement fall below 10, 1 and 0.1 %, up to four waves from the source, with 0.9 of the stable step. The error grows
/// with the distance.
std::array<double, 3> needed_cells_per_wave(const ElementChoice &);

/// Lines for `arenite check`: S wave of the main frequency of each pressure in @p loads, cells on it, and what the element needs. Collective.
template <int dim>
std::string describe_resolution(const dealii::Triangulation<dim> &, const Dynamics<dim> &, const ElementChoice &,
                                double slowest_speed, double end_time, MPI_Comm);
} // namespace Arenite
