#include <arenite/loads/nodal_force.h>

#include <cmath>
#include <functional>
#include <string>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::test_tools::tolerance;
using boost::unit_test::label;

// Pressure on the deformed surface. Forces are polynomials of the displacement along each face; where a rule is exact for them
// (Gauss-Lobatto with p + 1 points: degree 2 p - 1, the two Gauss points of degree 1: 3) theorems on closed surfaces hold to round-off.

namespace
{
/// Pressure of 1 Pa on boundaries of a box.
template <int dim>
std::unique_ptr<Pressure<dim>> pressure(const std::string &boundaries, const bool follower, const Symmetry symmetry)
{
  Parameters parameters =
    Parameters::from_text("subsection load\nset Amplitude = 1\nset Boundary = " + boundaries + "\nend\n", "test");
  auto result = std::make_unique<Pressure<dim>>();
  {
    const auto section = parameters.section("load");
    result->declare_parameters(parameters);
  }
  parameters.parse();
  auto box      = geometries<dim>().make("box");
  box->symmetry = symmetry;
  result->finalize(parameters, *box);
  if (follower)
    result->use_finite_strain();
  result->name = "pressure";
  return result;
}

template <int dim>
std::string all_sides()
{
  return dim == 1   ? "x min, x max"
         : dim == 2 ? "x min, x max, y min, y max"
                    : "x min, x max, y min, y max, z min, z max";
}

/// Box [r, r + 1] x [0, 1]..., its cells straight or moved at the inner vertices, with hanging nodes.
template <int dim>
BodyOf<dim> box(const unsigned int degree, const Symmetry symmetry, const double r, const double distortion,
                const bool hanging = true)
{
  return BodyOf<dim>(
    element(degree),
    [&](auto &t) {
      Point<dim> lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        upper[d] = 1.;
      lower[0] += r;
      upper[0] += r;
      GridGenerator::subdivided_hyper_rectangle(t, std::vector<unsigned int>(dim, 3), lower, upper, true);
      GridTools::transform(
        [&](const Point<dim> &x) {
          Point<dim> y = x;
          for (unsigned int d = 0; d < dim; ++d)
            if (x[d] > lower[d] + 1e-10 && x[d] < upper[d] - 1e-10)
              y[d] += distortion * std::sin(17. * x[(d + 1) % dim] + 7. * d + 3. * x[d]);
          return y;
        },
        t);
      for (const auto &cell : t.active_cell_iterators())
        if (hanging && !cell->is_artificial() && (dim == 1 || cell->is_locally_owned()) &&
            cell->center().distance(lower) < 0.6)
          cell->set_refine_flag();
      t.execute_coarsening_and_refinement();
    },
    soil(), symmetry);
}

/// Forces of @p load at the displacement of @p body.
template <int dim>
VectorType forces(BodyOf<dim> &body, Pressure<dim> &load)
{
  make_consistent(body.discretization, body.state.displacement);
  VectorType result = body.discretization.new_vector();
  load.add(result, body.state);
  return result;
}

template <int dim>
void prepare(BodyOf<dim> &body, Pressure<dim> &load)
{
  load.reinit(body.discretization, NodalMass(), {});
}

/// Sum of |f| over nodes.
template <int dim>
double sum_of_norms(const VectorType &f)
{
  double sum = 0.;
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    sum += std::abs(f.local_element(i));
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

template <int dim>
Tensor<1, dim> resultant(const VectorType &f)
{
  Tensor<1, dim> sum;
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    sum[i % dim] += f.local_element(i);
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

/// Call f(integral_constant dim, symmetry, inner radius) for all bodies, with and without an axis in them.
template <typename Function>
void for_all_symmetries(const Function &f)
{
  f(std::integral_constant<int, 1>(), Symmetry::plane_wave, 0.);
  f(std::integral_constant<int, 1>(), Symmetry::spherical, 0.5);
  f(std::integral_constant<int, 2>(), Symmetry::plane_strain, 0.);
  f(std::integral_constant<int, 2>(), Symmetry::axisymmetric, 0.5);
  f(std::integral_constant<int, 2>(), Symmetry::axisymmetric, 0.);
  f(std::integral_constant<int, 3>(), Symmetry::none, 0.);
}

/// A field that is linear in each coordinate.
template <int dim>
Tensor<1, dim> multilinear(const Point<dim> &x, const double phase)
{
  Tensor<1, dim> value;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int m = 0; m < (1u << dim); ++m)
      {
        double product = std::sin(phase + 2.3 * c + 1.9 * m);
        for (unsigned int d = 0; d < dim; ++d)
          product *= (m >> d) & 1u ? x[d] : 1.;
        value[c] += 0.1 * product;
      }
  return value;
}

/// Volume of the unit box at @p r that the field moves, from points inside of it: shares nothing but the measure with what is tested.
template <int dim>
double volume(const Symmetry symmetry, const double r, const std::function<Tensor<1, dim>(const Point<dim> &)> &u)
{
  double            sum = 0.;
  const QGauss<dim> rule(4);
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      Point<dim> X = rule.point(q);
      X[0] += r;
      Tensor<2, dim> F;
      for (unsigned int d = 0; d < dim; ++d) // u is linear in each coordinate: differences are derivatives
        {
          Tensor<1, dim> step;
          step[d]           = 0.5;
          const auto column = 2. * step + u(X + step) - u(X - step);
          for (unsigned int c = 0; c < dim; ++c)
            F[c][d] = column[c];
        }
      sum += rule.weight(q) * determinant(F) * measure(symmetry, X + u(X));
    }
  return sum;
}
} // namespace

BOOST_AUTO_TEST_SUITE(follower_pressure)

// On the undeformed body it is the dead pressure.
BOOST_AUTO_TEST_CASE(undeformed, *label("parallel"))
{
  for_all_symmetries([](const auto d, const Symmetry symmetry, const double r) {
    constexpr int dim = decltype(d)::value;
    for (const unsigned int degree : {1u, 2u, 3u, 4u})
      {
        auto body = box<dim>(degree, symmetry, r, 0.05);
        auto dead = pressure<dim>("x max", false, symmetry), follower = pressure<dim>("x max", true, symmetry);
        if (dim > 1)
          {
            dead     = pressure<dim>("y min, x max", false, symmetry);
            follower = pressure<dim>("y min, x max", true, symmetry);
          }
        body.state.reinit(body.discretization);
        prepare(body, *dead);
        prepare(body, *follower);
        VectorType   difference = forces(body, *follower);
        const double scale      = largest(difference);
        difference -= forces(body, *dead);
        BOOST_TEST(scale > 1e-3);
        BOOST_TEST(largest(difference) < 1e-14 * std::max(1., scale),
                   name(symmetry) << ", degree " << degree << ": " << largest(difference));
      }
  });
}

// Whatever the nodes do, the forces on a closed surface add up to zero: n dA of a polynomial surface has degree 2 p - 1 along each
// coordinate of a face (the measure of a ring brings in r, its axial part is r dr), which the rules integrate exactly. Around an axis
// or a centre only axial forces have a resultant.
BOOST_AUTO_TEST_CASE(closed_surface, *label("parallel"))
{
  for_all_symmetries([](const auto d, const Symmetry symmetry, const double r) {
    constexpr int      dim   = decltype(d)::value;
    const unsigned int first = n_hoop_directions(symmetry) > 0 ? 1 : 0; // component with a resultant
    for (const unsigned int degree : {1u, 2u, 3u, 4u})
      {
        auto body = box<dim>(degree, symmetry, r, 0.05);
        body.state.reinit(body.discretization);
        body.constraints.reinit(body.discretization); // no motion off the axis
        body.randomize(body.state.displacement, 0.1);
        auto load = pressure<dim>(all_sides<dim>(), true, symmetry);
        prepare(body, *load);
        const VectorType     f     = forces(body, *load);
        const Tensor<1, dim> total = resultant<dim>(f);
        const double         scale = sum_of_norms<dim>(f);
        BOOST_TEST(scale > 1.);
        for (unsigned int c = first; c < dim; ++c)
          BOOST_TEST(std::abs(total[c]) < 1e-14 * scale, name(symmetry) << ", degree " << degree << ": " << total);
      }
  });
}

// A rigid rotation turns the forces with the body.
BOOST_AUTO_TEST_CASE(rotation, *label("parallel"))
{
  const auto check = [](const auto d, const Symmetry symmetry, const auto &Q) {
    constexpr int dim = decltype(d)::value;
    for (const unsigned int degree : {1u, 3u})
      {
        auto body = box<dim>(degree, symmetry, 0., 0.05);
        body.state.reinit(body.discretization);
        auto load = pressure<dim>("x max, y min", true, symmetry);
        prepare(body, *load);
        const VectorType before = forces(body, *load);
        body.set(body.state.displacement,
                 [&](const Point<dim> &x) { return Q * Tensor<1, dim>(x) - Tensor<1, dim>(x); });
        VectorType after = forces(body, *load);
        for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int e = 0; e < dim; ++e)
              after.local_element(dim * node + c) -= Q[c][e] * before.local_element(dim * node + e);
        BOOST_TEST(largest(after) < 1e-14, name(symmetry) << ", degree " << degree << ": " << largest(after));
      }
  };
  const double s = std::sin(0.7), c = std::cos(0.7);
  Tensor<2, 2> plane({{c, -s}, {s, c}});
  Tensor<2, 3> about_z({{c, -s, 0.}, {s, c, 0.}, {0., 0., 1.}}), about_x({{1., 0., 0.}, {0., s, -c}, {0., c, s}});
  check(std::integral_constant<int, 2>(), Symmetry::plane_strain, plane);
  check(std::integral_constant<int, 3>(), Symmetry::none, Tensor<2, 3>(about_x * about_z));
}

// Its power is -p dV/dt of the body. The volume is a polynomial of degree 3 in time at most, of which differences over five points give the
// exact derivative. Displacements linear in each coordinate: of the degree 3 that both rules integrate exactly.
BOOST_AUTO_TEST_CASE(power_is_change_of_volume, *label("parallel"))
{
  for_all_symmetries([](const auto d, const Symmetry symmetry, const double r) {
    constexpr int dim   = decltype(d)::value;
    const auto    field = [&](const Point<dim> &x, const double phase) {
      Tensor<1, dim> value = multilinear(x, phase);
      if (r == 0. && n_hoop_directions(symmetry) > 0) // nothing leaves an axis
        {
          Point<dim> outside = x;
          outside[0]         = 1.;
          value[0]           = x[0] * multilinear(outside, phase)[0];
        }
      return value;
    };
    for (const unsigned int degree : {1u, 2u, 4u})
      {
        auto body = box<dim>(degree, symmetry, r, 0.);
        body.state.reinit(body.discretization);
        auto load = pressure<dim>(all_sides<dim>(), true, symmetry);
        prepare(body, *load);
        body.set(body.state.displacement, [&](const Point<dim> &x) { return field(x, 0.3); });
        VectorType velocity = body.discretization.new_vector();
        body.set(velocity, [&](const Point<dim> &x) { return field(x, 1.1); });
        zero_at_hanging_nodes(body.discretization, velocity);
        forces(body, *load);
        const double power = Utilities::MPI::sum(load->power(velocity), MPI_COMM_WORLD);

        const auto V = [&](const double t) {
          return volume<dim>(symmetry, r, [&](const Point<dim> &x) { return field(x, 0.3) + t * field(x, 1.1); });
        };
        const double h    = 0.1;
        const double rate = (V(-2. * h) - 8. * V(-h) + 8. * V(h) - V(2. * h)) / (12. * h);
        BOOST_TEST(std::abs(rate) > 1e-2);
        BOOST_TEST(power == -rate, tolerance(1e-12)); // measured 2e-14
      }
  });
}

// The cavity of a thick sphere at 1 r: p 4 pi r^2 dr/dt, in one dimension and around the axis.
BOOST_AUTO_TEST_CASE(spherical_cavity)
{
  for (const unsigned int degree : {1u, 3u})
    {
      auto body = box<1>(degree, Symmetry::spherical, 0.5, 0.);
      body.state.reinit(body.discretization);
      auto load = pressure<1>("x min", true, Symmetry::spherical);
      prepare(body, *load);
      body.state.displacement = 0.25;
      VectorType velocity     = body.discretization.new_vector();
      velocity                = 3.;
      forces(body, *load);
      BOOST_TEST(Utilities::MPI::sum(load->power(velocity), MPI_COMM_WORLD) == 4. * numbers::PI * 0.75 * 0.75 * 3.,
                 tolerance(1e-14));
    }
}

// The ledgers of a body that its pressure deforms strongly still agree: work is done by the forces that act.
BOOST_AUTO_TEST_CASE(ledgers_agree, *label("parallel"))
{
  for_all_symmetries([](const auto d, const Symmetry symmetry, const double r) {
    constexpr int dim = decltype(d)::value;
    for (const unsigned int degree : {1u, 3u})
      {
        auto body = box<dim>(degree, symmetry, r, 0.02);
        auto load = pressure<dim>(dim == 1 ? "x max" : "x max, y max", true, symmetry);
        std::vector<std::unique_ptr<Load<dim>>> loads;
        loads.push_back(std::move(load));
        // soft enough to be deformed by 1 Pa
        body.law.bulk_modulus  = 3.;
        body.law.shear_modulus = 2.;
        body.law.density       = 1.;
        body.assemble(std::move(loads));
        StableTimeStep<dim> limit;
        limit.calibrate(*body.dynamics);
        const double dt = 0.8 * limit.limit();
        for (unsigned int k = 0; k < 100; ++k)
          {
            body.dynamics->compute_force(body.state);
            body.dynamics->close_force(body.state, dt);
            body.dynamics->report(body.state, dt);
            body.dynamics->advance(body.state, dt);
          }
        BOOST_TEST(largest(body.state.displacement) > 0.05);
        BOOST_TEST(body.dynamics->balance.largest_error() < 1e-12,
                   name(symmetry) << ", degree " << degree << ": " << body.dynamics->balance.largest_error());
      }
  });
}

BOOST_AUTO_TEST_SUITE_END()
