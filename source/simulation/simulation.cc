#include <arenite/base/errors.h>
#include <arenite/base/values.h>
#include <arenite/io/error_norms.h>
#include <arenite/simulation/block_summary.h>
#include <arenite/simulation/initial_stress.h>
#include <arenite/simulation/resolution.h>
#include <arenite/simulation/simulation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
Simulation<dim>::Simulation(Scene<dim> &scene, Log &log, const MPI_Comm communicator)
  : scene(scene)
  , log(log)
  , communicator(communicator)
  , triangulation(communicator)
  , discretization(triangulation, scene.element.degree, scene.symmetry)
{}

template <int dim>
double Simulation<dim>::core_seconds(const Clock::time_point since) const
{
  return std::chrono::duration<double>(Clock::now() - since).count() * Utilities::MPI::n_mpi_processes(communicator);
}

/// The mesh of the start.
template <int dim>
void Simulation<dim>::make_mesh()
{
  const double cells = triangulation.n_global_active_cells() * std::pow(2., dim * scene.mesh.refinement);
  if (cells * std::pow(scene.element.degree, dim) * dim > 4.2e9)
    throw InputError("[Mesh] Refinement = " + std::to_string(scene.mesh.refinement) +
                     " gives more than 4.2e9 unknowns, the limit of 32-bit numbering. Use a coarser mesh.");
  triangulation.refine_global(scene.mesh.refinement);

  std::vector<types::boundary_id> loaded = scene.constraints.driven_boundaries();
  for (const auto &load : scene.loads)
    for (const auto id : load->loaded_boundaries())
      loaded.push_back(id);
  scene.adaptor.initial_refinement(triangulation, discretization, loaded);
}

template <int dim>
void Simulation<dim>::start_from_rest()
{
  scene.time_step.calibrate(*dynamics);
  scene.adaptor.schedule(*dynamics);
  set_initial_state();
  scene.time_step.limit_first(std::max(fastest_node(), scene.constraints.largest_speed(0.)));
  initial_mass = dynamics->total_mass();
}

template <int dim>
void Simulation<dim>::set_up(const FoundCheckpoint *const checkpoint)
{
  const auto start = Clock::now();
  scene.mesh.geometry->create(triangulation);
  check_blocks();
  balance_work();
  if (checkpoint)
    load_mesh(*checkpoint);
  else
    make_mesh();

  std::vector<std::unique_ptr<InternalForce<dim>>> blocks;
  for (Block &block : scene.blocks)
    blocks.push_back(make_block(block));
  dynamics = std::make_unique<Dynamics<dim>>(discretization, std::move(blocks), std::move(scene.loads),
                                             scene.constraints, material_of_block());
  if (scene.timed)
    dynamics->cost.emplace();
  dynamics->reinit(state, checkpoint == nullptr);
  if (checkpoint)
    load_state(*checkpoint);
  else
    start_from_rest();
  record.setup_core_seconds = core_seconds(start);
  describe();
}

template <int dim>
std::unique_ptr<InternalForce<dim>> Simulation<dim>::make_block(Block &block) const
{
  const types::material_id id = scene.blocks.size() == 1 ? numbers::invalid_material_id : block.material_id;
  if (!block.law)
    return make_elastic_force<dim>(scene.element, block.material, id, scene.symmetry);
  for (const std::string &warning : block.law->warnings())
    log << "Warning    block '" << block.name << "': " << warning << '\n';
  if (scene.element.degree > 1 && !block.law->history_names().empty())
    log << "Warning    block '" << block.name << "' remembers what it went through, and elements of degree "
        << scene.element.degree << " overshoot at shocks, for good. Degree 1 does not.\n";
  const auto names = block.law->history_names();
  if (scene.element.linear_viscosity < 0.3 && std::find(names.begin(), names.end(), "largest density") != names.end())
    log << "Warning    block '" << block.name
        << "' keeps its largest density: where a front overshoots, which a linear bulk viscosity of "
        << scene.element.linear_viscosity
        << " does not prevent in a compacting soil, that stays. 0.6 with a quadratic one of 2 does.\n";
  return make_law_force<dim>(scene.element, scene.kinematics, std::move(block.law), id, scene.symmetry);
}

/// Cells of blocks with laws take longer than fused elastic ones.
template <int dim>
void Simulation<dim>::balance_work()
{
  std::map<types::material_id, unsigned int> cost;
  std::set<unsigned int>                     different;
  for (const Block &block : scene.blocks)
    different.insert(cost[block.material_id] = !block.law                           ? CellCost::elastic
                                               : block.law->history_names().empty() ? CellCost::law
                                                                                    : CellCost::law_with_memory);
  cost_of_cells = [cost, only = scene.blocks.size() == 1](const types::material_id id) {
    return only ? cost.begin()->second : cost.at(id);
  };
  if (different.size() > 1)
    divide_by_cost(triangulation, cost_of_cells);
}

/// The present mesh has served since the last adaptation.
template <int dim>
void Simulation<dim>::note_levels()
{
  const double updates = double(state.step - step_of_adaptation) * triangulation.n_global_active_cells();
  record.most_cells    = std::max(record.most_cells, double(triangulation.n_global_active_cells()));
  cell_steps += updates;
  local_cell_steps += updates * share_of_updates(triangulation);
}

/// Every cell needs a block and every block a cell; a single block takes all cells.
template <int dim>
void Simulation<dim>::check_blocks() const
{
  if (scene.blocks.size() == 1)
    return;
  std::set<types::material_id> in_mesh;
  for (const auto &cell : triangulation.active_cell_iterators()) // the coarse mesh, the same on all processes
    if (!cell->is_artificial())
      in_mesh.insert(cell->material_id());
  std::vector<unsigned int> local(in_mesh.begin(), in_mesh.end());
  for (const auto &ids : Utilities::MPI::all_gather(communicator, local))
    in_mesh.insert(ids.begin(), ids.end());
  std::string            ids;
  std::set<unsigned int> with_block;
  for (const auto id : in_mesh)
    ids += (ids.empty() ? "" : ", ") + std::to_string(id);
  for (const Block &block : scene.blocks)
    {
      with_block.insert(block.material_id);
      if (in_mesh.count(block.material_id) == 0)
        throw InputError("[Materials / " + block.name + "] Material id = " + std::to_string(block.material_id) +
                         ": no cell of the mesh has it; the mesh has the ids " + ids + ".");
    }
  for (const auto id : in_mesh)
    if (with_block.count(id) == 0)
      throw InputError("[Materials]: the mesh has cells with the material ids " + ids +
                       ", but no block has 'Material id = " + std::to_string(id) + "'.");
}

template <int dim>
void Simulation<dim>::set_initial_state()
{
  if (scene.initial_state == "exact solution")
    for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
      {
        const auto u = scene.exact_solution->displacement(discretization.position(node), 0.);
        const auto v = scene.exact_solution->velocity(discretization.position(node), 0.);
        for (unsigned int c = 0; c < dim; ++c)
          {
            state.displacement.local_element(dim * node + c)  = u[c];
            state.half_velocity.local_element(dim * node + c) = v[c];
          }
      }
  else
    scene.initial_velocity.apply(*dynamics, state);
  scene.initial_energy.apply(*dynamics, state);
  scene.constraints.project(state.half_velocity);
  zero_at_hanging_nodes(discretization, state.half_velocity);
  make_consistent(discretization, state.displacement); // the energy of the start needs ghosts and hanging nodes
  if (scene.stress_at_rest.is_wanted())
    {
      std::vector<std::string> names;
      for (const Block &block : scene.blocks)
        names.push_back(block.name);
      begin_under_stress(scene.stress_at_rest, *dynamics, state, names);
    }
  const bool settles = scene.initial_state == "equilibrium";
  if (settles)
    find_equilibrium();
  if (scene.stress_at_rest.is_wanted())
    unbalanced = unbalanced_part(scene.stress_at_rest, settles, *dynamics, state);
}

/// Speed of the fastest node of all processes [m/s].
template <int dim>
double Simulation<dim>::fastest_node() const
{
  double largest = 0.;
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    {
      double square = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        square += std::pow(state.half_velocity.local_element(dim * node + c), 2);
      largest = std::max(largest, square);
    }
  return std::sqrt(Utilities::MPI::max(largest, communicator));
}

template <int dim>
void Simulation<dim>::describe() const
{
  const unsigned int ranks = Utilities::MPI::n_mpi_processes(communicator);
  std::ostringstream text;
  text << "Mesh       " << (dim < 3 ? name(scene.symmetry) + ", " : "") << scene.mesh.type << ", "
       << triangulation.n_global_active_cells() << " cells, refinement " << scene.mesh.refinement;
  if (scene.adaptor.active())
    text << " + up to " << scene.adaptor.max_passes();
  text << ", " << ranks << (ranks == 1 ? " process" : " processes") << '\n'
       << "Unknowns   " << unknowns() << ", " << scene.element.type << " of degree " << scene.element.degree << '\n';
  const auto manifolds = triangulation.get_manifold_ids();
  if (scene.adaptor.active() && scene.element.degree == 1 && !scene.mesh.refine_geometry &&
      std::any_of(manifolds.begin(), manifolds.end(), [](const auto id) { return id != numbers::flat_manifold_id; }))
    text << "Geometry   new nodes stay on the flat faces of the first mesh; 'Mesh / Refine geometry' puts them on "
            "curved surfaces\n";
  if (ranks > 1)
    text << "Processes  " << describe_partition(discretization, cost_of_cells) << '\n';
  for (unsigned int b = 0; b < scene.blocks.size(); ++b)
    {
      const LinearElastic &m = scene.blocks[b].material;
      text << "Block      " << scene.blocks[b].name << ": " << scene.blocks[b].law_name << ", "
           << dynamics->blocks[b]->description() << "; cp = " << m.p_wave_speed() << " m/s, cs = " << m.s_wave_speed()
           << " m/s\n";
      scene.blocks[b].constants.for_each_constant([&](const char *name, const double value, const std::string &unit) {
        text << "           " << name << ' ' << value << (has_unit(unit) ? " " + unit : "") << '\n';
      });
    }
  for (const auto &load : dynamics->loads)
    text << "Load       " << load->name << ": " << load->description() << '\n';
  text << scene.initial_velocity.description();
  if (unbalanced)
    text << "Rest       largest force on a node at the start: " << *unbalanced << " of its weight\n";
  text << "Mass       " << initial_mass * scene.mesh.geometry->symmetry_factor() << " kg" << per_extent(scene.symmetry)
       << " of the full body; boundaries: " << join(scene.mesh.geometry->boundary_names()) << '\n';
  if (scene.is_static())
    text << "Statics    " << scene.statics.load_steps << (scene.statics.load_steps == 1 ? " load step" : " load steps")
         << " to " << scene.end_time << " s, each to " << scene.statics.tolerance << " of the forces";
  else
    text << "Step       stable up to " << scene.time_step.limit() << " s (cell at " << scene.time_step.limiting_place()
         << "), about " << expected_steps() << " steps of " << scene.end_time / expected_steps() << " s";
  log << text.str() << '\n';
}

template <int dim>
MaterialOfBlock Simulation<dim>::material_of_block() const
{
  return [this](const types::material_id id) {
    for (const Block &block : scene.blocks)
      if (scene.blocks.size() == 1 || block.material_id == id)
        return block.material;
    return scene.blocks.front().material;
  };
}

template <int dim>
double Simulation<dim>::expected_steps() const
{
  if (scene.is_static())
    return scene.statics.load_steps;
  return std::ceil(scene.end_time / scene.time_step.usual());
}

template <int dim>
double Simulation<dim>::describe_cost()
{
  // the fastest of a few force evaluations; the update and the ledgers add about a tenth
  double fastest = std::numeric_limits<double>::max();
  for (unsigned int i = 0; i < 10; ++i)
    {
      for (BlockState &block : state.blocks)
        block.points.step = numbers::invalid_unsigned_int; // the law is part of a step
      const auto start = Clock::now();
      dynamics->compute_force(state);
      fastest     = std::min(fastest, core_seconds(start));
      state.force = 0.;
    }
  const double steps = expected_steps(), expected = 1.1 * steps * fastest;
  record.measure_memory(communicator);
  std::ostringstream text;
  text.precision(3);
  if (scene.is_static()) // how many iterations equilibria take nobody knows before
    text << "Cost       " << fastest
         << " core-seconds for an iteration on this mesh; ten to some hundred are usual in each of "
         << scene.statics.load_steps << " load steps";
  else
    text << "Cost       about " << expected << " core-seconds for the time loop on this mesh, "
         << std::lround(record.total_memory_mb) << " MB of memory";
  if (scene.adaptor.active())
    {
      const double finest = triangulation.n_global_coarse_cells() *
                            std::pow(2., dim * (scene.mesh.refinement + scene.adaptor.max_passes()));
      text << "\nAdaptive   " << triangulation.n_global_active_cells() << " cells now, " << std::uint64_t(finest)
           << " if all were fine";
    }
  if (scene.pictures.enabled())
    text << "\nOutput     " << scene.pictures.expected_pictures(scene.end_time) << " pictures of at most "
         << 1e-6 * scene.pictures.expected_bytes(discretization) << " MB each before compression";
  log.line(text.str());
  if (scene.is_static())
    return expected;
  double slowest = std::numeric_limits<double>::max();
  for (const Block &block : scene.blocks)
    slowest = std::min(slowest, block.material.s_wave_speed());
  log << describe_resolution(triangulation, *dynamics, scene.element, slowest, scene.end_time, communicator);
  return expected;
}

template <int dim>
bool Simulation<dim>::run(const OutputDirectory &directory)
{
  if (scene.is_static())
    return load_slowly(directory);
  const FileStart files = archive ? FileStart::resumed : FileStart::fresh;
  reinit_receivers();
  scene.receivers.open(directory.path(), 0., scene.end_time, scene.exact_solution.get(), files);
  scene.statistics.open(directory, log, state.time, scene.end_time, scene.mesh.geometry->symmetry_factor(),
                        per_extent(scene.symmetry), files);
  if (archive)
    {
      exchange_output(*archive);
      archive.reset();
    }
  else
    {
      if (dynamics->stores_points()) // what the points store at rest, or in a state that they are set into
        {
          dynamics->compute_force(state);
          watch(dynamics->point_limits(state));
          state.force = 0.;
        }
      dynamics->balance.set_initial(dynamics->total_energy(state, 0.));
      dynamics->momentum_balance.set_initial(state, dynamics->mass, communicator);
    }
  scene.checkpoints.start(directory, state.step);

  begin = Clock::now();
  bool is_complete;
  try
    {
      is_complete = march(directory);
    }
  catch (const PhysicsAlarm &alarm) // keep what was recorded on the way there
    {
      scene.receivers.finish();
      scene.statistics.finish();
      log.to_file(alarm.what());
      throw;
    }
  finish_receivers();
  scene.statistics.finish();
  if (!is_complete)
    return false;
  record_run();
  record.energy_error            = dynamics->balance.largest_error();
  record.impulse_error           = dynamics->momentum_balance.largest_error();
  record.adaptation_core_seconds = adaptation_seconds;
  if (n_adaptations > 0)
    log << "Adapted    " << n_adaptations << " times in " << adaptation_seconds << " core-seconds ("
        << 100. * adaptation_seconds / record.core_seconds << " % of the run); the front met "
        << scene.adaptor.coarse_cells_met() << " cells before they were refined\n";
  note_levels();
  if (local_cell_steps < 0.99 * cell_steps)
    log << "Levels     with a step of their own " << 100. * local_cell_steps / cell_steps
        << " % of the updates of cells would be left\n";
  if (n_adaptations > 0 && Utilities::MPI::n_mpi_processes(communicator) > 1)
    log << "Processes  " << describe_partition(discretization, cost_of_cells) << '\n';
  return true;
}

/// What the run was, and how far it is from the exact solution.
template <int dim>
void Simulation<dim>::record_run()
{
  record.dimension       = dim;
  record.symmetry        = name(scene.symmetry);
  record.element         = scene.element.type;
  record.degree          = scene.element.degree;
  record.cells           = triangulation.n_global_active_cells();
  record.dofs            = unknowns();
  record.steps           = state.step;
  record.time            = state.time;
  record.symmetry_factor = scene.mesh.geometry->symmetry_factor();
  if (scene.exact_solution && scene.exact_solution->is_field())
    {
      record.errors.merge(volume_errors(discretization, material_of_block(), state.displacement,
                                        dynamics->velocity(state), *scene.exact_solution, state.time));
      std::vector<types::boundary_id> loaded;
      for (const auto &load : dynamics->loads)
        for (const auto id : load->loaded_boundaries())
          loaded.push_back(id);
      if (!loaded.empty())
        record.errors.merge(traction_error(discretization, material_of_block(), state.displacement, loaded,
                                           *scene.exact_solution, state.time));
    }
  record_dissipation();
  record_parts();
}

/// What the points dissipated, for run.json and the log.
template <int dim>
void Simulation<dim>::record_dissipation()
{
  const BlockEnergy   own = dynamics->stored_energy(state);
  std::vector<double> sums{own.dissipated, own.bulk_viscosity, own.hourglass};
  Utilities::MPI::sum(sums, communicator, sums);
  record.dissipation            = record.symmetry_factor * sums[0];
  record.artificial_dissipation = record.symmetry_factor * sums[1];
  record.hourglass_energy       = record.symmetry_factor * sums[2];
  std::vector<std::string> names;
  for (const Block &block : scene.blocks)
    names.push_back(block.name);
  log << describe_blocks(*dynamics, state, names, record.symmetry_factor);
}

/// Where the time of the steps went.
template <int dim>
void Simulation<dim>::record_parts()
{
  if (!dynamics->cost)
    return;
  const StepCost &cost = *dynamics->cost;
  double          law = 0., scatter = 0.;
  for (const BlockState &block : state.blocks)
    {
      law += block.points.law_seconds;
      scatter += block.points.scatter_seconds;
    }
  std::vector<double> sums{law, scatter, cost.cells - law - scatter, cost.exchange, cost.loads, cost.update};
  Utilities::MPI::sum(sums, communicator, sums);
  record.parts = {{"laws", sums[0]},
                  {"gather and scatter", sums[1]},
                  {"strain and nodal forces", sums[2]},
                  {"exchange", sums[3]},
                  {"loads", sums[4]},
                  {"step", sums[5]}};
  double rest  = record.core_seconds;
  for (const auto &part : record.parts)
    rest -= part.second;
  record.parts["receivers, ledgers and the rest"] = rest;
}

/// @return false if asked to stop before the end time
template <int dim>
bool Simulation<dim>::march(const OutputDirectory &directory)
{
  const bool follows_points = dynamics->stores_points();
  while (true)
    {
      // before the first step there is nothing to keep, and points know no step that is stable
      if (const Wish wish = state.step > 0 ? scene.checkpoints.ask(state.step) : Wish::nothing; wish != Wish::nothing)
        {
          write_checkpoint(directory);
          if (wish == Wish::stop)
            return false;
        }
      double     crossing = std::numeric_limits<double>::infinity();
      const bool last     = state.time >= scene.end_time * (1. - 1e-12);
      dynamics->compute_force(state);
      if (follows_points)
        {
          const PointLimits<dim> limits = dynamics->point_limits(state);
          watch(limits);
          scene.time_step.follow(limits.stable_step);
          crossing = limits.crossing;
        }
      scene.adaptor.follow(state.dt_last, crossing);
      double dt = last ? state.dt_last : scene.time_step.next(state.time, scene.end_time, state.dt_last);
      if (!last)
        watch_step(dt);
      dynamics->close_force(state, dt);
      if (!last && scene.adaptor.due() && adapt(dt))
        dt = scene.time_step.next(state.time, scene.end_time, state.dt_last);
      observe(directory, dt, last);
      if (last)
        return true;
      step_power = dynamics->advance(state, dt);
      record.dof_steps += dim * double(discretization.n_nodes());
    }
}

template <int dim>
bool Simulation<dim>::adapt(const double dt_old)
{
  const auto                    start = Clock::now();
  std::optional<Conserved<dim>> before;
  for (unsigned int pass = 0; pass < scene.adaptor.max_passes(); ++pass)
    {
      if (!scene.adaptor.mark(triangulation, *dynamics, state, pass))
        break;
      if (!before)
        {
          before = dynamics->conserved(state, dt_old);
          note_levels();
        }
      scene.adaptor.execute(triangulation, *dynamics, state, scene.time_step);
      dynamics->compute_force(state);
    }
  if (before)
    {
      scene.time_step.update(*dynamics, state.step - step_of_adaptation); // as many as the mesh before had
      step_of_adaptation = state.step;
      if (dynamics->stores_points())
        scene.time_step.follow(dynamics->point_limits(state).stable_step);
      const double dt = scene.time_step.next(state.time, scene.end_time, state.dt_last);
      dynamics->close_force(state, dt, false);
      const Conserved<dim> after = dynamics->conserved(state, dt);
      dynamics->balance.add_adaptation(after.energy - before->energy);
      dynamics->momentum_balance.add_adaptation(after.momentum - before->momentum);
      record.mass_error = std::max(record.mass_error, std::abs(after.mass - before->mass) / initial_mass);
      if (after.momentum_scale > 0.)
        record.momentum_error =
          std::max(record.momentum_error, (after.momentum - before->momentum).norm() / after.momentum_scale);
      reinit_receivers();
      ++n_adaptations;
    }
  scene.adaptor.schedule(*dynamics);
  adaptation_seconds += core_seconds(start);
  return before.has_value();
}

template class Simulation<1>;
template class Simulation<2>;
template class Simulation<3>;
} // namespace Arenite
