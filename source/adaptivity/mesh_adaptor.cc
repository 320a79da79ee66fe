#include <arenite/adaptivity/field_transfer.h>
#include <arenite/adaptivity/mesh_adaptor.h>
#include <arenite/adaptivity/momentum_transfer.h>
#include <arenite/adaptivity/point_transfer.h>
#include <arenite/base/errors.h>
#include <arenite/base/state_archive.h>

#include <deal.II/distributed/cell_data_transfer.templates.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/numerics/adaptation_strategies.h>
#include <deal.II/numerics/cell_data_transfer.templates.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void MeshAdaptor<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Adaptivity");
  parameters.add_integer(
    "Levels", levels, 0, 8,
    "Levels that may be refined on top of the initial mesh; 0 keeps the mesh. Each level halves the step.");
  if (const auto chosen = parameters.peek_list("Adaptivity/Indicator"); !chosen.empty())
    types = chosen;
  for (const std::string &type : types)
    {
      const auto names = refinement_indicators<dim>().names();
      if (std::find(names.begin(), names.end(), type) == names.end())
        parameters.refuse("Adaptivity/Indicator",
                          "'" + type + "' is not a refinement indicator." + suggestion(type, names));
      indicators.push_back({refinement_indicators<dim>().make(type)});
      indicators.back().kind->declare_parameters(parameters);
    }
  parameters.add_list("Indicator", types,
                      "What marks a cell as part of the front, one or several of: " +
                        join(refinement_indicators<dim>().names()) + ".");
  parameters.add_quantity(
    "Refine above", refine_above, "-", {0., 1., true, false},
    "Part of the largest indicator above which a cell belongs to the front. Larger values refine less.");
  parameters.add_quantity(
    "Coarsen below", coarsen_below, "-", {0., 1., false, false},
    "Part of the largest indicator below which cells are coarsened. Larger values coarsen sooner.");
  parameters.add_integer("Buffer layers", layers, 1, 100,
                         "Layers of fine cells around the front. More layers cost cells and save adaptations.");
  parameters.add_points("Refined boxes", fine_boxes, "m",
                        "Boxes of the undeformed body that stay at the finest level, two opposite corners each.");
  parameters.add_points("Coarse boxes", coarse_boxes, "m",
                        "Boxes that stay as the initial mesh is, whatever happens in them, two opposite corners each.");
  parameters.add_list("Initially refined boundaries", boundary_names,
                      "Boundaries with fine cells at the start; 'auto': those under pressure.");
  parameters.add_integer("Largest number of cells", cell_limit, 1, 1000000000,
                         "The run stops with a message before it exceeds this.");
}

template <int dim>
void MeshAdaptor<dim>::finalize(const Parameters &parameters, const MeshChoice<dim> &mesh,
                                const Geometry<dim> &geometry)
{
  for (const auto &[entry, boxes] :
       {std::make_pair("Refined boxes", &fine_boxes), std::make_pair("Coarse boxes", &coarse_boxes)})
    if (boxes->size() % 2 != 0)
      parameters.refuse(std::string("Adaptivity/") + entry, "needs two corners for each box");
  base_level           = mesh.refinement;
  refine_geometry      = mesh.refine_geometry;
  automatic_boundaries = boundary_names == std::vector<std::string>{"auto"};
  if (!automatic_boundaries)
    initial_boundaries = geometry.boundary_ids(parameters, "Adaptivity/Initially refined boundaries", boundary_names);
  if (coarsen_below >= refine_above)
    parameters.refuse("Adaptivity/Coarsen below",
                      "must be smaller than 'Refine above', or cells would flip at every adaptation");
}

/// Add all cells that share a vertex with a marked one, on owned cells.
template <int dim>
void MeshAdaptor<dim>::grow(Triangulation &triangulation, std::vector<bool> &marked) const
{
  for (unsigned int layer = 0; layer < layers; ++layer)
    {
      using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;
      std::vector<bool> vertex(triangulation.n_vertices(), false);
      const auto        mark_vertices = [&](const Cell &cell) {
        for (const unsigned int v : cell->vertex_indices())
          vertex[cell->vertex_index(v)] = true;
      };
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && marked[cell->active_cell_index()])
          mark_vertices(cell);
      if constexpr (dim == 1)
        {
          std::vector<int> marks(vertex.begin(), vertex.end());
          Utilities::MPI::max(marks, triangulation.get_communicator(), marks);
          vertex.assign(marks.begin(), marks.end());
        }
      else
        GridTools::exchange_cell_data_to_ghosts<unsigned int, dealii::Triangulation<dim>>(
          triangulation, [&](const Cell &cell) { return marked[cell->active_cell_index()] ? 1u : 0u; },
          [&](const Cell &cell, const unsigned int value) {
            if (value)
              mark_vertices(cell);
          });
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int v : cell->vertex_indices())
            if (vertex[cell->vertex_index(v)])
              marked[cell->active_cell_index()] = true;
    }
}

/// Cells that boxes of the scene keep fine or coarse, by their centres.
template <int dim>
void MeshAdaptor<dim>::obey_boxes(const Discretization<dim> &discretization, std::vector<bool> &front,
                                  std::vector<bool> &coarse) const
{
  if (fine_boxes.empty() && coarse_boxes.empty())
    return;
  std::vector<Point<dim>> x;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      discretization.cell_positions(cell, x);
      Point<dim> centre;
      for (const Point<dim> &node : x)
        centre += node / double(x.size());
      const auto inside = [&](const std::vector<Point<dim>> &boxes) {
        for (std::size_t box = 0; box < boxes.size(); box += 2)
          {
            bool is_inside = true;
            for (unsigned int d = 0; d < dim; ++d)
              is_inside = is_inside && centre[d] >= std::min(boxes[box][d], boxes[box + 1][d]) &&
                          centre[d] <= std::max(boxes[box][d], boxes[box + 1][d]);
            if (is_inside)
              return true;
          }
        return false;
      };
      const unsigned int index = discretization.cells()[cell]->active_cell_index();
      coarse[index]            = inside(coarse_boxes);
      front[index]             = !coarse[index] && (front[index] || inside(fine_boxes));
    }
}

template <int dim>
void MeshAdaptor<dim>::flag(Triangulation &triangulation, const std::vector<bool> &front,
                            const std::vector<bool> &quiet) const
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const unsigned int level = cell->level();
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (front[cell->active_cell_index()] && level < base_level + levels)
          cell->set_refine_flag();
        else if (quiet[cell->active_cell_index()] && !front[cell->active_cell_index()] && level > base_level)
          cell->set_coarsen_flag();
      }
  keep_beside_finer(triangulation);
  share_flags(triangulation);
  triangulation.prepare_coarsening_and_refinement();
}

/// Cells that touch finer ones, or will, stay as they are. Otherwise it would be deal.II that keeps them because of the rule of one hanging node
/// per edge, which it cannot judge where the neighbours' families belong to other processes: the mesh would depend on the partition.
template <int dim>
void MeshAdaptor<dim>::keep_beside_finer(Triangulation &triangulation) const
{
  share_flags(triangulation);
  std::vector<int> level(triangulation.n_vertices(), 0); // finest around each vertex
  for (const auto &cell : triangulation.active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int v : cell->vertex_indices())
        level[cell->vertex_index(v)] =
          std::max(level[cell->vertex_index(v)], cell->level() + (cell->refine_flag_set() ? 1 : 0));
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->coarsen_flag_set())
      for (const unsigned int v : cell->vertex_indices())
        if (level[cell->vertex_index(v)] > cell->level())
          cell->clear_coarsen_flag();
}

/// Other processes' cells beside own ones get their flags; in one dimension, where every process changes the whole mesh, all do.
template <int dim>
void MeshAdaptor<dim>::share_flags(Triangulation &triangulation) const
{
  if constexpr (dim == 1)
    {
      std::vector<int> flags(triangulation.n_active_cells(), 0);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          flags[cell->active_cell_index()] = cell->refine_flag_set() ? 1 : (cell->coarsen_flag_set() ? -1 : 0);
      Utilities::MPI::sum(flags, triangulation.get_communicator(), flags);
      for (const auto &cell : triangulation.active_cell_iterators())
        {
          cell->clear_refine_flag();
          cell->clear_coarsen_flag();
          if (flags[cell->active_cell_index()] > 0)
            cell->set_refine_flag();
          else if (flags[cell->active_cell_index()] < 0)
            cell->set_coarsen_flag();
        }
    }
  else
    GridTools::exchange_cell_data_to_ghosts<int, dealii::Triangulation<dim>>(
      triangulation, [](const auto &cell) { return cell->refine_flag_set() ? 1 : (cell->coarsen_flag_set() ? -1 : 0); },
      [](const auto &cell, const int flag) {
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (flag > 0)
          cell->set_refine_flag();
        else if (flag < 0)
          cell->set_coarsen_flag();
      });
}

template <int dim>
void MeshAdaptor<dim>::initial_refinement(Triangulation &triangulation, Discretization<dim> &discretization,
                                          const std::vector<types::boundary_id> &loaded)
{
  discretization.distribute_nodes();
  discretization.positions_from_manifolds();
  if (!active())
    return;
  if (automatic_boundaries)
    initial_boundaries = loaded;
  for (unsigned int pass = 0; pass < levels; ++pass)
    {
      std::vector<bool> front(triangulation.n_active_cells(), false), quiet(front);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && std::find(initial_boundaries.begin(), initial_boundaries.end(),
                                                 face->boundary_id()) != initial_boundaries.end())
              front[cell->active_cell_index()] = true;
      std::vector<bool> coarse(front.size(), false);
      obey_boxes(discretization, front, coarse);
      grow(triangulation, front);
      for (std::size_t i = 0; i < front.size(); ++i)
        front[i] = front[i] && !coarse[i];
      flag(triangulation, front, quiet);
      check_size(triangulation, 0.);
      FieldTransfer<dim> transfer(discretization);
      transfer.add(discretization.positions);
      transfer.prepare();
      triangulation.execute_coarsening_and_refinement();
      discretization.distribute_nodes();
      transfer.interpolate();
      transfer.next(discretization.positions);
      discretization.complete_positions();
      if (refine_geometry)
        discretization.positions_from_manifolds();
    }
}

template <int dim>
bool MeshAdaptor<dim>::mark(Triangulation &triangulation, const Dynamics<dim> &dynamics, const State<dim> &state,
                            const bool count)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  const auto                &cells          = discretization.cells();
  const VectorType           velocity       = dynamics.velocity(state);
  std::vector<bool>          front(triangulation.n_active_cells(), false), quiet(front.size(), true), coarse(front);
  for (Indicator &indicator : indicators)
    {
      Vector<float> value(cells.size());
      indicator.kind->evaluate(dynamics, state, velocity, value);
      const float largest = Utilities::MPI::max(cells.empty() ? 0.f : value.linfty_norm(), discretization.communicator);
      // a wave that has left must not hand the fine cells over to what is left behind it
      indicator.peak        = std::max(indicator.peak, largest);
      const float reference = std::max(largest, 0.02f * indicator.peak);
      for (unsigned int cell = 0; cell < cells.size(); ++cell)
        {
          const unsigned int index = cells[cell]->active_cell_index();
          front[index]             = front[index] || value[cell] > refine_above * reference;
          quiet[index]             = quiet[index] && value[cell] <= coarsen_below * reference;
        }
    }
  obey_boxes(discretization, front, coarse);
  unsigned long met = 0;
  for (const auto &cell : cells)
    met += count && front[cell->active_cell_index()] && static_cast<unsigned int>(cell->level()) < base_level + levels;
  n_met += Utilities::MPI::sum(met, discretization.communicator);
  grow(triangulation, front);
  for (std::size_t i = 0; i < front.size(); ++i)
    if (coarse[i])
      {
        front[i] = false;
        quiet[i] = true;
      }
  flag(triangulation, front, quiet);
  check_size(triangulation, state.time);
  unsigned int changes = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      changes += cell->refine_flag_set() || cell->coarsen_flag_set();
  return Utilities::MPI::max(changes, discretization.communicator) > 0;
}

/// The flagged mesh must stay below the limit of the scene; said before any memory is asked for.
template <int dim>
void MeshAdaptor<dim>::check_size(const Triangulation &triangulation, const double time) const
{
  unsigned int refined = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      refined += cell->refine_flag_set();
  refined = Utilities::MPI::sum(refined, triangulation.get_communicator());
  if (triangulation.n_global_active_cells() + (GeometryInfo<dim>::max_children_per_cell - 1.) * refined > cell_limit)
    throw InputError("t = " + Utilities::to_string(time) + " s: adaptation needs more than " +
                     std::to_string(cell_limit) +
                     " cells. Raise 'Adaptivity / Largest number of cells', raise 'Refine above' or use fewer levels.");
}

namespace
{
/// One number per active cell: children take that of their parent, a parent the largest of its children.
template <int dim>
class RatioTransfer
{
public:
  explicit RatioTransfer(ParallelTriangulation<dim> &triangulation)
    : triangulation(triangulation)
    , transfer(make(triangulation))
  {}

  void prepare(const Vector<double> &values, const Discretization<dim> &discretization)
  {
    before.reinit(values.size());
    for (const auto &cell : discretization.cells())
      before[cell->active_cell_index()] = values[cell->active_cell_index()];
    if constexpr (dim == 1)
      {
        sum_over_processes(before, discretization.communicator);
        transfer.prepare_for_coarsening_and_refinement();
      }
    else
      transfer.prepare_for_coarsening_and_refinement(before);
  }

  void unpack(Vector<double> &values)
  {
    values.reinit(triangulation.n_active_cells());
    if constexpr (dim == 1)
      transfer.unpack(before, values);
    else
      transfer.unpack(values);
  }

private:
  using Transfer = std::conditional_t<dim == 1, CellDataTransfer<dim, dim, Vector<double>>,
                                      parallel::distributed::CellDataTransfer<dim, dim, Vector<double>>>;

  static Transfer make(ParallelTriangulation<dim> &triangulation)
  {
    const auto largest = [](const typename dealii::Triangulation<dim>::cell_iterator &,
                            const std::vector<double> &children) {
      return *std::max_element(children.begin(), children.end());
    };
    if constexpr (dim == 1)
      return Transfer(triangulation, &AdaptationStrategies::Refinement::preserve<dim, dim, double>, largest);
    else
      return Transfer(triangulation, false, &AdaptationStrategies::Refinement::preserve<dim, dim, double>, largest);
  }

  ParallelTriangulation<dim> &triangulation;
  Vector<double>              before;
  Transfer                    transfer;
};
} // namespace

template <int dim>
void MeshAdaptor<dim>::execute(Triangulation &triangulation, Dynamics<dim> &dynamics, State<dim> &state,
                               StableTimeStep<dim> &time_step) const
{
  Discretization<dim> &discretization = dynamics.discretization;

  FieldTransfer<dim> transfer(discretization);
  VectorType         velocity = state.half_velocity;
  make_consistent(discretization, velocity);
  transfer.add(discretization.positions);
  transfer.add(state.displacement);
  transfer.add(velocity);
  for (const auto &load : dynamics.loads)
    if (const VectorType *scalar = load->nodal_state())
      {
        VectorType consistent = *scalar;
        make_consistent(discretization, consistent);
        transfer.add(consistent);
      }
  transfer.prepare();
  RatioTransfer<dim> ratios(triangulation);
  ratios.prepare(time_step.ratio, discretization);
  PointTransfer<dim>    points(triangulation, dynamics, state);
  MomentumTransfer<dim> momentum(triangulation, dynamics, velocity);
  triangulation.execute_coarsening_and_refinement();

  discretization.distribute_nodes();
  transfer.interpolate();
  transfer.next(discretization.positions);
  discretization.complete_positions();
  if (refine_geometry)
    discretization.positions_from_manifolds();

  dynamics.reinit(state, false);
  transfer.next(state.displacement);
  transfer.next(state.half_velocity);
  dynamics.constraints.project(state.displacement);
  dynamics.constraints.project(state.half_velocity);
  for (const auto &load : dynamics.loads)
    if (load->nodal_state() != nullptr)
      {
        VectorType scalar = discretization.new_scalar();
        transfer.next(scalar);
        load->set_nodal_state(scalar);
      }
  make_consistent(discretization, state.displacement);
  make_consistent(discretization, state.half_velocity);
  momentum.restore(state, state.half_velocity);
  points.unpack(state);
  zero_at_hanging_nodes(discretization, state.half_velocity);

  ratios.unpack(time_step.ratio);
}

template <int dim>
void MeshAdaptor<dim>::schedule(const Dynamics<dim> &dynamics)
{
  if (!active())
    return;
  crossing_at_rest = std::numeric_limits<double>::max();
  for (const auto &cell : dynamics.discretization.cells())
    crossing_at_rest = std::min(crossing_at_rest, cell->minimum_vertex_distance() /
                                                    dynamics.material_of_block(cell->material_id()).p_wave_speed());
  crossing_at_rest = Utilities::MPI::min(crossing_at_rest, dynamics.discretization.communicator);
  crossed          = 0.;
}

template <int dim>
void MeshAdaptor<dim>::exchange(StateArchive &archive)
{
  for (Indicator &indicator : indicators)
    archive.common(indicator.peak);
  archive.common(crossed);
  archive.common(crossing_at_rest);
  archive.common(n_met);
}

template class MeshAdaptor<1>;
template class MeshAdaptor<2>;
template class MeshAdaptor<3>;
} // namespace Arenite
