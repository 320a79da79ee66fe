#include <arenite/base/errors.h>
#include <arenite/base/state_archive.h>
#include <arenite/time/stable_time_step.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void StableTimeStep<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Time stepping");
  parameters.add_quantity(
    "Courant number", courant, "-", {0., 2., true, false},
    "Part of the stable step. The error in time grows with its square; above 1 the run may blow up.");
  parameters.add_quantity("Fixed step", fixed, "s", non_negative,
                          "Use this step whatever the mesh needs; 0 follows the stable step.");
  parameters.add_quantity(
    "First step", first, "s", non_negative,
    "Where materials have memory or strains are finite; 0 takes a hundredth of the stable step, because the load may "
    "start with a jump, and less where what moves would cross a hundredth of a cell.");
  parameters.add_quantity("Largest growth", growth, "-", {1., 10., true, false},
                          "Where materials have memory or strains are finite: of a step over the last one.");
  parameters.add_quantity("Largest step", largest, "s", non_negative, "Upper limit, for accuracy in time; 0 for none.");
  parameters.add_quantity("Smallest step", least, "s", non_negative,
                          "Where materials have memory or strains are finite: a run that needs shorter ones ends with "
                          "a message; 0 takes a millionth of a millionth of the end time.");
}

template <int dim>
void StableTimeStep<dim>::finalize(const Parameters &)
{}

template <int dim>
double largest_eigenvalue(Dynamics<dim> &dynamics, const unsigned int n_iterations, const double tolerance,
                          const double rate)
{
  // Lanczos for A = M^-1/2 (K + rate C) M^-1/2; q and the work vectors hold M^1/2 u. Without reorthogonalisation the
  // largest Ritz value still converges to the largest eigenvalue (Paige, 1971).
  const Discretization<dim> &discretization = dynamics.discretization;
  State<dim>                 state;
  state.reinit(discretization);
  VectorType         root_mass = discretization.new_vector(), q = root_mass, last = root_mass;
  const unsigned int n = q.locally_owned_size();
  for (unsigned int i = 0; i < n; ++i)
    root_mass.local_element(i) = std::sqrt(dynamics.mass.local_element(i / dim));
  const auto dot = [&](const VectorType &a, const VectorType &b) {
    double sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      sum += a.local_element(i) * b.local_element(i);
    return Utilities::MPI::sum(sum, discretization.communicator);
  };
  for (unsigned int i = 0; i < n; ++i)
    {
      const Point<dim> x     = discretization.position(i / dim);
      double           phase = 1.1 * (i % dim);
      for (unsigned int d = 0; d < dim; ++d)
        phase += 1e5 * (1. + 0.37 * d) * x[d] / x.norm();
      q.local_element(i) = std::isfinite(phase) ? std::sin(phase + 3e4 * x.norm_square()) : 1.;
    }
  dynamics.constraints.project(q);
  for (unsigned int i = 0; i < n; ++i)
    q.local_element(i) *= root_mass.local_element(i);

  std::vector<double> diagonal, off_diagonal;
  double              beta = std::sqrt(dot(q, q)), eigenvalue = 0., residual = 0.;
  for (unsigned int k = 0; k < n_iterations && beta > 0.; ++k)
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          q.local_element(i) /= beta;
          const double m                       = root_mass.local_element(i);
          state.displacement.local_element(i)  = m > 0. ? q.local_element(i) / m : 0.;
          state.half_velocity.local_element(i) = rate * state.displacement.local_element(i);
        }
      state.force = 0.;
      dynamics.compute_internal_force(state);
      dynamics.constraints.project(state.force);
      VectorType &w = state.force; // A q - beta q_last - alpha q
      for (unsigned int i = 0; i < n; ++i)
        {
          const double m     = root_mass.local_element(i);
          w.local_element(i) = (m > 0. ? -w.local_element(i) / m : 0.) - (k > 0 ? beta : 0.) * last.local_element(i);
        }
      const double alpha = dot(w, q);
      for (unsigned int i = 0; i < n; ++i)
        {
          const double value    = w.local_element(i) - alpha * q.local_element(i);
          last.local_element(i) = q.local_element(i);
          q.local_element(i)    = value;
        }
      diagonal.push_back(alpha);
      beta = std::sqrt(dot(q, q));
      off_diagonal.push_back(beta);

      // the Ritz value and its residual beta |s_k| from the small tridiagonal matrix
      if (k + 1 == n_iterations || k % 5 == 4 || beta == 0.)
        {
          LAPACKFullMatrix<double> T(k + 1, k + 1);
          for (unsigned int i = 0; i <= k; ++i)
            {
              T(i, i) = diagonal[i];
              if (i < k)
                T(i, i + 1) = T(i + 1, i) = off_diagonal[i];
            }
          Vector<double>     eigenvalues;
          FullMatrix<double> vectors;
          T.compute_eigenvalues_symmetric(0., 1e300, 0., eigenvalues, vectors);
          eigenvalue = eigenvalues[eigenvalues.size() - 1];
          residual   = beta * std::abs(vectors(k, eigenvalues.size() - 1));
          if (residual < tolerance * eigenvalue)
            break;
        }
    }
  return eigenvalue + residual;
}

template <int dim>
double StableTimeStep<dim>::element_bound(const Dynamics<dim> &dynamics, const bool without_points)
{
  const auto    &cells = dynamics.discretization.cells();
  Vector<double> size(cells.size());
  for (const auto &block : dynamics.blocks)
    if (!(without_points && block->stores_points()))
      block->inverse_size_squared(size);
  double       largest_of_process = 0.;
  unsigned int limiting           = 0;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      const double lambda = ratio[cells[cell]->active_cell_index()] * size[cell];
      if (lambda > largest_of_process)
        {
          largest_of_process = lambda;
          limiting           = cell;
        }
    }
  const MPI_Comm communicator = dynamics.discretization.communicator;
  const auto     winner       = Utilities::MPI::min_max_avg(largest_of_process, communicator);
  largest_inverse_size        = std::sqrt(Utilities::MPI::max(size.linfty_norm(), communicator));
  place                       = Point<dim>();
  if (!cells.empty() && Utilities::MPI::this_mpi_process(communicator) == winner.max_index)
    {
      std::vector<Point<dim>> x;
      dynamics.discretization.cell_positions(limiting, x);
      for (const auto &node : x)
        place += node / static_cast<double>(x.size());
    }
  place = Utilities::MPI::broadcast(communicator, place, winner.max_index);
  // the power iteration ends up to 1 % below, and children of curved cells differ from their parents by some percent
  return 1.03 * winner.max;
}

template <int dim>
void StableTimeStep<dim>::calibrate(Dynamics<dim> &dynamics)
{
  const auto    &cells = dynamics.discretization.cells();
  Vector<double> lambda(cells.size()), size(cells.size());
  for (const auto &block : dynamics.blocks)
    {
      block->largest_eigenvalue(lambda);
      block->inverse_size_squared(size);
    }
  ratio.reinit(dynamics.discretization.triangulation.n_active_cells());
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    ratio[cells[cell]->active_cell_index()] = lambda[cell] / size[cell];
  update(dynamics);
}

/// Largest eigenvalue of the assembled system with residual and margin; @p elements bounds it from above.
template <int dim>
double StableTimeStep<dim>::assembled_bound(Dynamics<dim> &dynamics, const double elements)
{
  const auto estimate = [&](const double rate) { return 1.01 * largest_eigenvalue(dynamics, 80, 1e-3, rate); };
  if (std::none_of(dynamics.blocks.begin(), dynamics.blocks.end(),
                   [](const auto &block) { return block->uses_velocity(); }))
    return estimate(0.);

  // Viscous forces: the estimate at a rate above the root sqrt(lambda) is safe, and at most half as far from the root. One below is
  // corrected upwards.
  double rate = rate_ratio * std::sqrt(elements), safe = elements;
  for (unsigned int trial = 0; trial < 8; ++trial)
    {
      const double lambda = estimate(rate), change = std::sqrt(lambda) / rate;
      rate *= change;
      if (change <= 1.)
        safe = std::min(safe, lambda);
      else
        rate *= 1.01;
      if (change <= 1. && change > 0.99)
        break;
    }
  rate_ratio = 1.01 * std::sqrt(safe / elements);
  return safe;
}

template <int dim>
void StableTimeStep<dim>::update(Dynamics<dim> &dynamics, const unsigned int expected_steps)
{
  follows_points = dynamics.stores_points();
  if (follows_points)
    {
      // the moduli change with the state: what the assembled system gains over its elements is not used
      elastic_step   = 2. / std::sqrt(element_bound(dynamics, true)); // infinite without such blocks
      step_of_points = element_step = critical_step = 2. / std::sqrt(element_bound(dynamics));
    }
  else
    {
      const double elements  = element_bound(dynamics);
      const double assembled = expected_steps > 300 ? assembled_bound(dynamics, elements) : elements;
      element_step           = 2. / std::sqrt(elements);
      critical_step          = 2. / std::sqrt(std::min(elements, assembled));
    }
  if (!(critical_step > 0. && std::isfinite(critical_step)))
    throw InputError("[Mesh]: no step is stable on this mesh; some node has no mass, or some cell no volume.");
}

template <int dim>
void StableTimeStep<dim>::exchange(StateArchive &archive)
{
  for (double *value : {&first_by_motion, &largest_inverse_size, &step_of_points, &elastic_step, &critical_step,
                        &element_step, &rate_ratio})
    archive.common(*value);
  archive.common(follows_points);
  archive.common(place);
}

template <int dim>
void StableTimeStep<dim>::limit_first(const double speed)
{
  // |tr D| of a cell between a side that rests and one that moves is speed/h, and |J^-1| = 2/h
  first_by_motion = largest_volume_change / (largest_inverse_size * speed);
}

template <int dim>
double StableTimeStep<dim>::usual() const
{
  const double dt = fixed > 0. ? fixed : courant * limit();
  return largest > 0. ? std::min(dt, largest) : dt;
}

template <int dim>
double StableTimeStep<dim>::next(const double time, const double end_time, const double dt_last) const
{
  double dt = usual();
  if (follows_points && fixed == 0.)
    {
      if (dt_last > 0.)
        dt = std::min(dt, growth * dt_last);
      else // nobody knows yet what a piston or a jump of velocities does
        dt = std::min(dt, first > 0. ? first : std::min(0.01 * dt, first_by_motion));
    }
  const double left = end_time - time;
  return left / std::max(1., std::ceil(left / dt * (1. - 1e-12)));
}

template class StableTimeStep<1>;
template class StableTimeStep<2>;
template class StableTimeStep<3>;
template double largest_eigenvalue(Dynamics<1> &, unsigned int, double, double);
template double largest_eigenvalue(Dynamics<2> &, unsigned int, double, double);
template double largest_eigenvalue(Dynamics<3> &, unsigned int, double, double);
} // namespace Arenite
