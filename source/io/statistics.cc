#include <arenite/base/state_archive.h>
#include <arenite/base/values.h>
#include <arenite/io/files.h>
#include <arenite/io/statistics.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>

namespace Arenite
{
namespace
{
/// printf for one number.
std::string format(const char *pattern, const double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}
} // namespace

std::string duration(const double seconds)
{
  if (!(seconds < 1e9)) // also not a number
    return "unknown";
  const long s = std::lround(std::max(seconds, 0.));
  char       text[64];
  if (s < 60)
    std::snprintf(text, sizeof(text), "%ld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof(text), "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(text, sizeof(text), "%ld h %02ld min", s / 3600, s / 60 % 60);
  return text;
}

void Statistics::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Output");
  parameters.add_quantity(
    "Progress interval", progress_interval, "s", non_negative,
    "Wall time between two lines of progress on the screen; they come at rows of the statistics. 0 prints "
    "every row.");
  parameters.add_integer(
    "Statistics interval", row_interval, 1, 1000000,
    "Steps between two rows of statistics.csv, each with a check of the energy balance. More steps cost less "
    "and look less often: a row takes about as long as half a step.");
}

void Statistics::finalize(const Parameters &) {}

void Statistics::open(const OutputDirectory &directory, Log &new_log, const double new_start, const double new_end,
                      const double new_symmetry_factor, const std::string &new_per_extent, const FileStart file_start)
{
  per_extent      = new_per_extent;
  log             = &new_log;
  communicator    = directory.communicator;
  active          = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  start           = new_start;
  end             = new_end;
  symmetry_factor = new_symmetry_factor;
  begin = printed_at = Clock::now();
  if (active)
    {
      name  = directory.file("statistics.csv");
      errno = 0;
      file.open(name, file_start == FileStart::resumed ? std::ios::app : std::ios::out);
      if (!file)
        problem = write_problem(name);
    }
  agree_on_output(problem, communicator);
}

void Statistics::exchange(StateArchive &archive)
{
  exchange_length(archive, name, file);
  archive.common(last_info.step);
  archive.common(last_info.n_dofs);
  archive.common(largest_scale);
  archive.common(largest_momentum);
  archive.common(work);
  archive.common(n_rows);
  printed_work = work;
}

void Statistics::write_header(const EnergyReport &report)
{
  file << "t [s],step,dt [s],cells,dofs";
  const auto energy = [&](const std::string &what) { file << ',' << what << " (full body) [J" << per_extent << ']'; };
  energy("kinetic");
  energy("strain");
  energy("hourglass");
  if (report.stores_points)
    for (const char *what : {"dissipated by the law", "dissipated by bulk viscosity", "hypoelastic volume change"})
      energy(what);
  for (const auto &account : report.work)
    energy("work of " + account.first);
  for (const LoadValue &value : report.values)
    file << ',' << value.name << (value.of_sector ? " (full body)" : "") << " [" << value.unit
         << (value.of_sector ? per_extent : "") << ']';
  energy("initial");
  energy("step changes");
  energy("adaptation");
  energy("imbalance");
  file << ",relative energy error";
  for (const auto &column : report.momentum.columns)
    file << ',' << column.first << " (modelled part) [N s" << per_extent << ']';
  if (!report.momentum.columns.empty())
    file << ",relative momentum error";
  file << '\n';
}

void Statistics::add(const EnergyReport &report, const StepInfo &info)
{
  if (n_rows > 0)
    work += static_cast<double>(last_info.n_dofs) * (info.step - last_info.step);
  // relative to the largest energy so far: the first wave of a run has hardly any
  largest_scale    = std::max(largest_scale, report.scale());
  largest_momentum = std::max(largest_momentum, report.momentum.scale);
  last_error       = largest_scale > 0. ? std::abs(report.imbalance()) / largest_scale : 0.;
  last             = report;
  last_info        = info;
  printed_last     = false;

  if (active)
    {
      errno = 0;
      if (n_rows == 0)
        write_header(report);
      file << to_text(report.time) << ',' << info.step << ',' << to_text(info.dt) << ',' << info.n_cells << ','
           << info.n_dofs;
      const auto energy = [&](const double value) { file << ',' << to_text(symmetry_factor * value); };
      energy(report.kinetic);
      energy(report.strain);
      energy(report.hourglass);
      if (report.stores_points)
        for (const double value : {report.dissipated, report.bulk_viscosity, report.volume_change})
          energy(value);
      for (const auto &account : report.work)
        energy(account.second);
      for (const LoadValue &value : report.values)
        file << ',' << to_text(value.value * (value.of_sector ? symmetry_factor : 1.));
      energy(report.initial);
      energy(report.step_changes);
      energy(report.adaptation);
      energy(report.imbalance());
      file << ',' << to_text(last_error);
      for (const auto &column : report.momentum.columns)
        file << ',' << to_text(column.second);
      if (!report.momentum.columns.empty())
        file << ',' << to_text(largest_momentum > 0. ? std::abs(report.momentum.imbalance) / largest_momentum : 0.);
      file << '\n' << std::flush;
      if (!file)
        problem = write_problem(name);
      if (n_rows == 0 || std::chrono::duration<double>(Clock::now() - printed_at).count() >= progress_interval)
        print_progress();
    }
  ++n_rows;
  agree_on_output(problem, communicator);
}

void Statistics::print_progress()
{
  const auto   now     = Clock::now();
  const double seconds = std::chrono::duration<double>(now - printed_at).count();
  const double elapsed = std::chrono::duration<double>(now - begin).count();

  std::string text = "t = " + format("%.4e", last.time) + " s, step " + std::to_string(last_info.step) +
                     ", dt = " + format("%.3e", last_info.dt) + " s, " + std::to_string(last_info.n_cells) +
                     " cells, energy error " + format("%.1e", last_error);
  if (work > printed_work && seconds > 0.)
    text +=
      ", " +
      format("%.3g", (work - printed_work) / seconds / 1e6 / dealii::Utilities::MPI::n_mpi_processes(communicator)) +
      " MDoF/s per core";
  if (last.time > start && last.time < end)
    text += ", " + duration(elapsed * (end - last.time) / (last.time - start)) + " left";
  log->line(text);
  printed_at   = now;
  printed_work = work;
  printed_last = true;
}

void Statistics::finish()
{
  if (active && !printed_last)
    print_progress();
  if (file.is_open())
    {
      errno = 0;
      file.close();
      if (!file && problem.empty())
        problem = write_problem(name);
    }
  agree_on_output(problem, communicator);
}
} // namespace Arenite
