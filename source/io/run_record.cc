#include <arenite/base/version.h>
#include <arenite/io/files.h>
#include <arenite/io/run_record.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace Arenite
{
void RunRecord::measure_memory(const MPI_Comm communicator)
{
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  const double mb = static_cast<double>(memory.VmHWM) / 1024.; // VmHWM in kB
  peak_memory_mb  = dealii::Utilities::MPI::max(mb, communicator);
  total_memory_mb = dealii::Utilities::MPI::sum(mb, communicator);
}

void RunRecord::write(const OutputDirectory &directory) const
{
  std::string problem;
  if (dealii::Utilities::MPI::this_mpi_process(directory.communicator) == 0)
    {
      nlohmann::ordered_json json;
      json["version"]                 = version();
      json["commit"]                  = commit();
      json["compiler"]                = compiler();
      json["deal_ii"]                 = dealii_version();
      json["title"]                   = title;
      json["scenes"]                  = scenes;
      json["overrides"]               = overrides;
      json["ranks"]                   = dealii::Utilities::MPI::n_mpi_processes(directory.communicator);
      json["lanes"]                   = lanes;
      json["dimension"]               = dimension;
      json["symmetry"]                = symmetry;
      json["element"]                 = element;
      json["degree"]                  = degree;
      json["symmetry_factor"]         = symmetry_factor;
      json["cells"]                   = cells;
      json["most_cells"]              = most_cells;
      json["dofs"]                    = dofs;
      json["steps"]                   = steps;
      json["time"]                    = time;
      json["setup_core_seconds"]      = setup_core_seconds;
      json["core_seconds"]            = core_seconds;
      json["output_core_seconds"]     = output_core_seconds;
      json["adaptation_core_seconds"] = adaptation_core_seconds;
      json["mdofs_per_core_second"]   = mdofs_per_core_second();
      json["peak_memory_mb"]          = peak_memory_mb;
      json["total_memory_mb"]         = total_memory_mb;
      if (is_static)
        {
          json["newton_iterations"] = newton_iterations;
          json["linear_iterations"] = linear_iterations;
        }
      else
        {
          json["energy_error"]  = energy_error;
          json["impulse_error"] = impulse_error;
        }
      json["mass_error"]             = mass_error;
      json["momentum_error"]         = momentum_error;
      json["dissipation"]            = dissipation;
      json["artificial_dissipation"] = artificial_dissipation;
      json["hourglass_energy"]       = hourglass_energy;
      json["errors"]                 = nlohmann::ordered_json::object();
      for (const auto &error : errors)
        json["errors"][error.first] = error.second;
      json["values"] = nlohmann::ordered_json::object();
      for (const auto &value : values)
        json["values"][value.first] = value.second;
      if (!parts.empty())
        json["parts"] = nlohmann::ordered_json(parts);
      // a title in another encoding must not cost the record of the run
      const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
      problem = replace_file(directory.file("run.json"), [&](std::ostream &file) { file << text << '\n'; });
    }
  agree_on_output(problem, directory.communicator);
}

void RunRecord::print_summary(Log &log, const OutputDirectory &directory) const
{
  std::size_t width = 40;
  for (const auto &error : errors)
    width = std::max(width, error.first.size() + 2);
  const auto row = [&](const std::string &name, const char *pattern, const double value) {
    char text[64];
    std::snprintf(text, sizeof(text), pattern, value);
    log.line("  " + name + std::string(width - std::min(width, name.size()), ' ') + text);
  };
  log.line();
  for (const auto &error : errors)
    row(error.first, "%.4e", error.second);
  if (is_static)
    {
      row("Newton iterations", "%.0f", static_cast<double>(newton_iterations));
      row("linear iterations", "%.0f", static_cast<double>(linear_iterations));
    }
  else
    {
      row("energy error", "%.1e", energy_error);
      row("impulse error", "%.1e", impulse_error);
      row("mass error", "%.1e", mass_error);
      row("momentum error", "%.1e", momentum_error);
    }
  row("steps", "%.0f", static_cast<double>(steps));
  row("unknowns", "%.0f", static_cast<double>(dofs));
  row("set-up [core s]", "%.2f", setup_core_seconds);
  row("time loop [core s]", "%.2f", core_seconds);
  row("output [core s]", "%.2f", output_core_seconds);
  for (const auto &part : parts)
    row("  " + part.first + " [core s]", "%.3f", part.second);
  row("million unknowns per core second", "%.2f", mdofs_per_core_second());
  row("largest memory of a process [MB]", "%.0f", peak_memory_mb);

  // the process that speaks looks into the directory; the others have nothing to say
  if (dealii::Utilities::MPI::this_mpi_process(directory.communicator) != 0)
    return;
  std::string names;
  std::size_t pictures = 0, checkpoints = 0;
  for (const std::string &name : results_in(directory.path()))
    if (name.rfind("solution/", 0) == 0)
      pictures += name.size() > 5 && name.compare(name.size() - 5, 5, ".pvtu") == 0;
    else if (name.rfind("checkpoint", 0) == 0)
      checkpoints += name.find("/manifest.json") != std::string::npos;
    else
      names += (names.empty() ? "" : ", ") + name;
  log.line(
    "Files in " + directory.path() + ": " + names +
    (pictures > 0 ? " (" + std::to_string(pictures) + (pictures == 1 ? " picture)" : " pictures)") : "") +
    (checkpoints > 0 ? ", " + std::to_string(checkpoints) + (checkpoints == 1 ? " checkpoint" : " checkpoints") : ""));
}
} // namespace Arenite
