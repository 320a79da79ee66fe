#include <arenite/base/names.h>
#include <arenite/base/values.h>
#include <arenite/materials/material_test.h>
#include <arenite/materials/strain_path.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace Arenite
{
namespace
{
const std::vector<std::pair<std::string, std::string>> tests = {
  {"strain path", "All six strains from a CSV file."},
  {"isotropic", "Equal strain in all directions, compression or tension; the turning points are volume strains."},
  {"uniaxial strain", "Oedometer: axial strain eps11, no lateral strain."},
  {"simple shear", "The turning points are gamma = 2 eps12, nothing else moves."},
  {"triaxial", "Axial strain eps11 with constant lateral stress or constant pressure; compression and extension."},
  {"creep", "Stress rises, then stays."},
  {"relaxation", "Strain rises, then stays."},
  {"strain cycle", "Closed parallelogram 0, A, A + B, B, 0 in the space of strains: energy must not be won."},
  {"Hugoniot", "Uniaxial strain; every row with the shock that leads there from the initial state."}};

Condition condition(const Condition::On on, const std::array<double, 6> &weights, const double change = 0.)
{
  return {on, weights, change, true};
}

std::array<double, 6> unit(const int k)
{
  std::array<double, 6> weights{};
  weights[k] = 1.;
  return weights;
}

/// All six strains change by @p change.
Conditions strains(const SymTensor<double> &change)
{
  Conditions conditions;
  for (int k = 0; k < 6; ++k)
    conditions[k] = condition(Condition::On::strain, unit(k), change[k]);
  return conditions;
}

/// The driven component of a mode, with @p change of its strain or stress.
Conditions driven(const std::string &mode, const Condition::On on, const double change)
{
  Conditions conditions = strains({});
  if (mode == "isotropic")
    for (int k = 0; k < 3; ++k)
      conditions[k] = condition(on, unit(k), on == Condition::On::strain ? change / 3. : change);
  else if (mode == "simple shear")
    conditions[3] = condition(on, unit(3), on == Condition::On::strain ? 0.5 * change : change);
  else // uniaxial strain, triaxial
    {
      conditions[0] = condition(on, unit(0), change);
      if (mode == "triaxial")
        for (int k = 1; k < 3; ++k)
          conditions[k] = condition(Condition::On::stress, unit(k));
    }
  return conditions;
}
} // namespace

std::vector<std::string> MaterialTest::names()
{
  std::vector<std::string> result;
  for (const auto &test : tests)
    result.push_back(test.first);
  return result;
}

std::string MaterialTest::catalogue()
{
  std::string result;
  for (const auto &test : tests)
    result += "- **" + test.first + "**: " + test.second + "\n";
  return result;
}

void MaterialTest::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Test");
  path               = parameters.current_path();
  type               = parameters.peek_choice(path + "/Type", type, names());
  parameters.add_choice("Type", type, names(), "What is done to the point.");
  parameters.add_integer("Steps per row", steps_per_row, 1, 100000000,
                         "Steps of the law from one row of the result to the next. Larger: more accurate and slower.");
  if (is("strain path"))
    {
      parameters.add_text("File", strain_path,
                          "CSV file with the columns time, eps11, eps22, eps33, eps23, eps13, eps12, linear between "
                          "rows; relative to the working directory.");
      return;
    }
  parameters.add_integer("Rows", rows, 1, 1000000, "Rows of the result per leg, from one turning point to the next.");
  if (is("isotropic") || is("uniaxial strain") || is("simple shear") || is("triaxial") || is("relaxation") ||
      is("Hugoniot"))
    {
      parameters.add_list("Strains", strain_texts,
                          "Turning points, visited in this order from zero, tension positive: volume strain, axial "
                          "strain or gamma.");
      parameters.require("Strains");
    }
  if (is("strain cycle"))
    {
      const std::string order = ": eps11, eps22, eps33, eps23, eps13, eps12, tension positive.";
      parameters.add_list("First strain", first_strain, "A" + order);
      parameters.require("First strain");
      parameters.add_list("Second strain", second_strain, "B" + order);
      parameters.require("Second strain");
      parameters.add_integer("Cycles", cycles, 1, 10000, "Number of rounds.");
    }
  if (is("creep") || is("relaxation"))
    {
      parameters.add_choice("Mode", mode, {"isotropic", "uniaxial strain", "simple shear", "triaxial"},
                            "What is driven: all directions, eps11 without or with lateral strain, or gamma.");
      parameters.add_quantity("Hold time", hold_time, "s", positive, "Time for which stress or strain stays.");
    }
  if (is("creep"))
    {
      parameters.add_quantity("Stress", stress, "Pa", any_value,
                              "Change of the driven stress, tension positive; isotropic: of all three.");
      parameters.add_quantity("Loading time", loading_time, "s", positive, "Time in which the stress rises.");
    }
  else
    parameters.add_quantity("Strain rate", strain_rate, "1/s", positive,
                            "Of the turning points. Larger: more overstress in a viscous law.");
  if (is("triaxial"))
    parameters.add_choice("Lateral", lateral, {"constant stress", "constant pressure"},
                          "What stays: sigma22 = sigma33, or p.");
  if (is("Hugoniot"))
    parameters.add_choice(
      "States", states, {"loading path", "jumps"},
      "Loading path: each state of a ramp with its Rayleigh line. Jumps: each state in one step from "
      "the initial one, as in a shock without structure.");
  if (!is("strain cycle"))
    {
      parameters.add_quantity("Confining pressure", confining_pressure, "Pa", any_value,
                              "Isotropic pressure before the test.");
      parameters.add_quantity("Confining time", confining_time, "s", positive,
                              "Time in which the confining pressure rises. Larger: less overstress in a viscous law.");
    }
}

std::vector<double> MaterialTest::numbers(const Parameters &parameters, const std::string &entry,
                                          const std::vector<std::string> &texts, const std::size_t least,
                                          const std::size_t most) const
{
  std::vector<double> result;
  for (const std::string &text : texts)
    {
      const std::string complaint = complaint_about_number(text, "");
      if (!complaint.empty())
        parameters.refuse(path + "/" + entry, "'" + text + "' " + complaint);
      result.push_back(dealii::Utilities::string_to_double(text));
    }
  if (result.size() < least || result.size() > most)
    parameters.refuse(path + "/" + entry, least == most ? "needs " + std::to_string(least) + " numbers"
                                                        : "needs at least " + std::to_string(least) + " number");
  return result;
}

void MaterialTest::add_ramp(const std::string &ramp_mode, const std::vector<double> &turning_points)
{
  double before = 0.;
  for (const double strain : turning_points)
    {
      TestLeg leg;
      leg.name       = ramp_mode + " to " + to_text(strain);
      leg.conditions = driven(ramp_mode, On::strain, strain - before);
      if (ramp_mode == "triaxial" && lateral == "constant pressure")
        {
          leg.conditions[1] = condition(On::stress, {0., 1., -1., 0., 0., 0.});
          leg.conditions[2] = condition(On::stress, {1., 1., 1., 0., 0., 0.});
        }
      leg.duration = std::abs(strain - before) / strain_rate;
      leg.rows     = rows;
      leg.jumps    = is("Hugoniot") && states == "jumps";
      all_legs.push_back(leg);
      before = strain;
    }
}

void MaterialTest::add_cycle()
{
  SymTensor<double> A, B;
  constexpr int     order[] = {0, 1, 2, 5, 4, 3};
  for (int k = 0; k < 6; ++k)
    {
      A[order[k]] = dealii::Utilities::string_to_double(first_strain[k]);
      B[order[k]] = dealii::Utilities::string_to_double(second_strain[k]);
    }
  const std::pair<const char *, SymTensor<double>> sides[] = {{"to A", A},
                                                              {"to A + B", B},
                                                              {"to B", A * -1.},
                                                              {"to 0", B * -1.}};
  for (unsigned int cycle = 0; cycle < cycles; ++cycle)
    for (const auto &[name, change] : sides)
      {
        TestLeg leg;
        leg.name       = "cycle " + std::to_string(cycle + 1) + " " + name;
        leg.conditions = strains(change);
        leg.duration   = std::sqrt(contract(change, change)) / strain_rate;
        leg.rows       = rows;
        all_legs.push_back(leg);
      }
}

void MaterialTest::finalize(const Parameters &parameters)
{
  all_legs.clear();
  if (is("strain path"))
    return;
  if (confining_pressure != 0.)
    {
      TestLeg leg;
      leg.name       = "confinement";
      leg.conditions = driven("isotropic", On::stress, -confining_pressure);
      leg.duration   = confining_time;
      leg.rows       = rows;
      all_legs.push_back(leg);
    }
  if (is("strain cycle"))
    {
      const auto A = numbers(parameters, "First strain", first_strain, 6, 6);
      const auto B = numbers(parameters, "Second strain", second_strain, 6, 6);
      for (const auto &[entry, tensor] : {std::make_pair("First strain", A), std::make_pair("Second strain", B)})
        if (std::all_of(tensor.begin(), tensor.end(), [](const double value) { return value == 0.; }))
          parameters.refuse(path + "/" + entry, "must not vanish");
      add_cycle();
      return;
    }

  TestLeg hold;
  hold.name     = "hold";
  hold.duration = hold_time;
  hold.rows     = rows;
  if (is("creep"))
    {
      if (!std::isfinite(stress))
        parameters.refuse(path + "/Stress", "is missing");
      TestLeg leg;
      leg.name        = mode + " to " + to_text(stress) + " Pa";
      leg.conditions  = driven(mode, On::stress, stress);
      leg.duration    = loading_time;
      leg.rows        = rows;
      hold.conditions = driven(mode, On::stress, 0.);
      all_legs.push_back(leg);
      all_legs.push_back(hold);
      return;
    }
  const std::vector<double> turning_points = numbers(parameters, "Strains", strain_texts, 1, 1000);
  for (std::size_t i = 0; i < turning_points.size(); ++i)
    if (turning_points[i] == (i == 0 ? 0. : turning_points[i - 1]))
      parameters.refuse(path + "/Strains", "two turning points that follow each other are equal (the first one is 0)");
  if (is("Hugoniot") && (turning_points.size() != 1 || turning_points[0] >= 0.))
    parameters.refuse(path + "/Strains", "a Hugoniot curve has one compressive (negative) strain at its end");
  add_ramp(is("relaxation") ? mode : (is("Hugoniot") ? "uniaxial strain" : type), turning_points);
  if (is("relaxation"))
    {
      hold.conditions = driven(mode, On::strain, 0.);
      all_legs.push_back(hold);
    }
}

void run_leg(MaterialPoint &point, const TestLeg &leg, const unsigned int steps_per_row,
             const std::function<void()> &observe)
{
  const PointState start        = point.state;
  const bool       only_strains = std::all_of(leg.conditions.begin(), leg.conditions.end(),
                                              [](const Condition &c) { return c.on == Condition::On::strain; });
  Conditions       absolute     = leg.conditions;
  for (Condition &c : absolute)
    c.relative = false;
  // conditions on strain alone are one per component, in order
  SymTensor<double> change;
  for (int k = 0; k < 6; ++k)
    change[k] = leg.conditions[k].target;

  for (unsigned int row = 1; row <= leg.rows; ++row)
    {
      if (leg.jumps)
        point.state = start;
      const unsigned int n = steps_per_row;
      for (unsigned int step = 1; step <= n; ++step)
        {
          const double part = leg.jumps ? double(row) / (double(leg.rows) * n) : 1. / (double(leg.rows) * n);
          if (only_strains)
            {
              point.advance(change * part, leg.duration * part);
              continue;
            }
          const double done = ((row - 1.) * n + step) / (double(leg.rows) * n);
          for (int i = 0; i < 6; ++i)
            {
              const Condition &c = leg.conditions[i];
              absolute[i].target =
                c.value(c.on == Condition::On::strain ? start.strain : start.stress) + done * c.target;
            }
          point.advance(absolute, leg.duration * part);
        }
      observe();
    }
}

void run_path(MaterialPoint &point, const StrainPath &path, const unsigned int steps_per_row,
              const std::function<void()> &observe)
{
  for (std::size_t i = 1; i < path.rows.size(); ++i)
    {
      const auto  &from = path.rows[i - 1], &to = path.rows[i];
      const double n = steps_per_row;
      for (unsigned int step = 0; step < steps_per_row; ++step)
        point.advance((to.strain - from.strain) * (1. / n), (to.time - from.time) / n);
      observe();
    }
}

ShockJump shock_jump(const PointState &ahead, const PointState &behind)
{
  ShockJump    shock;
  const double compression = 1. - ahead.density / behind.density, rise = ahead.stress[0] - behind.stress[0];
  if (!(compression > 0. && rise > 0.))
    return shock;
  shock.shock_speed    = std::sqrt(rise / (ahead.density * compression));
  shock.particle_speed = compression * shock.shock_speed;
  shock.energy         = -0.5 * (ahead.stress[0] + behind.stress[0]) * compression;
  return shock;
}
} // namespace Arenite
