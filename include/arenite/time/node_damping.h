#pragma once

#include <arenite/loads/constraints.h>
#include <arenite/loads/load.h>

namespace Arenite
{
/// All dashpots of a scene, treated implicitly node by node: v_n = (v_{n-1/2} + v_{n+1/2})/2 in f_D = -D v_n, so that
///
///   a_n = (M + dt_mean/2 D)^-1 (f_n - D v_{n-1/2}).
///
/// The stable step of the undamped system is kept whatever D is.
template <int dim>
class NodeDamping
{
public:
  void reinit(const std::vector<std::unique_ptr<Load<dim>>> &loads, const Constraints<dim> &);

  /// f_n <- M a_n at the damped nodes.
  void apply(State<dim> &, double mean);

  /// Sum of f_D . v of load @p index [W], from the last apply().
  double power(unsigned int index, const VectorType &half_velocity) const;

  /// f_D of load @p index, from the last apply().
  void add_resultants(unsigned int index, Resultants<dim> &) const;

private:
  struct Node
  {
    unsigned int                    node;
    dealii::SymmetricTensor<2, dim> damping;
    dealii::Tensor<1, dim>          velocity; ///< v_n
  };
  std::vector<Node>               nodes;
  std::vector<DampingBlocks<dim>> per_load; ///< node: index into nodes
};
} // namespace Arenite
