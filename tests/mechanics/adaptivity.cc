#include <arenite/adaptivity/field_transfer.h>
#include <arenite/adaptivity/mesh_flags.h>

#include <deal.II/grid/grid_generator.h>

#include "body.h"
#include "cavity_scene.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;
using boost::unit_test::label;

namespace
{
/// The reference cavity with room for a front to travel, on a coarse mesh.
const std::vector<std::string> wide_cavity = {"End time=1.2e-3",
                                              "Mesh/Outer radius=0.5",
                                              "Mesh/Refinement=1",
                                              "Element/Degree=2",
                                              "Loads/far field/Condition=spherical",
                                              "Receivers/array/Directions=0.9, 0.35, 0.25; 0.5, 0.3, 0.8",
                                              "Receivers/array/Radii=0.1, 0.15, 0.2, 0.3"};
} // namespace

BOOST_AUTO_TEST_SUITE(adaptivity)

// Refining and coarsening back is the identity for every nodal field, and a polynomial of the element's degree survives any change
// of the mesh: on curved cells too, because positions are interpolated like the fields.
BOOST_AUTO_TEST_CASE(transfer_keeps_polynomials, *label("parallel"))
{
  for (const unsigned int degree : {1u, 2u, 4u})
    {
      Body       body(element(degree), [&](auto &t) { shell_octant(t, 1, false); });
      auto      &mesh   = body.discretization;
      VectorType field  = mesh.new_vector(), start;
      const auto motion = [](const Point<3> &x) { return Tensor<1, 3>({x[0] - 2. * x[1], x[2] + 0.5, 3. * x[1]}); };
      body.set(field, motion); // linear in the positions, so linear in the nodes whatever the cell's shape
      make_consistent(mesh, field);
      start             = field;
      const auto change = [&](const std::function<void(const dealii::Triangulation<3>::active_cell_iterator &)> &flag) {
        for (const auto &cell : body.triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            flag(cell);
        CellTransport<3> transport(body.triangulation, mesh);
        FieldTransfer<3> fields(transport, mesh);
        fields.add(mesh.positions);
        fields.add(field);
        transport.send();
        body.triangulation.execute_coarsening_and_refinement();
        mesh.distribute_nodes();
        transport.receive();
        fields.interpolate();
        fields.next(mesh.positions);
        make_consistent(mesh, mesh.positions);
        field.reinit(mesh.vector_partitioner);
        fields.next(field);
        make_consistent(mesh, field);
        double worst = 0.;
        for (unsigned int node = 0; node < mesh.n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(field.local_element(3 * node + c) - motion(mesh.position(node))[c]));
        BOOST_TEST(Utilities::MPI::max(worst, MPI_COMM_WORLD) < 1e-13, "degree " << degree);
      };
      const unsigned int cells = body.triangulation.n_global_active_cells();
      change([](const auto &cell) { cell->set_refine_flag(); });
      change([](const auto &cell) {
        if (cell->center()[0] > 0.9)
          cell->set_refine_flag();
      });
      for (unsigned int pass = 0; pass < 4 && body.triangulation.n_global_active_cells() > cells; ++pass)
        change([](const auto &cell) {
          if (cell->level() > 1)
            cell->set_coarsen_flag();
        });
      BOOST_TEST(body.triangulation.n_global_active_cells() == cells);
    }
}

// A front that is followed by the mesh: the ledgers agree to round-off with every adaptation booked, mass changes only by the
// quadrature of curved cells, and the error is that of the uniformly fine mesh.
BOOST_AUTO_TEST_CASE(front_is_followed, *label("parallel"))
{
  auto uniform = wide_cavity, adaptive = wide_cavity;
  uniform.push_back("Mesh/Refinement=2");
  adaptive.push_back("Adaptivity/Levels=1");
  adaptive.push_back("Adaptivity/Refine above=0.1");
  adaptive.push_back("Adaptivity/Coarsen below=0.02");
  adaptive.push_back("Adaptivity/Buffer layers=2");
  const RunRecord fine = run_scene(cavity_scene, uniform), followed = run_scene(cavity_scene, adaptive),
                  coarse = run_scene(cavity_scene, wide_cavity);
  const std::string key  = "array.displacement.E_t";
  BOOST_TEST_MESSAGE("E_t fine " << fine.errors.at(key) << " adaptive " << followed.errors.at(key) << " coarse "
                                 << coarse.errors.at(key) << ", unknowns x steps " << fine.dof_steps << " "
                                 << followed.dof_steps << " momentum " << followed.momentum_error);
  BOOST_TEST(followed.energy_error < 1e-11);
  BOOST_TEST(followed.mass_error < 1e-4);
  BOOST_TEST(followed.errors.at(key) < 1.3 * fine.errors.at(key));
  BOOST_TEST(followed.errors.at(key) < 0.5 * coarse.errors.at(key));
  // Unknowns of a step: 0.84 on this short path. Steps are shorter on a mesh that soon changes, where the elements alone say how long they may be
  // (theory.md, section 10); benchmarks/adaptive_vs_uniform counts the time of both.
  BOOST_TEST(followed.dof_steps / followed.steps < 0.9 * fine.dof_steps / fine.steps);
}

// The same agreement with both forms of hourglass control: viscous forces belong to two steps, and the mesh changes between them.
BOOST_AUTO_TEST_CASE(ledgers_agree_with_hourglass_control, *label("parallel"))
{
  for (const std::string control : {"stiffness", "viscous"})
    {
      auto scene = wide_cavity;
      for (const std::string entry : {"Element/Type=one-point hexahedron", "Element/Degree=1", "Mesh/Refinement=2",
                                      "Adaptivity/Levels=1", "Adaptivity/Coarsen below=0.02"})
        scene.push_back(entry);
      scene.push_back("Element/Hourglass control=" + control);
      const RunRecord record = run_scene(cavity_scene, scene);
      BOOST_TEST_MESSAGE(control << " energy error " << record.energy_error << " steps " << record.steps << " cells "
                                 << record.cells);
      BOOST_TEST(record.energy_error < 1e-11, control << ": " << record.energy_error);
    }
}

// Distances from a region in layers of the finest cells: on equal cells the larger of both differences of index less one; through cells twice
// as large twice as much. The same on any number of processes.
BOOST_AUTO_TEST_CASE(layers_from_a_region, *label("parallel"))
{
  ParallelTriangulation<2> triangulation(MPI_COMM_WORLD);
  GridGenerator::subdivided_hyper_cube(triangulation, 8, 0., 8.);
  const auto distances = [&](const unsigned int finest, const unsigned int most) {
    std::vector<bool> region(triangulation.n_active_cells(), false);
    for (const auto &cell : triangulation.active_cell_iterators())
      region[cell->active_cell_index()] = cell->is_locally_owned() && cell->center().norm() < 1.;
    return layers_from(triangulation, region, finest, most);
  };
  auto layers = distances(0, 5);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const unsigned int index = static_cast<unsigned int>(std::max(cell->center()[0], cell->center()[1]));
        BOOST_TEST(layers[cell->active_cell_index()] == std::min(index > 0 ? index - 1 : 0u, 5u));
      }
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] < 4.)
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
  layers = distances(1, 100); // the region is the four children of the cell at the origin
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[1] < 1.)
      {
        const double start = cell->center()[0] - (cell->level() == 1 ? 0.25 : 0.5); // of the cell, its region ends at 1
        BOOST_TEST(layers[cell->active_cell_index()] == static_cast<unsigned int>(std::max(2. * (start - 1.), 0.)));
      }
}

BOOST_AUTO_TEST_SUITE_END()
