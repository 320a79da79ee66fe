// Fields between the nodes, receivers and error norms: what is known exactly must come back, on any mesh and on any number of
// processes. Linear fields of x are reproduced by every isoparametric cell, however curved, and by hanging nodes.

#include <arenite/io/error_norms.h>
#include <arenite/verification/manufactured.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

#include "recorded_motion.h"

using namespace Arenite;
using namespace Arenite::Recorded;
using namespace dealii;

namespace
{
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

const std::vector<Point<dim>> array_points{{1.3, 0.4, 0.2}, {0.3, 0.8, 1.1}, {0., 0., 1.5}};
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
