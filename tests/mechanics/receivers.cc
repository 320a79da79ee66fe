// Fields between the nodes, receivers and error norms: what is known exactly must come back, on any mesh and on any number of
// processes. Linear fields of x are reproduced by every isoparametric cell, however curved, and by hanging nodes.

#include <arenite/base/errors.h>
#include <arenite/io/error_norms.h>
#include <arenite/io/receivers.h>
#include <arenite/verification/manufactured.h>

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_generator.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

using namespace Arenite;
using namespace dealii;

namespace
{
constexpr int dim = 3;

const LinearElastic soil{1600., 3e7, 2e7};
LinearElastic       soil_everywhere(types::material_id) { return soil; }

enum class Body
{
  box,  ///< unit cube, distorted
  shell ///< octant 1 < r < 2
};

/// A mesh with hanging nodes and its nodes.
struct Mesh
{
  Mesh(const Body body, const unsigned int degree, const unsigned int refinements, const bool hanging = true)
    : triangulation(MPI_COMM_WORLD)
    , body(body)
  {
    if (body == Body::box)
      GridGenerator::hyper_cube(triangulation);
    else
      GridGenerator::quarter_hyper_shell(triangulation, Point<dim>(), 1., 2.);
    triangulation.refine_global(refinements);
    discretization = std::make_unique<Discretization<dim>>(triangulation, degree);
    if (hanging)
      refine([](const Point<dim> &x) { return x[0] > x[1] && x[2] < 0.7; });
    else
      number();
  }

  void refine(const std::function<bool(const Point<dim> &)> &where)
  {
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && where(cell->center()))
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    number();
  }

  void number()
  {
    discretization->distribute_nodes();
    discretization->positions_from_manifolds();
    if (body == Body::box)
      discretization->transform([](const Point<dim> &x) {
        const double bump = 0.08 * std::sin(2. * x[0]) * std::cos(3. * x[1]) * std::sin(2. * x[2] + 0.3);
        return x + Point<dim>(bump, -0.7 * bump, 0.5 * bump);
      });
  }

  parallel::distributed::Triangulation<dim> triangulation;
  Body                                      body;
  std::unique_ptr<Discretization<dim>>      discretization;
};

/// u = (1 + 20 t + 300 t^2) (A x + b) [mm]: linear in space, quadratic in time.
class LinearMotion : public ExactSolution<dim>
{
public:
  static double factor(const double t) { return 1. + 20. * t + 300. * t * t; }
  static double rate(const double t) { return 20. + 600. * t; }

  Tensor<1, dim> shape(const Point<dim> &x) const { return A * x + b; }

  Tensor<1, dim> displacement(const Point<dim> &x, const double t) const override { return factor(t) * shape(x); }
  Tensor<1, dim> velocity(const Point<dim> &x, const double t) const override { return rate(t) * shape(x); }
  SymmetricTensor<2, 3> stress(const Point<dim> &, const double t) const override { return factor(t) * soil.stress(A); }

  const Tensor<1, dim> b{{0.3e-3, -0.5e-3, 0.7e-3}};
  const Tensor<2, dim> A{{{1e-3, 0.3e-3, -0.2e-3}, {0.5e-3, -0.7e-3, 0.4e-3}, {0.1e-3, 0.6e-3, 0.9e-3}}};
};

void set(VectorType &vector, const Discretization<dim> &discretization,
         const std::function<Tensor<1, dim>(const Point<dim> &)> &field)
{
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      vector.local_element(dim * node + c) = field(discretization.position(node))[c];
}

VectorType interpolate(const Discretization<dim>                               &discretization,
                       const std::function<Tensor<1, dim>(const Point<dim> &)> &field)
{
  VectorType result = discretization.new_vector();
  set(result, discretization, field);
  make_consistent(discretization, result);
  return result;
}

/// The state that central differences would have on a prescribed motion; hanging nodes of the half-step velocity hold nonsense.
void prescribe(State<dim> &state, const Discretization<dim> &discretization, const LinearMotion &motion,
               const Tensor<1, dim> &offset = {})
{
  state.displacement.zero_out_ghost_values();
  set(state.displacement, discretization,
      [&](const Point<dim> &x) { return motion.displacement(x, state.time) + offset; });
  make_consistent(discretization, state.displacement);
  state.half_velocity.zero_out_ghost_values();
  set(state.half_velocity, discretization,
      [&](const Point<dim> &x) { return motion.velocity(x, state.time - 0.5 * state.dt_last); });
  for (const unsigned int node : discretization.hanging.list())
    if (node < discretization.n_owned_nodes())
      state.half_velocity.local_element(dim * node) = 1e30;
}

/// Folder that all processes share, removed at the end.
struct Folder
{
  Folder()
    : path((std::filesystem::temp_directory_path() /
            ("arenite-receivers-" + std::to_string(Utilities::MPI::broadcast(MPI_COMM_WORLD, int(getpid())))))
             .string())
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::create_directories(path);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Folder()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::filesystem::remove_all(path, ignored);
  }
  const std::string path;
};

/// A written table read back.
struct TextTable
{
  explicit TextTable(const std::string &file_name)
  {
    std::ifstream file(file_name);
    std::string   line;
    const auto    next = [&]() { return bool(std::getline(file, line)); };
    if (next())
      for (std::istringstream words(line); std::getline(words, line, ',');)
        columns.push_back(line);
    while (next())
      {
        rows.emplace_back();
        for (std::istringstream words(line); std::getline(words, line, ',');)
          rows.back().push_back(std::strtod(line.c_str(), nullptr));
      }
  }
  std::vector<std::string>         columns;
  std::vector<std::vector<double>> rows;
};

/// Sets declared by a scene, ready for open().
struct Sets
{
  explicit Sets(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    receivers.declare_parameters(parameters);
    parameters.parse();
    receivers.finalize(parameters);
  }
  ReceiverSets<dim> receivers;
};

bool mentions(const std::exception &error, const std::vector<std::string> &words)
{
  const std::string text = error.what();
  for (const std::string &word : words)
    if (text.find(word) == std::string::npos)
      {
        BOOST_TEST_MESSAGE(text);
        return false;
      }
  return true;
}

const std::vector<Point<dim>> array_points{{1.3, 0.4, 0.2}, {0.3, 0.8, 1.1}, {0., 0., 1.5}};

const std::string array_scene = R"(
set Receivers = array
subsection Receivers
  subsection array
    set Points = 1.3,0.4,0.2; 0.3,0.8,1.1; 0,0,1.5
  end
end
)";
} // namespace

BOOST_AUTO_TEST_SUITE(receivers)

// The inverse map finds every place of every cell again, also a little outside.
BOOST_AUTO_TEST_CASE(inverse_map)
{
  for (const Body body : {Body::box, Body::shell})
    for (unsigned int degree = 1; degree <= 4; ++degree)
      {
        const Mesh            mesh(body, degree, 1);
        const CellFields<dim> fields(*mesh.discretization);
        double                largest = 0.;
        bool                  all     = true;
        for (unsigned int cell = 0; cell < mesh.discretization->cells().size(); ++cell)
          for (const Point<dim> &xi :
               {Point<dim>(0.12, 0.7, 0.43), Point<dim>(0., 1., 0.5), Point<dim>(0.9, 1.04, 0.2)})
            {
              const auto place = fields.invert(cell, fields.position(cell, fields.shape(xi)));
              all              = all && place.converged;
              largest          = std::max(largest, place.xi.distance(xi));
            }
        BOOST_TEST(all);
        BOOST_TEST(largest < 1e-12); // measured 1e-14
      }
}

// Values and stresses of a linear field at vertices, inside cells and at generic points, averaged over all touching cells of
// all processes; how many touch shows in the weights.
BOOST_AUTO_TEST_CASE(linear_field, *boost::unit_test::label("parallel"))
{
  const LinearMotion motion;
  for (const Body body : {Body::box, Body::shell})
    for (unsigned int degree = 1; degree <= 4; ++degree)
      {
        const Mesh            mesh(body, degree, degree == 1 ? 2 : 1);
        const CellFields<dim> fields(*mesh.discretization);
        const VectorType      u =
          interpolate(*mesh.discretization, [&](const Point<dim> &x) { return motion.displacement(x, 0.); });

        std::vector<Point<dim>> mine;
        for (unsigned int cell = 0; cell < mesh.discretization->cells().size(); cell += 3)
          for (const Point<dim> &xi : {Point<dim>(0., 1., 0.), Point<dim>(1., 0.4, 0.3), Point<dim>(0.3, 0.7, 0.6)})
            mine.push_back(fields.position(cell, fields.shape(xi)));
        std::vector<Point<dim>> points;
        for (const auto &of_rank : Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
          points.insert(points.end(), of_rank.begin(), of_rank.end());

        PointLocation<dim> location;
        location.reinit(fields, points, std::vector<std::string>(points.size(), "p"), "");
        constexpr unsigned int n = 10;
        std::vector<double>    local(n * points.size(), 0.), all(local.size());
        for (const auto &contact : location.contacts)
          {
            double    *values = &local[n * contact.point];
            const auto value  = fields.value(u, contact.cell, contact.factors);
            const auto stress = fields.stress(soil, u, contact.cell, contact.factors);
            for (unsigned int c = 0; c < dim; ++c)
              values[c] += contact.weight * value[c];
            for (unsigned int k = 0; k < 6; ++k)
              values[dim + k] += contact.weight * stress.access_raw_entry(k);
            values[9] += contact.weight;
          }
        Utilities::MPI::sum(local, MPI_COMM_WORLD, all);
        double value_error = 0., stress_error = 0., weight_error = 0., moved = 0.;
        for (unsigned int i = 0; i < points.size(); ++i)
          {
            moved             = std::max(moved, points[i].distance(location.positions[i]));
            const auto value  = motion.displacement(points[i], 0.);
            const auto stress = motion.stress(points[i], 0.);
            for (unsigned int c = 0; c < dim; ++c)
              value_error = std::max(value_error, std::abs(all[n * i + c] - value[c]) / 1e-3);
            for (unsigned int k = 0; k < 6; ++k)
              stress_error =
                std::max(stress_error, std::abs(all[n * i + dim + k] - stress.access_raw_entry(k)) / stress.norm());
            weight_error = std::max(weight_error, std::abs(all[n * i + 9] - 1.));
          }
        BOOST_TEST(moved < 1e-12);
        BOOST_TEST(value_error < 1e-12);  // measured 2e-15
        BOOST_TEST(stress_error < 1e-11); // measured 2e-14; derivatives multiply round-off by degree^2
        BOOST_TEST(weight_error < 1e-14);
      }
}

// Facets of degree 1 lie inside r = 2 and outside r = 1: receivers on the sphere move to them. Far points are refused.
BOOST_AUTO_TEST_CASE(points_outside, *boost::unit_test::label("parallel"))
{
  const Mesh            mesh(Body::shell, 1, 2, false);
  const CellFields<dim> fields(*mesh.discretization);
  PointLocation<dim>    location;
  const Point<dim>      on_sphere = Point<dim>(0.9, 0.35, 0.25) * (2. / Point<dim>(0.9, 0.35, 0.25).norm());
  location.reinit(fields, {on_sphere, {0.5, 1.2, 0.4}}, {"a", "b"}, "");
  const double moved = location.positions[0].distance(on_sphere);
  BOOST_TEST(moved > 1e-4);
  BOOST_TEST(moved < 0.02);
  BOOST_TEST(location.positions[0].norm() < 2.);
  // nearest point of a plane facet: the way is normal to it, which is nearly radial
  const Tensor<1, dim> way = on_sphere - location.positions[0];
  BOOST_TEST(way * on_sphere / (way.norm() * 2.) > 0.98);
  BOOST_TEST((location.positions[1] == Point<dim>(0.5, 1.2, 0.4)));
  BOOST_TEST(Utilities::MPI::sum(location.contacts.size(), MPI_COMM_WORLD) >= 2u);

  BOOST_CHECK_EXCEPTION(
    location.reinit(fields, {{0.5, 1.2, 0.4}, {0.2, 0.1, 0.3}}, {"a", "centre"}, "[Receivers / array]"), InputError,
    [](const InputError &error) {
      return mentions(error, {"[Receivers / array]", "centre", "0.2, 0.1, 0.3", "(0, 0, 0) to (2, 2, 2)"});
    });
}

// A motion that is quadratic in time has exact velocities at t_n with steps of any length, from the first row (v_0) to the last.
// In the middle the mesh changes and the transfer moves everything by half a millimetre, which no velocity may show.
BOOST_AUTO_TEST_CASE(table_with_adaptation, *boost::unit_test::label("parallel"))
{
  for (const bool forces_again : {true, false})
    {
      const Folder       folder;
      const LinearMotion motion;
      Mesh               mesh(Body::shell, 2, 1);
      Sets               sets(array_scene);
      State<dim>         state;
      state.reinit(*mesh.discretization);
      sets.receivers.reinit(*mesh.discretization, soil_everywhere);
      sets.receivers.open(folder.path, 0., 1., nullptr);

      Tensor<1, dim>     offset;
      const unsigned int n_steps = 1100; // more than the buffer has rows
      for (unsigned int step = 0; step <= n_steps; ++step)
        {
          state.step = step;
          if (step > 0)
            {
              state.dt_last = 1e-4 * (1. + 0.5 * std::sin(step));
              state.time += state.dt_last;
            }
          prescribe(state, *mesh.discretization, motion, offset);
          if (step == 700)
            {
              if (forces_again)
                sets.receivers.record(state);
              mesh.refine([](const Point<dim> &x) { return x[2] > 0.9; });
              state.reinit(*mesh.discretization);
              offset[1] = 0.5e-3;
              prescribe(state, *mesh.discretization, motion, offset);
              sets.receivers.reinit(*mesh.discretization, soil_everywhere);
            }
          sets.receivers.record(state);
        }
      sets.receivers.finish();

      const TextTable table(folder.path + "/receivers-array.csv");
      BOOST_TEST(table.columns.size() == 37u);
      BOOST_TEST(table.columns[0] == "t [s]");
      BOOST_TEST(table.columns[1] == "p1.displacement_x [m]");
      BOOST_TEST(table.columns[4] == "p1.velocity_x [m/s]");
      BOOST_TEST(table.columns[18] == "p2.velocity_z [m/s]");
      BOOST_TEST(table.columns[36] == "p3.stress_yz [Pa]");
      BOOST_TEST(table.rows.size() == n_steps + 1);
      double displacement_error = 0., velocity_error = 0., stress_error = 0.;
      for (unsigned int row = 0; row < table.rows.size() && table.columns.size() == 37; ++row)
        for (unsigned int point = 0; point < 3; ++point)
          {
            const double *values = &table.rows[row][1 + 12 * point];
            const double  t      = table.rows[row][0];
            const bool    moved  = row > 700 || (row == 700 && !forces_again);
            const auto    u = motion.displacement(array_points[point], t), v = motion.velocity(array_points[point], t);
            const auto    stress = motion.stress(array_points[point], t);
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double jump  = moved && c == 1 ? 0.5e-3 : 0.;
                displacement_error = std::max(displacement_error, std::abs(values[c] - u[c] - jump) / u.norm());
                velocity_error     = std::max(velocity_error, std::abs(values[dim + c] - v[c]) / v.norm());
              }
            for (unsigned int k = 0; k < 3; ++k)
              stress_error =
                std::max(stress_error, std::abs(values[6 + k] - stress.access_raw_entry(k)) / stress.norm());
          }
      // nine digits after the point in the table
      BOOST_TEST(displacement_error < 1e-9);
      BOOST_TEST(velocity_error < 1e-9);
      BOOST_TEST(stress_error < 1e-9);
      const TextTable points(folder.path + "/receivers-array-points.csv");
      BOOST_TEST(points.rows.size() == 3u);
      BOOST_TEST(points.rows[1][2] == 0.8);
    }
}

// A displacement 1 % too large is wrong by 1 % in every norm; only the wanted quantities are compared.
BOOST_AUTO_TEST_CASE(errors_of_a_set, *boost::unit_test::label("parallel"))
{
  class TooLarge : public LinearMotion
  {
    Tensor<1, dim> displacement(const Point<dim> &x, const double t) const override
    {
      return 1.01 * LinearMotion::displacement(x, t);
    }
    Tensor<1, dim> velocity(const Point<dim> &x, const double t) const override
    {
      return 1.01 * LinearMotion::velocity(x, t);
    }
  };
  const Folder       folder;
  const LinearMotion exact;
  const TooLarge     motion;
  const Mesh         mesh(Body::shell, 3, 1);
  Sets               sets(R"(
set Receivers = all, generic
subsection Receivers
  subsection all
    set Points   = 1.3,0.4,0.2; 0.3,0.8,1.1
    set Interval = 3e-3
  end
  subsection generic
    set Directions = 0.9,0.35,0.25; 0.3,0.5,0.8
    set Radii      = 1.2, 1.5, 1.8
    set Quantities = velocity
  end
end
)");
  State<dim>         state;
  state.reinit(*mesh.discretization);
  sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  sets.receivers.open(folder.path, 0., 0.02, &exact);
  state.dt_last = 0.;
  for (; state.step <= 20; ++state.step, state.time += state.dt_last = 1e-3)
    {
      prescribe(state, *mesh.discretization, motion);
      sets.receivers.record(state);
    }
  sets.receivers.finish();
  const auto errors = sets.receivers.errors();
  BOOST_TEST(errors.size() == 4u);
  for (const std::string key : {"all.displacement.E_t", "all.velocity.E_t", "all.stress.E_t", "generic.velocity.E_t"})
    if (errors.count(key) == 0)
      BOOST_ERROR(key + " is missing");
    else
      BOOST_TEST(errors.at(key) == 0.01, boost::test_tools::tolerance(1e-9));
  const TextTable table(folder.path + "/receivers-generic.csv"), coarse(folder.path + "/receivers-all.csv"),
    of_points(folder.path + "/receivers-generic-errors.csv");
  BOOST_TEST(table.columns.size() == 19u);
  BOOST_TEST(table.columns[16] == "d2r3.velocity_x [m/s]");
  BOOST_TEST(coarse.rows.size() == 7u); // 0, 3, ..., 18 ms
  BOOST_TEST(of_points.rows.size() == 7u);
}

// Planes and lines: one file, rows at multiples of the interval, velocities exact there too; the last row is the end time.
BOOST_AUTO_TEST_CASE(hdf5_sets, *boost::unit_test::label("parallel"))
{
  const Folder       folder;
  const LinearMotion motion;
  const Mesh         mesh(Body::shell, 2, 1);
  Sets               sets(R"(
set Receivers = cut, ray
subsection Receivers
  subsection cut
    set Type          = plane
    set Corner        = 1, 0.3, 0.3
    set First edge    = 0.5, 0, 0
    set Second edge   = 0, 0.5, 0.5
    set First number  = 11
    set Second number = 7
    set Interval      = 2.5e-3
  end
  subsection ray
    set Type       = line
    set Start      = 0.7, 0.6, 0.5
    set End        = 1.1, 1, 0.9
    set Number     = 5
    set Quantities = stress
    set Interval   = 1e-2
  end
end
)");
  State<dim>         state;
  state.reinit(*mesh.discretization);
  sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  sets.receivers.open(folder.path, 0., 0.02, nullptr);
  state.dt_last = 0.;
  for (; state.step <= 50; ++state.step, state.time += state.dt_last = 4e-4)
    {
      prescribe(state, *mesh.discretization, motion);
      sets.receivers.record(state);
    }
  sets.receivers.finish();
  HDF5::File  file(folder.path + "/receivers.h5", HDF5::File::FileAccessMode::open, MPI_COMM_WORLD);
  HDF5::Group cut      = file.open_group("cut");
  const auto  time     = cut.open_dataset("time").read<std::vector<double>>();
  const auto  position = cut.open_dataset("position").read<FullMatrix<double>>();
  BOOST_TEST(cut.open_dataset("velocity").get_attribute<std::string>("unit") == "m/s");
  BOOST_TEST(time.size() == 9u);
  BOOST_TEST(position.m() == 77u);
  BOOST_TEST(time[1] == 2.8e-3, boost::test_tools::tolerance(1e-12)); // first step at or after 2.5 ms
  BOOST_TEST(time[8] == 2e-2, boost::test_tools::tolerance(1e-12));
  const auto u      = cut.open_dataset("displacement").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 3});
  const auto v      = cut.open_dataset("velocity").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 3});
  const auto stress = cut.open_dataset("stress").read_hyperslab<std::vector<double>>({0, 0, 0}, {9, 77, 6});
  double     error  = 0.;
  for (unsigned int row = 0; row < 9; ++row)
    for (unsigned int point = 0; point < 77; ++point)
      {
        const Point<dim> x(position(point, 0), position(point, 1), position(point, 2));
        for (unsigned int c = 0; c < dim; ++c)
          {
            const unsigned int i       = (row * 77 + point) * dim + c;
            const auto         exact_u = motion.displacement(x, time[row]), exact_v = motion.velocity(x, time[row]);
            const auto         exact_stress = motion.stress(x, time[row]);
            error                           = std::max({error, std::abs(u[i] - exact_u[c]) / exact_u.norm(),
                                                        std::abs(v[i] - exact_v[c]) / exact_v.norm(),
                                                        std::abs(stress[2 * (i - c) + c] - exact_stress[c][c]) / exact_stress.norm()});
          }
      }
  BOOST_TEST(error < 1e-9);
  const auto ray_time = file.open_group("ray").open_dataset("time").read<std::vector<double>>();
  BOOST_TEST(ray_time.size() == 3u);
  BOOST_TEST(ray_time[2] == 2e-2, boost::test_tools::tolerance(1e-12));
}

// A device that is always full: all processes get the same error with the name of the file.
BOOST_AUTO_TEST_CASE(full_disk, *boost::unit_test::label("parallel"))
{
  if (!std::filesystem::exists("/dev/full"))
    return;
  const Folder folder;
  const Mesh   mesh(Body::shell, 1, 1);
  Sets         sets(array_scene);
  sets.receivers.reinit(*mesh.discretization, soil_everywhere);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::filesystem::create_symlink("/dev/full", folder.path + "/receivers-array.csv");
  MPI_Barrier(MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(sets.receivers.open(folder.path, 0., 1., nullptr), OutputError, [](const OutputError &error) {
    return mentions(error, {"receivers-array.csv", "No space left"});
  });
}

#ifndef DEBUG // deal.II's debug library aborts when HDF5 fails

// The same for HDF5, whose failures deal.II hides in release mode; here the system refuses files above 20 kB. The sets are open
// while the exception passes.
BOOST_AUTO_TEST_CASE(full_disk_hdf5, *boost::unit_test::label("parallel"))
{
  const Folder folder;
  const Mesh   mesh(Body::shell, 1, 1);
  rlimit       limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{20000, limit.rlim_max};
  const auto   old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const auto run = [&]() {
    Sets sets(R"(
set Receivers = ray
subsection Receivers
  subsection ray
    set Type     = line
    set Start    = 0.7, 0.6, 0.5
    set End      = 1.1, 1, 0.9
    set Number   = 1000
    set Interval = 1e-2
  end
end
)");
    sets.receivers.reinit(*mesh.discretization, soil_everywhere);
    sets.receivers.open(folder.path, 0., 1., nullptr);
    State<dim> state;
    state.reinit(*mesh.discretization);
    state.displacement.update_ghost_values();
    for (; state.step <= 100; ++state.step, state.time += state.dt_last = 1e-2)
      sets.receivers.record(state);
    sets.receivers.finish();
  };
  BOOST_CHECK_EXCEPTION(run(), OutputError, [](const OutputError &error) { return mentions(error, {"receivers.h5"}); });
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, old_handler);
  BOOST_CHECK_THROW(ReceiverStore(folder.path + "/missing/receivers.h5", MPI_COMM_WORLD), OutputError);
}
#endif

BOOST_AUTO_TEST_CASE(wrong_sets)
{
  const auto scene = [](const std::string &entries) {
    return "set Receivers = array\nsubsection Receivers\nsubsection array\n" + entries + "\nend\nend\n";
  };
  const auto refused = [&](const std::string &entries, const std::vector<std::string> &words) {
    try
      {
        Sets sets(scene(entries));
      }
    catch (const InputError &error)
      {
        return mentions(error, words);
      }
    return false;
  };
  BOOST_TEST(refused("set Points = 1,nan,2", {"Points"}));
  BOOST_TEST(refused("set Directions = 1,1,0", {"Radii"}));
  BOOST_TEST(refused("set Directions = 0,0,0\nset Radii = 1", {"direction 1"}));
  BOOST_TEST(refused("set Directions = 0,0,1\nset Radii = 1, x", {"Radii", "'x'"}));
  BOOST_TEST(refused("", {"no point"}));
  BOOST_TEST(refused("set Points = 1,1,1\nset Quantities = velocities", {"Did you mean 'velocity'"}));
  BOOST_TEST(refused("set Type = line\nset Start = 0,0,0\nset End = 1,0,0", {"Interval"}));
}

// Interpolation of a smooth field: E_x of the displacement falls with h^(p+1), of the stress with h^p. The exact field itself
// has a traction error of the same order as its stress.
BOOST_AUTO_TEST_CASE(order_of_volume_errors, *boost::unit_test::label("parallel"))
{
  const ManufacturedPlane<dim> exact(soil, {{Tensor<1, dim>({1e-3, 2e-3, -1e-3}), Tensor<1, dim>({1.1, -0.7, 0.9}),
                                             300., 0.4}});
  for (unsigned int degree = 1; degree <= 3; ++degree)
    {
      std::map<std::string, double> errors[2];
      for (unsigned int level = 0; level < 2; ++level)
        {
          const Mesh mesh(Body::shell, degree, (degree == 1 ? 2 : 1) + level, false);
          const auto u =
            interpolate(*mesh.discretization, [&](const Point<dim> &x) { return exact.displacement(x, 1e-3); });
          const auto v =
            interpolate(*mesh.discretization, [&](const Point<dim> &x) { return exact.velocity(x, 1e-3); });
          errors[level] = volume_errors<dim>(*mesh.discretization, soil_everywhere, u, v, exact, 1e-3);
          errors[level].merge(traction_error<dim>(*mesh.discretization, soil_everywhere, u, {0}, exact, 1e-3));
        }
      const auto order = [&](const std::string &key) { return std::log2(errors[0].at(key) / errors[1].at(key)); };
      BOOST_TEST(errors[0].size() == 4u);
      // the coarsest shells are not quite asymptotic
      BOOST_TEST(std::abs(order("volume.displacement.E_x") - (degree + 1)) < 0.3);
      BOOST_TEST(std::abs(order("volume.velocity.E_x") - (degree + 1)) < 0.3);
      BOOST_TEST(std::abs(order("volume.stress.E_x") - degree) < 0.3);
      BOOST_TEST(order("boundary.traction.E_inf") > degree - 0.4);
      BOOST_TEST(errors[0].at("boundary.traction.E_inf") < 1.);
    }
}

BOOST_AUTO_TEST_SUITE_END()
