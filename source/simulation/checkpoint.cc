#include <arenite/simulation/simulation.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
const char *const run_file = "run.state";

std::string cells_file(const unsigned int rank) { return "cells-" + std::to_string(rank) + ".bin"; }
} // namespace

/// What the state is besides the fields of the mesh, in both directions.
template <int dim>
void Simulation<dim>::exchange_state(StateArchive &archive)
{
  archive.common(state.time);
  archive.common(state.dt_last);
  archive.common(state.step);
  for (BlockState &block : state.blocks)
    block.points.exchange(archive);
  dynamics->balance.exchange(archive);
  dynamics->momentum_balance.exchange(archive);
  scene.time_step.exchange(archive);
  scene.adaptor.exchange(archive);
  for (const auto &load : dynamics->loads)
    load->exchange(archive);
  archive.sum(step_power);
  for (double *value :
       {&cell_steps, &local_cell_steps, &known_energy, &initial_mass, &output_seconds, &adaptation_seconds,
        &record.mass_error, &record.momentum_error, &record.dof_steps, &record.most_cells})
    archive.common(*value);
  double in_the_loop =
    archive.loads() ? 0. : earlier_seconds + core_seconds(begin); // with output, which is counted alone
  archive.common(in_the_loop);
  if (archive.loads())
    earlier_seconds = in_the_loop;
  archive.common(n_adaptations);
  archive.common(step_of_adaptation);
  archive.common(warned_of_step);
  archive.common(warned_of_folding);
}

/// How far the files of the run are.
template <int dim>
void Simulation<dim>::exchange_output(StateArchive &archive)
{
  scene.receivers.exchange(archive);
  scene.statistics.exchange(archive);
  scene.pictures.exchange(archive);
}

template <int dim>
void Simulation<dim>::write_checkpoint(const OutputDirectory &directory)
{
  const auto         start = Clock::now();
  const unsigned int rank  = Utilities::MPI::this_mpi_process(communicator);
  StateArchive       collected(communicator);
  exchange_state(collected);
  exchange_output(collected);
  const auto write_cells = SavedCells<dim>::writer(*dynamics, state, {&scene.time_step.ratio, &scene.adaptor.trail});

  NewCheckpoint folder(directory);
  folder.add(cells_file(rank), write_cells);
  if (rank == 0)
    folder.add(run_file, [&](std::ostream &file) { file << collected.bytes(); });
  CheckpointManifest manifest;
  manifest.step             = state.step;
  manifest.time             = state.time;
  manifest.parameters       = parameters;
  const std::uint64_t bytes = folder.finish(manifest);

  const double seconds = core_seconds(start);
  output_seconds += seconds;
  scene.checkpoints.note_checkpoint(seconds / Utilities::MPI::n_mpi_processes(communicator));
  std::ostringstream text;
  text.precision(3);
  text << "Checkpoint t = " << state.time << " s, step " << state.step << ": " << 1e-6 * bytes << " MB in " << seconds
       << " core-seconds";
  log.line(text.str());
}

template <int dim>
void Simulation<dim>::load_mesh(const FoundCheckpoint &checkpoint)
{
  std::vector<std::string> files;
  for (unsigned int rank = 0; rank < checkpoint.manifest.ranks; ++rank)
    files.push_back(checkpoint.file(cells_file(rank)));
  saved.emplace(files, communicator);
  saved->make_mesh(triangulation);
  discretization.distribute_nodes();
  saved->read(discretization);
}

template <int dim>
void Simulation<dim>::load_state(const FoundCheckpoint &checkpoint)
{
  saved->set_fields(*dynamics, state, {&scene.time_step.ratio, &scene.adaptor.trail});
  saved.reset();
  std::ifstream     file(checkpoint.file(run_file), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  archive = std::make_unique<StateArchive>(bytes, communicator);
  exchange_state(*archive);
}

#define ARENITE_INSTANTIATE(dim)                                            \
  template void Simulation<dim>::exchange_state(StateArchive &);            \
  template void Simulation<dim>::exchange_output(StateArchive &);           \
  template void Simulation<dim>::write_checkpoint(const OutputDirectory &); \
  template void Simulation<dim>::load_mesh(const FoundCheckpoint &);        \
  template void Simulation<dim>::load_state(const FoundCheckpoint &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
