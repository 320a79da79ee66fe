#include <arenite/loads/gas_pressure.h>
#include <arenite/mesh/geometry.h>

#include <cmath>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::test_tools::tolerance;
using boost::unit_test::label;

// Gas in the cavity of the shell 1 < r < 2.

namespace
{
const std::string ideal = "set Gas = ideal gas\nset Initial pressure = 0.5\n";
const std::string explosive =
  "set Gas = detonation products\nset Charge density = 1\nset Charge mass = 2\nset A = 3\nset B = 0.05\nset R1 = 4.5\n"
  "set R2 = 1.2\nset Omega = 0.3\nset Energy = 1\n";

template <int dim>
struct Shell
{
  Shell(const unsigned int degree, const Symmetry symmetry, const unsigned int refinement, const std::string &entries,
        const bool finite_strain)
    : geometry(geometries<dim>().make("spherical shell"))
  {
    Parameters parameters = Parameters::from_text(
      "subsection Mesh\nset Inner radius = 1\nset Outer radius = 2\nend\nsubsection gas\nset Boundary = cavity\n" +
        entries + "end\n",
      "test");
    auto gas           = std::make_unique<GasPressure<dim>>();
    geometry->symmetry = symmetry;
    {
      const auto section = parameters.section("Mesh");
      geometry->declare_parameters(parameters);
    }
    {
      const auto section = parameters.section("gas");
      gas->declare_parameters(parameters);
    }
    parameters.parse();
    geometry->finalize(parameters);
    gas->finalize(parameters, *geometry);
    gas->name = "gas";
    if (finite_strain)
      gas->use_finite_strain();

    LinearElastic soft;
    soft.bulk_modulus  = 3.;
    soft.shear_modulus = 2.;
    soft.density       = 1.;
    body               = std::make_unique<BodyOf<dim>>(
      element(degree),
      [&](auto &triangulation) {
        geometry->create(triangulation);
        triangulation.refine_global(refinement);
      },
      soft, symmetry);
    body->constraints.set_symmetry({2, 3, 4});
    std::vector<std::unique_ptr<Load<dim>>> loads;
    loads.push_back(std::move(gas));
    body->assemble(std::move(loads));
  }

  EnergyReport step(const double dt)
  {
    body->dynamics->compute_force(body->state);
    body->dynamics->close_force(body->state, dt);
    const EnergyReport report = body->dynamics->report(body->state, dt);
    body->dynamics->advance(body->state, dt);
    return report;
  }

  std::unique_ptr<Geometry<dim>> geometry;
  std::unique_ptr<BodyOf<dim>>   body;
};

double value(const EnergyReport &report, const std::string &name)
{
  for (const LoadValue &entry : report.values)
    if (entry.name == "gas: " + name)
      return entry.value;
  BOOST_FAIL("no value '" + name + "'");
  return 0.;
}
} // namespace

BOOST_AUTO_TEST_SUITE(gas_pressure)

// The volume of the sector: that of the sphere as far as the facets are.
BOOST_AUTO_TEST_CASE(volume_of_a_cavity, *label("parallel"))
{
  const auto error = [](const auto d, const Symmetry symmetry, const unsigned int degree, const unsigned int refinement,
                        const bool finite) {
    constexpr int dim = decltype(d)::value;
    Shell<dim>    shell(degree, symmetry, refinement, ideal, finite);
    const auto    report = shell.step(1e-3);
    return value(report, "gas volume") * shell.geometry->symmetry_factor() / (4. / 3. * numbers::PI) - 1.;
  };
  const std::integral_constant<int, 1> line;
  const std::integral_constant<int, 2> plane;
  const std::integral_constant<int, 3> space;
  for (const bool finite : {false, true})
    {
      BOOST_TEST(std::abs(error(line, Symmetry::spherical, 1, 0, finite)) < 1e-14);
      // facets of degree p have areas and volumes of the order 2p: 0.25 and 1/16
      BOOST_TEST(error(plane, Symmetry::axisymmetric, 1, 3, finite) /
                     error(plane, Symmetry::axisymmetric, 1, 2, finite) ==
                   0.25,
                 tolerance(0.02));
      BOOST_TEST(error(space, Symmetry::none, 1, 3, finite) / error(space, Symmetry::none, 1, 2, finite) == 0.25,
                 tolerance(0.03));
      BOOST_TEST(error(space, Symmetry::none, 2, 2, finite) / error(space, Symmetry::none, 2, 1, finite) == 1. / 16.,
                 tolerance(0.1));
    }
}

// What the gas loses the body gains: forces are the derivative of the volume with respect to each node, so that the work of the steps is the
// trapezoidal rule of dE = -p dV. It misses by the square of the step.
BOOST_AUTO_TEST_CASE(energy_goes_into_the_body, *label("parallel"))
{
  const auto miss = [](const auto d, const Symmetry symmetry, const unsigned int degree, const std::string &gas,
                       const bool finite, const unsigned int steps) {
    constexpr int dim = decltype(d)::value;
    Shell<dim>    shell(degree, symmetry, dim == 3 ? 1 : 2, gas, finite);
    const auto    start = shell.step(0.5 / steps);
    EnergyReport  end;
    for (unsigned int k = 1; k <= steps; ++k)
      end = shell.step(0.5 / steps);
    const double lost = value(start, "gas energy") - value(end, "gas energy"), given = end.work.front().second;
    BOOST_TEST(value(end, "gas volume") >
               1.04 * value(start, "gas volume")); // by 4 % (products, the smaller pressure) to 20 %
    BOOST_TEST(given > 0.01 * value(start, "gas energy"));
    return given / lost - 1.;
  };
  const auto check = [&](const auto d, const Symmetry symmetry, const unsigned int degree) {
    for (const std::string &gas : {ideal, explosive})
      for (const bool finite : {false, true})
        {
          const double coarse = miss(d, symmetry, degree, gas, finite, 100),
                       fine   = miss(d, symmetry, degree, gas, finite, 200);
          BOOST_TEST_MESSAGE("gas, " << name(symmetry) << " degree " << degree << ": " << coarse << ' ' << fine);
          BOOST_TEST(std::abs(coarse) < 1e-5);
          // on deformed faces of degree 2 the rule is not exact for the volume: 1e-7 stays whatever the step
          if (degree == 1 || !finite)
            BOOST_TEST(coarse / fine == 4., tolerance(0.1));
        }
  };
  check(std::integral_constant<int, 1>(), Symmetry::spherical, 1);
  check(std::integral_constant<int, 2>(), Symmetry::axisymmetric, 2);
  check(std::integral_constant<int, 3>(), Symmetry::none, 1);
}

BOOST_AUTO_TEST_SUITE_END()
