// What points store when the mesh changes: rules for one cell, bodies at rest, and momentum.

#include <arenite/adaptivity/field_transfer.h>
#include <arenite/adaptivity/momentum_transfer.h>
#include <arenite/adaptivity/point_transfer.h>
#include <arenite/loads/nodal_force.h>

#include <random>

#include "law_body.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
constexpr double g = 9.81;

/// Layout of an element's points without anything of the cell itself: 9 numbers and the volume.
template <int dim>
CellRecord layout(const ElementChoice &choice)
{
  return make_law_force<dim>(choice, KinematicsChoice(), example_law(native_lanes, "tabulated compaction", "sand"),
                             numbers::invalid_material_id, cartesian<dim>())
    ->cell_record();
}

/// A record whose values are value(place in the unit cell, k), and equal volumes but for the rule's weights.
template <int dim>
std::vector<double> record(const CellRecord                                              &layout,
                           const std::function<double(const Point<dim> &, unsigned int)> &value)
{
  std::vector<double> result(layout.size(dim), 1.);
  for (unsigned int q = 0; q < layout.n_points(dim); ++q)
    {
      Point<dim>   x;
      double       volume = 1.;
      unsigned int rest   = q;
      for (int d = 0; d < dim; ++d, rest /= layout.points.size())
        {
          x[d] = layout.points[rest % layout.points.size()];
          volume *= layout.weights[rest % layout.points.size()];
        }
      for (unsigned int k = 0; k + 1 < layout.n_values; ++k)
        result[q * layout.n_values + k] = value(x, k);
      result[(q + 1) * layout.n_values - 1] = volume;
    }
  return result;
}
} // namespace

BOOST_AUTO_TEST_SUITE(point_transfer)

// A linear field between neighbours that continue it survives halving and joining, whatever the element; random values stay within the bounds of the
// cell and its neighbours, and elements of degree 1 keep means.
BOOST_AUTO_TEST_CASE(rules_of_a_cell)
{
  constexpr int                          dim = 2;
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (const unsigned int degree : all_elements)
    {
      const CellRecords<dim> rules(layout<dim>(element(degree)));
      const CellRecord      &l                 = rules.layout;
      const unsigned int     n                 = l.n_values - 1;
      const double           distance[2 * dim] = {1., 1.5, 0.75, 1.};
      const Point<dim>       centre(0.5, 0.5);
      for (const bool linear : {true, false})
        {
          const auto field = [&](const Point<dim> &x, const unsigned int k) {
            return linear ? 3. + k + (1. + k) * x[0] - 2. * x[1] : number(random);
          };
          const auto          parent = record<dim>(l, field);
          const auto          mean   = rules.means(parent.data());
          std::vector<double> neighbours[2 * dim];
          for (unsigned int f = 0; f < 2 * dim; ++f)
            for (unsigned int k = 0; k < n; ++k)
              {
                Point<dim> x = centre;
                x[f / 2] += (f % 2 == 0 ? -1. : 1.) * distance[f];
                neighbours[f].push_back(field(x, k));
              }
          const auto                       around = rules.look_around(mean, neighbours, distance);
          std::vector<std::vector<double>> children(4, std::vector<double>(l.size(dim)));
          std::vector<double>              sum(n, 0.), whole(l.size(dim));
          std::vector<const double *>      pointers;
          for (unsigned int child = 0; child < 4; ++child)
            {
              rules.refine(parent.data(), around, child, children[child].data());
              pointers.push_back(children[child].data());
              const auto exact = record<dim>(l, [&](const Point<dim> &x, const unsigned int k) {
                return field(Point<dim>((x[0] + child % 2) / 2., (x[1] + child / 2) / 2.), k);
              });
              const auto own   = rules.means(children[child].data());
              for (unsigned int k = 0; k < n; ++k)
                sum[k] += own[k] / 4.;
              for (unsigned int q = 0; q < l.n_points(dim); ++q)
                for (unsigned int k = 0; k < n; ++k)
                  {
                    const double value = children[child][q * l.n_values + k];
                    if (linear)
                      BOOST_TEST(std::abs(value - exact[q * l.n_values + k]) < 1e-13 * (10. + k), "degree " << degree);
                    double low = mean[k], high = mean[k];
                    for (const auto &neighbour : neighbours)
                      {
                        low  = std::min(low, neighbour[k]);
                        high = std::max(high, neighbour[k]);
                      }
                    for (unsigned int p = 0; p < l.n_points(dim); ++p)
                      {
                        low  = std::min(low, parent[p * l.n_values + k]);
                        high = std::max(high, parent[p * l.n_values + k]);
                      }
                    BOOST_TEST((value >= low - 1e-14 && value <= high + 1e-14), "degree " << degree << ": " << value);
                  }
            }
          rules.coarsen(pointers, whole.data());
          const auto again = rules.means(whole.data());
          for (unsigned int k = 0; k < n; ++k)
            {
              if (degree < 2) // joining keeps the mean of any children
                BOOST_TEST(std::abs(again[k] - sum[k]) < 1e-13 * (10. + k));
              if (degree == 0 || linear)
                BOOST_TEST(std::abs(again[k] - mean[k]) < 1e-13 * (10. + k));
            }
        }
    }
}

namespace
{
/// Change a body's mesh as the adaptor does; velocities and momentum included.
template <int dim>
void change(LawBody<dim>                                                                         &body,
            const std::function<void(const typename Triangulation<dim>::active_cell_iterator &)> &flag)
{
  auto &mesh  = body.discretization;
  auto &state = body.state;
  for (const auto &cell : body.triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      flag(cell);
  VectorType velocity = state.half_velocity;
  make_consistent(mesh, velocity);
  CellTransport<dim> transport(body.triangulation, mesh);
  FieldTransfer<dim> fields(transport, mesh);
  fields.add(mesh.positions);
  fields.add(state.displacement);
  fields.add(velocity);
  PointTransfer<dim>    points(transport, body.triangulation, *body.dynamics, state);
  MomentumTransfer<dim> momentum(transport, *body.dynamics, velocity);
  transport.send();
  body.triangulation.execute_coarsening_and_refinement();
  mesh.distribute_nodes();
  transport.receive();
  fields.interpolate();
  fields.next(mesh.positions);
  mesh.complete_positions();
  body.dynamics->reinit(state, false);
  fields.next(state.displacement);
  fields.next(state.half_velocity);
  make_consistent(mesh, state.displacement);
  make_consistent(mesh, state.half_velocity);
  momentum.restore(state, state.half_velocity);
  points.unpack(state);
  zero_at_hanging_nodes(mesh, state.half_velocity);
}
} // namespace

// A body flies freely with random velocities of its nodes while cells are halved and joined at random, 20 times: its momentum stays. One
// change that is undone leaves the velocities as they were.
BOOST_AUTO_TEST_CASE(momentum_stays, *label("parallel"))
{
  for (const unsigned int degree : {0u, 1u, 2u})
    {
      LawBody<3> body(element(degree), "finite strain", example_law(native_lanes, "mie grueneisen", "clay"),
                      [](auto &t) {
                        GridGenerator::subdivided_hyper_cube(t, 3);
                        GridTools::distort_random(0.15, t, true, 5);
                      });
      body.randomize(body.state.half_velocity, 1.);
      const auto before = body.dynamics->conserved(body.state, 0.);
      VectorType start  = body.state.half_velocity;
      change<3>(body, [](const auto &cell) { cell->set_refine_flag(); });
      change<3>(body, [](const auto &cell) { cell->set_coarsen_flag(); });
      double off = 0.;
      for (unsigned int i = 0; i < start.locally_owned_size(); ++i)
        off = std::max(off, std::abs(start.local_element(i) - body.state.half_velocity.local_element(i)));
      BOOST_TEST(Utilities::MPI::max(off, MPI_COMM_WORLD) < (degree < 2 ? 1e-13 : 1e-2), "degree " << degree);
      double worst = 0.;
      for (unsigned int pass = 0; pass < 20; ++pass)
        {
          const double where = 0.5 + 0.5 * std::sin(1.7 * pass);
          change<3>(body, [&](const auto &cell) {
            if (std::abs(cell->center()[0] - where) < 0.2 && cell->level() < 2)
              cell->set_refine_flag();
            else if (cell->level() > 0)
              cell->set_coarsen_flag();
          });
          const auto now = body.dynamics->conserved(body.state, 0.);
          BOOST_TEST(std::abs(now.mass / before.mass - 1.) < (degree < 2 ? 1e-13 : 1e-12));
          worst = std::max(worst, (now.momentum - before.momentum).norm() / before.momentum_scale);
        }
      BOOST_TEST_MESSAGE("degree " << degree << ": momentum " << worst << ", velocities " << off);
      BOOST_TEST(worst < 1e-13);
    }
}

namespace
{
/// Hourglass forces of the cells of a body, cell by cell.
template <int dim>
std::vector<double> hourglass_forces(const LawBody<dim> &body)
{
  const unsigned int  n    = dim * (dim == 2 ? 1 : 4);
  const auto          size = body.dynamics->blocks[0]->cell_record().size(dim);
  std::vector<double> all, values(size);
  for (unsigned int cell = 0; cell < body.discretization.cells().size(); ++cell)
    {
      body.dynamics->blocks[0]->pack(body.state.blocks[0], cell, values.data());
      all.insert(all.end(), values.end() - n, values.end());
    }
  return all;
}

/// Largest difference over the largest number.
double difference(const std::vector<double> &a, const std::vector<double> &b)
{
  double off = 0., largest = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    {
      off     = std::max(off, std::abs(a[k] - b[k]));
      largest = std::max(largest, std::abs(b[k]));
    }
  return off / largest;
}

/// A field of products of two coordinates has the same hourglass in every cell: forces of an elastic body that was halved are those of one that
/// had the fine mesh all the time, and joined again it has its own.
template <int dim>
void halve_bent_body()
{
  const auto make = [](const unsigned int refinements) {
    return LawBody<dim>(element(0), "small strain", example_law(native_lanes, "linear elastic", "soil"), [=](auto &t) {
      GridGenerator::subdivided_hyper_cube(t, 2);
      t.refine_global(refinements);
    });
  };
  const auto bent = [](const Point<dim> &x) {
    Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = 1e-3 * (1. - 0.4 * d) * x[d] * x[(d + 1) % dim];
    return u;
  };
  LawBody<dim> body = make(0), fine = make(1);
  for (LawBody<dim> *b : {&body, &fine})
    b->move(bent, 1e-4);
  const auto start = hourglass_forces(body);
  change<dim>(body, [](const auto &cell) { cell->set_refine_flag(); });
  BOOST_TEST(difference(hourglass_forces(body), hourglass_forces(fine)) < 1e-11);
  change<dim>(body, [](const auto &cell) { cell->set_coarsen_flag(); });
  BOOST_TEST(difference(hourglass_forces(body), start) < 1e-13);
}
} // namespace

BOOST_AUTO_TEST_CASE(hourglass_forces_of_halves)
{
  halve_bent_body<2>();
  halve_bent_body<3>();
}

// A column in equilibrium under its own weight, with the stress of its depth at each point and K0 = 0.5, is halved and joined in parts: forces of stress
// and weight stay equal at every node, between cells of two sizes and at the surface, too. Round-off of the sums: 1e-11 of a node's weight.
BOOST_AUTO_TEST_CASE(column_at_rest, *label("parallel"))
{
  for (const auto &[law, block] :
       {std::make_pair("linear elastic", "soil"), std::make_pair("viscoplastic cap", "loose sand")})
    for (const ElementChoice &choice : elements_for_laws())
      {
        LawBody<2>   body(choice, "small strain", example_law(native_lanes, law, block), [](auto &t) {
          GridGenerator::subdivided_hyper_rectangle(t, {2u, 8u}, Point<2>(), Point<2>(2., 8.), true);
        });
        auto        &dynamics = *body.dynamics;
        auto        &state    = body.state;
        const double weight   = g * dynamics.blocks[0]->material().density;
        const auto   layout   = dynamics.blocks[0]->cell_record();
        for (unsigned int cell = 0; cell < body.discretization.cells().size(); ++cell)
          {
            std::vector<double> values(layout.size(2));
            dynamics.blocks[0]->pack(state.blocks[0], cell, values.data());
            for (unsigned int q = 0; q < layout.n_points(2); ++q)
              {
                const double depth =
                  8. - (body.discretization.cells()[cell]->center()[1] - 0.5 + layout.points[q / layout.points.size()]);
                double *const stress = &values[q * layout.n_values];
                stress[1]            = -weight * depth;
                stress[0] = stress[2] = 0.5 * stress[1];
              }
            dynamics.blocks[0]->unpack(state.blocks[0], cell, values.data());
          }
        double     worst   = 0.;
        const auto balance = [&] {
          state.force = 0.;
          dynamics.compute_internal_force(state);
          double off = 0.;
          for (unsigned int node = 0; node < body.discretization.n_owned_nodes(); ++node)
            if (const double m = dynamics.mass.local_element(node);
                m > 0. && body.discretization.position(node)[1] > 1e-9) // above the ground
              off = std::max(off, std::abs(state.force.local_element(2 * node + 1) - m * g) / (m * g));
          state.force = 0.;
          worst       = std::max(worst, Utilities::MPI::max(off, MPI_COMM_WORLD));
        };
        balance();
        BOOST_TEST(worst < 1e-11, law << " before");
        for (const auto &[low, high] :
             {std::make_pair(3., 6.), std::make_pair(5., 9.), std::make_pair(-1., 2.5), std::make_pair(10., 11.)})
          {
            const double from = low, to = high;
            change<2>(body, [&](const auto &cell) {
              if (cell->center()[1] > from && cell->center()[1] < to && cell->level() < 2)
                cell->set_refine_flag();
              else if (cell->level() > 0)
                cell->set_coarsen_flag();
            });
            balance();
          }
        BOOST_TEST_MESSAGE(law << ", " << choice.type << " " << choice.degree << " " << choice.volumetric_strain << ": "
                               << worst << ", " << body.triangulation.n_global_active_cells() << " cells");
        BOOST_TEST(worst < 1e-11, law << ", " << choice.type << " " << choice.degree);
      }
}

BOOST_AUTO_TEST_SUITE_END()
