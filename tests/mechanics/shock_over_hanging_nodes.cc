// A plane shock runs into a refined region whose edge is oblique to it. The mesh is refined before the
// start and stays; adaptive ones have tests/mechanics/point_transfer.cc and scenes.

#include <optional>

#include "law_body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
constexpr double V = 200., rho_0 = 1800., speed = 1500. + 1.8 * V,
                 pressure_behind = rho_0 * speed * V; // clay of tests/data/laws

/// Strip of 1 m x 0.2 m, refined beyond a line at 45 degrees.
void strip(BodyOf<2>::Triangulation &triangulation, const bool refined)
{
  GridGenerator::subdivided_hyper_rectangle(triangulation, {40u, 8u}, Point<2>(), Point<2>(1., 0.2), true);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (refined && cell->is_locally_owned() && cell->center()[0] > 0.3 + cell->center()[1])
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
}

struct Result
{
  double imbalance = 0., transverse = 0., velocity = 0., stress = 0.; ///< relative to energy, V, V and the pressure
};

/// Start the strip with a velocity and move it until a shock from the wall has come to 0.75 m; @p observe is called in every step.
/// @return largest imbalance of the energies, relative to the largest energy
double march(
  LawBody<2> &body, const std::function<Tensor<1, 2>(const Point<2> &)> &velocity,
  const std::function<void()> &observe = [] {})
{
  auto &dynamics = *body.dynamics;
  auto &state    = body.state;
  dynamics.reinit(state);
  dynamics.compute_force(state);
  state.force = 0.;
  body.set(state.half_velocity, velocity);
  zero_at_hanging_nodes(body.discretization, state.half_velocity);
  body.constraints.project(state.half_velocity);
  dynamics.balance.set_initial(dynamics.total_energy(state, 0.));

  StableTimeStep<2> step;
  step.calibrate(dynamics);
  const double end       = 0.75 / speed;
  double       imbalance = 0., scale = 0.;
  while (true)
    {
      const bool last = state.time >= end * (1. - 1e-12);
      dynamics.compute_force(state);
      const PointLimits<2> limits = dynamics.point_limits(state);
      BOOST_REQUIRE(!limits.failed);
      step.follow(limits.stable_step);
      const double dt = last ? state.dt_last : step.next(state.time, end, state.dt_last);
      dynamics.close_force(state, dt);
      const EnergyReport report = dynamics.report(state, dt);
      imbalance                 = std::max(imbalance, std::abs(report.imbalance()));
      scale                     = std::max(scale, report.scale());
      observe();
      if (last)
        return imbalance / scale;
      dynamics.advance(state, dt);
    }
}

/// The strip flies against a wall at x = 0 until the shock has come to 0.75 m; errors behind it.
Result hit_the_wall(const ElementChoice &choice, const bool refined)
{
  LawBody<2> body(choice, "finite strain", example_law(native_lanes, "mie grueneisen", "clay"),
                  [&](auto &t) { strip(t, refined); });
  body.constraints.set_symmetry({0, 2, 3});
  Result result;
  result.imbalance = march(body, [](const Point<2> &) {
    Tensor<1, 2> v;
    v[0] = -V;
    return v;
  });
  // behind the shock and off the first cells at the wall
  const auto       behind = [](const double x) { return x > 0.1 && x < 0.65; };
  const VectorType v      = body.dynamics->velocity(body.state);
  for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
    if (behind(body.discretization.position(node)[0]))
      {
        result.velocity   = std::max(result.velocity, std::abs(v.local_element(2 * node)) / V);
        result.transverse = std::max(result.transverse, std::abs(v.local_element(2 * node + 1)) / V);
      }
  for (unsigned int cell = 0; cell < body.discretization.cells().size(); ++cell)
    if (behind(body.discretization.cells()[cell]->center()[0]))
      {
        const auto values = body.values(cell);
        double     mean   = 0.;
        for (std::size_t at = 0; at < values.size(); at += body.n_values())
          mean -= values[at] / (values.size() / body.n_values());
        result.stress = std::max(result.stress, std::abs(mean / pressure_behind - 1.));
      }
  for (double *number : {&result.transverse, &result.velocity, &result.stress})
    *number = Utilities::MPI::max(*number, MPI_COMM_WORLD);
  return result;
}
} // namespace

BOOST_AUTO_TEST_SUITE(shock_over_hanging_nodes)

// The state behind is that of the jump relations on both sides of the edge, as well as without refinement, and little moves sideways
// (measured 3.6 %; distorted cells of such a solid are off by 15 to 22 %, benchmarks/hard_cases). The ledgers agree while the shock is in cells of both
// sizes. The strength of 1 MPa is 0.1 % of the pressure.
BOOST_AUTO_TEST_CASE(oblique_edge, *label("parallel"))
{
  for (const unsigned int degree : {0u, 1u})
    {
      const Result plain = hit_the_wall(element(degree), false), refined = hit_the_wall(element(degree), true);
      for (const auto &[what, r] : {std::pair<const char *, const Result &>{"plain", plain}, {"refined", refined}})
        BOOST_TEST_MESSAGE("degree " << degree << ", " << what << ": energy " << r.imbalance << ", transverse "
                                     << r.transverse << ", velocity " << r.velocity << ", stress " << r.stress);
      BOOST_TEST(plain.transverse < 1e-9);
      BOOST_TEST(plain.stress < 0.08); // ringing behind a front on 40 cells with the usual viscosity
      BOOST_TEST(refined.imbalance < 1e-3);
      BOOST_TEST(refined.transverse < 0.05);
      BOOST_TEST(refined.velocity < 0.06);
      // one point: 1.115, with forces k q, which grow with the pressure without work, 1.05
      BOOST_TEST(refined.stress < (degree == 0 ? 1.15 : 1.) * plain.stress);
    }
}

// A free body, one part of which flies into the other: what crosses cells, hanging nodes and processes takes momentum from one part and
// gives it to the other. 1e-12 of the sum of m |v| is the round-off of some 500 steps with 10^3 nodes.
BOOST_AUTO_TEST_CASE(momentum, *label("parallel"))
{
  for (const unsigned int degree : {0u, 1u, 2u})
    {
      LawBody<2> body(element(degree), "finite strain", example_law(native_lanes, "mie grueneisen", "clay"),
                      [](auto &t) { strip(t, true); });
      std::optional<Conserved<2>> start;
      double                      largest   = 0.;
      const double                imbalance = march(
                       body,
                       [](const Point<2> &x) {
          Tensor<1, 2> v;
          v[0] = x[0] > 0.5 + 0.3 * x[1] ? -V : 0.;
          v[1] = 0.1 * V;
          return v;
        },
                       [&] {
          const Conserved<2> now = body.dynamics->conserved(body.state, 0.);
          if (!start)
            start = now;
          largest = std::max(largest, (now.momentum - start->momentum).norm() / start->momentum_scale);
        });
      BOOST_TEST_MESSAGE("degree " << degree << ": momentum " << largest << ", energy " << imbalance);
      BOOST_TEST(largest < 1e-12);
      BOOST_TEST(imbalance < 1e-3);
    }
}

BOOST_AUTO_TEST_SUITE_END()
