#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/base/aligned_vector.h>

#include <vector>

namespace Arenite
{
/// Viscous hourglass forces of one block, kept from one evaluation to the next: the velocity v_{n-1/2} meets the forces of t_{n-1}
/// and of t_n. Without room for amplitudes no record is kept: states on which forces are only tried out have none.
struct ViscousForces
{
  dealii::AlignedVector<double> amplitude; ///< of the last evaluation, in the order of the block's kernel
  double power = 0.; ///< that the mean of the last two forces takes out of the cells at v_{n-1/2} [W]
};

/// What a step changes. Between two steps displacement and force belong to t, the velocity to t - dt_last/2.
template <int dim>
struct State
{
  VectorType displacement;  ///< u_n [m], ghosts and hanging nodes valid after the forces were computed
  VectorType half_velocity; ///< v_{n-1/2} [m/s], owned unconstrained nodes only
  VectorType force;         ///< f_n [N], zero between steps: the update consumes it
  VectorType inverse_mass;  ///< 1/m per entry [1/kg]; zero at hanging nodes

  std::vector<ViscousForces> viscous; ///< by block, sized by Dynamics::reinit()

  double       time    = 0.;
  double       dt_last = 0.; ///< length of the step that led to t; 0 at the start, where half_velocity is v_0
  unsigned int step    = 0;

  void reinit(const Discretization<dim> &discretization)
  {
    displacement  = discretization.new_vector();
    half_velocity = discretization.new_vector();
    force         = discretization.new_vector();
    inverse_mass  = discretization.new_vector();
    viscous.clear();
  }
};
} // namespace Arenite
