#pragma once

#include <arenite/mechanics/state.h>

namespace Arenite
{
/// Central differences with variable step, one sweep over memory:
///
///   v_{n+1/2} = v_{n-1/2} + dt_mean M^-1 f_n,   dt_mean = (dt_{n-1} + dt_n)/2,   u_{n+1} = u_n + dt_n v_{n+1/2}.
///
/// The same as velocity-Verlet with v_n = v_{n-1/2} + dt_{n-1}/2 a_n; the first step has dt_{-1} = 0 and v_{-1/2} = v_0.
/// Second order for constant steps. The force is consumed (set to zero). Hughes, The Finite Element Method (1987), section 9.2.
///
/// @return f_n . v_{n+1/2} of this process [W], for the energy balance.
template <int dim>
double central_difference(State<dim> &state, const double dt, const double mean)
{
  double *__restrict u       = state.displacement.begin();
  double *__restrict v       = state.half_velocity.begin();
  double *__restrict f       = state.force.begin();
  const double *__restrict w = state.inverse_mass.begin();
  const unsigned int n       = state.displacement.locally_owned_size();
  double             power   = 0.;
#pragma omp simd reduction(+ : power)
  for (unsigned int i = 0; i < n; ++i)
    {
      const double force = f[i], velocity = v[i] + mean * w[i] * force;
      power += force * velocity;
      v[i] = velocity;
      u[i] += dt * velocity;
      f[i] = 0.;
    }
  state.time += dt;
  state.dt_last = dt;
  ++state.step;
  return power;
}

/// f_n . v_{n-1/2} of this process [W].
template <int dim>
double power(const State<dim> &state)
{
  double sum = 0.;
  for (unsigned int i = 0; i < state.half_velocity.locally_owned_size(); ++i)
    sum += state.force.local_element(i) * state.half_velocity.local_element(i);
  return sum;
}

/// Leapfrog-conserved kinetic energy of this process, 1/2 v_{n-1/2} . M v_{n+1/2} [J], with the force of t_n not yet consumed.
template <int dim>
double kinetic_energy(const State<dim> &state, const double mean)
{
  double sum = 0.;
  for (unsigned int i = 0; i < state.half_velocity.locally_owned_size(); ++i)
    if (const double w = state.inverse_mass.local_element(i); w > 0.)
      {
        const double v = state.half_velocity.local_element(i);
        sum += v * (v / w + mean * state.force.local_element(i));
      }
  return 0.5 * sum;
}
} // namespace Arenite
