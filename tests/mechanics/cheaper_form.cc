// Forms in fewer dimensions that `arenite check` suggests.

#include <arenite/base/names.h>
#include <arenite/simulation/cheaper_form.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>

#include "cavity_scene.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;

namespace
{
using Lines = std::vector<std::string>;

std::vector<Reduction> forms_of(const std::string &text, const Lines &lines)
{
  Parameters parameters = Parameters::from_text(text, "test scene", lines);
  return with_dimension(parameters, [&](const auto dim) {
    const Scene<decltype(dim)::value> scene(parameters);
    return cheaper_forms(scene, parameters);
  });
}

/// "spherical, axisymmetric"
std::string names_of_forms(const std::string &text, const Lines &lines = {})
{
  Lines names;
  for (const Reduction &form : forms_of(text, lines))
    names.push_back(name(form.form));
  return join(names);
}

Lines together(Lines a, const Lines &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Pressure on one end of a bar in uniaxial strain.
const std::string bar_scene = reference_soil + R"(
set End time  = 3e-3
set Loads     = push
set Receivers = points
subsection Mesh
  set Type         = box
  set Upper corner = 1, 0.1, 0.05
  set Cells        = 20, 2, 1
end
subsection Element
  set Type   = spectral element
  set Degree = 3
end
subsection Loads
  subsection push
    set Boundary  = x min
    set History   = C3 step
    set Amplitude = 1e6
    set Rise time = 1e-3
  end
end
subsection Constraints
  set Symmetry planes  = y min, y max, z min, z max
  set Fixed boundaries = x max
end
subsection Receivers
  subsection points
    set Points = 0.013, 0.02, 0.03; 0.487, 0.02, 0.01
  end
end
)";

/// A body without load, without the sections that depend on it.
std::string free_body(const std::string &mesh, const std::string &solution)
{
  return reference_soil + R"(
set End time = 1e-3
subsection Mesh
  set Type = )" +
         mesh + R"(
end
subsection Initial conditions
  set State = exact solution
end
subsection Verification
  set Exact solution = )" +
         solution + R"(
end
)";
}

/// Cavity in a quarter of a half-space.
const std::string half_space_scene = reference_soil + R"(
set End time = 1e-3
set Loads    = cavity pressure, far field
subsection Mesh
  set Type = half-space
end
subsection Loads
  subsection cavity pressure
    set Boundary = cavity
  end
  subsection far field
    set Type     = absorbing boundary
    set Boundary = outer
  end
end
)";

/// The scene and its first form have the same signals at all receivers, up to @p tolerance of their norms.
void check_same_signals(const std::string &text, const Lines &lines, const double tolerance)
{
  const RunRecord whole = run_scene(text, lines);
  const RunRecord form  = run_scene(text, together(lines, forms_of(text, lines).at(0).changes));
  BOOST_TEST(form.dimension < whole.dimension);
  BOOST_TEST(!whole.values.empty());
  for (const auto &[quantity, value] : whole.values)
    {
      const double difference = form.values.at(quantity) / value - 1.;
      BOOST_TEST_MESSAGE(quantity << " differs by " << difference << ", unknowns " << whole.dofs << " " << form.dofs);
      BOOST_TEST(std::abs(difference) < tolerance);
    }
}

/// cheaper_forms() are those named, for each change of a scene.
void check_forms(const std::string &text, const std::string &forms, const std::vector<Lines> &changes)
{
  for (const Lines &lines : changes)
    BOOST_TEST(names_of_forms(text, lines) == forms, forms + " expected with " + join(lines));
}

Lines with_weight(const std::string &loads, const std::string &acceleration)
{
  return {"Loads=" + loads + ", weight", "Loads/weight/Type=gravity", "Loads/weight/Acceleration=" + acceleration,
          "Loads/weight/Amplitude=1"};
}
} // namespace

BOOST_AUTO_TEST_SUITE(cheaper_form)

// Shells: what acts alike in all directions keeps the symmetry, in every sector; what singles out z leaves the body of revolution; a
// section that a load or nobody holds, and everything else, leaves nothing.
BOOST_AUTO_TEST_CASE(shells)
{
  const std::string loads = "cavity pressure, far field", planes = "Constraints/Symmetry planes=";
  check_forms(cavity_scene, "spherical, axisymmetric",
              {{"Mesh/Sector=octant"},
               {"Mesh/Sector=half"},
               {"Mesh/Sector=full"},
               {planes + "symmetry x, symmetry y, symmetry z"},
               {"Loads/far field/Condition=spherical", "Loads/far field/Centre=0, 0, 0"},
               {"Loads/cavity pressure/Boundary=cavity, outer"},
               {"Constraints/Fixed boundaries=cavity"},
               {"Initial conditions/State=exact solution"},
               {"Adaptivity/Levels=1"}});
  check_forms(cavity_scene, "axisymmetric",
              {with_weight(loads, "0, 0, -9.81"),
               {"Loads/far field/Condition=spherical", "Loads/far field/Centre=0, 0, 0.05"},
               {"Constraints/Prescribed velocities=outer", "Constraints/outer/Direction=0, 0, 1"}});
  check_forms(cavity_scene, "",
              {{"Mesh/Sector=full", planes},
               {"Loads/cavity pressure/Boundary=symmetry x"},
               {"Loads/far field/Boundary=outer, symmetry z"},
               {planes},
               {planes + "symmetry x, symmetry y"},
               {planes + "symmetry x, symmetry y, symmetry z, outer"},
               {"Constraints/Fixed boundaries=symmetry y"},
               {"Constraints/Prescribed velocities=outer"},
               {"Loads/far field/Condition=spherical", "Loads/far field/Centre=0.05, 0, 0"},
               {"Blocks=solid, other", "Materials/other/Density=2200", "Materials/other/Young modulus=200e6",
                "Materials/other/Poisson ratio=0.3"},
               with_weight(loads, "0, 9.81, 0"),
               {"Dimension=1", "Symmetry=spherical"}});
  check_forms(cavity_scene, "spherical",
              {{"Dimension=2", "Symmetry=axisymmetric"}, {"Dimension=2", "Symmetry=axisymmetric", "Mesh/Sector=full"}});
  check_forms(cavity_scene, "",
              {{"Dimension=2", "Symmetry=axisymmetric", "Loads/cavity pressure/Boundary=symmetry z"}});
}

// Initial states, and body forces that keep them moving, count as they are: breathing is radial, twisting is not.
BOOST_AUTO_TEST_CASE(exact_motions)
{
  check_forms(free_body("ball", "breathing mode"), "spherical, axisymmetric", {{}, {"Mesh/Sector=full"}});
  check_forms(free_body("ball", "torsion mode"), "", {{"Mesh/Sector=full"}});
  const std::string shell = free_body("spherical shell", "manufactured shell");
  check_forms(shell, "", {{}, {"Mesh/Sector=full"}});
  check_forms(shell, "spherical", {{"Dimension=2", "Symmetry=axisymmetric", "Constraints/Exact boundaries=cavity"}});
  check_forms(free_body("box", "Lame mode"), "", {{"Constraints/Symmetry planes=z min, z max"}});
  check_forms(free_body("box", "manufactured cube"), "", {{}});
}

// Boxes: sides that cannot move along their normals, and nothing that acts on them or across.
BOOST_AUTO_TEST_CASE(boxes)
{
  const std::string planes = "Constraints/Symmetry planes=", fixed = "Constraints/Fixed boundaries=";
  check_forms(bar_scene, "plane wave, plane strain",
              {{},
               {fixed},
               {planes + "x max, y min, y max, z min, z max", fixed},
               {"Constraints/Prescribed velocities=x min", "Constraints/x min/Direction=-1, 0, 0"},
               {"Loads/push/Boundary=x min, x max"},
               with_weight("push", "9.81, 0, 0")});
  check_forms(bar_scene, "plane strain",
              {{planes + "z min, z max"},
               {fixed + "y max"},
               {"Loads/push/Boundary=x min, y max"},
               {"Constraints/Prescribed velocities=x min", "Constraints/x min/Direction=1, 1, 0"},
               with_weight("push", "0, -9.81, 0")});
  check_forms(bar_scene, "",
              {{planes},
               {planes + "y min, y max"},
               {planes + "y min, y max, z min"},
               {"Loads/push/Boundary=z max"},
               with_weight("push", "0, 0, -9.81")});
  check_forms(bar_scene, "plane wave",
              {{"Dimension=2", "Symmetry=plane strain", "Mesh/Upper corner=1, 0.1", "Mesh/Cells=20, 2",
                planes + "y min, y max"}});
  check_forms(bar_scene, "",
              {{"Dimension=2", "Symmetry=axisymmetric", "Mesh/Upper corner=1, 0.1", "Mesh/Cells=20, 2",
                planes + "y min, y max"}});
}

// The brick around a buried cavity becomes a cylinder: only if it absorbs there, and if nothing acts on the surface, whose extent changes.
BOOST_AUTO_TEST_CASE(half_spaces)
{
  check_forms(half_space_scene, "axisymmetric", {{}, with_weight("cavity pressure, far field", "0, 0, -9.81")});
  check_forms(half_space_scene, "",
              {{"Loads/far field/Boundary=surface"},
               {"Loads/cavity pressure/Boundary=surface"},
               {"Loads/cavity pressure/Boundary=outer"},
               {"Constraints/Fixed boundaries=outer"},
               {"Dimension=2", "Symmetry=axisymmetric"}});
}

// A scene and its form have the same signals. (The octant of the cavity: one_scene_in_three_forms in fewer_dimensions.cc.) Bars agree
// to round-off with equal steps, round bodies to the errors of their meshes: 3e-4 and 1.4e-3 of the velocity were measured.
BOOST_AUTO_TEST_CASE(same_signals)
{
  const Lines step = {"Time stepping/Fixed step=1e-5"};
  check_same_signals(bar_scene, step, 1e-12);
  check_same_signals(bar_scene,
                     together(step,
                              together(with_weight("push", "9.81, -9.81, 0"), {"Loads/push/Boundary=x min, y max"})),
                     1e-12);
  check_same_signals(cavity_scene, {"Mesh/Sector=half", "Mesh/Radial layers=2", "Mesh/Refinement=2"}, 1e-3);
  check_same_signals(cavity_scene,
                     together(with_weight("cavity pressure, far field", "0, 0, -1e5"), {"Mesh/Refinement=2"}), 3e-3);
}

BOOST_AUTO_TEST_SUITE_END()
