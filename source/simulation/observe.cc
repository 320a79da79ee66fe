#include <arenite/simulation/simulation.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void Simulation<dim>::reinit_receivers()
{
  StoredPointValues<dim> stored;
  if (dynamics->gives_point_values())
    stored = {[this](const State<dim> &s, const unsigned int cell, std::vector<double> &values) {
                return dynamics->point_values(s, cell, values);
              },
              dynamics->names_of_point_values()};
  scene.receivers.reinit(*dynamics, stored);
}

/// The time of the computation ends here: receivers still write, and evaluate the exact solution.
template <int dim>
void Simulation<dim>::finish_receivers()
{
  output_seconds += scene.receivers.output_seconds() * Utilities::MPI::n_mpi_processes(communicator);
  record.core_seconds        = earlier_seconds + core_seconds(begin) - output_seconds;
  record.output_core_seconds = output_seconds;
  scene.receivers.finish();
  record.errors = scene.receivers.errors();
  record.values = scene.receivers.norms();
}

template <int dim>
void Simulation<dim>::observe(const OutputDirectory &directory, const double dt, const bool last)
{
  scene.receivers.record(state);
  // Between the rows a cheap sign of trouble: the power of the last step on some process far above the energy there is.
  bool due = last || scene.statistics.is_due(state.step);
  if (!due && state.step % 10 == 0)
    due = state.step <= 50 ||
          Utilities::MPI::max(!(std::abs(step_power) * dt < 10. * known_energy) && step_power != 0. ? 1 : 0,
                              communicator) > 0;
  if (due)
    {
      const EnergyReport report = dynamics->report(state, dt);
      scene.statistics.add(report, {state.step, dt, triangulation.n_global_active_cells(), unknowns()});
      watch(report);
      watch_corners();
      known_energy = report.scale();
    }
  if (scene.pictures.enabled() && (last || scene.pictures.is_due(state.time, dt)))
    write_picture(directory);
}

template <int dim>
void Simulation<dim>::write_picture(const OutputDirectory &directory)
{
  const auto                 start = Clock::now();
  std::vector<LinearElastic> materials;
  for (const Block &block : scene.blocks)
    {
      materials.resize(std::max<std::size_t>(materials.size(), scene.blocks.size() == 1 ? 1 : block.material_id + 1));
      materials[scene.blocks.size() == 1 ? 0 : block.material_id] = block.material;
    }
  StoredFields<dim> stored;
  if (dynamics->gives_point_values())
    {
      stored.names  = dynamics->names_of_point_values();
      stored.values = [this](const unsigned int cell, std::vector<double> &values) {
        return dynamics->point_values(state, cell, values);
      };
    }
  scene.pictures.write(directory, discretization, state.displacement, dynamics->velocity(state), materials, state.time,
                       state.step, {}, stored);
  output_seconds += core_seconds(start);
}

#define ARENITE_INSTANTIATE(dim)                                                 \
  template void Simulation<dim>::reinit_receivers();                             \
  template void Simulation<dim>::finish_receivers();                             \
  template void Simulation<dim>::observe(const OutputDirectory &, double, bool); \
  template void Simulation<dim>::write_picture(const OutputDirectory &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
