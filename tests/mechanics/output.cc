// What a run leaves behind: the guard of its directory, complete files or an error, and fields that are right.

#include <arenite/base/errors.h>
#include <arenite/io/files.h>
#include <arenite/io/log.h>
#include <arenite/io/output_directory.h>
#include <arenite/io/run_record.h>
#include <arenite/io/statistics.h>
#include <arenite/io/vtu_output.h>
#include <arenite/mechanics/nodal_stress.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <unistd.h>

using namespace Arenite;
using namespace dealii;
namespace fs      = std::filesystem;
namespace utf     = boost::unit_test;
using Distributed = parallel::distributed::Triangulation<3>;

namespace
{
const MPI_Comm world = MPI_COMM_WORLD;

bool first_process() { return Utilities::MPI::this_mpi_process(world) == 0; }

void on_first(const std::function<void()> &action)
{
  if (first_process())
    action();
  MPI_Barrier(world);
}

/// A directory of the test that disappears with it, the same on all processes.
struct Scratch
{
  Scratch()
  {
    path =
      (fs::temp_directory_path() / ("arenite-output-" + std::to_string(Utilities::MPI::broadcast(world, getpid()))))
        .string();
    on_first([&]() {
      fs::remove_all(path);
      fs::create_directories(path);
    });
  }
  ~Scratch()
  {
    if (std::uncaught_exceptions() == 0)
      MPI_Barrier(world); // others may still read
    on_first([&]() { fs::remove_all(path); });
  }
  std::string path;
};

std::string content(const std::string &name)
{
  std::ifstream     file(name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

void make_file(const std::string &name, const std::string &text) { std::ofstream(name) << text; }

/// std::cout is silent while this lives.
struct Quiet
{
  Quiet()
    : old(std::cout.rdbuf(text.rdbuf()))
  {}
  ~Quiet() { std::cout.rdbuf(old); }
  std::ostringstream text;
  std::streambuf    *old;
};

/// Shell or box with cells of three sizes, so that nodes hang on faces and edges; the box is bent.
struct Mesh
{
  Mesh(const bool shell, const unsigned int degree)
    : triangulation(world)
    , discretization(triangulation, degree)
  {
    if (shell)
      GridGenerator::hyper_shell(triangulation, Point<3>(), 0.4, 1., 6);
    else
      GridGenerator::subdivided_hyper_cube(triangulation, 2, -1., 1.);
    for (unsigned int level = 0; level < 2; ++level)
      {
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && cell->center() * Point<3>(1., 0.8, 0.6) > (level == 0 ? 0.1 : 0.7))
            cell->set_refine_flag();
        triangulation.execute_coarsening_and_refinement();
      }
    discretization.distribute_nodes();
    discretization.positions_from_manifolds();
    if (!shell)
      discretization.transform([](const Point<3> &x) {
        return Point<3>(x[0] + 0.1 * x[1] * x[2], x[1] + 0.1 * std::sin(x[0] + x[2]), x[2] - 0.1 * x[0] * x[0]);
      });
  }

  VectorType linear_field(const Tensor<2, 3> &gradient) const
  {
    VectorType u = discretization.new_vector();
    for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
      for (unsigned int i = 0; i < 3; ++i)
        u.local_element(3 * node + i) = gradient[i] * discretization.position(node);
    make_consistent(discretization, u);
    return u;
  }

  Distributed       triangulation;
  Discretization<3> discretization;
};

constexpr LinearElastic soil{2000., 8e8, 3e8}, steel{7850., 1.6e11, 8e10};

Tensor<2, 3> some_gradient()
{
  Tensor<2, 3> gradient;
  double       value = 1e-3;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      gradient[i][j] = value *= -0.8;
  return gradient;
}
} // namespace

BOOST_AUTO_TEST_SUITE(output)

BOOST_AUTO_TEST_CASE(stress_of_a_linear_field_is_exact, *utf::label("parallel"))
{
  const Tensor<2, 3>          gradient = some_gradient();
  const SymmetricTensor<2, 3> exact    = soil.stress(gradient);
  // sigma = lambda tr(eps) I + 2 G eps, one component of each kind by hand
  BOOST_TEST(exact[0][1] == soil.shear_modulus * (gradient[0][1] + gradient[1][0]),
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(pressure(exact) == -soil.bulk_modulus * trace(gradient), boost::test_tools::tolerance(1e-13));

  for (const bool shell : {false, true})
    for (const unsigned int degree : {1, 2, 3, 4})
      {
        const Mesh mesh(shell, degree);
        BOOST_TEST(Utilities::MPI::sum(mesh.discretization.hanging.size(), world) > 0u);
        const NodalStress<3> stress = nodal_stress(mesh.discretization, mesh.linear_field(gradient), {soil});
        double               error  = 0.;
        for (unsigned int k = 0; k < stress.size(); ++k)
          for (unsigned int node = 0; node < mesh.discretization.n_local_nodes();
               ++node) // ghosts and hanging nodes too
            error = std::max(error, std::abs(stress[k].local_element(node) - exact.access_raw_entry(k)));
        // round-off of u times the inverse size of the smallest cell
        BOOST_TEST(error < 1e-11 * exact.norm());
      }
}

BOOST_AUTO_TEST_CASE(stress_between_materials_is_the_mean, *utf::label("parallel"))
{
  Distributed triangulation(world);
  GridGenerator::subdivided_hyper_rectangle(triangulation, {2, 1, 1}, Point<3>(), Point<3>(2., 1., 1.));
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_material_id(cell->center()[0] > 1. ? 1 : 0);
  Discretization<3> discretization(triangulation, 2);
  discretization.distribute_nodes();
  discretization.positions_from_manifolds();
  VectorType u = discretization.new_vector();
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    u.local_element(3 * node) = 1e-3 * discretization.position(node)[1]; // pure shear, sigma_xy = 1e-3 G
  make_consistent(discretization, u);
  const NodalStress<3> stress = nodal_stress(discretization, u, {soil, steel});
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    {
      const double x = discretization.position(node)[0];
      const double G = x < 0.99   ? soil.shear_modulus
                       : x > 1.01 ? steel.shear_modulus
                                  : 0.5 * (soil.shear_modulus + steel.shear_modulus);
      BOOST_TEST(stress[3].local_element(node) == 1e-3 * G, boost::test_tools::tolerance(1e-11));
    }
}

BOOST_AUTO_TEST_CASE(von_mises_of_uniaxial_stress)
{
  SymmetricTensor<2, 3> stress;
  stress[2][2] = -7.;
  BOOST_TEST(von_mises_stress(stress) == 7., boost::test_tools::tolerance(1e-14));
  BOOST_TEST(pressure(stress) == 7. / 3., boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(directory_has_the_name_of_the_scene)
{
  BOOST_TEST(OutputDirectory("", "prm/blast.prm", OutputDirectory::Mode::overwrite, MPI_COMM_SELF).path() ==
             "output/blast");
  BOOST_TEST(OutputDirectory("", "a.b.prm", OutputDirectory::Mode::overwrite, MPI_COMM_SELF).path() == "output/a.b");
  BOOST_TEST(OutputDirectory("", "blast.txt", OutputDirectory::Mode::overwrite, MPI_COMM_SELF).path() ==
             "output/blast.txt");
  BOOST_TEST(OutputDirectory("there/", "blast.prm", OutputDirectory::Mode::overwrite, MPI_COMM_SELF).path() == "there");
}

BOOST_AUTO_TEST_CASE(old_results_are_guarded, *utf::label("parallel"))
{
  const Scratch scratch;
  for (const std::string result :
       {"parameters_used.prm", "run.json", "log.txt", "statistics.csv", "solution.pvd", "receivers.h5",
        "receivers-array.csv", "solution/step-000010.pvtu", "solution/step-1234567.11.vtu"})
    {
      on_first([&]() {
        fs::remove_all(scratch.path);
        fs::create_directories(scratch.path + "/solution");
        make_file(scratch.path + "/" + result, "old");
      });
      BOOST_CHECK_EXCEPTION(OutputDirectory(scratch.path, "", OutputDirectory::Mode::refuse, world), InputError,
                            [&](const InputError &error) {
                              const std::string what = error.what();
                              return what.find(result) != std::string::npos &&
                                     what.find("--overwrite") != std::string::npos &&
                                     what.find('\n') == std::string::npos;
                            });
      BOOST_TEST(content(scratch.path + "/" + result) == "old");
      MPI_Barrier(world);
      const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::overwrite, world);
      BOOST_TEST(content(scratch.path + "/" + result) == "old"); // nothing is touched before create()
      MPI_Barrier(world);
      directory.create();
      BOOST_TEST(results_in(scratch.path).empty());
      MPI_Barrier(world);
    }
}

BOOST_AUTO_TEST_CASE(foreign_files_stay, *utf::label("parallel"))
{
  const Scratch                  scratch;
  const std::vector<std::string> foreign = {"notes.txt",
                                            "receivers.csv",
                                            "run.json.bak",
                                            "solution/step-1.vtu",
                                            "solution/step-000001.vtu.txt",
                                            "solution/my-step-000001.pvtu",
                                            "log.txt/inside"}; // a directory with the name of a result
  on_first([&]() {
    fs::create_directories(scratch.path + "/solution");
    fs::create_directories(scratch.path + "/log.txt");
    for (const std::string &name : foreign)
      make_file(scratch.path + "/" + name, "mine");
    make_file(scratch.path + "/statistics.csv", "old");
  });
  OutputDirectory(scratch.path, "", OutputDirectory::Mode::overwrite, world).create();
  for (const std::string &name : foreign)
    BOOST_TEST(content(scratch.path + "/" + name) == "mine");
  BOOST_TEST(!fs::exists(scratch.path + "/statistics.csv"));
  // without results it is nobody's output directory: no flag is needed
  OutputDirectory(scratch.path, "", OutputDirectory::Mode::refuse, world).create();
  MPI_Barrier(world);
}

BOOST_AUTO_TEST_CASE(impossible_directories, *utf::label("parallel"))
{
  const Scratch scratch;
  on_first([&]() { make_file(scratch.path + "/file", "mine"); });
  BOOST_CHECK_THROW(OutputDirectory(scratch.path + "/file", "", OutputDirectory::Mode::overwrite, world), InputError);
  const OutputDirectory below_a_file(scratch.path + "/file/deep", "", OutputDirectory::Mode::refuse, world);
  BOOST_CHECK_EXCEPTION(below_a_file.create(), OutputError, [&](const OutputError &error) {
    return std::string(error.what()).find(scratch.path) != std::string::npos;
  });
  BOOST_TEST(content(scratch.path + "/file") == "mine");
  const OutputDirectory deep(scratch.path + "/a/b c/d", "", OutputDirectory::Mode::refuse, world);
  deep.create();
  BOOST_TEST(fs::is_directory(deep.path()));
  BOOST_TEST(fs::is_empty(deep.path())); // the probe is gone
  MPI_Barrier(world);
}

BOOST_AUTO_TEST_CASE(log_speaks_once, *utf::label("parallel"))
{
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  std::string           screen;
  {
    Quiet quiet;
    Log   log(world);
    log << "Cells: " << 12 << '\n';
    log.open(directory);
    log << "one";
    log << " two\nthree";
    log.line(" four");
    on_first(
      [&]() { BOOST_TEST(content(directory.file("log.txt")) == "Cells: 12\none two\nthree four\n"); }); // at once
    log << "end";
    log.finish();
    screen = quiet.text.str();
  }
  MPI_Barrier(world);
  BOOST_TEST(content(directory.file("log.txt")) == "Cells: 12\none two\nthree four\nend\n");
  BOOST_TEST(screen == (first_process() ? "Cells: 12\none two\nthree four\nend\n" : ""));
}

BOOST_AUTO_TEST_CASE(one_log_for_several_runs, *utf::label("parallel"))
{
  const Scratch scratch;
  {
    Quiet quiet;
    Log   log(world);
    for (const std::string run : {"first", "second"})
      {
        const OutputDirectory directory(scratch.path + "/" + run, "", OutputDirectory::Mode::refuse, world);
        directory.create();
        log.line("Title of the " + run);
        log.open(directory);
        log.line("end");
        BOOST_CHECK_NO_THROW(log.finish());
      }
  }
  BOOST_TEST(content(scratch.path + "/first/log.txt") == "Title of the first\nend\n");
  BOOST_TEST(content(scratch.path + "/second/log.txt") == "Title of the second\nend\n");
  MPI_Barrier(world);
}

BOOST_AUTO_TEST_CASE(statistics_are_those_of_the_full_body, *utf::label("parallel"))
{
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  std::string           screen;
  double                dof_steps = 0.;
  {
    Quiet      quiet;
    Log        log(world);
    Statistics statistics;
    statistics.progress_interval = 1e6; // only the first and the last row
    statistics.open(directory, log, 0., 4., 8.);
    EnergyReport report;
    report.work = {{"blast", 0.}};
    statistics.add(report, {0, 0.5, 10, 300});
    for (unsigned int step : {2, 4, 8})
      {
        report.time           = 0.5 * step;
        report.kinetic        = 0.5 * step;
        report.strain         = 0.25 * step;
        report.work[0].second = step == 8 ? 5. : 0.75 * step;
        statistics.add(report, {step, 0.5, 10, 300});
      }
    statistics.finish();
    dof_steps = statistics.dof_steps();
    screen    = quiet.text.str();
  }
  BOOST_TEST(dof_steps == 8 * 300.);
  if (!first_process())
    return;
  BOOST_TEST(std::count(screen.begin(), screen.end(), '\n') == 2);
  std::ifstream file(directory.file("statistics.csv"));
  std::string   line, last;
  std::getline(file, line);
  BOOST_TEST(line ==
             "t [s],step,dt [s],cells,dofs,kinetic (full body) [J],strain (full body) [J],hourglass (full body) [J],"
             "work of blast (full body) [J],initial (full body) [J],step changes (full body) [J],"
             "adaptation (full body) [J],imbalance (full body) [J],relative energy error");
  unsigned int n_rows = 0;
  while (std::getline(file, line))
    {
      ++n_rows;
      last = line;
    }
  BOOST_TEST(n_rows == 4u);
  // 8 x (4 + 2 - 5) = 8 J are missing; the largest energy of the sector was 6 J
  BOOST_TEST(last.substr(0, last.rfind(',')) == "4,8,0.5,10,300,32,16,0,40,0,0,0,8");
  BOOST_TEST(std::stod(last.substr(last.rfind(',') + 1)) == 1. / 6., boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(run_record_round_trip, *utf::label("parallel"))
{
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  RunRecord             record;
  record.title        = "Cavity \"elastic\" \xe9"; // Latin-1: not valid in JSON
  record.scenes       = {"prm/cavity.prm"};
  record.overrides    = {"Element/Degree=2"};
  record.dofs         = 6000000000ull; // more than 32 bits
  record.cells        = 7;
  record.steps        = 11;
  record.dof_steps    = 3e6;
  record.core_seconds = 1.5;
  record.energy_error = 1.25e-12;
  record.errors       = {{"array.displacement.E_t", 0.1}, {"body.velocity.E_x", 1e-300}};
  record.measure_memory(world);
  record.write(directory);
  record.cells = 8;
  record.write(directory); // replaces
  MPI_Barrier(world);

  const auto json = nlohmann::json::parse(content(directory.file("run.json")));
  for (const char *key : {"version", "commit", "compiler", "deal_ii", "setup_core_seconds", "output_core_seconds",
                          "lanes", "mass_error", "momentum_error"})
    BOOST_TEST(json.contains(key), key);
  BOOST_TEST(json.at("ranks") == Utilities::MPI::n_mpi_processes(world));
  BOOST_TEST(json.at("dimension") == 3);
  BOOST_TEST(json.at("cells") == 8);
  BOOST_TEST(json.at("dofs").get<std::uint64_t>() == record.dofs);
  BOOST_TEST(json.at("steps") == 11);
  BOOST_TEST(json.at("mdofs_per_core_second").get<double>() == 2.);
  BOOST_TEST(json.at("energy_error").get<double>() == 1.25e-12);
  BOOST_TEST(json.at("errors").at("array.displacement.E_t").get<double>() == 0.1);
  BOOST_TEST(json.at("errors").at("body.velocity.E_x").get<double>() == 1e-300);
  BOOST_TEST(json.at("overrides").at(0) == "Element/Degree=2");
  const double peak = json.at("peak_memory_mb").get<double>();
  BOOST_TEST((peak > 10. && peak < 1e5)); // MB: an empty program has about 150
  BOOST_TEST(json.at("total_memory_mb").get<double>() >= peak);
  BOOST_TEST(!fs::exists(directory.file("run.json.new")));
  MPI_Barrier(world);
}

BOOST_AUTO_TEST_CASE(pictures_are_complete, *utf::label("parallel"))
{
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  const Mesh            mesh(true, 2);
  const VectorType      u = mesh.linear_field(some_gradient());
  Vector<float>         indicator(mesh.triangulation.n_active_cells());
  VTUOutput<3>          vtu;
  BOOST_TEST(!vtu.enabled());
  BOOST_TEST(!vtu.is_due(0., 1.));
  vtu.interval = 1e-3;
  BOOST_TEST(vtu.is_due(0., 1e-4));
  vtu.write(directory, mesh.discretization, u, u, {soil}, 0., 0);
  BOOST_TEST(!vtu.is_due(0.9e-3, 1e-4));
  BOOST_TEST(vtu.is_due(0.96e-3, 1e-4));
  vtu.write(directory, mesh.discretization, u, u, {soil}, 0.96012345e-3, 9, {{"indicator", indicator}});
  vtu.write(directory, mesh.discretization, u, u, {soil}, 0.96012345e-3, 9, {{"indicator", indicator}}); // again
  BOOST_TEST(!vtu.is_due(1.06e-3, 1e-4));
  BOOST_TEST(vtu.is_due(1.96e-3, 1e-4));
  BOOST_TEST(vtu.last_time() == 0.96012345e-3);
  MPI_Barrier(world);

  using boost::property_tree::ptree;
  ptree              tree;
  std::uint64_t      n_points = 0, n_cells = 0;
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(world);
  for (unsigned int rank = 0; rank < n_ranks; ++rank)
    {
      boost::property_tree::read_xml(directory.file("solution/step-000009." + std::to_string(rank) + ".vtu"), tree);
      const ptree &piece = tree.get_child("VTKFile.UnstructuredGrid.Piece");
      n_points += piece.get<std::uint64_t>("<xmlattr>.NumberOfPoints");
      n_cells += piece.get<std::uint64_t>("<xmlattr>.NumberOfCells");
      // deal.II writes an array without numbers, and no error, when it does not know the shape of the cells
      for (const char *section : {"Points", "Cells", "PointData"})
        for (const auto &item : piece.get_child(section))
          if (item.first == "DataArray")
            BOOST_TEST(item.second.data().find_first_not_of(" \n") != std::string::npos,
                       section << ": " << item.second.get<std::string>("<xmlattr>.Name", "positions"));
      std::set<std::string> arrays;
      for (const auto &item : piece.get_child("PointData"))
        if (item.first == "DataArray")
          arrays.insert(item.second.get<std::string>("<xmlattr>.Name") + ":" +
                        item.second.get<std::string>("<xmlattr>.NumberOfComponents", "1"));
      for (const char *array : {"displacement:3", "velocity:3", "stress:9", "pressure:1", "von_mises_stress:1",
                                "material:1", "refinement_level:1", "subdomain:1", "indicator:1"})
        BOOST_TEST(arrays.count(array) == 1, array);
    }
  BOOST_TEST(n_cells == mesh.triangulation.n_global_active_cells());
  BOOST_TEST(n_points == 27 * mesh.triangulation.n_global_active_cells()); // one Lagrange cell of degree 2 per cell

  boost::property_tree::read_xml(directory.file("solution/step-000009.pvtu"), tree);
  BOOST_TEST(tree.get_child("VTKFile.PUnstructuredGrid").count("Piece") == n_ranks);
  boost::property_tree::read_xml(directory.file("solution.pvd"), tree);
  std::vector<std::pair<double, std::string>> times;
  for (const auto &item : tree.get_child("VTKFile.Collection"))
    times.emplace_back(item.second.get<double>("<xmlattr>.timestep"), item.second.get<std::string>("<xmlattr>.file"));
  BOOST_TEST(times.size() == 2u);
  BOOST_TEST(times.back().first == 0.96012345e-3, boost::test_tools::tolerance(1e-11));
  BOOST_TEST(fs::exists(directory.file(times.back().second)));
  BOOST_TEST(content(directory.file("solution.visit")).find("solution/step-000009.0.vtu") != std::string::npos);
  MPI_Barrier(world);
}

BOOST_AUTO_TEST_CASE(processes_without_cells_can_write, *utf::label("parallel"))
{
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  Distributed           triangulation(world);
  GridGenerator::hyper_cube(triangulation);
  Discretization<3> discretization(triangulation, 1);
  discretization.distribute_nodes();
  discretization.positions_from_manifolds();
  const VectorType u = discretization.new_vector();
  VTUOutput<3>     vtu;
  vtu.write(directory, discretization, u, u, {soil}, 0., 0);
  on_first([&]() { BOOST_TEST(fs::exists(directory.file("solution/step-000000.pvtu"))); });
}

// Every file in turn is a link to the device that is always full.
BOOST_AUTO_TEST_CASE(full_disk, *utf::label("parallel"))
{
  if (!fs::exists("/dev/full"))
    return;
  const auto says_full = [](const OutputError &error) {
    const std::string what = error.what();
    return what.find("No space left") != std::string::npos && what.find('\n') == std::string::npos;
  };
  const Scratch         scratch;
  const OutputDirectory directory(scratch.path, "", OutputDirectory::Mode::refuse, world);
  const auto            fill = [&](const std::string &name) {
    on_first([&]() { fs::create_symlink("/dev/full", directory.file(name)); });
  };

  fill("log.txt");
  {
    Quiet quiet;
    Log   log(world);
    log.open(directory);
    log.line("The run goes on.");
    BOOST_CHECK_EXCEPTION(log.finish(), OutputError, says_full);
    BOOST_TEST(quiet.text.str() == (first_process() ? "The run goes on.\n" : ""));
  }

  fill("statistics.csv");
  {
    Quiet      quiet;
    Log        log(world);
    Statistics statistics;
    statistics.open(directory, log, 0., 1., 1.);
    BOOST_CHECK_EXCEPTION(statistics.add({}, {}), OutputError, says_full);
  }

  fill("run.json.new");
  BOOST_CHECK_EXCEPTION(RunRecord().write(directory), OutputError, says_full);
  BOOST_TEST(!fs::exists(directory.file("run.json")));

  const Mesh       mesh(false, 1);
  const VectorType u    = mesh.linear_field(some_gradient());
  const auto       last = std::to_string(Utilities::MPI::n_mpi_processes(world) - 1);
  for (const std::string &name : {"solution/step-000001." + last + ".vtu", std::string("solution/step-000002.pvtu.new"),
                                  std::string("solution.pvd.new"), std::string("solution.visit.new")})
    {
      on_first([&]() {
        fs::remove_all(directory.file("solution"));
        fs::create_directories(directory.file("solution"));
      });
      fill(name);
      VTUOutput<3>       vtu;
      const unsigned int step = name.find("2.pvtu") != std::string::npos ? 2 : 1;
      BOOST_CHECK_EXCEPTION(vtu.write(directory, mesh.discretization, u, u, {soil}, 0., step), OutputError, says_full);
      on_first([&]() { BOOST_TEST(!fs::exists(fs::symlink_status(directory.file(name)))); }); // no short file is left
    }
}

BOOST_AUTO_TEST_CASE(one_section_for_all_output)
{
  Parameters   parameters = Parameters::from_text("subsection Output\n set VTU interval = 1e-4\n set Subdivisions = 1\n"
                                                    " set Progress interval = 0\n set Statistics interval = 5\nend\n");
  VTUOutput<3> vtu;
  Statistics   statistics;
  vtu.declare_parameters(parameters);
  statistics.declare_parameters(parameters);
  parameters.parse();
  BOOST_TEST(vtu.interval == 1e-4);
  BOOST_TEST(vtu.subdivisions == 1u);
  BOOST_TEST(statistics.progress_interval == 0.);
  BOOST_TEST(statistics.is_due(15));
  BOOST_TEST(!statistics.is_due(16));
}

BOOST_AUTO_TEST_CASE(durations)
{
  BOOST_TEST(duration(0.4) == "0 s");
  BOOST_TEST(duration(185.) == "3 min 05 s");
  BOOST_TEST(duration(7800.) == "2 h 10 min");
  BOOST_TEST(duration(std::nan("")) == "unknown");
}

BOOST_AUTO_TEST_SUITE_END()
