#include <arenite/base/names.h>
#include <arenite/base/parameters.h>
#include <arenite/base/registry.h>

#include <deal.II/base/mpi.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <unistd.h>
#include <vector>

using namespace Arenite;

namespace
{
/// A small scene that owns one entry of each kind.
struct Scene
{
  std::string                   title = "untitled", type = "box";
  std::vector<std::string>      blocks;
  double                        end_time = 1e-3, density = 0., poisson_ratio = 0.25, courant_number = 0.9;
  unsigned int                  refinement = 2;
  bool                          adaptive   = false;
  dealii::Tensor<1, 3>          gravity;
  std::vector<dealii::Point<2>> points;

  void declare(Parameters &parameters)
  {
    parameters.add_text("Title", title, "Free text.");
    parameters.add_list("Blocks", blocks, "Names of the material blocks.");
    parameters.add_quantity("End time", end_time, "s", positive, "The run stops here.");
    parameters.add_vector<3>("Gravity", gravity, "m/s^2", "Constant acceleration.");
    {
      const auto mesh = parameters.section("Mesh");
      parameters.add_choice("Type", type, {"box", "spherical shell"}, "Shape of the body.");
      parameters.add_integer("Refinement", refinement, 0, 12, "Each level doubles the cells per direction.");
      parameters.add_flag("Adaptive", adaptive, "Refine where the shock is.");
    }
    {
      const auto materials = parameters.section("Materials");
      const auto soil      = parameters.section("soil");
      parameters.add_quantity("Density", density, "kg/m^3", positive, "Initial density.");
      parameters.add_quantity("Poisson ratio", poisson_ratio, "", {0., 0.5, false, true}, "Lateral over axial strain.");
    }
    {
      const auto stepping = parameters.section("Time stepping");
      parameters.add_quantity("Courant number", courant_number, "-", {0., 1., true, false},
                              "Share of the stable step.");
    }
    {
      const auto receivers = parameters.section("Receivers");
      parameters.add_points<2>("Points", points, "m", "Where to listen.");
    }
  }
};

/// The scene that has everything it needs, followed by @p more, as lines from 4 on.
const std::string complete = "subsection Materials / soil\n"
                             "  set Density = 1800\n"
                             "end\n";

Scene read(const std::string &text, const std::vector<std::string> &overrides = {})
{
  Parameters parameters = Parameters::from_text(text, "scene.prm", overrides);
  Scene      scene;
  scene.declare(parameters);
  parameters.parse();
  return scene;
}

std::string message_of(const std::function<void()> &action)
{
  try
    {
      action();
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "(no InputError)";
}

std::string refusal(const std::string &text, const std::vector<std::string> &overrides = {})
{
  return message_of([&]() { read(text, overrides); });
}

bool mentions(const std::string &message, const std::string &part)
{
  if (message.find(part) != std::string::npos)
    return true;
  BOOST_TEST_MESSAGE("message: " << message);
  return false;
}

/// A directory for the files of one test, one per process.
struct Folder
{
  Folder()
    : path(std::filesystem::temp_directory_path() / ("arenite_parameters_" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }

  std::string write(const std::string &name, const std::string &content) const
  {
    const std::filesystem::path file = path / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file.string();
  }

  std::filesystem::path path;
};

std::string refusal_of_file(const std::string &file)
{
  return message_of([&]() { Parameters::from_files({file}); });
}
} // namespace

BOOST_AUTO_TEST_SUITE(parameters)

// Values of every kind arrive in the members; what is not set keeps its default.
BOOST_AUTO_TEST_CASE(values_arrive)
{
  const Scene scene = read(complete + "set Title   =  Buried   charge # comment\n"
                                      "set Blocks = soil,  steel plate\n"
                                      "set End time = 3e-3\n"
                                      "set Gravity = 0, 0, \\\n"
                                      "              -9.81\n"
                                      "subsection Mesh\n"
                                      "  set Type = spherical shell\n"
                                      "  set Refinement = 4\n"
                                      "  set Adaptive = true\n"
                                      "end\n"
                                      "subsection Receivers\n"
                                      "  set Points = 0.5, 1; 2, -3e-1\n"
                                      "end\n");
  BOOST_TEST(scene.title == "Buried charge");
  BOOST_TEST(join(scene.blocks, "|") == "soil|steel plate");
  BOOST_TEST(scene.end_time == 3e-3);
  BOOST_TEST(scene.gravity[2] == -9.81);
  BOOST_TEST(scene.type == "spherical shell");
  BOOST_TEST(scene.refinement == 4u);
  BOOST_TEST(scene.adaptive);
  BOOST_TEST(scene.density == 1800.);
  BOOST_TEST(scene.courant_number == 0.9);
  BOOST_REQUIRE(scene.points.size() == 2u);
  BOOST_TEST(scene.points[1][1] == -0.3);
}

// A misspelt entry is reported with file, line, section, nearest name and its unit.
BOOST_AUTO_TEST_CASE(misspelt_entry)
{
  BOOST_TEST(refusal(complete + "set End tme = 1\n") ==
             "scene.prm:4: 'End tme' is not a parameter here. Did you mean 'End time' [s]?");
  BOOST_TEST(
    refusal("subsection Materials\n  subsection soil\n    set density = 1\n    set Density = 2\n  end\nend\n") ==
    "scene.prm:3: [Materials / soil] 'density' is not a parameter here. Did you mean 'Density' [kg/m^3]?");
}

// An entry that exists in another section is sent there.
BOOST_AUTO_TEST_CASE(entry_of_another_section)
{
  BOOST_TEST(refusal(complete + "set Courant number = 0.5\n") ==
             "scene.prm:4: 'Courant number' is not a parameter here. It belongs to [Time stepping].");
  BOOST_TEST(refusal(complete + "subsection Mesh\nset End time = 1\nend\n") ==
             "scene.prm:5: [Mesh] 'End time' is not a parameter here. It belongs to the top level.");
}

// An unknown section is reported once, at its opening, with the nearest section; not again for each entry.
BOOST_AUTO_TEST_CASE(misspelt_section)
{
  BOOST_TEST(refusal(complete + "subsection Mehs\n  set Refinement = 3\n  set Bogus = 1\nend\n") ==
             "scene.prm:4: [Mehs] is not a section here. Did you mean [Mesh]?");
  BOOST_TEST(refusal(complete + "subsection Materials\n  subsection sand\n  end\nend\n") ==
             "scene.prm:5: [Materials / sand] is not a section here. Known: soil.");
}

// A word, a unit, a decimal comma or a Fortran exponent is not a number, and the message names the unit.
BOOST_AUTO_TEST_CASE(not_a_number)
{
  for (const std::string value : {"1 ms", "1e-3 s", "abc", "1,5", "1.0d-3", "0x10", "", "3 4", "info",
                                  "\xE2\x88\x92"
                                  "1",
                                  "1e", "--1"})
    BOOST_TEST(mentions(refusal(complete + "set End time = " + value + "\n"),
                        "is not a number. Write plain SI numbers, without a unit (here s) and with a decimal point."),
               value);
  BOOST_TEST(
    refusal("subsection Materials / soil\n  set Density = 1 ms\nend\n") ==
    "scene.prm:2: [Materials / soil] Density = 1 ms: is not a number. Write plain SI numbers, without a unit (here "
    "kg/m^3) and with a decimal point.");
}

// NaN, infinities and numbers that overflow or underflow are refused, also those that the ParameterHandler lets pass.
BOOST_AUTO_TEST_CASE(numbers_that_are_not_finite)
{
  for (const std::string value : {"nan", "NaN", "inf", "-inf", "infinity", "1e999", "-1e999", "1e-400", "1e-310"})
    {
      BOOST_TEST(mentions(refusal(complete + "set End time = " + value + "\n"),
                          "scene.prm:4: End time = " + value + ":"),
                 value);
      BOOST_TEST(mentions(refusal(complete + "set Gravity = 0, 0, " + value + "\n"), "Gravity = 0, 0, " + value + ":"),
                 value);
    }
}

// Bounds are inclusive or exclusive as declared, and printed as a person writes them.
BOOST_AUTO_TEST_CASE(ranges)
{
  const auto poisson_ratio = [](const std::string &value) {
    return refusal("subsection Materials / soil\nset Density = 1\nset Poisson ratio = " + value + "\nend\n");
  };
  BOOST_TEST(poisson_ratio("0") == "(no InputError)");
  BOOST_TEST(poisson_ratio("0.4999999999") == "(no InputError)");
  BOOST_TEST(poisson_ratio("0.5") == "scene.prm:3: [Materials / soil] Poisson ratio = 0.5: must be in [0, 0.5).");
  BOOST_TEST(poisson_ratio("-1e-9") == "scene.prm:3: [Materials / soil] Poisson ratio = -1e-9: must be in [0, 0.5).");
  BOOST_TEST(refusal(complete + "set End time = 0") == "scene.prm:4: End time = 0: must be > 0 [s].");
}

// Integers have bounds, and nothing but digits is an integer.
BOOST_AUTO_TEST_CASE(integers)
{
  for (const std::string value : {"-3", "13", "2.5", "2.0", "1e1", "two", "99999999999", ""})
    BOOST_TEST(refusal(complete + "subsection Mesh\n  set Refinement = " + value + "\nend\n") ==
                 "scene.prm:5: [Mesh] Refinement = " + value + ": must be an integer in [0, 12].",
               value);
}

// A choice lists the words that it allows and the nearest one; a flag says what it is.
BOOST_AUTO_TEST_CASE(choices_and_flags)
{
  BOOST_TEST(refusal(complete + "subsection Mesh\n  set Type = sperical shell\n  set Adaptive = maybe\nend\n") ==
             "scene.prm:5: [Mesh] Type = sperical shell: must be one of: box, spherical shell. Did you mean 'spherical "
             "shell'?\n"
             "scene.prm:6: [Mesh] Adaptive = maybe: must be true or false.");
  const Parameters parameters = Parameters::from_text("set Kind = ful\n", "scene.prm");
  BOOST_TEST(message_of([&]() {
               parameters.peek_choice("Kind", "full", {"full", "half"});
             }) == "scene.prm:1: Kind = ful: must be one of: full, half. Did you mean 'full'?");
  BOOST_TEST(parameters.peek_choice("Other", "half", {"full", "half"}) == "half");
}

// Vectors and points have the right number of components, each a number.
BOOST_AUTO_TEST_CASE(vectors_and_points)
{
  BOOST_TEST(refusal(complete + "set Gravity = 0, -9.81\n") ==
             "scene.prm:4: Gravity = 0, -9.81: must be 3 numbers separated by commas, in m/s^2.");
  BOOST_TEST(mentions(refusal(complete + "set Gravity = 0, x, 1\n"), "Gravity = 0, x, 1: 'x' is not a number."));
  BOOST_TEST(mentions(refusal(complete + "set Gravity = 0 0 1\n"), "must be 3 numbers separated by commas"));
  BOOST_TEST(mentions(refusal(complete + "subsection Receivers\nset Points = 1, 2; 3\nend\n"),
                      "in point '3': must be 2 numbers separated by commas, in m."));
  BOOST_TEST(mentions(refusal(complete + "subsection Receivers\nset Points = 1, 2;\nend\n"), "in point ''"));
  BOOST_TEST(read(complete + "subsection Receivers\nset Points =\nend\n").points.empty());
}

// What is required, or has no admissible default, must be set; the message shows where its section is.
BOOST_AUTO_TEST_CASE(missing_entries)
{
  BOOST_TEST(refusal("") ==
             "scene.prm: [Materials / soil] 'Density' [kg/m^3] is missing; it has no default. Initial density.");
  BOOST_TEST(refusal("set End time = 1\nsubsection Materials\n  subsection soil\n  end\nend\n") ==
             "scene.prm:3: [Materials / soil] 'Density' [kg/m^3] is missing; it has no default. Initial density.");

  Parameters parameters = Parameters::from_text("", "scene.prm");
  double     length     = 1.;
  parameters.add_quantity("Length", length, "m", positive, "Of the bar.");
  parameters.require("Length");
  BOOST_TEST(message_of([&]() { parameters.parse(); }) ==
             "scene.prm: 'Length' [m] is missing; it has no default. Of the bar.");
  BOOST_CHECK_THROW(parameters.require("Width"), std::logic_error);
}

// All mistakes are reported together in the order of the file, at most eight lines and the number of the others.
BOOST_AUTO_TEST_CASE(all_mistakes_at_once)
{
  std::string text = complete;
  for (unsigned int i = 0; i < 11; ++i)
    text += "set Bogus " + std::to_string(i) + " = 1\n";
  const std::string message = refusal(text);
  BOOST_TEST(std::count(message.begin(), message.end(), '\n') == 8);
  BOOST_TEST(mentions(message, "scene.prm:4: 'Bogus 0'"));
  BOOST_TEST(mentions(message, "scene.prm:11: 'Bogus 7'"));
  BOOST_TEST(mentions(message, "\n... and 3 more."));
}

// A scene that is refused leaves the members as they were.
BOOST_AUTO_TEST_CASE(refused_scene_changes_nothing)
{
  Parameters parameters =
    Parameters::from_text(complete + "set End time = 7\nset Title = x\nset Bogus = 1\n", "scene.prm");
  Scene scene;
  scene.declare(parameters);
  BOOST_CHECK_THROW(parameters.parse(), InputError);
  BOOST_TEST(scene.end_time == 1e-3);
  BOOST_TEST(scene.title == "untitled");
}

// An unclosed subsection is reported with the line of its opening, an 'end' too many with its own.
BOOST_AUTO_TEST_CASE(unclosed_subsection)
{
  BOOST_TEST(refusal("set End time = 1\nsubsection Mesh\n  set Refinement = 1\n") ==
             "scene.prm:2: subsection 'Mesh' is never closed with 'end'.");
  BOOST_TEST(refusal("subsection Mesh\nend\nend\n") == "scene.prm:3: 'end' without an open subsection.");
}

// An entry given twice in one file is an error that names both lines, also when its section is opened twice.
BOOST_AUTO_TEST_CASE(duplicate)
{
  BOOST_TEST(refusal("set End time = 1\nset  End  time = 2\n") ==
             "scene.prm:2: 'End time' was set already in line 1. Remove one of them.");
  BOOST_TEST(refusal("subsection Mesh\nset Type = box\nend\nsubsection Mesh\nset Type = box\nend\n") ==
             "scene.prm:5: [Mesh] 'Type' was set already in line 2. Remove one of them.");
}

// Lines that are no statements are reported with what they lack.
BOOST_AUTO_TEST_CASE(broken_lines)
{
  BOOST_TEST(refusal("End time = 1\n") == "scene.prm:1: 'End time = 1' is not understood. Is 'set' missing in front?");
  BOOST_TEST(refusal("Title = x\n") == "scene.prm:1: 'Title = x' is not understood. Is 'set' missing in front?");
  BOOST_TEST(refusal("End\n") == "scene.prm:1: 'End' is not understood. Did you mean 'end'?");
  BOOST_TEST(refusal("sett Title = x\n") == "scene.prm:1: 'sett Title = x' is not understood. Did you mean 'set'?");
  BOOST_TEST(refusal("set Title x\n") == "scene.prm:1: 'set Title x' lacks a '='. Write 'set Name = value'.");
  BOOST_TEST(refusal("set = x\n") == "scene.prm:1: 'set = x' lacks the name. Write 'set Name = value'.");
  BOOST_TEST(mentions(refusal("subsection\nend\n"), "scene.prm:1: 'subsection' needs a name"));
  BOOST_TEST(mentions(refusal("subsection Mesh\nend Mesh\n"), "scene.prm:2: 'end' stands alone on its line"));
  BOOST_TEST(mentions(refusal("set Mesh/Type = box\n"), "scene.prm:1: 'Mesh/Type' contains '/'."));
  BOOST_TEST(mentions(refusal("set Title = x \\"), "scene.prm:1: the file ends after the '\\'"));
  BOOST_TEST(mentions(refusal("set\xC2\xA0Title = x\n"), "scene.prm:1: the line contains an invisible character"));
  BOOST_TEST(mentions(refusal("set Title = gr\xFC\xDF\n"), "scene.prm:1: the line is not UTF-8 text."));
}

// A backslash at the end of a comment does not swallow the next line (deal.II would).
BOOST_AUTO_TEST_CASE(comment_with_backslash)
{
  BOOST_TEST(read(complete + "# path\\\nset End time = 2\nset Title = x # y\\\n").end_time == 2.);
}

// A byte order mark, CRLF or CR line ends and a missing final newline change nothing.
BOOST_AUTO_TEST_CASE(files_of_other_systems)
{
  const Folder folder;
  for (const std::string newline : {"\n", "\r\n", "\r"})
    {
      const std::string file = folder.write("scene.prm", "\xEF\xBB\xBFset End time = 5" + newline + "subsection Mesh" +
                                                           newline + "set Type = spherical shell" + newline + "end");
      const Parameters  parameters = Parameters::from_files({file});
      BOOST_TEST(parameters.peek("End time", "") == "5");
      BOOST_TEST(parameters.peek("Mesh/Type", "") == "spherical shell");
    }
  BOOST_TEST(Parameters::from_files({folder.write("empty.prm", "")}).source_text() == "");
}

// Absent, unreadable, binary, huge files and directories are refused in one line without reading on.
BOOST_AUTO_TEST_CASE(files_that_cannot_be_read)
{
  const Folder folder;
  const auto   in_one_line = [](const std::string &message, const std::string &part) {
    return mentions(message, part) && message.find('\n') == std::string::npos;
  };
  BOOST_TEST(in_one_line(refusal_of_file(folder.path.string()), "is a directory"));
  BOOST_TEST(in_one_line(refusal_of_file((folder.path / "absent.prm").string()), "absent.prm' does not exist."));
  BOOST_TEST(in_one_line(refusal_of_file(""), "does not exist."));
  BOOST_TEST(in_one_line(refusal_of_file(folder.write("a.out", std::string("\x7F"
                                                                           "ELF\0\1",
                                                                           6))),
                         "is not a text file"));
  BOOST_TEST(in_one_line(refusal_of_file(folder.write("utf16.prm", std::string("\xFF\xFEs\0", 4))), "is UTF-16 text"));
  BOOST_TEST(in_one_line(refusal_of_file("/proc/self/mem"), "cannot be read"));
  BOOST_TEST(in_one_line(refusal_of_file("/dev/zero"), "larger than 16 MB"));
}

// Included files are found beside the file that includes them, may stand inside a section, and later settings win.
BOOST_AUTO_TEST_CASE(includes)
{
  const Folder folder;
  folder.write("parts/soil.prm", "set Density = 1\nset Poisson ratio = 0.1\ninclude more.prm\n");
  folder.write("parts/more.prm", "set Poisson ratio = 0.2\n");
  const std::string file =
    folder.write("scene.prm", "subsection Materials / soil\ninclude parts/soil.prm\nset Density = 3\nend\n");
  const Parameters parameters = Parameters::from_files({file});
  BOOST_TEST(parameters.peek("Materials/soil/Density", "") == "3");
  BOOST_TEST(parameters.peek("Materials/soil/Poisson ratio", "") == "0.2");
}

// A missing included file is reported with the line that includes it.
BOOST_AUTO_TEST_CASE(missing_include)
{
  const Folder      folder;
  const std::string file    = folder.write("scene.prm", "set Title = x\ninclude absent.prm\n");
  const std::string message = refusal_of_file(file);
  BOOST_TEST(mentions(message, "scene.prm:2: included file '"));
  BOOST_TEST(mentions(message, "' does not exist."));
}

// A file that includes itself, directly or through others, is refused with the whole chain (deal.II crashes).
BOOST_AUTO_TEST_CASE(recursive_include)
{
  const Folder folder;
  folder.write("b.prm", "include ./c.prm\n");
  folder.write("c.prm", "\ninclude a.prm\n");
  const std::string message = refusal_of_file(folder.write("a.prm", "include b.prm\n"));
  BOOST_TEST(mentions(message, "c.prm:2: a file must not include itself: "));
  const std::size_t a = message.find("a.prm -> "), b = message.find("b.prm -> "), c = message.find("c.prm -> ");
  BOOST_TEST((a < b && b < c && c != std::string::npos));
}

// Includes that double at every level end with a message instead of filling the memory.
BOOST_AUTO_TEST_CASE(too_many_includes)
{
  const Folder folder;
  for (unsigned int i = 0; i < 40; ++i)
    {
      const std::string next = "include " + std::to_string(i + 1) + ".prm\n";
      folder.write(std::to_string(i) + ".prm", next + next);
    }
  folder.write("40.prm", "");
  BOOST_TEST(mentions(refusal_of_file((folder.path / "0.prm").string()), "more than 1000 included files"));
}

// Of several files the later wins, and overrides win over files.
BOOST_AUTO_TEST_CASE(precedence)
{
  const Folder      folder;
  const std::string first      = folder.write("1.prm", "set End time = 1\nset Title = a\nset Blocks = x\n");
  const std::string last       = folder.write("2.prm", "set End time = 2\nset Title = b\n");
  const Parameters  parameters = Parameters::from_files({first, last}, {" End  time = 3"});
  BOOST_TEST(parameters.peek("End time", "") == "3");
  BOOST_TEST(parameters.peek("Title", "") == "b");
  BOOST_TEST(parameters.peek("Blocks", "") == "x");
  BOOST_TEST(parameters.source_text() == "Blocks = x\nEnd time = 3\nTitle = b\n");
}

// A replaced value need not suit the scene any more, as that of another dimension; its name must.
BOOST_AUTO_TEST_CASE(replaced_values)
{
  const std::string plane = "set Gravity = 0, -9.81\n" + complete;
  BOOST_TEST(mentions(refusal(plane), "must be 3 numbers"));
  BOOST_TEST(read(plane, {"Gravity=0, 0, -9.81"}).gravity[2] == -9.81);
  BOOST_TEST(mentions(refusal("set Gravty = 1\n" + complete, {"Gravty=0, 0, 1"}), "'Gravty' is not a parameter"));
}

// Mistakes in overrides are reported as the user typed them.
BOOST_AUTO_TEST_CASE(overrides)
{
  BOOST_TEST(read(complete, {"Mesh / Refinement = 5"}).refinement == 5u);
  BOOST_TEST(read("", {"Materials/soil/Density=5"}).density == 5.);
  BOOST_TEST(refusal(complete, {"Mesh/Refinemnt=3"}) ==
             "--set 'Mesh/Refinemnt=3': [Mesh] 'Refinemnt' is not a parameter here. Did you mean 'Refinement'?");
  BOOST_TEST(refusal(complete, {"Mehs/Refinement=3"}) ==
             "--set 'Mehs/Refinement=3': [Mehs] is not a section here. Did you mean [Mesh]?");
  BOOST_TEST(refusal(complete, {"Mesh/Refinement=-3"}) ==
             "--set 'Mesh/Refinement=-3': [Mesh] Refinement = -3: must be an integer in [0, 12].");
  BOOST_TEST(refusal(complete, {"Mesh/Refinement"}) ==
             "--set 'Mesh/Refinement': lacks a '='. Write --set \"Section/Entry=value\".");
  for (const std::string assignment : {"=3", "Mesh/=3", "/Title=3", ""})
    BOOST_TEST(mentions(refusal(complete, {assignment}), "--set '" + assignment + "': "), assignment);
  for (const std::string assignment : {"Title=a#b", "Title=a\nset End time = 1", "Title=a\\"})
    BOOST_TEST(mentions(refusal(complete, {assignment}), "cannot be part of a value"), assignment);
}

// The first pass reads choices without declarations; lists of names are refused when they could not name sections.
BOOST_AUTO_TEST_CASE(peeking)
{
  const Parameters parameters = Parameters::from_text(
    "set Blocks = soil ,  steel plate\nset None =\nset Twice = a, a\nset Gap = a,,b\nset Slash = a/b\n", "scene.prm");
  BOOST_TEST(parameters.peek("Mesh/Type", "box") == "box");
  BOOST_TEST(join(parameters.peek_list("Blocks"), "|") == "soil|steel plate");
  BOOST_TEST(parameters.peek_list("None").empty());
  BOOST_TEST(parameters.peek_list("Absent").empty());
  BOOST_TEST(parameters.is_set("None"));
  BOOST_TEST(!parameters.is_set("Absent"));
  BOOST_TEST(message_of([&]() { parameters.peek_list("Twice"); }) == "scene.prm:3: Twice = a, a: names 'a' twice.");
  BOOST_TEST(
    mentions(message_of([&]() { parameters.peek_list("Gap"); }), "scene.prm:4: Gap = a,,b: has an empty item"));
  BOOST_TEST(mentions(message_of([&]() { parameters.peek_list("Slash"); }), "scene.prm:5: Slash = a/b: a name cannot"));
}

// A rule that only the caller knows is reported at the place of the setting, the default, or the section.
BOOST_AUTO_TEST_CASE(refusing)
{
  Parameters parameters = Parameters::from_text(complete, "scene.prm");
  Scene      scene;
  scene.declare(parameters);
  parameters.parse();
  BOOST_TEST(message_of([&]() { parameters.refuse("Materials/soil/Density", "too light."); }) ==
             "scene.prm:2: [Materials / soil] Density = 1800: too light.");
  BOOST_TEST(message_of([&]() { parameters.refuse("End time", "too short."); }) ==
             "scene.prm: End time = 0.001 (default): too short.");
  BOOST_TEST(message_of([&]() { parameters.refuse("Materials/soil", "cap order."); }) ==
             "scene.prm:1: [Materials / soil]: cap order.");
  BOOST_TEST(message_of([&]() { parameters.refuse("Mesh/", "no cells."); }) == "scene.prm: [Mesh]: no cells.");
}

// The echo reads back to bitwise the same values, and echoes the same again.
BOOST_AUTO_TEST_CASE(echo_repeats_the_scene)
{
  Parameters parameters = Parameters::from_text(
    complete + "set End time = 0.1234567890123456789\nset Gravity = 1e-300, 0.1, -12345678.9\nset Title = x = y, z\n"
               "subsection Receivers\n set Points = .333333333333333333, 2; 1e22, 3\nend\n");
  Scene scene;
  scene.declare(parameters);
  parameters.parse();

  Parameters again = Parameters::from_text(parameters.echo(), "parameters_used.prm");
  Scene      copy;
  copy.declare(again);
  again.parse();
  BOOST_TEST(copy.end_time == scene.end_time);
  BOOST_TEST(copy.gravity == scene.gravity);
  BOOST_TEST(copy.title == "x = y, z");
  BOOST_TEST((copy.points == scene.points));
  BOOST_TEST(copy.density == scene.density);
  BOOST_TEST(again.echo() == parameters.echo());
  BOOST_TEST(mentions(again.echo(), "    # Initial density. [kg/m^3] (> 0)\n    set Density = 1800\n"));
}

// The manual has a table per section with default, unit, admissible values and meaning, before any scene is read.
BOOST_AUTO_TEST_CASE(manual)
{
  Parameters parameters;
  Scene      scene;
  scene.declare(parameters);
  const std::string text = parameters.manual();
  BOOST_TEST(mentions(text, "## Materials / soil\n\n| Entry | Default | Unit | Admissible | Meaning |\n"));
  BOOST_TEST(mentions(text, "| Density | *required* | kg/m^3 | > 0 | Initial density. |\n"));
  BOOST_TEST(mentions(text, "| End time | 0.001 | s | > 0 | The run stops here. |\n"));
  BOOST_TEST(mentions(text, "| Type | box |  | box, spherical shell | Shape of the body. |\n"));
}

// Declaring one entry twice is an error of the programmer, not of the user.
BOOST_AUTO_TEST_CASE(declared_twice)
{
  Parameters parameters;
  double     a = 1., b = 2.;
  parameters.add_quantity("Length", a, "m", positive, "One.");
  BOOST_CHECK_THROW(parameters.add_quantity("Length", b, "m", positive, "Two."), std::logic_error);
}

// A list may repeat a word (numbers of cells), but has no empty item.
BOOST_AUTO_TEST_CASE(lists)
{
  BOOST_TEST(join(read(complete + "set Blocks = 2, 2, 4\n").blocks, "|") == "2|2|4");
  BOOST_TEST(refusal(complete + "set Blocks = 2,, 4\n") ==
             "scene.prm:4: Blocks = 2,, 4: has an empty item: write words separated by single commas.");
}

// Every process gets the settings, or the same error, from process 0.
BOOST_AUTO_TEST_CASE(collective_reading, *boost::unit_test::label("parallel"))
{
  const Folder   folder; // each process has its own, only that of process 0 holds the file
  const MPI_Comm world = MPI_COMM_WORLD;
  const bool     first = dealii::Utilities::MPI::this_mpi_process(world) == 0;
  std::string    file  = (folder.path / "scene.prm").string();
  if (first)
    folder.write("scene.prm", "set Title = from process 0\n");
  BOOST_TEST(Parameters::from_files({file}).peek("Title", "") == "from process 0");
  if (first)
    folder.write("scene.prm", "subsection Mesh\n");
  const std::string message = refusal_of_file(file);
  BOOST_TEST(message == dealii::Utilities::MPI::broadcast(world, message));
  BOOST_TEST(mentions(message, "never closed"));
}

// The nearest name forgives case, one slip per three letters and a beginning; it does not guess.
BOOST_AUTO_TEST_CASE(nearest_names)
{
  const std::vector<std::string> known = {"Bulk modulus", "Density", "Refinement", "p"};
  BOOST_TEST(nearest_name("bulk modolus", known) == "Bulk modulus");
  BOOST_TEST(nearest_name("Desnity", known) == "Density");
  BOOST_TEST(nearest_name("DENSITY", known) == "Density");
  BOOST_TEST(nearest_name("Refine", known) == "Refinement");
  BOOST_TEST(nearest_name("Viscosity", known) == "");
  BOOST_TEST(nearest_name("q", known) == "");
  BOOST_TEST(nearest_name("", known) == "");
  BOOST_TEST(nearest_name("x", {}) == "");
}

namespace
{
struct Shape
{
  virtual ~Shape()              = default;
  virtual double volume() const = 0;
};
struct Cube : Shape
{
  explicit Cube(const double a)
    : a(a)
  {}
  double volume() const override { return a * a * a; }
  double a;
};
struct Bar : Shape
{
  explicit Bar(const double a)
    : a(a)
  {}
  double volume() const override { return a; }
  double a;
};
} // namespace

// A registry makes objects by name, refuses others with the nearest name and prints its catalogue in order.
BOOST_AUTO_TEST_CASE(registry)
{
  Registry<Shape, double> shapes("shape");
  shapes.add<Cube>("cube", "Three equal sides.");
  shapes.add<Bar>("bar", "One side.");
  BOOST_TEST(shapes.make("cube", 2.)->volume() == 8.);
  BOOST_TEST(join(shapes.names()) == "cube, bar");
  BOOST_TEST(shapes.catalogue() == "- **cube**: Three equal sides.\n- **bar**: One side.\n");
  BOOST_TEST(message_of([&]() { shapes.make("cubr", 1.); }) ==
             "'cubr' is not a shape. Did you mean 'cube'? Known: cube, bar.");
  BOOST_CHECK_THROW(shapes.add<Bar>("bar", "Again."), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()
