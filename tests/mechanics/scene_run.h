#pragma once

#include <arenite/simulation/simulation.h>

#include <filesystem>
#include <string>
#include <vector>

namespace Arenite::Test
{
/// Run a scene quietly, into a directory that is removed again.
template <int dim>
RunRecord run_scene_in(Parameters &parameters)
{
  Scene<dim>         scene(parameters);
  Log                log(MPI_COMM_SELF);
  std::ostringstream screen;
  auto *const        old = std::cout.rdbuf(screen.rdbuf());
  Simulation<dim>    simulation(scene, log, MPI_COMM_WORLD);
  const auto         path = std::filesystem::temp_directory_path() / ("arenite-test-" + std::to_string(getppid()));
  try
    {
      simulation.set_up();
      const OutputDirectory directory(path, "test.prm", OutputDirectory::Mode::overwrite, MPI_COMM_WORLD);
      directory.create();
      simulation.run(directory);
    }
  catch (...)
    {
      std::cout.rdbuf(old);
      throw;
    }
  std::cout.rdbuf(old);
  MPI_Barrier(MPI_COMM_WORLD);
  std::error_code ignored;
  std::filesystem::remove_all(path, ignored);
  return simulation.record;
}

inline RunRecord run_scene(Parameters parameters)
{
  return with_dimension(parameters, [&](const auto dim) { return run_scene_in<decltype(dim)::value>(parameters); });
}

/// The same for a scene given as text.
inline RunRecord run_scene(const std::string &text, const std::vector<std::string> &overrides = {})
{
  return run_scene(Parameters::from_text(text, "test scene", overrides));
}
} // namespace Arenite::Test
