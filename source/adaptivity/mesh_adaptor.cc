#include <arenite/adaptivity/cell_transport.h>
#include <arenite/adaptivity/field_transfer.h>
#include <arenite/adaptivity/mesh_adaptor.h>
#include <arenite/adaptivity/mesh_flags.h>
#include <arenite/adaptivity/momentum_transfer.h>
#include <arenite/adaptivity/point_transfer.h>
#include <arenite/base/errors.h>
#include <arenite/base/state_archive.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <list>

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
  parameters.add_integer(
    "Buffer layers", layers, 1, 100,
    "Layers of fine cells around the front, and width of the belts of each coarser level. More layers cost cells "
    "and save adaptations, each of which costs as much as some hundred steps.");
  parameters.add_integer("Layers behind", layers_behind, 1, 100,
                         "As 'Buffer layers', for what the front has left: cells that were nearer to it when the mesh "
                         "changed last. Fewer save cells; a wave that "
                         "starts there, at a layer or where two waves meet, is refined at the next look only.");
  parameters.add_points(
    "Refined boxes", fine_boxes, "m",
    "Boxes of the undeformed body whose cells stay at the finest level, two opposite corners each.");
  parameters.add_points("Coarse boxes", coarse_boxes, "m",
                        "Boxes whose cells are not refined to the finest level, two opposite corners each.");
  parameters.add_integer("Levels in coarse boxes", levels_in_boxes, 0, 8,
                         "That may be refined there; 0: they stay as the initial mesh is, whatever happens in them.");
  parameters.add_list(
    "Initially refined boundaries", boundary_names,
    "Boundaries with fine cells at the start; 'auto': those under pressure or with a prescribed velocity.");
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
  layers_behind        = std::min(layers_behind, layers);
  room                 = layers / 2 + 1; // something may start away from the refined boundaries
  base_level           = mesh.refinement;
  refine_geometry      = mesh.refine_geometry;
  automatic_boundaries = boundary_names == std::vector<std::string>{"auto"};
  if (!automatic_boundaries)
    initial_boundaries = geometry.boundary_ids(parameters, "Adaptivity/Initially refined boundaries", boundary_names);
  if (coarsen_below >= refine_above)
    parameters.refuse("Adaptivity/Coarsen below",
                      "must be smaller than 'Refine above', or cells would flip at every adaptation");
}

namespace
{
/// Whether the box from @p low to @p high meets one of those that are given by two opposite corners each.
template <int dim>
bool in_some_box(const std::vector<Point<dim>> &corners, const Point<dim> &low, const Point<dim> &high)
{
  for (std::size_t box = 0; box < corners.size(); box += 2)
    {
      bool meets = true;
      for (unsigned int d = 0; d < dim; ++d)
        meets = meets && high[d] >= std::min(corners[box][d], corners[box + 1][d]) &&
                low[d] <= std::max(corners[box][d], corners[box + 1][d]);
      if (meets)
        return true;
    }
  return false;
}
} // namespace

/// The finest level that each cell may have: coarse boxes have those cells whose centre is in them. Cells that a box keeps fine, those that it
/// meets, join the @p front; those that must stay as they are at the start leave it.
template <int dim>
std::vector<unsigned int> MeshAdaptor<dim>::obey_boxes(const Discretization<dim> &discretization,
                                                       std::vector<bool>         &front) const
{
  std::vector<unsigned int> finest(front.size(), base_level + levels);
  if (fine_boxes.empty() && coarse_boxes.empty())
    return finest;
  std::vector<Point<dim>> x;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      discretization.cell_positions(cell, x);
      const BoundingBox<dim> extent(x);
      const Point<dim>       centre = extent.center();
      const unsigned int     index  = discretization.cells()[cell]->active_cell_index();
      if (in_some_box(coarse_boxes, centre, centre))
        finest[index] = base_level + std::min(levels_in_boxes, levels);
      // a common face is no meeting
      const Tensor<1, dim> inwards = 1e-6 * (extent.get_boundary_points().second - extent.get_boundary_points().first);
      front[index]                 = finest[index] > base_level &&
                     (front[index] || in_some_box(fine_boxes, extent.get_boundary_points().first + inwards,
                                                  extent.get_boundary_points().second - inwards));
    }
  return finest;
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
      const std::vector<unsigned int> finest = obey_boxes(discretization, front);
      const auto layers_of                   = layers_from(triangulation, front, base_level + levels, levels * layers);
      set_flags(triangulation, wanted_levels(layers_of, finest, Vector<double>(triangulation.n_active_cells())), quiet);
      check_size(triangulation, 0.);
      CellTransport<dim> transport(triangulation, discretization);
      FieldTransfer<dim> fields(transport, discretization);
      fields.add(discretization.positions);
      transport.send();
      triangulation.execute_coarsening_and_refinement();
      discretization.distribute_nodes();
      transport.receive();
      fields.interpolate();
      fields.next(discretization.positions);
      discretization.complete_positions();
      if (refine_geometry)
        discretization.positions_from_manifolds();
    }
}

/// Cells with a large indicator, and those with small ones.
template <int dim>
void MeshAdaptor<dim>::find_front(const Dynamics<dim> &dynamics, const State<dim> &state, std::vector<bool> &front,
                                  std::vector<bool> &quiet)
{
  const auto      &cells    = dynamics.discretization.cells();
  const VectorType velocity = dynamics.velocity(state);
  for (Indicator &indicator : indicators)
    {
      Vector<float> value(cells.size());
      indicator.kind->evaluate(dynamics, state, velocity, value);
      const float largest =
        Utilities::MPI::max(cells.empty() ? 0.f : value.linfty_norm(), dynamics.discretization.communicator);
      // A wave that has left must not hand the fine cells over to what is left behind it, and one that fades by spreading must keep them:
      // what was seen counts less with the square of the time since then, blasts fade more slowly
      const double fading   = state.time > 0. ? std::min(1., std::pow(marked_at / state.time, 2)) : 1.;
      indicator.peak        = std::max(static_cast<float>(fading) * indicator.peak, largest);
      const float reference = std::max(largest, 0.02f * indicator.peak);
      for (unsigned int cell = 0; cell < cells.size(); ++cell)
        {
          const unsigned int index = cells[cell]->active_cell_index();
          front[index]             = front[index] || value[cell] > refine_above * reference;
          quiet[index]             = quiet[index] && value[cell] <= coarsen_below * reference;
        }
    }
  marked_at = state.time;
}

/// The trail as it would be if the mesh changed now. Where the distance from the front has grown since the last change, a cell is behind it, where
/// it has shrunk it is not; smaller differences than the layers behind may come from coarse cells in the front and change nothing. @p layers_of:
/// layers_from() the front.
template <int dim>
Vector<double> MeshAdaptor<dim>::marks_of(Triangulation &triangulation, const std::vector<bool> &front,
                                          const std::vector<unsigned int> &layers_of) const
{
  const unsigned int n = triangulation.n_active_cells();
  Vector<double>     marks(n);
  std::copy(front.begin(), front.end(), marks.begin());
  if (layers_behind == layers || trail.size() != n)
    return marks;
  std::vector<bool> before(n);
  for (unsigned int i = 0; i < n; ++i)
    before[i] = trail[i] > 0.;
  const auto layers_then = layers_from(triangulation, before, base_level + levels, levels * layers);
  for (unsigned int i = 0; i < n; ++i)
    if (!front[i])
      {
        const bool has_grown  = layers_of[i] > layers_then[i] + layers_behind,
                   has_shrunk = layers_then[i] > layers_of[i] + layers_behind;
        if (has_grown || (trail[i] < 0. && !has_shrunk))
          marks[i] = -1.;
      }
  return marks;
}

/// The finest level around the front, and belts as wide as this buffer of each coarser one around it: a front that moves by its buffer then finds
/// cells that lack no more than one level. @p layers_of: layers_from() the front; @p finest: that boxes allow; @p
/// marks: as in the trail.
template <int dim>
std::vector<unsigned int> MeshAdaptor<dim>::wanted_levels(const std::vector<unsigned int> &layers_of,
                                                          const std::vector<unsigned int> &finest,
                                                          const Vector<double>            &marks) const
{
  std::vector<unsigned int> wanted(layers_of.size());
  for (unsigned int i = 0; i < wanted.size(); ++i)
    wanted[i] = std::min(finest[i], base_level + levels - std::min(levels, layers_of[i] / layers_around(marks[i])));
  return wanted;
}

template <int dim>
bool MeshAdaptor<dim>::mark(Triangulation &triangulation, const Dynamics<dim> &dynamics, const State<dim> &state,
                            const unsigned int pass)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  const auto                &cells          = discretization.cells();
  std::vector<bool>          front(triangulation.n_active_cells(), false), quiet(front.size(), pass == 0);
  if (pass == 0)
    find_front(dynamics, state, front, quiet);
  else
    for (const auto &cell : cells)
      front[cell->active_cell_index()] = trail[cell->active_cell_index()] > 0.;
  const std::vector<unsigned int> finest    = obey_boxes(discretization, front);
  const std::vector<unsigned int> layers_of = layers_from(triangulation, front, base_level + levels, levels * layers);
  const Vector<double>            marks     = pass == 0 ? marks_of(triangulation, front, layers_of) : trail;
  const std::vector<unsigned int> wanted    = wanted_levels(layers_of, finest, marks);

  std::vector<unsigned long> count(3, 0); // in the front and too coarse; below the wanted level; above
  room = layers;
  for (const auto &cell : cells)
    {
      const unsigned int index = cell->active_cell_index(), level = cell->level();
      quiet[index] = quiet[index] || level > finest[index];
      count[0] += front[index] && level < finest[index];
      count[1] += level < wanted[index];
      count[2] += quiet[index] && level > wanted[index];
      if (level < finest[index] && marks[index] >= 0.)
        room = std::min(room, layers_of[index]);
    }
  room = Utilities::MPI::min(room, discretization.communicator);
  Utilities::MPI::sum(count, discretization.communicator, count);
  const unsigned long met = count[0], below = count[1], above = count[2];
  const bool          is_near = room < std::max(2u, layers / 4);
  if (pass == 0)
    n_met += met;
  // a front that is far enough from coarse cells may wait, unless a quarter of all cells could be joined
  const auto is_many = [&](const unsigned long n) { return 4 * n > triangulation.n_global_active_cells(); };
  if (pass == 0 ? !is_near && !is_many(above) : below == 0)
    return false;
  keep_what_is_distorted(discretization, state.displacement, quiet);
  set_flags(triangulation, wanted, quiet);
  check_size(triangulation, state.time);
  unsigned long refined = 0, joined = 0;
  for (const auto &cell : cells)
    {
      refined += cell->refine_flag_set();
      joined += cell->coarsen_flag_set();
    }
  refined = Utilities::MPI::sum(refined, discretization.communicator);
  joined  = Utilities::MPI::sum(joined, discretization.communicator);
  if (pass > 0 ? refined > 0 : (is_near ? refined + joined > 0 : is_many(joined)))
    {
      trail = marks;
      return true;
    }
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      cell->clear_refine_flag();
      cell->clear_coarsen_flag();
    }
  return false;
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

template <int dim>
void MeshAdaptor<dim>::execute(Triangulation &triangulation, Dynamics<dim> &dynamics, State<dim> &state,
                               StableTimeStep<dim> &time_step)
{
  Discretization<dim> &discretization = dynamics.discretization;

  VectorType velocity = state.half_velocity;
  make_consistent(discretization, velocity);
  std::list<VectorType> states_of_loads;
  for (const auto &load : dynamics.loads)
    for (const VectorType *scalar : load->nodal_states())
      {
        states_of_loads.push_back(*scalar);
        make_consistent(discretization, states_of_loads.back());
      }
  CellTransport<dim> transport(triangulation, discretization);
  FieldTransfer<dim> fields(transport, discretization);
  for (const VectorType *field : {&discretization.positions, &state.displacement, &velocity})
    fields.add(*field);
  for (const VectorType &scalar : states_of_loads)
    fields.add(scalar);
  using Cell    = typename CellTransport<dim>::Cell;
  using Numbers = typename CellTransport<dim>::Numbers;
  // children take the numbers of their parent, a parent the largest of its children
  const unsigned int ratios_and_marks = transport.add(
    [&](const Cell &cell, bool, Numbers &numbers) {
      const unsigned int index = cell->active_cell_index();
      numbers.insert(numbers.end(), {time_step.ratio[index], trail[index]});
    },
    [](const std::vector<Numbers> &children) {
      Numbers largest = children[0];
      for (const Numbers &child : children)
        for (std::size_t k = 0; k < largest.size(); ++k)
          largest[k] = std::max(largest[k], child[k]);
      return largest;
    });
  PointTransfer<dim>    points(transport, triangulation, dynamics, state);
  MomentumTransfer<dim> momentum(transport, dynamics, velocity);
  transport.send();
  triangulation.execute_coarsening_and_refinement();

  discretization.distribute_nodes();
  transport.receive();
  fields.interpolate();
  fields.next(discretization.positions);
  discretization.complete_positions();
  if (refine_geometry)
    discretization.positions_from_manifolds();

  dynamics.reinit(state, false);
  fields.next(state.displacement);
  fields.next(state.half_velocity);
  dynamics.constraints.project(state.displacement);
  dynamics.constraints.project(state.half_velocity);
  for (const auto &load : dynamics.loads)
    if (const std::size_t n_states = load->nodal_states().size(); n_states > 0)
      {
        std::vector<VectorType> states(n_states, discretization.new_scalar());
        for (VectorType &scalar : states)
          fields.next(scalar);
        load->set_nodal_states(states);
      }
  make_consistent(discretization, state.displacement);
  make_consistent(discretization, state.half_velocity);
  momentum.restore(state, state.half_velocity);
  points.unpack(state);
  zero_at_hanging_nodes(discretization, state.half_velocity);

  room = layers;
  for (Vector<double> *numbers : {&time_step.ratio, &trail})
    numbers->reinit(triangulation.n_active_cells());
  transport.unpack(ratios_and_marks,
                   [&](const Cell &cell, const Numbers &numbers, const typename CellTransport<dim>::Change change) {
                     const auto put = [&](const Cell &active) {
                       time_step.ratio[active->active_cell_index()] = numbers[0];
                       trail[active->active_cell_index()]           = numbers[1];
                     };
                     if (change != CellTransport<dim>::Change::halved)
                       return put(cell);
                     for (unsigned int child = 0; child < cell->n_children(); ++child)
                       if (cell->child(child)->is_locally_owned())
                         put(cell->child(child));
                   });
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
  archive.common(marked_at);
  archive.common(crossed);
  archive.common(crossing_at_rest);
  archive.common(n_met);
  archive.common(room);
}

template class MeshAdaptor<1>;
template class MeshAdaptor<2>;
template class MeshAdaptor<3>;
} // namespace Arenite
