#pragma once

#include <arenite/statics/elastic_preconditioner.h>

#include <functional>
#include <string>

namespace Arenite
{
/// `subsection Statics` of a scene.
struct StaticsChoice
{
  unsigned int load_steps         = 10;
  double       tolerance          = 1e-8;
  unsigned int largest_iterations = 30;
  double       settling_time      = 1.; ///< [s]

  void declare_parameters(Parameters &);
};

/// Equilibrium under loads and prescribed motions that change so slowly that nothing is accelerated. The residual is the nodal force
/// of the explicit code itself, f_int(u) + f_loads(u, t), without what planes and prescribed motions hold: kinematics, laws, hourglass
/// stiffness, hanging nodes are those of Dynamics, and a state in equilibrium stays at rest there. A load step is one step of the laws,
/// so the time of the histories is that of rates and relaxation, too; bulk viscosity is off.
///
/// Newton's method. The tangent acts on a direction w by
///
///   - J w ~ (f(u) - f(u + e w))/e,   |e w| = 1e-6 |u| in the largest entry,
///
/// which contains what law, finite strain and follower loads do to it. Round-off and curvature leave 1e-6 to 1e-5 of J w: GMRES reaches
/// what it is asked for, Newton's convergence is that of an inexact method and not visibly slower, and the equilibrium does not know
/// of the tangent. Where all blocks are linear elastic at small strain, f is affine: J w = f(0) - f(w) to round-off, symmetric, and CG
/// does it. The preconditioner is the elastic stiffness.
///
/// Where stress is found from a density of order one, forces have the round-off of a strain of order one. A residual of that size is zero.
///
/// A trial does not count: each evaluation begins from the points of the last equilibrium.
template <int dim>
class StaticEquilibrium
{
public:
  /// What a step took.
  struct Effort
  {
    unsigned int steps = 0, newton = 0, linear = 0, evaluations = 0;
    double       residual = 0.; ///< at the end, relative to the internal forces
  };

  /// @p state as Dynamics::reinit() leaves it, or in equilibrium. Velocities become zero. @p say receives lines on steps that are divided.
  StaticEquilibrium(Dynamics<dim> &, State<dim> &, const StaticsChoice &,
                    std::function<void(const std::string &)> say = {});

  /// Go to the equilibrium at @p time, in one step if it converges, otherwise in shorter ones. PhysicsAlarm if these become shorter than
  /// 1/1024 of it. Collective.
  Effort advance_to(double time);

  /// Go to the equilibrium under the loads of the present time in one step, in which @p dt passes for the laws. PhysicsAlarm if it
  /// does not converge. Collective.
  Effort settle(double dt);

  /// From now on the state is one of dynamics, at rest.
  void release();

private:
  struct Residual
  {
    VectorType force;                 ///< what is left where nodes are free [N]
    double     norm = 0., scale = 0.; ///< of the force, and of internal or external forces
    bool       valid = false;
    bool       better_than(const Residual &other) const { return valid && (!other.valid || norm < other.norm); }
  };

  bool small(const Residual &) const;
  bool step_to(double time, Effort &);
  void commit();
  void restore();
  void evaluate(const VectorType &displacement, Residual &);
  void predict(double from, double time, VectorType &u, Residual &, Effort &);
  void elastic_force(const VectorType &displacement, VectorType &force);
  bool search(VectorType &u, const VectorType &direction, Residual &);
  void solve_tangent(const VectorType &u, const Residual &, double tolerance, VectorType &direction, Effort &);
  template <typename Solver, typename Operator>
  void solve(const Operator &, const VectorType &rhs, double tolerance, VectorType &x, Effort &) const;

  Dynamics<dim>                           &dynamics;
  State<dim>                              &state;
  const StaticsChoice                      choice;
  std::function<void(const std::string &)> say;
  const bool                               is_affine;
  FreeMotion<dim>                          free;
  ElasticPreconditioner<dim>               preconditioner;

  // the last equilibrium
  std::vector<BlockState> points;
  VectorType              displacement, last_displacement, last_change;
  double                  last_dt = 0.;
  State<dim>              trial; ///< without points: blocks answer with their elastic stiffness
  unsigned int            n_evaluations = 0;
};
} // namespace Arenite
