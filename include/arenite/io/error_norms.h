#pragma once

#include <arenite/mechanics/cell_fields.h>
#include <arenite/verification/exact_solution.h>

#include <map>

namespace Arenite
{
/// Errors over the volume at one time, for displacement, velocity and stress:
///
///   E_x = sqrt(int |q_h - q|^2 dV / int |q|^2 dV),
///
/// Gauss quadrature with p+2 points per direction (exact for degree 2p+3) on the cells' own geometry: not the nodes, where the
/// error of spectral elements is smaller than elsewhere. Both vectors need valid ghosts and hanging nodes. Collective.
/// @return "volume.displacement.E_x", "volume.velocity.E_x", "volume.stress.E_x"; infinite where q vanishes and q_h does not.
template <int dim>
std::map<std::string, double> volume_errors(const Discretization<dim> &, const MaterialOfBlock &,
                                            const VectorType &displacement, const VectorType &velocity,
                                            const ExactSolution<dim> &, double                time);

/// Largest error of the traction on some boundaries, relative to the largest exact stress there:
///
///   E_inf = max |sigma_h n - sigma n| / max |sigma|
///
/// over (p+2)^(dim-1) Gauss points per face, with the normal n of the polynomial geometry. Collective.
/// @return "boundary.traction.E_inf"
template <int dim>
std::map<std::string, double> traction_error(const Discretization<dim> &, const MaterialOfBlock &,
                                             const VectorType                              &displacement,
                                             const std::vector<dealii::types::boundary_id> &ids,
                                             const ExactSolution<dim> &, double time);
} // namespace Arenite
