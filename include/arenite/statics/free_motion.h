#pragma once

#include <arenite/loads/constraints.h>

#include <vector>

namespace Arenite
{
/// The unknowns of an equilibrium: motions of nodes that planes and prescribed motions leave free. Nodes that hang have none of their own.
template <int dim>
class FreeMotion
{
public:
  void reinit(const Discretization<dim> &, const Constraints<dim> &);

  /// Leave what is free of the forces or motions of owned nodes.
  void project(VectorType &) const;

  /// The projector of each node on this process, also of nodes that others own; the identity where nothing is held. Collective.
  std::vector<dealii::Tensor<2, dim>> of_local_nodes() const;

private:
  std::vector<NodeValue<dealii::SymmetricTensor<2, dim>>> projectors;
  const Discretization<dim>                              *discretization = nullptr;
};
} // namespace Arenite
