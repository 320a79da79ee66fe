#include <arenite/base/errors.h>
#include <arenite/base/values.h>
#include <arenite/io/receiver_file.h>
#include <arenite/materials/law_list.h>
#include <arenite/materials/strain_path.h>
#include <arenite/simulation/material_bench.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace Arenite
{
std::string declare_law(Parameters &parameters, std::string &name)
{
  const std::string entry = parameters.current_path() + "/Law";
  const auto        names = material_laws(1).names();
  name                    = parameters.peek_choice(entry, name, names);
  parameters.add_choice("Law", name, names, "Constitutive law.");
  return entry;
}

MaterialBench::MaterialBench(Parameters &parameters, const std::string &strain_path, const unsigned int steps_per_row)
{
  declare_parameters(parameters);
  parameters.parse();
  law->finalize(parameters);
  if (!strain_path.empty())
    {
      test.type        = "strain path";
      test.strain_path = strain_path;
    }
  test.finalize(parameters);
  if (steps_per_row > 0)
    test.steps_per_row = steps_per_row;
  if (test.type == "strain path" && test.strain_path.empty())
    parameters.refuse("Test", "what is to be done? Set 'Test / Type' and its entries, or give --strain-path FILE.csv.");
}

void MaterialBench::declare_parameters(Parameters &parameters)
{
  parameters.add_text("Title", title, "One line for the log.");
  block_names = parameters.peek_list("Blocks");
  parameters.add_list("Blocks", block_names, "Name of the block, a subsection of 'Materials'.");
  if (block_names.size() > 1)
    parameters.refuse("Blocks", "the bench tests one block; name the one.");
  block = block_names.empty() ? "solid" : block_names.front();
  {
    const auto materials = parameters.section("Materials");
    const auto section   = parameters.section(block);
    law_name             = "linear elastic";
    declare_law(parameters, law_name);
    law = material_laws(1).make(law_name);
    parameters.add_integer("Material id", material_id, 0, 254, "As in a scene; without effect on the bench.");
    law->declare_parameters(parameters);
  }
  test.declare_parameters(parameters);
}

std::size_t MaterialBench::Table::index(const std::string &column) const
{
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (name_and_unit(columns[i]).first == column)
      return i;
  throw std::logic_error("The bench has no column '" + column + "'.");
}

std::vector<double> MaterialBench::Table::values(const std::string &column) const
{
  const std::size_t   i = index(column);
  std::vector<double> result;
  for (const auto &row : rows)
    result.push_back(row[i]);
  return result;
}

double MaterialBench::Table::last(const std::string &column) const { return rows.back()[index(column)]; }

std::vector<std::string> MaterialBench::columns() const
{
  std::vector<std::string> names = {"time [s]",     "eps11",        "eps22",           "eps33",        "eps23",
                                    "eps13",        "eps12",        "sigma11 [Pa]",    "sigma22 [Pa]", "sigma33 [Pa]",
                                    "sigma23 [Pa]", "sigma13 [Pa]", "sigma12 [Pa]",    "p [Pa]",       "q [Pa]",
                                    "I1 [Pa]",      "sqrt J2 [Pa]", "density [kg/m^3]"};
  for (const std::string &name : law->history_names())
    names.push_back(name);
  for (const char *name : {"work [J/m^3]", "stored [J/m^3]", "dissipated [J/m^3]", "stored by volume change [J/m^3]",
                           "wave speed [m/s]", "substeps"})
    names.push_back(name);
  if (test.type == "Hugoniot")
    for (const char *name : {"Us [m/s]", "up [m/s]", "shock energy [J/m^3]"})
      names.push_back(name);
  return names;
}

void MaterialBench::add_row(Table &table, const PointState &ahead, const PointState &s) const
{
  constexpr int       order[] = {0, 1, 2, 5, 4, 3};
  std::vector<double> row     = {s.time};
  for (const int k : order)
    row.push_back(s.strain[k]);
  for (const int k : order)
    row.push_back(s.stress[k]);
  const double p = pressure(s.stress) + 0., J2 = second_invariant(deviator(s.stress));
  row.insert(row.end(), {p, std::sqrt(3. * J2), 3. * p, std::sqrt(J2), s.density});
  row.insert(row.end(), s.history.begin(), s.history.end());
  row.insert(row.end(), {s.work, s.stored, s.dissipated, s.stored_by_volume, s.wave_speed, s.substeps});
  if (test.type == "Hugoniot")
    {
      const ShockJump shock = shock_jump(ahead, s);
      row.insert(row.end(), {shock.shock_speed, shock.particle_speed, shock.energy});
    }
  table.rows.push_back(row);
}

void MaterialBench::run(Table &table) const
{
  MaterialPoint point(*law);
  table.columns    = columns();
  PointState ahead = point.state;
  add_row(table, ahead, ahead);
  const auto observe = [&]() { add_row(table, ahead, point.state); };
  if (test.type == "strain path")
    {
      run_path(point, read_strain_path(test.strain_path), test.steps_per_row, observe);
      return;
    }
  for (const TestLeg &leg : test.legs())
    try
      {
        ahead = point.state;
        run_leg(point, leg, test.steps_per_row, observe);
      }
    catch (const PhysicsAlarm &alarm)
      {
        throw PhysicsAlarm("[Test] " + test.type + ", " + leg.name + ": " + alarm.what());
      }
}

Sweep::Sweep(const std::string &text)
{
  const std::size_t equals = text.rfind('=');
  const auto        parts =
    equals == std::string::npos ? std::vector<std::string>() : split_list(text.substr(equals + 1), ':');
  const std::string form = "--sweep " + text + ": ";
  if (parts.size() != 3)
    throw InputError(form + "write \"Section/Sub section/Entry=first:last:count\".");
  path = dealii::Utilities::trim(text.substr(0, equals));
  for (const std::string &part : parts)
    if (const std::string complaint = complaint_about_number(part, ""); !complaint.empty())
      throw InputError(form + "'" + part + "' " + complaint);
  const double first = dealii::Utilities::string_to_double(parts[0]),
               last  = dealii::Utilities::string_to_double(parts[1]),
               count = dealii::Utilities::string_to_double(parts[2]);
  if (count != std::floor(count) || count < 2. || count > 1000.)
    throw InputError(form + "the count '" + parts[2] + "' must be an integer in [2, 1000].");
  for (unsigned int i = 0; i < count; ++i)
    values.push_back(i + 1 == count ? last : first + (last - first) * i / (count - 1.));
}
} // namespace Arenite
