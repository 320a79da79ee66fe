// The directional form of the bulk viscosity, beside the volumetric one.

#include <arenite/mechanics/bulk_viscosity.h>

#include <random>

#include "law_body.h"

using namespace Arenite;
using namespace Arenite::Test;
using namespace boost::unit_test;

namespace
{
constexpr double dt = 1e-5;

std::vector<ElementChoice> elements(const std::string &form)
{
  std::vector<ElementChoice> choices = elements_for_laws();
  for (ElementChoice &choice : choices)
    {
      choice.linear_viscosity    = 0.5;
      choice.quadratic_viscosity = 1.5;
      choice.viscosity_form      = form;
    }
  return choices;
}

std::string kind_of(const ElementChoice &choice)
{
  return choice.type + " of degree " + std::to_string(choice.degree) + ' ' + choice.volumetric_strain;
}

template <int dim>
LawBody<dim> soil_body(const ElementChoice &choice, const std::string &kinematics,
                       const std::function<void(typename BodyOf<dim>::Triangulation &)> &mesh,
                       const Symmetry                                                    symmetry = cartesian<dim>())
{
  return LawBody<dim>(choice, kinematics, example_law(native_lanes, "linear elastic", "soil"), mesh, symmetry);
}

/// The largest of the points that the nodes show.
template <int dim>
double largest_viscosity(const LawBody<dim> &body)
{
  double     largest = 0.;
  const auto values  = body.values();
  for (std::size_t at = 0; at < values.size(); at += body.n_values())
    largest = std::max(largest, std::abs(values[at + 7]));
  return largest;
}

template <int dim>
void brick(typename BodyOf<dim>::Triangulation &triangulation)
{
  Point<dim> lower, upper;
  for (int k = 0; k < dim; ++k)
    {
      lower[k] = 1. + k;
      upper[k] = lower[k] + 1. / (1 + k);
    }
  std::vector<unsigned int> cells(dim, 1);
  cells[0] = 3;
  GridGenerator::subdivided_hyper_rectangle(triangulation, cells, lower, upper);
}
} // namespace

BOOST_AUTO_TEST_SUITE(bulk_viscosity)

/// Four rounds of Jacobi rotations leave round-off of any symmetric matrix, also with equal eigenvalues: measured 9e-16 of its norm.
BOOST_AUTO_TEST_CASE(principal_directions_of_matrices)
{
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> between(-1., 1.);
  double                                 worst = 0.;
  for (int trial = 0; trial < 20000; ++trial)
    {
      double a[3][3], d[3][3], s[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
          a[i][j] = a[j][i] = between(random) * (i != j && trial % 3 == 0 ? 1e-9 : 1.);
      if (trial % 5 == 0)
        for (int i = 0; i < 3; ++i) // I + v v^T
          for (int j = 0; j < 3; ++j)
            a[i][j] = (i == j) + (1. + i) * (1. + j);
      std::copy(&a[0][0], &a[0][0] + 9, &d[0][0]);
      principal_directions(d, s);
      double norm = 0.;
      for (int i = 0; i < 9; ++i)
        norm = std::max(norm, std::abs((&a[0][0])[i]));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            double product = 0., unit = 0.;
            for (int k = 0; k < 3; ++k)
              {
                product += s[i][k] * d[k][k] * s[j][k];
                unit += s[i][k] * s[j][k];
              }
            worst = std::max({worst, std::abs(product - a[i][j]) / norm, std::abs(unit - (i == j))});
          }
    }
  BOOST_TEST(worst < 1e-14);
  BOOST_TEST_MESSAGE("principal directions: " << worst);
}

/// The stress of any rate takes energy out of the motion, whatever the shape of the cell.
BOOST_AUTO_TEST_CASE(takes_energy_out)
{
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> between(-1., 1.);
  for (const bool in_expansion : {false, true})
    {
      ElementChoice choice;
      choice.linear_viscosity       = 0.5;
      choice.viscosity_in_expansion = in_expansion;
      for (int trial = 0; trial < 2000; ++trial)
        {
          SymTensor<double> strain;
          double            A[3][3], square = 0.;
          for (int k = 0; k < 6; ++k)
            square += std::pow(strain[k] = 1e-3 * between(random), 2);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              A[i][j] = between(random) * (i == 0 ? 30. : 1.) + (i == j);
          BulkViscosity<3, double> viscosity{choice, 2000., 300., 2.};
          const double             work = -contract(viscosity.directional(strain, dt, A), strain);
          // -work <= rho nu (rates : strains) as the stable step takes it
          BOOST_TEST(work >= 0.);
          BOOST_TEST(work <= 2000. * viscosity.largest * 2. * square / dt);
        }
    }
}

/// Where all moves along lines of the mesh both forms are one: nodal forces along these lines, at any element. 1e-12 of the largest: sums
/// of round-off.
template <int dim>
void compare_forms_along_a_line(const Symmetry symmetry)
{
  for (const char *kinematics : {"small strain", "finite strain"})
    for (unsigned int e = 0; e < elements("").size(); ++e)
      {
        auto volumetric  = soil_body<dim>(elements("volumetric")[e], kinematics, brick<dim>, symmetry),
             directional = soil_body<dim>(elements("directional")[e], kinematics, brick<dim>, symmetry);
        for (const double time : {1., 2., 3.})
          {
            const auto move = [&](const Point<dim> &x) {
              Tensor<1, dim> u;
              u[0] = -1e-3 * time * std::sin(2. * x[0] + time);
              return u;
            };
            volumetric.move(move, dt);
            directional.move(move, dt);
          }
        double worst = 0., scale = 0.;
        for (unsigned int k = 0; k < volumetric.state.force.locally_owned_size(); k += dim)
          {
            const double f = volumetric.state.force.local_element(k);
            scale          = std::max(scale, std::abs(f));
            worst          = std::max(worst, std::abs(f - directional.state.force.local_element(k)));
          }
        const double q = largest_viscosity(volumetric);
        BOOST_TEST(q > 1e4);
        BOOST_TEST(worst < 1e-12 * scale, kind_of(elements("")[e])
                                            << ' ' << kinematics << ' ' << dim << ": " << worst / scale);
        BOOST_TEST(largest_viscosity(directional) == q, boost::test_tools::tolerance(1e-11));
        // expanding cells of a brick take a shorter length for their step
        BOOST_TEST(directional.state.blocks[0].points.stable_step == volumetric.state.blocks[0].points.stable_step,
                   boost::test_tools::tolerance(dim == 1 ? 1e-11 : 0.1));
      }
}
BOOST_AUTO_TEST_CASE(along_a_line_of_the_mesh)
{
  compare_forms_along_a_line<1>(Symmetry::plane_wave);
  compare_forms_along_a_line<2>(Symmetry::plane_strain);
  compare_forms_along_a_line<3>(Symmetry::none);
}

/// Gas that comes closer to a centre or an axis with the same velocity everywhere is compressed in directions that no mesh resolves: no
/// shock can be there. The volumetric form answers with q. The radial strain is what du_r/dr of 1e-13 leaves. Not with mean dilatation, which
/// spreads the difference to the mean of the cell over all directions.
BOOST_AUTO_TEST_CASE(convergence_is_no_shock)
{
  const auto move = [](const Point<1> &) { return Tensor<1, 1>({-1e-4}); };
  for (const char *kinematics : {"small strain", "finite strain"})
    for (unsigned int e = 0; e < elements("").size(); ++e)
      {
        auto volumetric  = soil_body<1>(elements("volumetric")[e], kinematics, brick<1>, Symmetry::spherical),
             directional = soil_body<1>(elements("directional")[e], kinematics, brick<1>, Symmetry::spherical);
        volumetric.move(move, dt);
        directional.move(move, dt);
        if (elements("")[e].volumetric_strain != "mean dilatation")
          BOOST_TEST(largest_viscosity(directional) < 1e-9 * largest_viscosity(volumetric), kind_of(elements("")[e]));
      }
}

/// A frame that turns sees no force of the viscosity, and one that has turned sees the forces turned: first a rotation of 0.7, then a
/// compression in directions that turned with it. Round-off of displacements of 1 in strains of 1e-3: 1e-12.
template <int dim>
void turn_the_frame()
{
  for (unsigned int e = 0; e < elements("").size(); ++e)
    {
      auto fixed  = soil_body<dim>(elements("directional")[e], "finite strain", brick<dim>),
           turned = soil_body<dim>(elements("directional")[e], "finite strain", brick<dim>);
      Tensor<2, dim> R;
      for (int k = 0; k < dim; ++k)
        R[k][k] = 1.;
      R[0][0] = R[1][1]   = std::cos(0.7);
      R[1][0]             = std::sin(0.7);
      R[0][1]             = -R[1][0];
      const auto strained = [](const Point<dim> &x) {
        Tensor<1, dim> u;
        for (int k = 0; k < dim; ++k)
          u[k] = -1e-3 * (1. + k) * x[k] + 6e-4 * x[(k + 1) % dim] + 6e-4 * x[(k + dim - 1) % dim];
        return u;
      };
      fixed.move([](const Point<dim> &) { return Tensor<1, dim>(); }, dt);
      turned.move([&](const Point<dim> &x) { return R * x - x; }, dt);
      fixed.move(strained, dt);
      const double scale = largest_viscosity(fixed);
      BOOST_TEST(scale > 1e4);
      // what is left of the first step
      BOOST_TEST(largest_viscosity(turned) < 1e-11 * scale);
      turned.move([&](const Point<dim> &x) { return R * (x + strained(x)) - x; }, dt);
      double worst = 0., largest = 0.;
      for (unsigned int node = 0; node < fixed.discretization.n_owned_nodes(); ++node)
        {
          Tensor<1, dim> f, f_turned;
          for (int k = 0; k < dim; ++k)
            {
              f[k]        = fixed.state.force.local_element(dim * node + k);
              f_turned[k] = turned.state.force.local_element(dim * node + k);
            }
          largest = std::max(largest, f.norm());
          worst   = std::max(worst, (R * f - f_turned).norm());
        }
      BOOST_TEST(worst < 1e-10 * largest, kind_of(elements("")[e]) << ' ' << dim << ": " << worst / largest);
      BOOST_TEST(largest_viscosity(turned) == scale, boost::test_tools::tolerance(1e-10));
    }
}
BOOST_AUTO_TEST_CASE(turned_frames)
{
  turn_the_frame<2>();
  turn_the_frame<3>();
}

BOOST_AUTO_TEST_SUITE_END()
