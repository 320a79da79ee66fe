#pragma once

#include <arenite/mechanics/state.h>
#include <arenite/time/energy_balance.h>

#include <string>
#include <utility>
#include <vector>

namespace Arenite
{
class StateArchive;

/// Accumulates the impulse of all forces from outside: f_n acts over the mean step (dt_{n-1} + dt_n)/2.
///
/// Internal forces have no sum along the axes of a Cartesian mesh, whatever elements and laws do, so
///
///   sum_i m_i v_i - what it was at the start = impulse of loads, dashpots, planes and prescribed motions
///
/// to round-off in every step. On a body of revolution this holds along its axis only: in radial direction there is no sum that vanishes, and
/// the momentum of the full body does.
template <int dim>
class MomentumBalance
{
public:
  void set_names(const std::vector<std::string> &names);

  /// The forces of account @p index at t_n, to be known before advance().
  void set_force(const unsigned int index, const dealii::Tensor<1, dim> &force) { forces[index] = force; }

  /// They act over the mean step.
  void advance(double mean)
  {
    for (std::size_t i = 0; i < forces.size(); ++i)
      impulses[i] += mean * forces[i];
  }

  /// Jump of the momentum over a change of the mesh, summed over processes.
  void add_adaptation(const dealii::Tensor<1, dim> &jump) { adaptation += jump; }

  /// What the nodes have at the start. Collective.
  void set_initial(const State<dim> &, const VectorType &mass, MPI_Comm);

  /// At t_n, with the force of t_n not yet consumed. Collective.
  MomentumLedger report(const State<dim> &, const VectorType &mass, Symmetry, MPI_Comm);

  /// Over all reports, relative to the largest impulse, or sum of m |v| over the nodes.
  double largest_error() const { return largest_scale > 0. ? largest_imbalance / largest_scale : 0.; }

  void exchange(StateArchive &);

private:
  std::vector<std::string>            names;
  std::vector<dealii::Tensor<1, dim>> forces, impulses; ///< of this process
  dealii::Tensor<1, dim>              adaptation, initial;
  double                              largest_imbalance = 0., largest_scale = 0.;
};
} // namespace Arenite
