#pragma once

#include <arenite/adaptivity/saved_cells.h>
#include <arenite/base/state_archive.h>
#include <arenite/io/checkpoint_folder.h>
#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>
#include <arenite/io/run_record.h>
#include <arenite/simulation/mesh_summary.h>
#include <arenite/simulation/scene.h>
#include <arenite/time/dynamics.h>

#include <chrono>
#include <optional>

namespace Arenite
{
/// One run of a scene: holds the members and the order of the calls.
template <int dim>
class Simulation
{
public:
  Simulation(Scene<dim> &, Log &, MPI_Comm);

  /// Mesh, unknowns, stable step and initial state, with their lines in the log. With a checkpoint the mesh and the state are those of the
  /// interrupted run, which run() goes on with.
  void set_up(const FoundCheckpoint * = nullptr);

  /// From 0 to the end time, in motion or through equilibria; writes into @p directory. Fills record(). PhysicsAlarm when the state leaves physics.
  /// @return false if it was asked to stop before; there is a checkpoint then
  bool run(const OutputDirectory &directory);

  std::map<std::string, std::string> parameters; ///< of the scene by path, for checkpoints

  std::uint64_t unknowns() const { return std::uint64_t(dim) * discretization.n_nodes(); }
  double        expected_steps() const; ///< on the present mesh

  /// Time a few steps and print what a run on the present mesh would cost, for `arenite check`; core-seconds.
  double describe_cost();

  RunRecord   record;
  Scene<dim> &scene;

private:
  using Clock = std::chrono::steady_clock;

  void                                check_blocks() const;
  void                                balance_work();
  void                                make_mesh();
  void                                start_from_rest();
  void                                load_mesh(const FoundCheckpoint &);
  void                                load_state(const FoundCheckpoint &);
  void                                write_checkpoint(const OutputDirectory &);
  void                                exchange_state(StateArchive &);
  void                                exchange_output(StateArchive &);
  void                                set_initial_state();
  std::unique_ptr<InternalForce<dim>> make_block(Block &) const;
  bool                                march(const OutputDirectory &);
  bool                                load_slowly(const OutputDirectory &);
  void                                find_equilibrium();
  void                                finish_receivers();
  void                                record_run();
  void                                describe() const;
  void                                reinit_receivers();
  bool                                adapt(double dt);
  void                                observe(const OutputDirectory &, double dt, bool last);
  void                                watch(const EnergyReport &);
  void                                watch(const PointLimits<dim> &) const;
  std::string                         describe_points(unsigned int block, unsigned int cell) const;
  void                                watch_step(double dt);
  void                                watch_corners();
  double                              fastest_node() const;
  void                                record_dissipation();
  void                                record_parts();
  void                                write_picture(const OutputDirectory &);
  double                              core_seconds(Clock::time_point since) const;

  MaterialOfBlock material_of_block() const;
  void            note_levels();

  Log                           &log;
  const MPI_Comm                 communicator;
  ParallelTriangulation<dim>     triangulation;
  Discretization<dim>            discretization;
  std::unique_ptr<Dynamics<dim>> dynamics;
  State<dim>                     state;
  double                         initial_mass = 0., output_seconds = 0., adaptation_seconds = 0.;
  double                         step_power = 0., known_energy = 0.;
  std::optional<double>          unbalanced; ///< force at rest over the weight of its node, under a geostatic stress
  unsigned int                   n_adaptations = 0, step_of_adaptation = 0;
  bool                           warned_of_step = false, warned_of_folding = false;
  CostOfCells                    cost_of_cells;
  double            cell_steps = 0., local_cell_steps = 0.; ///< updates of cells; those left with a step per level
  Clock::time_point begin;                                  ///< of the time loop
  double            earlier_seconds = 0.; ///< core-seconds of the runs that this one goes on with, without their set-up
  std::optional<SavedCells<dim>> saved;   ///< while it is loaded
  std::unique_ptr<StateArchive>  archive; ///< as well
};
} // namespace Arenite
