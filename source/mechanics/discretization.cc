#include <arenite/mechanics/discretization.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>

namespace Arenite
{
using namespace dealii;

void HangingNodes::clear(const bool with_radial)
{
  with_radial_weights = with_radial;
  nodes.clear();
  master.clear();
  weight.clear();
  radial_weight.clear();
  start.assign(1, 0);
  n_local = 0;
}

void HangingNodes::add(const unsigned int node, const std::vector<Master> &masters)
{
  nodes.push_back(node);
  for (const Master &m : masters)
    {
      master.push_back(m.node);
      weight.push_back(m.weight);
      if (with_radial_weights)
        radial_weight.push_back(m.radial_weight);
    }
  start.push_back(static_cast<unsigned int>(master.size()));
}

std::vector<HangingNodes::Master> HangingNodes::masters(const unsigned int line) const
{
  std::vector<Master> result;
  for (unsigned int k = start[line]; k < start[line + 1]; ++k)
    result.push_back({master[k], weight[k], first_weights()[k]});
  return result;
}

bool HangingNodes::depends_on_ghosts(const unsigned int node) const
{
  // lines are added in ascending order within the local and the ghost-dependent part
  return std::binary_search(nodes.begin() + n_local, nodes.end(), node);
}

template <int dim>
Discretization<dim>::Discretization(Triangulation &triangulation, const unsigned int degree, const Symmetry symmetry)
  : communicator(triangulation.get_communicator())
  , triangulation(triangulation)
  , symmetry(symmetry)
  , fe(QGaussLobatto<1>(degree + 1))
  , dofs(triangulation)
  , lexicographic(FETools::lexicographic_to_hierarchic_numbering<dim>(degree))
{}

namespace
{
/// The owned range of nodes blown up to `dim` entries per node.
IndexSet with_components(const IndexSet &nodes, const unsigned int n_components)
{
  IndexSet result(nodes.size() * n_components);
  for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals(); ++interval)
    result.add_range(*interval->begin() * n_components, (interval->last() + 1) * n_components);
  result.compress();
  return result;
}

/// Whether nodes on the axis of a body of revolution follow their lines, see add_axis_lines().
template <int dim>
bool has_axis_lines(const Symmetry symmetry, const unsigned int degree)
{
  return dim == 2 && symmetry == Symmetry::axisymmetric && degree > 1;
}
} // namespace

/// List the owned cells along the curve through the trees of cells, and number owned nodes as these cells meet them. deal.II's own order
/// depends on how the mesh came about: sums over nodes and cells of a run that begins anew from a checkpoint would differ in round-off.
template <int dim>
void Discretization<dim>::number_by_cells()
{
  std::vector<std::pair<CellId, CellIterator>> by_id;
  for (const auto &cell : dofs.active_cell_iterators())
    if (cell->is_locally_owned())
      by_id.emplace_back(cell->id(), cell);
  std::sort(by_id.begin(), by_id.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  cell_list.clear();
  for (const auto &entry : by_id)
    cell_list.push_back(entry.second);

  const IndexSet               &owned = dofs.locally_owned_dofs();
  const types::global_dof_index none = numbers::invalid_dof_index, first = owned.n_elements() > 0 ? *owned.begin() : 0;
  std::vector<types::global_dof_index> number(owned.n_elements(), none), indices(nodes_per_cell());
  types::global_dof_index              next = first;
  for (const auto &cell : cell_list)
    {
      cell->get_dof_indices(indices);
      for (const auto index : indices)
        if (index >= first && index - first < number.size() && number[index - first] == none)
          number[index - first] = next++;
    }
  dofs.renumber_dofs(number);
}

template <int dim>
void Discretization<dim>::distribute_nodes()
{
  dofs.distribute_dofs(fe);
  number_by_cells();
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dofs, relevant);
  AffineConstraints<double> radial(relevant), constraints(relevant);
  DoFTools::make_hanging_node_constraints(dofs, constraints);
  if (has_axis_lines<dim>(symmetry, degree()))
    DoFTools::make_hanging_node_constraints(dofs, radial);
  add_axis_lines(constraints);
  radial.close();
  constraints.close();

  const unsigned int                   n = nodes_per_cell();
  std::vector<types::global_dof_index> indices(n), needed;
  std::vector<types::global_dof_index> global_table;
  for (const auto &cell : cell_list)
    {
      cell->get_dof_indices(indices);
      for (unsigned int i = 0; i < n; ++i)
        global_table.push_back(indices[lexicographic[i]]);
    }

  // Ghosts: the nodes of owned cells and the masters of those that hang.
  std::vector<types::global_dof_index> used = global_table;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<types::global_dof_index> hanging_lines;
  needed = used;
  for (const auto i : used)
    if (const auto *entries = constraints.get_constraint_entries(i))
      {
        hanging_lines.push_back(i);
        for (const auto &entry : *entries)
          needed.push_back(entry.first);
      }
  std::sort(needed.begin(), needed.end());
  IndexSet ghosts(dofs.n_dofs());
  ghosts.add_indices(needed.begin(), needed.end());
  ghosts.subtract_set(dofs.locally_owned_dofs());

  node_partitioner =
    std::make_shared<const Utilities::MPI::Partitioner>(dofs.locally_owned_dofs(), ghosts, communicator);
  vector_partitioner =
    std::make_shared<const Utilities::MPI::Partitioner>(with_components(dofs.locally_owned_dofs(), dim),
                                                        with_components(ghosts, dim), communicator);

  node_table.resize(global_table.size());
  std::transform(global_table.begin(), global_table.end(), node_table.begin(),
                 [&](const types::global_dof_index i) { return node_partitioner->global_to_local(i); });
  make_hanging_nodes(hanging_lines, constraints, radial);
  positions.reinit(vector_partitioner);
}

/// The lines of the explicit list: nodes that @p constraints knows, and what @p radial says of the first component.
template <int dim>
void Discretization<dim>::make_hanging_nodes(const std::vector<types::global_dof_index> &unsorted_lines,
                                             const AffineConstraints<double>            &constraints,
                                             const AffineConstraints<double>            &radial)
{
  const auto local = [&](const types::global_dof_index i) { return node_partitioner->global_to_local(i); };
  auto       lines = unsorted_lines;
  std::sort(lines.begin(), lines.end(), [&](const auto a, const auto b) { return local(a) < local(b); });
  const bool has_axis = has_axis_lines<dim>(symmetry, degree());
  hanging.clear(has_axis);
  std::vector<HangingNodes::Master> masters;
  for (const bool with_ghosts : {false, true})
    {
      for (const auto i : lines)
        {
          masters.clear();
          // a ghost that hangs is overwritten by the exchange, so it counts as dependent whatever its masters are
          bool has_ghost = local(i) >= n_owned_nodes();
          for (const auto &[master, weight] : *constraints.get_constraint_entries(i))
            {
              double radial_weight = weight;
              if (has_axis) // masters of the radial component are some of these, and the axis, where it vanishes
                {
                  radial_weight = 0.;
                  if (const auto *entries = radial.get_constraint_entries(i))
                    for (const auto &entry : *entries)
                      if (entry.first == master)
                        radial_weight = entry.second;
                }
              masters.push_back({local(master), weight, radial_weight});
              has_ghost = has_ghost || masters.back().node >= n_owned_nodes();
            }
          if (has_ghost == with_ghosts)
            hanging.add(local(i), masters);
        }
      if (!with_ghosts)
        hanging.n_local = hanging.size();
    }
}

/// For degree p >= 2 in a body of revolution: the lines of nodes that begin on the axis. Of the cells that share such a line the
/// coarsest counts: its nodes do not hang there.
template <int dim>
void Discretization<dim>::add_axis_lines(AffineConstraints<double> &constraints) const
{
  if constexpr (dim == 2)
    if (has_axis_lines<dim>(symmetry, degree()))
      {
        const std::vector<double>            weights = even_line_weights(degree());
        const unsigned int                   N       = degree() + 1;
        std::vector<types::global_dof_index> indices(nodes_per_cell());
        for (unsigned int level = 0; level < triangulation.n_global_levels(); ++level)
          for (const auto &cell : dofs.active_cell_iterators())
            if (static_cast<unsigned int>(cell->level()) == level && !cell->is_artificial())
              for (unsigned int f = 0; f < 4; ++f)
                {
                  const auto  &face = cell->face(f);
                  const double tiny =
                    1e-6 * face->diameter(); // blended meshes place vertices to 1e-9 of a coarse cell only
                  if (!face->at_boundary() || std::abs(face->vertex(0)[0]) > tiny ||
                      std::abs(face->vertex(1)[0]) > tiny)
                    continue;
                  cell->get_dof_indices(indices);
                  const int along = f / 2 == 0 ? N : 1, across = (f / 2 == 0 ? 1 : N) * (f % 2 == 0 ? 1 : -1);
                  const int corner = f % 2 == 0 ? 0 : (N - 1) * (f / 2 == 0 ? 1 : N);
                  for (unsigned int j = 0; j < N; ++j)
                    {
                      const int  node  = corner + j * along;
                      const auto index = indices[lexicographic[node]];
                      if (constraints.is_constrained(index))
                        continue;
                      constraints.add_line(index);
                      for (unsigned int m = 1; m < N; ++m)
                        constraints.add_entry(index, indices[lexicographic[node + int(m) * across]], weights[m]);
                    }
                }
      }
  (void)constraints;
}

template <int dim>
void Discretization<dim>::complete_positions()
{
  if (n_hoop_directions(symmetry) > 0)
    {
      double largest = 0.;
      for (unsigned int node = 0; node < n_owned_nodes(); ++node)
        largest = std::max(largest, std::abs(positions.local_element(dim * node)));
      largest = Utilities::MPI::max(largest, communicator);
      for (unsigned int node = 0; node < n_owned_nodes(); ++node)
        if (double &r = positions.local_element(dim * node); std::abs(r) < 1e-8 * largest)
          r = 0.;
    }
  make_consistent(*this, positions);
}

template <int dim>
void Discretization<dim>::positions_from_manifolds()
{
  // one evaluation per cell: every call for a single point would place all nodes of the cell anew
  std::vector<Point<dim>> unit(nodes_per_cell());
  for (unsigned int i = 0; i < unit.size(); ++i)
    unit[i] = fe.unit_support_point(lexicographic[i]);
  const MappingQ<dim> mapping(degree());
  FEValues<dim>       values(mapping, fe, Quadrature<dim>(unit), update_quadrature_points);
  positions = 0.;
  for (unsigned int cell = 0; cell < cell_list.size(); ++cell)
    {
      values.reinit(cell_list[cell]);
      for (unsigned int i = 0; i < unit.size(); ++i)
        if (const unsigned int node = cell_nodes(cell)[i]; node < n_owned_nodes())
          for (unsigned int c = 0; c < dim; ++c)
            positions.local_element(dim * node + c) = values.quadrature_point(i)[c];
    }
  complete_positions();
}

template <int dim>
void Discretization<dim>::transform(const std::function<Point<dim>(const Point<dim> &)> &map)
{
  for (unsigned int node = 0; node < n_owned_nodes(); ++node)
    {
      const Point<dim> x = map(position(node));
      for (unsigned int c = 0; c < dim; ++c)
        positions.local_element(dim * node + c) = x[c];
    }
  complete_positions();
}

template <int dim>
Point<dim> Discretization<dim>::position(const unsigned int node) const
{
  Point<dim> x;
  for (unsigned int c = 0; c < dim; ++c)
    x[c] = positions.local_element(dim * node + c);
  return x;
}

template <int dim>
void Discretization<dim>::cell_positions(const unsigned int cell, std::vector<Point<dim>> &x) const
{
  x.resize(nodes_per_cell());
  for (unsigned int i = 0; i < x.size(); ++i)
    x[i] = position(cell_nodes(cell)[i]);
}

template <int dim>
void make_consistent(const Discretization<dim> &discretization, VectorType &vector)
{
  vector.zero_out_ghost_values();
  vector.update_ghost_values();
  const bool scalar = vector.get_partitioner().get() == discretization.node_partitioner.get();
  if (scalar)
    discretization.hanging.template interpolate<1>(vector.begin());
  else
    discretization.hanging.template interpolate<dim>(vector.begin());
}

template <int dim>
void zero_at_hanging_nodes(const Discretization<dim> &discretization, VectorType &vector)
{
  const unsigned int n_components = vector.get_partitioner().get() == discretization.node_partitioner.get() ? 1 : dim;
  for (const unsigned int node : discretization.hanging.list())
    if (node < discretization.n_owned_nodes())
      for (unsigned int c = 0; c < n_components; ++c)
        vector.local_element(n_components * node + c) = 0.;
}

#define ARENITE_INSTANTIATE(dim)                                            \
  template class Discretization<dim>;                                       \
  template void make_consistent(const Discretization<dim> &, VectorType &); \
  template void zero_at_hanging_nodes(const Discretization<dim> &, VectorType &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
