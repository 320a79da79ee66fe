#pragma once

#include <arenite/io/error_norms.h>
#include <arenite/loads/body_force.h>
#include <arenite/verification/free_vibration.h>

#include <cmath>

#include "body.h"

namespace Arenite::Test
{
inline double order(const double coarse, const double fine) { return std::log2(coarse / fine); }

/// Relative error of the displacement at @p end of a manufactured motion whose boundary values are prescribed.
template <int dim>
double manufactured_error(const ElementChoice &choice, std::shared_ptr<const ExactSolution<dim>> exact,
                          const std::function<void(ParallelTriangulation<dim> &)> &make_mesh,
                          const std::vector<types::boundary_id> &boundaries, const double courant, const double end,
                          const Symmetry symmetry = cartesian<dim>())
{
  BodyOf<dim> body(choice, make_mesh, soil(), symmetry);
  body.constraints.set_exact(boundaries, exact.get());
  std::vector<std::unique_ptr<Load<dim>>> loads;
  loads.push_back(std::make_unique<BodyForce<dim>>(exact));
  body.assemble(std::move(loads));
  body.set(body.state.displacement, [&](const Point<dim> &x) { return exact->displacement(x, 0.); });
  body.set(body.state.half_velocity, [&](const Point<dim> &x) { return exact->velocity(x, 0.); });
  zero_at_hanging_nodes(body.discretization, body.state.half_velocity);
  StableTimeStep<dim> limit;
  limit.calibrate(*body.dynamics);
  const unsigned int n_steps = std::ceil(end / (courant * limit.limit()));
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, end / n_steps);
      body.dynamics->advance(body.state, end / n_steps);
    }
  make_consistent(body.discretization, body.state.displacement);
  return volume_errors<dim>(
           body.discretization, [&](types::material_id) { return body.law; }, body.state.displacement,
           body.state.displacement, *exact, end)
    .at("volume.displacement.E_x");
}

/// Free vibration: the frequency that the discrete body shows, from the three-term recurrence of its projection on the mode,
/// q(t+dt) + q(t-dt) = 2 cos(w dt) q(t), and corrected for the known error of central differences, sin(w dt/2) = w_h dt/2.
template <int dim>
double measured_frequency(BodyOf<dim> &body, const FreeVibration<dim> &mode, const double periods)
{
  body.set(body.state.displacement, [&](const Point<dim> &x) { return mode.mode(x); });
  StableTimeStep<dim> limit;
  limit.calibrate(*body.dynamics);
  const double        dt    = 0.8 * limit.limit();
  VectorType          shape = body.state.displacement;
  std::vector<double> q;
  const unsigned int  n_steps = periods * 2. * numbers::PI / mode.angular_frequency() / dt;
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < shape.locally_owned_size(); ++i)
        if (const double w = body.state.inverse_mass.local_element(i); w > 0.)
          sum += shape.local_element(i) * body.state.displacement.local_element(i) / w;
      q.push_back(Utilities::MPI::sum(sum, MPI_COMM_WORLD));
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, dt);
      body.dynamics->advance(body.state, dt);
    }
  double numerator = 0., denominator = 0.;
  for (unsigned int k = 1; k + 1 < q.size(); ++k)
    {
      numerator += (q[k + 1] + q[k - 1]) * q[k];
      denominator += 2. * q[k] * q[k];
    }
  const double angle = std::acos(numerator / denominator);
  return 2. / dt * std::sin(0.5 * angle);
}

} // namespace Arenite::Test
