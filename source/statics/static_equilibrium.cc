#include <arenite/base/errors.h>
#include <arenite/statics/static_equilibrium.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr unsigned int largest_linear_iterations = 500;
constexpr double       shortest_part             = 1. / 1024.; ///< of a load step

/// For the solvers of deal.II.
template <typename Function>
struct LinearOperator
{
  Function apply;
  void     vmult(VectorType &result, const VectorType &x) const { apply(result, x); }
};
template <typename Function>
LinearOperator<Function> linear_operator(const Function &apply)
{
  return {apply};
}
} // namespace

void StaticsChoice::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Statics");
  parameters.add_integer("Load steps", load_steps, 1, 1000000,
                         "Equal steps of the histories from 0 to the end time. Larger: laws with memory follow the "
                         "path more accurately, and each step converges more easily.");
  parameters.add_quantity(
    "Tolerance", tolerance, "-", positive,
    "Largest force out of balance, relative to the forces in the body (root of the sum of squares "
    "over nodes).");
  parameters.add_integer("Largest iterations", largest_iterations, 1, 1000,
                         "Newton iterations after which a load step is halved.");
  parameters.add_quantity("Settling time", settling_time, "s", positive,
                          "What passes for laws with viscosity until the equilibrium of 'Initial conditions / State'. "
                          "Larger: less overstress is left.");
}

template <int dim>
StaticEquilibrium<dim>::StaticEquilibrium(Dynamics<dim> &dynamics, State<dim> &state, const StaticsChoice &choice,
                                          std::function<void(const std::string &)> say)
  : dynamics(dynamics)
  , state(state)
  , choice(choice)
  , say(std::move(say))
  , is_affine(!dynamics.stores_points())
{
  const Discretization<dim> &discretization = dynamics.discretization;
  free.reinit(discretization, dynamics.constraints);
  preconditioner.reinit(dynamics, free);
  trial.reinit(discretization);
  displacement        = discretization.new_vector();
  last_change         = discretization.new_vector();
  state.half_velocity = 0.;
  for (BlockState &block : state.blocks)
    block.points.quasi_static = true;
  state.dt_last = 0.;
  state.force   = 0.;
  dynamics.compute_internal_force(state); // what points store at rest
  state.force = 0.;
  commit();
}

/// The state is an equilibrium: the next trials begin here.
template <int dim>
void StaticEquilibrium<dim>::commit()
{
  points = state.blocks;
  displacement.copy_locally_owned_data_from(state.displacement);
  if (!is_affine)
    copy_with_ghosts(state.last_displacement, last_displacement);
}

/// Points as in the last equilibrium; the time and the number of the step stay.
template <int dim>
void StaticEquilibrium<dim>::restore()
{
  if (is_affine)
    return;
  state.blocks = points;
  copy_with_ghosts(last_displacement, state.last_displacement);
}

template <int dim>
void StaticEquilibrium<dim>::evaluate(const VectorType &u, Residual &residual)
{
  ++n_evaluations;
  restore();
  state.displacement.zero_out_ghost_values();
  state.displacement.copy_locally_owned_data_from(u);
  state.force = 0.;
  dynamics.compute_internal_force(state);
  const double internal = state.force.l2_norm();
  residual.force        = state.force;
  for (const auto &load : dynamics.loads)
    load->add(state.force, state);
  residual.force -= state.force;
  residual.scale = std::max(internal, residual.force.l2_norm());
  residual.force = state.force;
  free.project(residual.force);
  residual.norm = residual.force.l2_norm();
  bool failed   = !std::isfinite(residual.norm);
  for (const BlockState &block : state.blocks)
    failed = failed || block.points.failed_cell != std::numeric_limits<unsigned int>::max();
  residual.valid = Utilities::MPI::max(failed ? 1 : 0, dynamics.discretization.communicator) == 0;
}

template <int dim>
bool StaticEquilibrium<dim>::small(const Residual &residual) const
{
  const double round_off = is_affine ? 0. : 1e-15 * preconditioner.force_of_unit_strain();
  return residual.valid && residual.norm <= std::max(choice.tolerance * residual.scale, round_off);
}

template <int dim>
void StaticEquilibrium<dim>::elastic_force(const VectorType &u, VectorType &force)
{
  trial.displacement.zero_out_ghost_values();
  trial.displacement.copy_locally_owned_data_from(u);
  trial.force = 0.;
  dynamics.compute_internal_force(trial);
  force = trial.force;
  free.project(force);
}

/// From zero. A solver that gives up leaves the best it has.
template <int dim>
template <typename Solver, typename Operator>
void StaticEquilibrium<dim>::solve(const Operator &A, const VectorType &rhs, const double tolerance, VectorType &x,
                                   Effort &effort) const
{
  SolverControl control(largest_linear_iterations, tolerance * rhs.l2_norm());
  x = 0.;
  try
    {
      if constexpr (std::is_same_v<Solver, SolverGMRES<VectorType>>)
        {
          SolverGMRES<VectorType> solver(control, typename Solver::AdditionalData(62, true));
          solver.solve(A, x, rhs, preconditioner);
        }
      else
        {
          SolverCG<VectorType> solver(control);
          solver.solve(A, x, rhs, preconditioner);
        }
    }
  catch (const SolverControl::NoConvergence &)
    {}
  effort.linear += control.last_step();
  free.project(x);
}

/// The better one of two guesses: the elastic answer to the change of loads and prescribed motions, and the last change continued.
template <int dim>
void StaticEquilibrium<dim>::predict(const double from, const double time, VectorType &u, Residual &residual,
                                     Effort &effort)
{
  VectorType change = dynamics.discretization.new_vector(), force = change, answer = change;
  dynamics.constraints.prescribe(change, displacement, from, time);
  evaluate(displacement, residual);
  if (!residual.valid || (small(residual) && change.linfty_norm() == 0.))
    return;
  // the internal force of what is prescribed, with the rest of the body at rest
  elastic_force(change, force);
  force += residual.force;
  const double enough = is_affine ? 0.1 * choice.tolerance : 1e-3;
  if (force.l2_norm() > 0.)
    {
      const auto K = linear_operator([&](VectorType &result, const VectorType &x) {
        elastic_force(x, result);
        result *= -1.;
      });
      solve<SolverCG<VectorType>>(K, force, enough, answer, effort);
      ++effort.newton;
    }
  u = displacement;
  u += change;
  u += answer;
  evaluate(u, residual);

  if (is_affine || last_dt == 0.)
    return;
  Residual   continued;
  VectorType other = last_change;
  other *= (time - from) / last_dt;
  dynamics.constraints.prescribe(other, displacement, from, time);
  other += displacement;
  evaluate(other, continued);
  if (continued.better_than(residual))
    {
      u.swap(other);
      std::swap(residual, continued);
    }
}

/// - J direction = residual.
template <int dim>
void StaticEquilibrium<dim>::solve_tangent(const VectorType &u, const Residual &residual, const double tolerance,
                                           VectorType &direction, Effort &effort)
{
  VectorType free_part, moved = u;
  Residual   ahead;
  if (is_affine)
    {
      VectorType zero = dynamics.discretization.new_vector();
      Residual   at_zero;
      evaluate(zero, at_zero);
      const auto K = linear_operator([&](VectorType &result, const VectorType &w) {
        evaluate(w, ahead);
        result = at_zero.force;
        result -= ahead.force;
      });
      solve<SolverCG<VectorType>>(K, residual.force, tolerance, direction, effort);
      return;
    }
  preconditioner.vmult(direction, residual.force);
  const double size = 1e-6 * std::max(u.linfty_norm(), direction.linfty_norm());
  const auto   J    = linear_operator([&](VectorType &result, const VectorType &w) {
    free_part = w;
    free.project(free_part);
    const double largest = free_part.linfty_norm();
    if (largest == 0.)
      {
        result = 0.;
        return;
      }
    const double factor = size / largest;
    moved               = u;
    moved.add(factor, free_part);
    evaluate(moved, ahead);
    result = residual.force;
    result -= ahead.force;
    result *= 1. / factor;
  });
  solve<SolverGMRES<VectorType>>(J, residual.force, tolerance, direction, effort);
}

/// Go along the direction, shorter if that does not lessen the residual. @return false if nothing does.
template <int dim>
bool StaticEquilibrium<dim>::search(VectorType &u, const VectorType &direction, Residual &residual)
{
  VectorType ahead;
  Residual   there;
  for (double length = 1.; length > 0.01; length *= 0.5)
    {
      ahead = u;
      ahead.add(length, direction);
      evaluate(ahead, there);
      if (there.valid && there.norm < (1. - 1e-4 * length) * residual.norm)
        {
          u.swap(ahead);
          std::swap(residual, there);
          return true;
        }
    }
  return false;
}

/// One step of the laws. @return whether it is in equilibrium then; otherwise the state is that of before.
template <int dim>
bool StaticEquilibrium<dim>::step_to(const double time, Effort &effort)
{
  const double       from  = state.time;
  const unsigned int first = effort.newton;
  state.time               = time;
  state.dt_last            = time - from;
  ++state.step;

  VectorType u = displacement, direction = displacement;
  Residual   residual;
  predict(from, time, u, residual, effort);
  double accuracy = 1e-2;
  while (residual.valid && !small(residual) && effort.newton < first + choice.largest_iterations)
    {
      const double before = residual.norm, wanted = 0.3 * choice.tolerance * residual.scale / residual.norm;
      solve_tangent(u, residual, is_affine ? wanted : std::max(wanted, accuracy), direction, effort);
      ++effort.newton;
      if (!search(u, direction, residual))
        break;
      // a linear solution is worth no more than the next residual (Eisenstat & Walker, choice 2)
      const double ratio = residual.norm / before;
      accuracy           = std::min(1e-2, std::max(0.9 * ratio * ratio, 1e-5));
    }
  effort.residual = residual.norm / std::max(residual.scale, std::numeric_limits<double>::min());
  if (small(residual))
    {
      evaluate(u, residual); // the points of the state are those of u
      last_change = u;
      last_change -= displacement;
      last_dt = state.dt_last;
      commit();
      return true;
    }
  restore();
  state.displacement.zero_out_ghost_values();
  state.displacement.copy_locally_owned_data_from(displacement);
  state.time = from;
  --state.step;
  return false;
}

template <int dim>
typename StaticEquilibrium<dim>::Effort StaticEquilibrium<dim>::advance_to(const double time)
{
  Effort       effort;
  const double whole = time - state.time;
  double       part  = whole;
  n_evaluations      = 0;
  while (state.time < time - 1e-12 * whole)
    {
      const double from = state.time, to = part < (1. - 1e-12) * (time - from) ? from + part : time;
      if (step_to(to, effort))
        {
          ++effort.steps;
          part = std::min(2. * part, time - state.time);
          continue;
        }
      std::ostringstream text;
      text << "t = " << from << " s: no equilibrium at " << to << " s (" << effort.residual
           << " of the forces stays out of balance)";
      part = 0.5 * (to - from);
      if (part < shortest_part * whole)
        throw PhysicsAlarm(text.str() + ". The load step cannot be divided any more: the body may have reached its "
                                        "limit load, or nothing holds it. Look at the load and the constraints there.");
      if (say)
        say(text.str() + ", the step is halved");
    }
  state.time         = time;
  state.force        = 0.;
  effort.evaluations = n_evaluations;
  return effort;
}

template <int dim>
typename StaticEquilibrium<dim>::Effort StaticEquilibrium<dim>::settle(const double dt)
{
  Effort       effort;
  const double time = state.time;
  n_evaluations     = 0;
  state.time        = time - dt;
  if (!step_to(time, effort))
    {
      std::ostringstream text;
      text << "t = " << time << " s: no equilibrium under the loads of this time (" << effort.residual
           << " of the forces stays out of balance). Begin nearer to it with 'Initial conditions / Stress = geostatic' "
              "and 'Held boundaries', or give soil without cohesion a little.";
      throw PhysicsAlarm(text.str());
    }
  effort.steps       = 1;
  effort.evaluations = n_evaluations;
  state.force        = 0.;
  return effort;
}

template <int dim>
void StaticEquilibrium<dim>::release()
{
  for (BlockState &block : state.blocks)
    block.points.quasi_static = false;
  state.dt_last       = 0.;
  state.half_velocity = 0.;
  state.force         = 0.;
}

template class StaticEquilibrium<1>;
template class StaticEquilibrium<2>;
template class StaticEquilibrium<3>;
} // namespace Arenite
