#pragma once

#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>
#include <arenite/io/run_record.h>
#include <arenite/simulation/scene.h>
#include <arenite/time/dynamics.h>

#include <chrono>

namespace Arenite
{
/// One run of a scene: holds the members and the order of the calls.
template <int dim>
class Simulation
{
public:
  Simulation(Scene<dim> &, Log &, MPI_Comm);

  /// Mesh, unknowns, stable step and initial state, with their lines in the log.
  void set_up();

  /// From 0 to the end time; writes into @p directory. Fills record(). PhysicsAlarm when the state leaves physics.
  void run(const OutputDirectory &directory);

  std::uint64_t unknowns() const { return std::uint64_t(dim) * discretization.n_nodes(); }
  double        expected_steps() const; ///< on the present mesh

  /// Time a few steps and print what a run would cost, for `arenite check`.
  void describe_cost();

  RunRecord   record;
  Scene<dim> &scene;

private:
  using Clock = std::chrono::steady_clock;

  void                                check_blocks() const;
  void                                set_initial_state();
  std::unique_ptr<InternalForce<dim>> make_block(Block &) const;
  void                                march(const OutputDirectory &);
  void                                describe() const;
  void                                reinit_receivers();
  bool                                adapt(double dt);
  void                                observe(const OutputDirectory &, double dt, bool last);
  void                                watch(const EnergyReport &);
  void                                watch(const PointLimits<dim> &) const;
  std::string                         describe_points(unsigned int block, unsigned int cell) const;
  void                                watch_step(double dt);
  double                              fastest_node() const;
  void                                record_dissipation();
  void                                record_parts();
  void                                write_picture(const OutputDirectory &);
  double                              core_seconds(Clock::time_point since) const;

  MaterialOfBlock material_of_block() const;

  Log                           &log;
  const MPI_Comm                 communicator;
  ParallelTriangulation<dim>     triangulation;
  Discretization<dim>            discretization;
  std::unique_ptr<Dynamics<dim>> dynamics;
  State<dim>                     state;
  double                         initial_mass = 0., output_seconds = 0., adaptation_seconds = 0.;
  double                         step_power = 0., known_energy = 0.;
  unsigned int                   n_adaptations  = 0;
  bool                           warned_of_step = false;
};
} // namespace Arenite
