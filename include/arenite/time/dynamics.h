#pragma once

#include <arenite/mechanics/internal_force.h>
#include <arenite/time/central_difference.h>
#include <arenite/time/energy_balance.h>
#include <arenite/time/momentum_balance.h>
#include <arenite/time/node_damping.h>

#include <optional>

namespace Arenite
{
/// What a change of the mesh should leave alone, of the modelled sector and summed over processes.
template <int dim>
struct Conserved
{
  double                 mass   = 0.;         ///< [kg]
  double                 energy = 0.;         ///< kinetic and stored [J]
  dealii::Tensor<1, dim> momentum;            ///< [kg m/s]
  double                 momentum_scale = 0.; ///< sum of m |v_c| over nodes and components [kg m/s]
};

/// What the points of all blocks say about the last step, over all processes.
template <int dim>
struct PointLimits
{
  double stable_step = 0.;    ///< [s]
  double crossing    = 0.;    ///< time in which a P wave crosses the smallest cell, for a cube: 2 sqrt(dim)/omega [s]
  bool   failed      = false; ///< some point is inverted or not finite
  int    failed_rank = -1;
};

/// Wall time of this process in the parts of its steps [s].
struct StepCost
{
  double cells    = 0.; ///< strain, laws, nodal forces
  double exchange = 0.; ///< between processes, and with hanging nodes; waiting included
  double loads    = 0.;
  double update   = 0.; ///< dashpots, constraints, the step itself and its work
};

/// The semi-discrete equations M a = f_int(u) + f_loads(u, v, t) of one mesh, and one step through them:
///
///   dynamics.compute_force(state);      // f_n: internal forces and loads
///   dynamics.close_force(state, dt);    // dashpots and constraints, first half of the work at t_n
///   dynamics.report(state, dt);         // optional: energies at t_n. Here observers look at u_n, v_n and f_n
///   dynamics.advance(state, dt);        // u_{n+1}, v_{n+1/2}, second half of the work
template <int dim>
class Dynamics
{
public:
  Dynamics(Discretization<dim> &discretization, std::vector<std::unique_ptr<InternalForce<dim>>> blocks,
           std::vector<std::unique_ptr<Load<dim>>> loads, Constraints<dim> &constraints,
           const MaterialOfBlock &material_of_block = {});

  /// Rebuild everything that depends on the mesh; sizes the state, keeps its time. What points store is at rest, or without @p at_rest
  /// waits for what comes from another mesh.
  void reinit(State<dim> &, bool at_rest = true);

  /// state.force = f_n. Ghost exchange runs beside the cells that do not need it, unless @p overlap is off.
  void compute_force(State<dim> &, bool overlap = true);

  /// state.force = f_int(u) alone, with the displacement's ghosts and hanging nodes valid afterwards.
  void compute_internal_force(State<dim> &, bool overlap = true);

  /// Apply dashpots and constraints for the coming step and book the work of f_n over the half step behind. After a change of the
  /// mesh that half was already booked with the old forces: @p book_first_half = false.
  void close_force(State<dim> &, double dt, bool book_first_half = true);

  /// Energies and momentum at t_n, between close_force() and advance(). Collective.
  EnergyReport report(const State<dim> &, double dt);

  /// Forces of t_n from outside on the nodes of this process, after close_force(): loads, dashpots, constraints. By boundary.
  Resultants<dim> external_forces();

  /// Kinetic and stored energy at t_n, summed over processes, without an entry in the balance. Collective.
  double total_energy(const State<dim> &, double dt) const;

  /// u_{n+1}, v_{n+1/2}; consumes the force. @return f_n . v_{n+1/2} of this process [W].
  double advance(State<dim> &, double dt);

  /// Sum of the blocks' energies on this process.
  BlockEnergy stored_energy(const State<dim> &) const;

  /// v_n = v_{n-1/2} + dt_{n-1}/2 M^-1 f_n with ghosts and hanging nodes, between close_force() and advance().
  VectorType velocity(const State<dim> &) const;

  /// Whether some block stores stress and history.
  bool stores_points() const;

  /// Of the step that led to the present forces. Collective.
  PointLimits<dim> point_limits(const State<dim> &);

  /// InternalForce::point_values() of the block of an owned cell, in the order of the names of all blocks, zero for what a block does
  /// not have; false where the stress follows from the displacement.
  bool                     point_values(const State<dim> &, unsigned int cell, std::vector<double> &values) const;
  std::vector<std::string> names_of_point_values() const;
  bool                     gives_point_values() const;

  /// Total mass of the modelled sector [kg].
  double total_mass() const;

  /// Mass, energy and momentum at t_n, between close_force() and advance(). Collective.
  Conserved<dim> conserved(const State<dim> &, double dt) const;

  Discretization<dim>                             &discretization;
  std::vector<std::unique_ptr<InternalForce<dim>>> blocks;
  std::vector<std::unique_ptr<Load<dim>>>          loads;
  Constraints<dim>                                &constraints;
  EnergyBalance                                    balance;
  MomentumBalance<dim>                             momentum_balance;
  VectorType                                       mass; ///< per node [kg], zero at hanging nodes
  MaterialOfBlock                                  material_of_block;
  std::optional<StepCost>                          cost; ///< measured if it is there; set it before reinit()

private:
  void book_work(const State<dim> &, double half_step);

  NodeDamping<dim> damping;
  Resultants<dim>  of_load; ///< of one after the other, in a step that allocates nothing
};
} // namespace Arenite
