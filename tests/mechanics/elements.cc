#include "body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

BOOST_AUTO_TEST_SUITE(elements)

// A linear displacement gives constant stress: interior nodes of any mesh are in equilibrium (patch test).
BOOST_AUTO_TEST_CASE(patch_test, *label("parallel"))
{
  for (const unsigned int degree : all_elements)
    for (const bool hanging : {false, true})
      {
        Body body(element(degree), [&](auto &t) { distorted_cube(t, 4, hanging); });
        body.assemble();
        const Tensor<2, 3> gradient({{1e-3, 2e-4, -3e-4}, {4e-4, -5e-4, 1e-4}, {-2e-4, 6e-4, 3e-4}});
        body.set(body.state.displacement, [&](const Point<3> &x) { return gradient * x; });
        body.dynamics->compute_force(body.state);
        double interior = 0., boundary = 0.;
        for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
          {
            const Point<3> x = body.discretization.position(node);
            const bool     is_free =
              x[0] > 1e-9 && x[1] > 1e-9 && x[2] > 1e-9 && x[0] < 1. - 1e-9 && x[1] < 1. - 1e-9 && x[2] < 1. - 1e-9;
            for (unsigned int c = 0; c < 3; ++c)
              (is_free ? interior : boundary) =
                std::max(is_free ? interior : boundary, std::abs(body.state.force.local_element(3 * node + c)));
          }
        interior = Utilities::MPI::max(interior, MPI_COMM_WORLD);
        boundary = Utilities::MPI::max(boundary, MPI_COMM_WORLD);
        // round-off of sums of some hundred terms of the size of the boundary forces
        BOOST_TEST(interior < 1e-13 * boundary * 100.,
                   "degree " << degree << " hanging " << hanging << ": " << interior / boundary);
      }
}

// A rigid motion (infinitesimal rotation and translation) causes no force.
BOOST_AUTO_TEST_CASE(rigid_body_motion, *label("parallel"))
{
  for (const unsigned int degree : all_elements)
    {
      Body body(element(degree), [&](auto &t) { shell_octant(t, 1, true); });
      body.assemble();
      body.set(body.state.displacement, [&](const Point<3> &x) {
        return Tensor<1, 3>(
          {1. + 0.3 * x[1] - 0.2 * x[2], 2. - 0.3 * x[0] + 0.1 * x[2], -1. + 0.2 * x[0] - 0.1 * x[1]});
      });
      body.dynamics->compute_force(body.state);
      // stress scale: stiffness times displacement times cell size
      BOOST_TEST(largest(body.state.force) < 1e-11 * body.law.bulk_modulus * 2.);
    }
}

// The nodal force is the negative derivative of the strain and hourglass energy, which the kernel sums from the points.
BOOST_AUTO_TEST_CASE(force_is_gradient_of_energy, *label("parallel"))
{
  for (const unsigned int degree : all_elements)
    {
      Body body(element(degree), [&](auto &t) { shell_octant(t, 1, true); });
      body.assemble();
      VectorType direction = body.discretization.new_vector();
      body.randomize(direction, 1e-3);
      body.randomize(body.state.displacement, 1e-3);
      body.state.displacement += direction; // another random field
      body.randomize(direction, 7e-4);
      body.dynamics->compute_force(body.state);
      double power = 0.;
      for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
        power -= body.state.force.local_element(i) * direction.local_element(i);
      power = Utilities::MPI::sum(power, MPI_COMM_WORLD);

      // energy is quadratic: the central difference is exact up to round-off
      const VectorType u       = body.state.displacement;
      double           side[2] = {0., 0.};
      for (const int s : {0, 1})
        {
          for (unsigned int i = 0; i < direction.locally_owned_size(); ++i)
            body.state.displacement.local_element(i) = u.local_element(i) + (s ? 1. : -1.) * direction.local_element(i);
          make_consistent(body.discretization, body.state.displacement);
          const BlockEnergy energy = body.dynamics->stored_energy(body.state);
          side[s]                  = Utilities::MPI::sum(energy.strain + energy.hourglass, MPI_COMM_WORLD);
        }
      BOOST_TEST(0.5 * (side[1] - side[0]) == power, boost::test_tools::tolerance(1e-10));
    }
}

// Nodal masses add up to density times volume; on the polynomial geometry of a box that is exact, and all are positive.
BOOST_AUTO_TEST_CASE(mass_is_complete_and_positive, *label("parallel"))
{
  for (const unsigned int degree : all_elements)
    {
      Body body(element(degree), [&](auto &t) { distorted_cube(t, 3, true); });
      body.assemble();
      BOOST_TEST(body.dynamics->total_mass() == body.law.density, boost::test_tools::tolerance(1e-12));
      for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
        BOOST_TEST_REQUIRE(body.dynamics->mass.local_element(node) >= 0.);
    }
}

// Lanes only compute side by side: 1, 4 and 8 of them give the same forces to round-off. 81 cells leave lanes unused.
BOOST_AUTO_TEST_CASE(lanes_agree)
{
  for (const unsigned int degree : all_elements)
    for (const std::string control : {"stiffness", "viscous"})
      {
        ElementChoice choice     = element(degree);
        choice.hourglass_control = control;
        Body body(choice, [&](auto &t) { shell_octant(t, 1, true); });
        body.assemble();
        body.randomize(body.state.displacement, 1e-3);
        body.randomize(body.state.half_velocity, 1.);
        make_consistent(body.discretization, body.state.displacement);
        std::vector<VectorType> forces;
        const auto              compute = [&](std::unique_ptr<InternalForce<3>> block) {
          block->reinit(body.discretization);
          forces.push_back(body.discretization.new_vector());
          BlockState unused;
          for (const auto part : {CellPart::boundary, CellPart::inner_first, CellPart::inner_second})
            block->add(forces.back(), body.state, part, unused);
        };
        compute(make_elastic_force<3, 1>(choice, body.law));
        compute(make_elastic_force<3, 4>(choice, body.law));
        compute(make_elastic_force<3, 8>(choice, body.law));
        for (unsigned int k = 1; k < forces.size(); ++k)
          {
            forces[k] -= forces[0];
            BOOST_TEST(largest(forces[k]) < 1e-13 * largest(forces[0]) * 10.);
          }
      }
}

// One cell, and more processes than cells: the same code, the same mass and equilibrium.
BOOST_AUTO_TEST_CASE(one_cell, *label("parallel"))
{
  for (const unsigned int degree : all_elements)
    {
      Body body(element(degree), [](auto &t) { GridGenerator::hyper_cube(t, 0., 2.); });
      body.assemble();
      body.set(body.state.displacement, [](const Point<3> &x) { return Tensor<1, 3>({1e-3 * x[0], 0., 0.}); });
      body.dynamics->compute_force(body.state);
      double push = 0.;
      for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
        if (body.discretization.position(node)[0] > 1.999)
          push += body.state.force.local_element(3 * node);
      push = Utilities::MPI::sum(push, MPI_COMM_WORLD);
      // uniaxial strain: stress (lambda + 2 mu) eps on 4 m^2
      const double M = body.law.density * std::pow(body.law.p_wave_speed(), 2);
      BOOST_TEST(push == -4. * M * 1e-3, boost::test_tools::tolerance(1e-12));
      BOOST_TEST(body.dynamics->total_mass() == 8. * body.law.density, boost::test_tools::tolerance(1e-12));
    }
}

BOOST_AUTO_TEST_SUITE_END()
