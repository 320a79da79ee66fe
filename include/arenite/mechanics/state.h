#pragma once

#include <arenite/mechanics/discretization.h>

namespace Arenite
{
/// What a step changes. Between two steps displacement and force belong to t, the velocity to t - dt_last/2.
template <int dim>
struct State
{
  VectorType   displacement;  ///< u_n [m], ghosts and hanging nodes valid after the forces were computed
  VectorType   half_velocity; ///< v_{n-1/2} [m/s], owned unconstrained nodes only
  VectorType   force;         ///< f_n [N], zero between steps: the update consumes it
  VectorType   inverse_mass;  ///< 1/m per entry [1/kg]; zero at hanging nodes
  double       time    = 0.;
  double       dt_last = 0.; ///< length of the step that led to t; 0 at the start, where half_velocity is v_0
  unsigned int step    = 0;

  void reinit(const Discretization<dim> &discretization)
  {
    displacement  = discretization.new_vector();
    half_velocity = discretization.new_vector();
    force         = discretization.new_vector();
    inverse_mass  = discretization.new_vector();
  }
};
} // namespace Arenite
