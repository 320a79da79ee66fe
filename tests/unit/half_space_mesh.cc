#include <arenite/mesh/half_space.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>

using namespace Arenite;

namespace
{
template <typename Mesh>
Mesh geometry_of(const std::string &entries, const Symmetry symmetry)
{
  Parameters parameters = Parameters::from_text(entries, "scene.prm");
  Mesh       geometry;
  geometry.symmetry = symmetry;
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
          geometry_of<HalfSpace<2>>(entries, Symmetry::axisymmetric).create(mesh);
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
            geometry_of<HalfSpace<3>>(entries, Symmetry::none).create(mesh);
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

// The load ends at the edge of a cell, cells under it are square, and no cell is longer than its neighbour by more than the growth and
// the stretch that lets them end at the border (half a cell of the last ones).
BOOST_AUTO_TEST_CASE(under_a_load)
{
  for (const unsigned int across : {1, 3})
    for (const double growth : {1., 1.3})
      {
        const std::string entries = "set Load radius = 0.1\nset Cells across load = " + std::to_string(across) +
                                    "\nset Outer distance = 2\nset Growth = " + std::to_string(growth) + "\n";
        dealii::Triangulation<2> mesh;
        geometry_of<LoadedHalfSpace>(entries, Symmetry::axisymmetric).create(mesh);
        auto size = areas(mesh);
        BOOST_TEST(std::abs(dealii::GridTools::volume(mesh) - 4.) < 1e-12);
        BOOST_TEST(std::abs(size[0] - .1) < 1e-12);
        BOOST_TEST(std::abs(size[1] - 1.9) < 1e-12);
        BOOST_TEST(std::abs(size[2] - 4.) < 1e-12);
        BOOST_TEST(std::abs(size[3] - 2.) < 1e-12);
        std::map<double, double> width; // of the surface, by place
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->at_boundary(3) && std::abs(cell->face(3)->center()[1]) < 1e-12)
            width[cell->center()[0]] = cell->face(3)->measure();
        BOOST_TEST(std::abs(width.begin()->second - .1 / across) < 1e-12);
        double before = width.begin()->second;
        for (const auto &[x, w] : width)
          {
            BOOST_TEST(w > before / 1.15);
            BOOST_TEST(w < before * growth * 1.15);
            before = w;
          }
      }
}

BOOST_AUTO_TEST_SUITE_END()
