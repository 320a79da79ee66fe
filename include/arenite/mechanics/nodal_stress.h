#pragma once

#include <arenite/materials/linear_elastic.h>
#include <arenite/mechanics/discretization.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace Arenite
{
/// One scalar nodal vector per component.
template <int dim>
using NodalStress = std::array<VectorType, n_stress_components(dim)>;

/// What the points of some blocks store, see InternalForce::point_values(); empty if no block stores anything.
template <int dim>
struct StoredFields
{
  std::vector<std::string>                                            names; ///< after the stress
  std::function<bool(unsigned int cell, std::vector<double> &values)> values;
};

/// Stress at the nodes [Pa], tension positive: the law applied to the gradient of each cell's own polynomial at its nodes, then
/// the mean over the cells that touch the node, all with the same weight. Hanging nodes follow their masters. Exact for linear
/// displacements on cells of any shape; ghosts and hanging nodes of the result are valid. Collective.
///
/// @param displacement  [m], ghosts and hanging nodes valid
/// @param materials     by material id; a single one holds for all cells
/// @param stored        for cells of blocks that store their stress; @p others: means of what they store besides, over the cells that do
template <int dim>
NodalStress<dim> nodal_stress(const Discretization<dim> &, const VectorType &displacement,
                              const std::vector<LinearElastic> &materials, const StoredFields<dim> &stored = {},
                              std::vector<VectorType> *others = nullptr);

/// Mean pressure [Pa], compression positive.
double pressure(const dealii::SymmetricTensor<2, 3> &stress);

/// sqrt(3/2 s : s) [Pa] with the deviator s.
double von_mises_stress(const dealii::SymmetricTensor<2, 3> &stress);
} // namespace Arenite
