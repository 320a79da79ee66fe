#include <arenite/materials/law_list.h>
#include <arenite/materials/material_test.h>
#include <arenite/materials/strength.h>
#include <arenite/simulation/commands.h>
#include <arenite/simulation/scene.h>

#include <algorithm>

namespace Arenite
{
namespace
{
/// A scene with one load and one receiver set of every kind, so that all their entries appear.
constexpr const char *one_of_each = R"(
set End time = 1
set Blocks = solid
set Loads = pressure, gas pressure, gravity, absorbing boundary, sponge
set Receivers = points, line, plane, surface, box
subsection Materials
  subsection solid
    set Density = 2000
    set Young modulus = 1e8
    set Poisson ratio = 0.3
  end
end
subsection Loads
  subsection pressure
    set Type = pressure
    set Boundary = cavity
  end
  subsection gas pressure
    set Type = gas pressure
    set Boundary = cavity
    set Initial pressure = 1e6
  end
  subsection gravity
    set Type = gravity
    set Acceleration = 0, 0, -9.81
  end
  subsection absorbing boundary
    set Type = absorbing boundary
    set Boundary = outer
  end
  subsection sponge
    set Type = sponge
  end
end
subsection Constraints
  set Prescribed velocities = outer
end
subsection Initial conditions
  set Stress = geostatic
  set Moving regions = moving region
  subsection moving region
    set Velocity = 0; 0; 0
  end
end
subsection Receivers
  subsection points
    set Points = 0.2, 0, 0
  end
  subsection line
    set Type = line
    set Start = 0.1, 0, 0
    set End = 0.4, 0, 0
    set Interval = 0.1
  end
  subsection surface
    set Type = surface
    set Boundary = cavity
  end
  subsection box
    set Type = box
    set Corner = 0.1, 0, 0
    set Opposite corner = 0.2, 0.1, 0.1
  end
  subsection plane
    set Type = plane
    set Corner = 0.1, 0, 0
    set First edge = 0.1, 0, 0
    set Second edge = 0, 0.1, 0
    set Interval = 0.1
  end
end
)";

/// What @p object declares, in @p section or, if that is empty, on its own; @p entries: what it reads while it declares.
template <typename Object>
std::string entries_of(Object &object, const std::string &setting, const std::string &section, Parameters entries = {})
{
  if (section.empty())
    object.declare_parameters(entries);
  else
    {
      const auto inside = entries.section(section);
      object.declare_parameters(entries);
    }
  return "\nEntries of `set " + setting + "`:\n\n" + entries.manual();
}

template <int dim>
std::string entries_of_mesh(const std::string &name)
{
  return entries_of(*geometries<dim>().make(name), "Type = " + name, "Mesh");
}
} // namespace

std::string complete_manual()
{
  Parameters     parameters = Parameters::from_text(one_of_each, "manual");
  const Scene<3> scene(parameters);
  std::string    text =
    "# Parameters\n\nWritten by `./arenite parameters --markdown`; do not edit. Loads, receiver sets and prescribed "
    "velocities carry the names that a scene gives them; here each kind appears under its own name.\n\n" +
    parameters.manual();

  text += "\n# Mesh types\n\n" + geometries<3>().catalogue() + "\n";
  for (const std::string &name : geometries<3>().names())
    text += entries_of_mesh<3>(name);
  for (const std::string &name : geometries<2>().names())
    if (const auto &known = geometries<3>().names(); std::find(known.begin(), known.end(), name) == known.end())
      text += "\nIn two dimensions only: " + name + ".\n" + entries_of_mesh<2>(name);

  text += "\n# Gas in a cavity\n" +
          entries_of(*loads<3>().make("gas pressure"), "Gas = detonation products", "Loads",
                     Parameters::from_text("subsection Loads\nset Gas = detonation products\nend\n", "manual"));

  text += "\n# Laws\n\nEntries of a block, `subsection Materials / <block>`, beside those above. Scenes take `linear "
          "elastic`, "
          "`arenite material` takes all.\n\n" +
          material_laws(1).catalogue();
  for (const std::string &name : material_laws(1).names())
    text += entries_of(*material_laws(1).make(name), "Law = " + name, "Materials");

  text += "\n# Strengths\n\nEntries of the laws that have `Strength`, by its value; `none` has no others.\n";
  for (const std::string name : {ElasticShear::name, MisesStrength::name, FrictionStrength::name})
    {
      SelectedStrength  strength;
      const std::string setting = "Strength = " + name;
      text += entries_of(strength, setting, "Materials",
                         Parameters::from_text("subsection Materials\nset " + setting + "\nend\n", "manual"));
    }

  text += "\n# Tests of a material\n\n`arenite material FILE.prm` does one of these to one point:\n\n" +
          MaterialTest::catalogue();
  for (const std::string &name : MaterialTest::names())
    {
      MaterialTest      test;
      const std::string setting = "Type = " + name;
      text +=
        entries_of(test, setting, "", Parameters::from_text("subsection Test\nset " + setting + "\nend\n", "manual"));
    }

  text += "\n# Histories\n";
  for (const std::string &name : time_history_names())
    text += entries_of(*make_time_history(name), "History = " + name, "");
  return text;
}
} // namespace Arenite
