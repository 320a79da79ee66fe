#include <arenite/mesh/half_space.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>

using namespace Arenite;

namespace
{
template <int dim>
HalfSpace<dim> half_space(const std::string &entries)
{
  Parameters     parameters = Parameters::from_text(entries, "scene.prm");
  HalfSpace<dim> geometry;
  geometry.declare_parameters(parameters);
  parameters.parse();
  geometry.finalize(parameters);
  return geometry;
}

/// Area of the faces of each boundary.
template <int dim>
std::map<unsigned int, double> areas(const dealii::Triangulation<dim> &mesh)
{
  std::map<unsigned int, double> result;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        result[face->boundary_id()] += face->measure();
  return result;
}
} // namespace

BOOST_AUTO_TEST_SUITE(half_space_mesh)

// Section and body have the size of rectangle and brick less the cavity, and so have their named boundaries. The facets miss the cavity
// by a part of the square of their angle: 0.7 % of the cavity in the section (11 degrees), 7 % in space (22 degrees; halved it is 1.7 %).
BOOST_AUTO_TEST_CASE(sizes)
{
  const double pi = dealii::numbers::PI;
  for (const double depth : {.15, .5, 1.7}) // just below the surface, ordinary, deep
    for (const double growth : {1., 1.3})
      {
        const std::string entries = "set Cavity radius = 0.1\nset Depth = " + std::to_string(depth) +
                                    "\nset Outer distance = 2\nset Growth = " + std::to_string(growth) + "\n";
        {
          dealii::Triangulation<2> mesh;
          half_space<2>(entries).create(mesh);
          mesh.refine_global(2);
          const auto   size = areas(mesh);
          const double hole = .5 * pi * .01, height = 2. + depth;
          BOOST_TEST(std::abs(dealii::GridTools::volume(mesh) - (2. * height - hole)) < 7e-3 * hole);
          BOOST_TEST(std::abs(size.at(0) - pi * .1) < 2e-3 * pi * .1);
          BOOST_TEST(std::abs(size.at(1) - 2.) < 1e-12);
          BOOST_TEST(std::abs(size.at(2) - (2. + height)) < 1e-12);
          BOOST_TEST(std::abs(size.at(3) - (height - .2)) < 1e-12);
        }
        if (growth > 1.)
          {
            dealii::Triangulation<3> mesh;
            half_space<3>(entries).create(mesh);
            mesh.refine_global(1);
            const auto   size = areas(mesh);
            const double hole = pi / 3. * 1e-3, height = 2. + depth;
            BOOST_TEST(std::abs(dealii::GridTools::volume(mesh) - (4. * height - hole)) < 7e-2 * hole);
            BOOST_TEST(std::abs(size.at(0) - pi * .01) < 3.5e-2 * pi * .01);
            BOOST_TEST(std::abs(size.at(1) - 4.) < 1e-12);
            BOOST_TEST(std::abs(size.at(2) - (4. + 4. * height)) < 1e-12);
            for (const unsigned int plane : {3, 4})
              BOOST_TEST(std::abs(size.at(plane) - (2. * height - .5 * pi * .01)) < 3e-2 * .5 * pi * .01);
          }
      }
}

BOOST_AUTO_TEST_SUITE_END()
