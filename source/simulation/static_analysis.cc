#include <arenite/base/errors.h>
#include <arenite/loads/support_at_rest.h>
#include <arenite/simulation/simulation.h>
#include <arenite/statics/static_equilibrium.h>

#include <sstream>

namespace Arenite
{
/// From equilibrium to equilibrium, with a row of the receivers and a line of the log at each.
template <int dim>
bool Simulation<dim>::load_slowly(const OutputDirectory &directory)
{
  reinit_receivers();
  scene.receivers.open(directory.path(), 0., scene.end_time, scene.exact_solution.get());
  begin = Clock::now();
  StaticEquilibrium<dim> equilibrium(*dynamics, state, scene.statics,
                                     [this](const std::string &text) { log.line("Warning    " + text); });
  scene.receivers.record(state);
  try
    {
      const double dt = scene.end_time / scene.statics.load_steps;
      for (unsigned int step = 1; step <= scene.statics.load_steps; ++step)
        {
          const bool last   = step == scene.statics.load_steps;
          const auto effort = equilibrium.advance_to(last ? scene.end_time : step * dt);
          record.newton_iterations += effort.newton;
          record.linear_iterations += effort.linear;
          record.dof_steps += dim * double(discretization.n_nodes()) * effort.evaluations;
          std::ostringstream text;
          text << "Load step  " << step << ", t = " << state.time << " s: " << effort.newton << " Newton, "
               << effort.linear << " linear iterations, out of balance " << effort.residual;
          log.line(text.str());
          scene.receivers.record(state);
          if (scene.pictures.enabled() && (last || scene.pictures.is_due(state.time, dt)))
            write_picture(directory);
        }
    }
  catch (const PhysicsAlarm &alarm) // keep what was recorded on the way there
    {
      scene.receivers.finish();
      log.to_file(alarm.what());
      throw;
    }
  equilibrium.release();
  finish_receivers();
  record_run();
  record.is_static = true;
  return true;
}

namespace
{
template <int dim>
SupportAtRest<dim> *find_support(const Dynamics<dim> &dynamics)
{
  for (const auto &load : dynamics.loads)
    if (auto *support = dynamic_cast<SupportAtRest<dim> *>(load.get()))
      return support;
  return nullptr;
}

/// What the supports hold of the present state, which goes on as a load.
template <int dim>
void keep_support(SupportAtRest<dim> &support, const bool along_normals, Dynamics<dim> &dynamics, State<dim> &state)
{
  state.force = 0.;
  dynamics.compute_force(state);
  VectorType reactions = state.force, free = state.force;
  dynamics.constraints.project(free);
  dynamics.constraints.hold({}, false);
  dynamics.constraints.reinit(dynamics.discretization);
  reactions -= free;
  dynamics.constraints.project(reactions); // planes and fixed boundaries go on holding what is theirs
  reactions *= -1.;
  support.take_up(reactions, along_normals);
  state.force = 0.;
}
} // namespace

/// The start of a dynamic run: the equilibrium under the loads of t = 0, from the stress that the points have.
template <int dim>
void Simulation<dim>::find_equilibrium()
{
  SupportAtRest<dim> *const support = find_support(*dynamics);
  if (support)
    {
      scene.constraints.hold(support->boundaries(), scene.support_at_rest == "fixed");
      scene.constraints.reinit(discretization);
    }
  StaticEquilibrium<dim> equilibrium(*dynamics, state, scene.statics);
  const auto             effort = equilibrium.settle(scene.statics.settling_time);
  equilibrium.release();
  state.step = 0;
  for (BlockState &block : state.blocks)
    {
      block.points.step       = 0;
      block.points.dissipated = block.points.viscous_work = block.points.volume_change = 0.; // before the start
    }
  if (support)
    keep_support(*support, scene.support_at_rest == "rollers", *dynamics, state);
  std::ostringstream text;
  text << "Equilibrium of the start: " << effort.newton << " Newton, " << effort.linear << " linear iterations, "
       << effort.residual << " of the forces out of balance";
  log.line(text.str());
}

#define ARENITE_INSTANTIATE(dim)                                       \
  template bool Simulation<dim>::load_slowly(const OutputDirectory &); \
  template void Simulation<dim>::find_equilibrium();
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
