// The stiffness form of hourglass control where the stiffness follows the state of the soil: it takes energy and gives none, turns with the
// cell, and moves with the mesh (point_transfer.cc).

#include "law_body.h"

using namespace Arenite;
using namespace Arenite::Test;

namespace
{
constexpr double dt = 1e-5;

template <int dim>
void one_cell(typename BodyOf<dim>::Triangulation &triangulation)
{
  GridGenerator::hyper_cube(triangulation, -1., 1.);
}

ElementChoice one_point_without_viscosity()
{
  ElementChoice choice    = element(0);
  choice.linear_viscosity = choice.quadratic_viscosity = 0.;
  return choice;
}

template <int dim>
Tensor<2, dim> rotation(const double angle)
{
  Tensor<2, dim> R = unit_symmetric_tensor<dim>();
  R[0][0] = R[1][1] = std::cos(angle);
  R[1][0]           = std::sin(angle);
  R[0][1]           = -std::sin(angle);
  return R;
}

/// Displacement of a cell of [-1,1]^dim that goes to F X with an hourglass of the amplitude q [m]: the pattern x y (with z where there is a z), in
/// a direction that is none of the axes.
template <int dim>
std::function<Tensor<1, dim>(const Point<dim> &)> bent(const Tensor<2, dim> &F, const double q,
                                                       const Tensor<2, dim> &R = unit_symmetric_tensor<dim>())
{
  return [=](const Point<dim> &x) {
    Tensor<1, dim> pattern;
    for (unsigned int d = 0; d < dim; ++d)
      pattern[d] = (1. - 0.4 * d) * x[0] * x[1] + (dim == 3 ? 0.3 * (1. + d) * x[0] * x[1] * x[dim - 1] : 0.);
    return R * (F * Tensor<1, dim>(x) + q * pattern) - Tensor<1, dim>(x);
  };
}

template <int dim>
Tensor<2, dim> compressed(const double strain)
{
  return std::exp(-strain / dim) * Tensor<2, dim>(unit_symmetric_tensor<dim>());
}

template <int dim>
LawBody<dim> soil_cell(const std::string &rate = "Jaumann")
{
  return LawBody<dim>(one_point_without_viscosity(), "finite strain",
                      example_law(native_lanes, "viscoplastic cap with stiffening", "moist sand"), one_cell<dim>,
                      cartesian<dim>(), rate);
}

template <int dim>
double work(const LawBody<dim> &body)
{
  return body.dynamics->stored_energy(body.state).hourglass;
}

/// An hourglass comes into a cell of soft soil and leaves it after a compaction that made it stiff, or comes into the stiff cell and leaves it
/// after the stiffness has gone. @return the work after each of the three parts over the largest
template <int dim>
std::array<double, 3> closed_cycle(const bool stiffens)
{
  constexpr int n = 100;
  const double  q = 1e-3, compaction = 0.2, first = stiffens ? 0. : compaction, second = stiffens ? compaction : 0.;
  LawBody<dim>  body = soil_cell<dim>();
  for (int k = 1; k <= n && !stiffens; ++k)
    body.move(bent<dim>(compressed<dim>(first * k / n), 0.), dt);
  std::array<double, 3> works;
  for (int k = 1; k <= n; ++k)
    body.move(bent<dim>(compressed<dim>(first), q * k / n), dt);
  works[0] = work(body);
  for (int k = 1; k <= n; ++k)
    body.move(bent<dim>(compressed<dim>(first + (second - first) * k / n), q), dt);
  works[1] = work(body);
  for (int k = 1; k <= n; ++k)
    body.move(bent<dim>(compressed<dim>(second), q * (1. - double(k) / n)), dt);
  works[2]             = work(body);
  const double largest = std::max({works[0], works[1], works[2]});
  for (double &w : works)
    w /= largest;
  return works;
}

/// Nodal forces, node by node.
template <int dim>
std::vector<Tensor<1, dim>> forces(const LawBody<dim> &body)
{
  std::vector<Tensor<1, dim>> result(body.discretization.n_owned_nodes());
  for (unsigned int node = 0; node < result.size(); ++node)
    for (unsigned int d = 0; d < dim; ++d)
      result[node][d] = body.state.force.local_element(dim * node + d);
  return result;
}

/// Largest difference of the forces of two bodies of which one has turned by R, over the largest force.
template <int dim>
double difference(const std::vector<Tensor<1, dim>> &turned, const std::vector<Tensor<1, dim>> &fixed,
                  const Tensor<2, dim> &R)
{
  double off = 0., largest = 0.;
  for (unsigned int node = 0; node < fixed.size(); ++node)
    {
      off     = std::max(off, (turned[node] - R * fixed[node]).norm());
      largest = std::max(largest, fixed[node].norm());
    }
  return off / largest;
}

/// A bent cell of compacted soil turns by 115 degrees: its forces turn along, no work is done.
template <int dim>
void turn(const std::string &rate)
{
  LawBody<dim> body = soil_cell<dim>(rate);
  for (int k = 1; k <= 50; ++k)
    body.move(bent<dim>(compressed<dim>(0.1 * k / 50), 0.05 * k / 50), dt);
  // rates of the law go on while nothing strains: without time
  body.move(bent<dim>(compressed<dim>(0.1), 0.05), 1e-300);
  const auto   start = forces(body);
  const double spent = work(body);
  for (int k = 1; k <= 40; ++k)
    body.move(bent<dim>(compressed<dim>(0.1), 0.05, rotation<dim>(0.05 * k)), 1e-300);
  BOOST_TEST(spent > 0.);
  BOOST_TEST(difference(forces(body), start, rotation<dim>(2.)) < 1e-12,
             rate << ' ' << dim); // round-off of 40 rotations
  BOOST_TEST(std::abs(work(body) / spent - 1.) < 1e-12);
}

/// The same while it is bent, against a cell that does not turn, in @p n steps.
template <int dim>
double error_while_turning(const int n)
{
  LawBody<dim> turning = soil_cell<dim>(), fixed = soil_cell<dim>();
  for (int k = 1; k <= n; ++k)
    {
      const auto   F = compressed<dim>(0.1 * k / n);
      const double q = 0.05 * k / n;
      fixed.move(bent<dim>(F, q), 1e-3 / n);
      turning.move(bent<dim>(F, q, rotation<dim>(1.5 * k / n)), 1e-3 / n);
    }
  return difference(forces(turning), forces(fixed), rotation<dim>(1.5));
}
} // namespace

BOOST_AUTO_TEST_SUITE(hourglass_of_laws)

// What goes in comes out at most: k q with the present k would give back (k_2/k_1 - 1) times the work where the soil stiffens, here 61 times as much; the sum
// of k dq takes 1 - k_1/k_2 of it where it softens, here 8 % in space. While the amplitude rests there is no work.
BOOST_AUTO_TEST_CASE(closed_cycles_give_nothing)
{
  for (const bool stiffens : {true, false})
    for (const auto &works : {closed_cycle<2>(stiffens), closed_cycle<3>(stiffens)})
      {
        BOOST_TEST_MESSAGE((stiffens ? "stiffens: " : "softens: ") << works[0] << ", " << works[1] << ", " << works[2]);
        BOOST_TEST(works[0] > 0.);
        BOOST_TEST(std::abs(works[1] - works[0]) < 1e-9); // round-off of the amplitude while F changes
        BOOST_TEST(works[2] > 0.);
        if (stiffens) // (k_2 - k_1) q^2/2 against the force that was left, k_1 q
          BOOST_TEST(works[2] > 50. * works[0]);
      }
}

BOOST_AUTO_TEST_CASE(forces_turn_with_the_cell)
{
  for (const std::string rate : {"Jaumann", "Green-Naghdi"})
    {
      turn<2>(rate);
      turn<3>(rate);
    }
  const double coarse = error_while_turning<3>(100), fine = error_while_turning<3>(200);
  BOOST_TEST_MESSAGE("bent while it turns: " << coarse << ", " << fine);
  BOOST_TEST(fine < 2e-6); // of second order
  BOOST_TEST(fine < 0.27 * coarse);
}

BOOST_AUTO_TEST_SUITE_END()
