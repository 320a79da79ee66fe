#include <arenite/base/errors.h>
#include <arenite/base/values.h>
#include <arenite/io/files.h>
#include <arenite/io/log.h>
#include <arenite/io/receiver_file.h>
#include <arenite/simulation/commands.h>
#include <arenite/simulation/material_bench.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <system_error>

namespace Arenite
{
namespace
{
/// A file written by process 0; OutputError on all processes if that fails.
void write_file(const std::string &name, const std::function<void(std::ostream &)> &write)
{
  std::string problem;
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      const std::filesystem::path folder = std::filesystem::path(name).parent_path();
      std::error_code             error;
      if (!folder.empty())
        std::filesystem::create_directories(folder, error);
      problem = error ? folder.string() + ": cannot be created: " + error.message() + "." : replace_file(name, write);
    }
  agree_on_output(problem, MPI_COMM_WORLD);
}

void write_table(const std::string &name, const std::vector<std::string> &columns,
                 const std::vector<std::vector<double>> &rows)
{
  write_file(name, [&](std::ostream &file) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      file << (i > 0 ? "," : "") << columns[i];
    file << '\n' << std::setprecision(15);
    for (const auto &row : rows)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
          file << (i > 0 ? "," : "") << row[i];
        file << '\n';
      }
  });
}

double largest(const std::vector<double> &values) { return *std::max_element(values.begin(), values.end()); }
double smallest(const std::vector<double> &values) { return *std::min_element(values.begin(), values.end()); }

/// What a reader wants to know first, per run.
struct Summary
{
  std::vector<std::string> columns;
  std::vector<double>      values;
};
Summary summary(const MaterialBench &bench, const MaterialBench::Table &table)
{
  Summary    result;
  const auto add = [&](const std::string &name, const double value) {
    result.columns.push_back(name);
    result.values.push_back(value);
  };
  add("largest p [Pa]", largest(table.values("p")));
  add("smallest p [Pa]", smallest(table.values("p")));
  add("largest q [Pa]", largest(table.values("q")));
  add("largest density [kg/m^3]", largest(table.values("density")));
  for (const std::string &name : bench.law->history_names())
    add("final " + name, table.last(name));
  add("work [J/m^3]", table.last("work"));
  add("stored [J/m^3]", table.last("stored"));
  add("dissipated [J/m^3]", table.last("dissipated"));
  add("stored by volume change [J/m^3]", table.last("stored by volume change"));
  add("largest wave speed [m/s]", largest(table.values("wave speed")));
  add("steps of the law", table.last("substeps"));
  if (bench.test.type == "Hugoniot")
    {
      add("Us at the end [m/s]", table.last("Us"));
      add("up at the end [m/s]", table.last("up"));
    }
  return result;
}

void print(Log &log, const std::string &name, const double value, const std::string &unit)
{
  std::ostringstream line;
  line << "  " << std::left << std::setw(50) << name << std::setprecision(7) << value << ' '
       << (has_unit(unit) ? unit : "");
  log.line(line.str());
}

void print_constants(Log &log, const MaterialBench &bench)
{
  log.line(bench.block + ": " + bench.law_name);
  for (const DerivedConstant &constant : bench.law->derived_constants())
    print(log, constant.name, constant.value, constant.unit);
  for (const std::string &sentence : bench.law->warnings())
    log.line("  Warning: " + sentence);
}

/// Test, save, and report one set of parameters. Rows that were reached before an alarm are saved, too.
Summary run_bench(const RunOptions &options, const std::vector<std::string> &overrides, const std::string &stem,
                  Log &log)
{
  Parameters          parameters = Parameters::from_files(options.scenes, overrides);
  const MaterialBench bench(parameters, options.strain_path, options.steps_per_row);
  if (!bench.title.empty())
    log.line(bench.title);
  print_constants(log, bench);
  MaterialBench::Table table;
  const auto           save = [&]() {
    write_table(stem + ".csv", table.columns, table.rows);
    write_file(stem + "_used.prm", [&](std::ostream &file) { file << parameters.echo(); });
  };
  try
    {
      bench.run(table);
    }
  catch (const PhysicsAlarm &)
    {
      save();
      throw;
    }
  save();
  const Summary result = summary(bench, table);
  log.line(bench.test.type + ", " + std::to_string(table.rows.size()) + " rows:");
  for (std::size_t i = 0; i < result.columns.size(); ++i)
    {
      const auto [name, unit] = name_and_unit(result.columns[i]);
      print(log, name, result.values[i], unit);
    }
  log.line("  " + stem + ".csv, " + stem + "_used.prm");
  return result;
}
} // namespace

int material(const RunOptions &options)
{
  Log         log(MPI_COMM_WORLD);
  std::string stem =
    options.output.empty() ? "output/" + std::filesystem::path(options.scenes.front()).stem().string() : options.output;
  if (stem.size() > 4 && stem.substr(stem.size() - 4) == ".csv")
    stem.erase(stem.size() - 4);
  if (options.sweep.empty())
    {
      run_bench(options, options.overrides, stem, log);
      return 0;
    }

  const Sweep                      sweep(options.sweep);
  const std::string                entry = sweep.path.substr(sweep.path.rfind('/') + 1);
  std::vector<std::string>         columns;
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < sweep.values.size(); ++i)
    {
      const std::string value = to_text(sweep.values[i]);
      log.line("--- " + entry + " = " + value);
      std::vector<std::string> overrides = options.overrides;
      overrides.push_back(sweep.path + "=" + value);
      const Summary result = run_bench(options, overrides, stem + "-" + std::to_string(i + 1), log);
      columns              = {entry};
      columns.insert(columns.end(), result.columns.begin(), result.columns.end());
      rows.push_back({sweep.values[i]});
      rows.back().insert(rows.back().end(), result.values.begin(), result.values.end());
    }
  write_table(stem + "-sweep.csv", columns, rows);

  log.line("");
  std::ostringstream table;
  table << std::left << std::setprecision(5);
  for (const std::string &column : columns)
    table << std::setw(std::max<int>(13, column.size() + 2)) << column;
  table << '\n';
  for (const auto &row : rows)
    {
      for (std::size_t i = 0; i < row.size(); ++i)
        table << std::setw(std::max<int>(13, columns[i].size() + 2)) << row[i];
      table << '\n';
    }
  log << table.str();
  log.line("  " + stem + "-sweep.csv");
  return 0;
}
} // namespace Arenite
