#include <arenite/base/symmetry.h>

#include <boost/test/unit_test.hpp>

using namespace Arenite;
using dealii::Point;

BOOST_AUTO_TEST_SUITE(symmetry)

// A point of the body keeps its distance from the axis or the centre: (3, 4, 12) lies at r = 5, z = 12, and at r = 13.
BOOST_AUTO_TEST_CASE(points_of_the_body)
{
  const Point<3> x(3., 4., 12.);
  BOOST_TEST(reduce<2>(Symmetry::axisymmetric, x).distance(Point<2>(5., 12.)) == 0.);
  BOOST_TEST(reduce<1>(Symmetry::spherical, x)[0] == 13.);
  BOOST_TEST(reduce<2>(Symmetry::plane_strain, x).distance(Point<2>(3., 4.)) == 0.);
  BOOST_TEST(reduce<1>(Symmetry::plane_wave, x)[0] == 3.);
  BOOST_TEST(reduce<3>(Symmetry::none, x).distance(x) == 0.);
}

// Points of a scene may have the coordinates of the mesh or of the body, and no other number of them.
BOOST_AUTO_TEST_CASE(points_in_a_file)
{
  const auto read = [](const std::string &text) {
    Parameters            parameters = Parameters::from_text("set Points = " + text + "\n");
    std::vector<Point<1>> points;
    parameters.add_points<1>("Points", points, "m", "Places.",
                             [](const Point<3> &x) { return reduce<1>(Symmetry::spherical, x); });
    parameters.parse();
    return points;
  };
  const auto points = read("2; 3, 4, 12");
  BOOST_TEST_REQUIRE(points.size() == 2u);
  BOOST_TEST(points[0][0] == 2.);
  BOOST_TEST(points[1][0] == 13.);
  BOOST_CHECK_THROW(read("1, 2"), InputError);
}

// Dimension and symmetry belong together.
BOOST_AUTO_TEST_CASE(pairs)
{
  const auto choice = [](const std::string &dimension, const std::string &symmetry) {
    return DimensionChoice(
      Parameters::from_text("set Dimension = " + dimension + "\nset Symmetry = " + symmetry + "\n"));
  };
  BOOST_TEST(choice("2", "axisymmetric").dimension == 2u);
  BOOST_TEST((choice("1", "plane wave").symmetry == Symmetry::plane_wave));
  BOOST_TEST((DimensionChoice(Parameters::from_text("")).symmetry == Symmetry::none));
  for (const auto &[dimension, symmetry] :
       {std::make_pair("3", "spherical"), std::make_pair("2", "none"), std::make_pair("1", "plane strain")})
    BOOST_CHECK_THROW(choice(dimension, symmetry), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
