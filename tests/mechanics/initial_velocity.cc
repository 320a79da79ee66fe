#include <arenite/simulation/initial_velocity.h>

#include <string>
#include <vector>

#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::test_tools::tolerance;
using boost::unit_test::label;

namespace
{
/// Two blocks of different densities in a distorted cube, joined at x = 1/2.
struct TwoBlocks
{
  TwoBlocks(const ElementChoice &choice, const bool hanging)
    : body(choice, [&](auto &t) {
      GridGenerator::subdivided_hyper_cube(t, 4);
      for (const auto &cell : t.active_cell_iterators())
        cell->set_material_id(cell->center()[0] < 0.5 ? 0 : 1);
      GridTools::transform(
        [](const Point<3> &x) {
          return Point<3>(x[0] + 0.05 * std::sin(3. * x[1] + 2. * x[2]), x[1] + 0.04 * x[2] * x[0], x[2]);
        },
        t);
      for (const auto &cell : t.active_cell_iterators())
        if (hanging && cell->is_locally_owned() && cell->center().norm() < 0.9)
          cell->set_refine_flag();
      t.execute_coarsening_and_refinement();
    })
  {
    std::vector<std::unique_ptr<InternalForce<3>>> blocks;
    for (const unsigned int id : {0u, 1u})
      {
        LinearElastic law = soil();
        law.density       = density[id];
        blocks.push_back(make_elastic_force<3>(choice, law, id));
      }
    body.dynamics = std::make_unique<Dynamics<3>>(body.discretization, std::move(blocks),
                                                  std::vector<std::unique_ptr<Load<3>>>(), body.constraints);
    body.dynamics->reinit(body.state);
  }

  /// Lumped momentum of block @p b if it moves alone, from its own masses: sum of m_b v_b.
  Tensor<1, 3> momentum_of_block(const unsigned int b, const std::function<Tensor<1, 3>(const Point<3> &)> &v) const
  {
    VectorType mass = body.discretization.new_scalar();
    body.dynamics->blocks[b]->add_mass(mass);
    body.discretization.hanging.template condense<1>(mass.begin());
    mass.compress(VectorOperation::add);
    Tensor<1, 3> sum;
    for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
      sum += mass.local_element(node) * v(body.discretization.position(node));
    return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }

  static constexpr double density[2] = {2000., 7800.};
  Body                    body;
};

/// `subsection Initial conditions` for blocks of these names.
InitialVelocity<3> moving(const std::string &entries)
{
  Parameters         parameters = Parameters::from_text("subsection Initial\n" + entries + "\nend\n", "scene.prm");
  InitialVelocity<3> velocity;
  {
    const auto section = parameters.section("Initial");
    velocity.declare_parameters(parameters);
  }
  parameters.parse();
  velocity.finalize(parameters, {"light", "heavy"});
  return velocity;
}

std::string refusal(const std::string &entries)
{
  try
    {
      moving(entries);
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace

BOOST_AUTO_TEST_SUITE(initial_velocities)

// Uniform velocities: the momentum is mass times velocity of each region, whatever the nodes between them do. The volumes of the
// regions come from the masses of the blocks.
BOOST_AUTO_TEST_CASE(momentum_of_regions, *label("parallel"))
{
  const auto both    = moving(R"(
    set Moving regions = flyer, target
    subsection flyer
      set Block    = light
      set Velocity = 300*(1+x*y); -20; 5*sin(z)
    end
    subsection target
      set Block    = heavy
      set Velocity = -70; 3*exp(x); 1
    end)");
  const auto v_light = [](const Point<3> &x) {
    return Tensor<1, 3>({300. * (1. + x[0] * x[1]), -20., 5. * std::sin(x[2])});
  };
  const auto v_heavy = [](const Point<3> &x) { return Tensor<1, 3>({-70., 3. * std::exp(x[0]), 1.}); };
  for (const unsigned int degree : all_elements)
    for (const bool hanging : {false, true})
      {
        TwoBlocks two(element(degree), hanging);
        both.apply(*two.body.dynamics, two.body.state);
        const Tensor<1, 3> wanted = two.momentum_of_block(0, v_light) + two.momentum_of_block(1, v_heavy);
        const auto         found  = two.body.dynamics->conserved(two.body.state, 0.);
        BOOST_TEST((found.momentum - wanted).norm() < 1e-14 * found.momentum_scale,
                   "degree " << degree << ": " << found.momentum << " instead of " << wanted);

        // one block alone moves: its mass times its velocity, half of which the joint would lose by a plain mean
        moving("set Moving regions = a\nsubsection a\nset Block = heavy\nset Velocity = 2; 0; 0\nend")
          .apply(*two.body.dynamics, two.body.state);
        VectorType mass = two.body.discretization.new_scalar();
        two.body.dynamics->blocks[1]->add_mass(mass);
        double sum = 0.;
        for (unsigned int node = 0; node < two.body.discretization.n_local_nodes(); ++node)
          sum += mass.local_element(node);
        sum                   = Utilities::MPI::sum(sum, MPI_COMM_WORLD);
        const auto of_a_block = two.body.dynamics->conserved(two.body.state, 0.);
        BOOST_TEST(of_a_block.momentum[0] == 2. * sum, tolerance(1e-13));
      }
}

// Without a block all cells move, by exactly the formula.
BOOST_AUTO_TEST_CASE(whole_body, *label("parallel"))
{
  TwoBlocks two(element(2), true);
  moving("set Moving regions = all\nsubsection all\nset Velocity = x; 2*pi; x*y-z\nend")
    .apply(*two.body.dynamics, two.body.state);
  VectorType wanted = two.body.discretization.new_vector();
  two.body.set(wanted, [](const Point<3> &x) { return Tensor<1, 3>({x[0], 2. * numbers::PI, x[0] * x[1] - x[2]}); });
  zero_at_hanging_nodes(two.body.discretization, wanted);
  wanted -= two.body.state.half_velocity;
  BOOST_TEST(largest(wanted) < 1e-14 * 2. * numbers::PI);
}

BOOST_AUTO_TEST_CASE(refusals)
{
  const auto mentions = [](const std::string &text, const std::string &words) {
    return text.find("scene.prm:") == 0 && text.find(words) != std::string::npos;
  };
  const std::string one = "set Moving regions = a\nsubsection a\n", two = "set Moving regions = a, b\nsubsection a\n";
  BOOST_TEST(mentions(refusal(one + "set Velocity = 1; 2\nend"), "3 formulas separated by semicolons"));
  BOOST_TEST(mentions(refusal(one + "set Velocity = 1; 2; \nend"), "empty formula"));
  BOOST_TEST(mentions(refusal(one + "set Velocity = 1; q; 3\nend"), "q"));
  BOOST_TEST(mentions(refusal(one + "set Block = hevy\nset Velocity = 1; 2; 3\nend"), "Did you mean 'heavy'?"));
  BOOST_TEST(mentions(refusal(two + "set Block = heavy\nset Velocity = 1; 2; 3\nend\nsubsection b\nset Block = heavy\n"
                                    "set Velocity = 1; 2; 3\nend"),
                      "again"));
  BOOST_TEST(mentions(refusal(two + "set Velocity = 1; 2; 3\nend\nsubsection b\nset Block = heavy\n"
                                    "set Velocity = 1; 2; 3\nend"),
                      "all cells"));
}

BOOST_AUTO_TEST_SUITE_END()
