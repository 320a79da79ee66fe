#pragma once

#include <arenite/simulation/simulation.h>

#include <filesystem>
#include <string>
#include <vector>

namespace Arenite::Test
{
/// Run a scene given as text, quietly, into a directory that is removed again.
inline RunRecord run_scene(const std::string &text, const std::vector<std::string> &overrides = {})
{
  Parameters         parameters = Parameters::from_text(text, "test scene", overrides);
  Scene<3>           scene(parameters);
  Log                log(MPI_COMM_SELF);
  std::ostringstream screen;
  auto *const        old = std::cout.rdbuf(screen.rdbuf());
  Simulation<3>      simulation(scene, log, MPI_COMM_WORLD);
  const auto         path = std::filesystem::temp_directory_path() / ("arenite-test-" + std::to_string(getppid()));
  try
    {
      simulation.set_up();
      const OutputDirectory directory(path, "test.prm", true, MPI_COMM_WORLD);
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
} // namespace Arenite::Test
