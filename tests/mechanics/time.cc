#include <arenite/loads/absorbing.h>
#include <arenite/loads/nodal_force.h>

#include <cstdlib>
#include <new>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

// Counts what the step allocates; only while `counting` is on.
namespace
{
bool         counting    = false;
unsigned int allocations = 0;
} // namespace
void *operator new(const std::size_t size)
{
  if (counting)
    ++allocations;
  if (void *memory = std::malloc(size))
    return memory;
  throw std::bad_alloc();
}
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }

namespace
{
void step(Body &body, const double dt)
{
  body.dynamics->compute_force(body.state);
  body.dynamics->close_force(body.state, dt);
  body.dynamics->advance(body.state, dt);
}

/// Largest disagreement of the ledgers over @p n_steps from a random velocity, over the initial energy. @p dissipated: work that
/// viscous hourglass forces took out up to each step, over the same.
double ledger_error(Body &body, const std::function<double(unsigned int)> &dt, const unsigned int n_steps,
                    std::vector<double> *dissipated = nullptr)
{
  body.randomize(body.state.half_velocity, 1.);
  double kinetic = 0.;
  for (unsigned int i = 0; i < body.state.half_velocity.locally_owned_size(); ++i)
    if (const double w = body.state.inverse_mass.local_element(i); w > 0.)
      kinetic += 0.5 * std::pow(body.state.half_velocity.local_element(i), 2) / w;
  kinetic = Utilities::MPI::sum(kinetic, MPI_COMM_WORLD);
  body.dynamics->balance.set_initial(kinetic);
  double worst = 0.;
  for (unsigned int k = 0; k < n_steps; ++k)
    {
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, dt(k));
      const EnergyReport report = body.dynamics->report(body.state, dt(k));
      worst                     = std::max(worst, std::abs(report.imbalance()));
      if (dissipated)
        dissipated->push_back(-report.work.back().second / kinetic);
      body.dynamics->advance(body.state, dt(k));
    }
  return worst / kinetic;
}

/// An elastic block that makes the force of one cell wrong by a thousandth, but not its energy.
class FaultyForce : public InternalForce<3>
{
public:
  FaultyForce(std::unique_ptr<InternalForce<3>> block, const unsigned int cell)
    : block(std::move(block))
    , cell(cell)
  {}
  void reinit(const Discretization<3> &d) override
  {
    discretization = &d;
    block->reinit(d);
  }
  void add(VectorType &force, const State<3> &state, const CellPart part, BlockState &record) const override
  {
    block->add(force, state, part, record);
    if (part != CellPart::inner_first)
      return;
    // the displacement of this cell alone loads only its nodes and neighbours: take the part on its own nodes
    State<3> alone;
    alone.displacement  = discretization->new_vector();
    alone.half_velocity = discretization->new_vector();
    for (unsigned int i = 0; i < discretization->nodes_per_cell(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const unsigned int entry                = 3 * discretization->cell_nodes(cell)[i] + c;
          alone.displacement.local_element(entry) = state.displacement.local_element(entry);
        }
    VectorType extra = discretization->new_vector();
    for (const auto p : {CellPart::boundary, CellPart::inner_first, CellPart::inner_second})
      block->add(extra, alone, p, record);
    force.add(1e-3, extra);
  }
  BlockEnergy energy(const State<3> &s, const BlockState &b) const override { return block->energy(s, b); }
  void        add_mass(VectorType &m) const override { block->add_mass(m); }
  void        cell_mass(const unsigned int cell, std::vector<double> &m) const override { block->cell_mass(cell, m); }
  void cell_stiffness(const unsigned int cell, FullMatrix<double> &K) const override { block->cell_stiffness(cell, K); }
  bool contains(const unsigned int cell) const override { return block->contains(cell); }
  void inverse_size_squared(dealii::Vector<double> &v) const override { block->inverse_size_squared(v); }
  void largest_eigenvalue(dealii::Vector<double> &v) const override { block->largest_eigenvalue(v); }
  const LinearElastic &material() const override { return block->material(); }
  std::string          description() const override { return block->description(); }

private:
  std::unique_ptr<InternalForce<3>> block;
  const unsigned int                cell;
  const Discretization<3>          *discretization = nullptr;
};
} // namespace

BOOST_AUTO_TEST_SUITE(time_stepping)

// Without loads the leapfrog energy plus the strain energy of the points stays what it was, to 1e-12 of itself: hanging nodes,
// curved cells, every element, equal and unequal steps.
BOOST_AUTO_TEST_CASE(ledgers_agree, *label("parallel"))
{
  for (const ElementChoice &choice : all_choices())
    for (const bool equal_steps : {true, false})
      {
        Body body(choice, [&](auto &t) { shell_octant(t, 1, true); });
        body.assemble();
        StableTimeStep<3> limit;
        limit.calibrate(*body.dynamics);
        const auto dt = [&](const unsigned int k) {
          return limit.limit() * (equal_steps ? 0.9 : 0.7 + 0.2 * std::sin(1. * k));
        };
        // 100 sums of 10^4 terms lose 12 digits at most
        BOOST_TEST(ledger_error(body, dt, 100) < 1e-12, choice.type << " of degree " << choice.degree << ' '
                                                                    << choice.hourglass_control << " equal steps "
                                                                    << equal_steps);
      }
}

// Viscous hourglass control takes energy out at every step, and the ledgers see all of it. At a third of the stable step: near the
// limit the velocity of some modes changes its sign from step to step, and forces with lag push them for half of it.
BOOST_AUTO_TEST_CASE(hourglass_viscosity_dissipates, *label("parallel"))
{
  for (const bool equal_steps : {true, false})
    {
      Body body(viscous_element(), [&](auto &t) { shell_octant(t, 1, true); });
      body.assemble();
      StableTimeStep<3> limit;
      limit.calibrate(*body.dynamics);
      const auto dt = [&](const unsigned int k) {
        return limit.limit() * (equal_steps ? 0.33 : 0.3 + 0.05 * std::sin(1. * k));
      };
      std::vector<double> dissipated;
      BOOST_TEST(ledger_error(body, dt, 200, &dissipated) < 1e-12, "equal steps " << equal_steps);
      BOOST_TEST(dissipated.front() == 0.);
      for (unsigned int k = 1; k < dissipated.size(); ++k)
        BOOST_TEST_REQUIRE(dissipated[k] > dissipated[k - 1], "step " << k);
      BOOST_TEST(dissipated.back() < 1.);
      BOOST_TEST_MESSAGE("dissipated " << dissipated.back());
    }
}

// Two independent ledgers find a wrong kernel: one cell's force too large by a thousandth breaks the agreement by far more than
// round-off. (Work alone closes for any force.)
BOOST_AUTO_TEST_CASE(ledgers_find_a_wrong_force)
{
  Body                                           body(element(2), [&](auto &t) { distorted_cube(t, 3, false); });
  std::vector<std::unique_ptr<InternalForce<3>>> blocks;
  blocks.push_back(std::make_unique<FaultyForce>(make_elastic_force<3>(body.choice, body.law), 13));
  body.dynamics = std::make_unique<Dynamics<3>>(body.discretization, std::move(blocks),
                                                std::vector<std::unique_ptr<Load<3>>>(), body.constraints);
  body.dynamics->reinit(body.state);
  StableTimeStep<3> limit;
  limit.calibrate(*body.dynamics);
  BOOST_TEST(ledger_error(
               body, [&](unsigned int) { return 0.9 * limit.limit(); }, 50) > 1e-7);
}

// Halving the step divides the error in time by four (second order), start included: a mode of the discrete system oscillates as
// cos(w t), so compare with a run at a sixteenth of the step.
BOOST_AUTO_TEST_CASE(second_order_in_time)
{
  const auto final_state = [](const unsigned int n_steps) {
    Body body(element(2), [&](auto &t) { distorted_cube(t, 2, false); });
    body.assemble();
    body.set(body.state.half_velocity, [](const Point<3> &x) {
      return Tensor<1, 3>({x[0] * x[0], std::sin(x[1]), 0.3 * x[2] * x[0]});
    });
    body.set(body.state.displacement, [](const Point<3> &x) {
      return Tensor<1, 3>({1e-3 * x[1] * x[1], 0., 1e-3 * x[0]});
    });
    const double end = 4e-3;
    for (unsigned int k = 0; k < n_steps; ++k)
      step(body, end / n_steps);
    return body.state.displacement;
  };
  VectorType   reference = final_state(3200);
  const double scale     = reference.l2_norm();
  double       error[2];
  for (const unsigned int k : {0, 1})
    {
      VectorType u = final_state(k ? 400 : 200);
      u -= reference;
      error[k] = u.l2_norm() / scale;
    }
  BOOST_TEST(std::log2(error[0] / error[1]) == 2.0, boost::test_tools::tolerance(0.02));
}

// The step allocates nothing: forces, ghost exchange, hanging nodes, loads, dashpots, update and ledgers.
BOOST_AUTO_TEST_CASE(no_allocation_in_the_step, *label("parallel"))
{
  for (const ElementChoice &choice : all_choices())
    {
      Body                                  body(choice, [&](auto &t) { shell_octant(t, 1, true); });
      std::vector<std::unique_ptr<Load<3>>> loads;
      loads.push_back(std::make_unique<AbsorbingBoundary<3>>(std::vector<types::boundary_id>{1}, "spherical"));
      body.assemble(std::move(loads));
      body.randomize(body.state.half_velocity, 1.);
      StableTimeStep<3> limit;
      limit.calibrate(*body.dynamics);
      for (unsigned int k = 0; k < 5; ++k) // deal.II sizes its message buffers in the first exchange
        step(body, 0.9 * limit.limit());
      allocations = 0;
      counting    = true;
      for (unsigned int k = 0; k < 20; ++k)
        step(body, 0.9 * limit.limit());
      counting = false;
      if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
        BOOST_TEST(allocations == 0u, choice.type << " of degree " << choice.degree << ' ' << choice.hourglass_control);
      else // the requests of a message belong to deal.II and Open MPI: a few per step, none per cell
        BOOST_TEST(allocations <= 20u * 40u, choice.type << " of degree " << choice.degree << ": " << allocations);
    }
}

// 10^5 steps without energy drift: at 90 % of the stable step the energy of a free body stays what it was to 3e-10. What is left is
// rounding, 1e-15 per step: between -7e-11 and 1.3e-10 for random velocities of four sizes.
BOOST_AUTO_TEST_CASE(no_energy_drift)
{
  Body body(element(1), [&](auto &t) { distorted_cube(t, 2, false); });
  body.assemble();
  body.randomize(body.state.half_velocity, 1.);
  StableTimeStep<3> limit;
  limit.calibrate(*body.dynamics);
  const double dt = 0.9 * limit.limit();
  step(body, dt);
  step(body, dt); // the start-up step is half as long
  const auto energy = [&]() {
    body.dynamics->compute_force(body.state);
    body.dynamics->close_force(body.state, dt);
    const double value = body.dynamics->total_energy(body.state, dt);
    body.dynamics->advance(body.state, dt);
    return value;
  };
  const double before = energy();
  for (unsigned int k = 0; k < 100000; ++k)
    step(body, dt);
  BOOST_TEST(energy() == before, boost::test_tools::tolerance(3e-10));
}

BOOST_AUTO_TEST_SUITE_END()
