#pragma once

#include <arenite/adaptivity/cell_transport.h>
#include <arenite/time/dynamics.h>

namespace Arenite
{
/// Keeps the momentum of every part of the body when the mesh changes. Interpolated velocities keep it where cells are halved, because the
/// parent's field goes on; where cells are joined, fine nodes disappear with what they carried. Each cell remembers
///
///   p_e = sum_i m_i^e v_i          with its own share m_i^e of the nodes' masses,
///
/// and what is missing in a halved or joined cell, or in one that stays beside it with other hanging nodes, goes to its nodes in
/// proportion to mass, but not to what planes hold. A cell that is halved and joined again keeps its velocities.
template <int dim>
class MomentumTransfer
{
public:
  /// @p velocity with ghosts and hanging nodes, before the change.
  MomentumTransfer(CellTransport<dim> &, const Dynamics<dim> &, const VectorType &velocity);
  MomentumTransfer(const MomentumTransfer &) = delete;

  /// Correct the interpolated @p velocity on the new mesh, with ghosts and hanging nodes before and after. Collective.
  void restore(const State<dim> &, VectorType &velocity);

private:
  using Cell    = typename CellTransport<dim>::Cell;
  using Numbers = std::vector<double>;
  using Tensor  = dealii::Tensor<1, dim>;

  const std::vector<double> &mass_of(unsigned int cell);
  Tensor                     momentum(unsigned int cell, const VectorType &velocity);

  CellTransport<dim>  &transport;
  const Dynamics<dim> &dynamics;
  std::vector<double>  mass; ///< of the last cell that was asked for
  std::vector<Tensor>  old;  ///< momentum per active cell of the old mesh
  unsigned int         cargo;
};
} // namespace Arenite
