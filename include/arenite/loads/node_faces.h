#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace Arenite
{
/// What a node has of the faces of a boundary: integrals of N_i over them, with the measure of kinematics.h or that of the mesh.
template <int dim>
struct NodeFaces
{
  unsigned int                    node;
  dealii::SymmetricTensor<2, dim> dyad; ///< of n n^T dS
  dealii::Tensor<1, dim>          area; ///< of n dS, n out of the body
  double                          size; ///< of dS

  /// Unit vector, or zero where opposite faces meet.
  dealii::Tensor<1, dim> normal() const
  {
    const double length = area.norm();
    return length > 1e-8 * size ? area / length : dealii::Tensor<1, dim>();
  }
};

/// Of each owned free node on one of the boundaries, ascending. Hanging nodes give theirs to their masters, with the measure of the body, or
/// are left out, with that of the mesh, which does not vanish on an axis.
template <int dim>
std::vector<NodeFaces<dim>> faces_of_nodes(const Discretization<dim> &,
                                           const std::vector<dealii::types::boundary_id> &ids, bool condense);

/// K^-1 on the directions in which springs of the stiffness @p K hold a node, zero on the others. Of the reaction R of the node springs side by side
/// take K_b K^-1 R each.
template <int dim>
dealii::SymmetricTensor<2, dim> flexibility_where_held(const dealii::SymmetricTensor<2, dim> &K);
} // namespace Arenite
