#include <arenite/adaptivity/cell_transport.h>
#include <arenite/adaptivity/mesh_flags.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <limits>

namespace Arenite
{
using namespace dealii;

template <int dim>
std::vector<unsigned int> layers_from(ParallelTriangulation<dim> &triangulation, const std::vector<bool> &region,
                                      const unsigned int finest, const unsigned int most)
{
  // shortest ways from vertex to vertex, through cells that count as many layers as fine ones would stand in their place
  using Cell         = typename dealii::Triangulation<dim>::active_cell_iterator;
  const auto to_cell = [](const std::vector<unsigned int> &of_vertex, const Cell &cell) {
    unsigned int least = std::numeric_limits<unsigned int>::max();
    for (const unsigned int v : cell->vertex_indices())
      least = std::min(least, of_vertex[cell->vertex_index(v)]);
    return least;
  };
  std::vector<unsigned int> of_vertex(triangulation.n_vertices(), most);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && region[cell->active_cell_index()])
      for (const unsigned int v : cell->vertex_indices())
        of_vertex[cell->vertex_index(v)] = 0;
  unsigned int changes = 1;
  while (changes > 0)
    {
      changes           = 0;
      const auto extend = [&](const Cell &cell, const unsigned int to_this) {
        const unsigned int level = cell->level(), through = to_this + (1u << (finest > level ? finest - level : 0));
        for (const unsigned int v : cell->vertex_indices())
          if (unsigned int &known = of_vertex[cell->vertex_index(v)]; known > through)
            {
              known = through;
              ++changes;
            }
      };
      if constexpr (dim == 1)
        Utilities::MPI::min(of_vertex, triangulation.get_communicator(), of_vertex);
      else
        GridTools::exchange_cell_data_to_ghosts<std::vector<unsigned int>, dealii::Triangulation<dim>>(
          triangulation,
          [&](const Cell &cell) {
            std::vector<unsigned int> numbers;
            for (const unsigned int v : cell->vertex_indices())
              numbers.push_back(of_vertex[cell->vertex_index(v)]);
            return numbers;
          },
          [&](const Cell &cell, const std::vector<unsigned int> &numbers) {
            for (const unsigned int v : cell->vertex_indices())
              if (unsigned int &known = of_vertex[cell->vertex_index(v)]; known > numbers[v])
                {
                  known = numbers[v];
                  ++changes;
                }
          });
      for (const auto &cell : triangulation.active_cell_iterators())
        if (!cell->is_artificial())
          if (const unsigned int to_this = to_cell(of_vertex, cell); to_this < most)
            extend(cell, to_this);
      changes = Utilities::MPI::max(changes, triangulation.get_communicator());
    }
  std::vector<unsigned int> result(region.size(), most);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      result[cell->active_cell_index()] = to_cell(of_vertex, cell);
  return result;
}

template <int dim>
void keep_what_is_distorted(const Discretization<dim> &discretization, const VectorType &displacement,
                            std::vector<bool> &quiet)
{
  constexpr double                tolerance = 0.03; // of the shortest edge
  constexpr unsigned int          n = GeometryInfo<dim>::vertices_per_cell, N = 3;
  const std::vector<unsigned int> index = index_of_active_cells(discretization);
  const unsigned int              p     = discretization.degree();
  for (const auto &cell : discretization.cells())
    {
      if (cell->level() == 0 || !quiet[cell->active_cell_index()] || cell->parent()->child(0) != cell)
        continue;
      bool is_family = true;
      for (unsigned int child = 0; child < n && is_family; ++child)
        is_family = cell->parent()->child(child)->is_active() && cell->parent()->child(child)->is_locally_owned();
      if (!is_family)
        continue;
      // displacements and places of the 3^dim corners of the children
      std::vector<Tensor<1, dim>> u(Utilities::pow(N, dim)), x(u.size());
      for (unsigned int child = 0; child < n; ++child)
        {
          const unsigned int *nodes =
            discretization.cell_nodes(index[cell->parent()->child(child)->active_cell_index()]);
          for (unsigned int v = 0; v < n; ++v)
            {
              unsigned int corner = 0, of_family = 0;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  corner += (v >> d & 1) * p * Utilities::pow(p + 1, d);
                  of_family += ((child >> d & 1) + (v >> d & 1)) * Utilities::pow(N, d);
                }
              for (unsigned int c = 0; c < dim; ++c)
                u[of_family][c] = displacement.local_element(dim * nodes[corner] + c);
              x[of_family] = discretization.position(nodes[corner]) + u[of_family];
            }
        }
      double moves = 0., edge = std::numeric_limits<double>::max();
      for (unsigned int i = 0; i < u.size(); ++i)
        {
          Tensor<1, dim> linear;
          for (unsigned int v = 0; v < n; ++v)
            {
              double       weight    = 1.;
              unsigned int of_family = 0;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const unsigned int place = i / Utilities::pow(N, d) % N;
                  weight *= 0.5 * ((v >> d & 1) ? place : 2 - place);
                  of_family += (v >> d & 1) * 2 * Utilities::pow(N, d);
                }
              linear += weight * u[of_family];
            }
          moves = std::max(moves, (u[i] - linear).norm());
          for (unsigned int d = 0; d < dim; ++d)
            if (i / Utilities::pow(N, d) % N + 1 < N)
              edge = std::min(edge, (x[i + Utilities::pow(N, d)] - x[i]).norm());
        }
      if (moves > tolerance * edge)
        for (unsigned int child = 0; child < n; ++child)
          quiet[cell->parent()->child(child)->active_cell_index()] = false;
    }
}

namespace
{
/// Other processes' cells beside own ones get their flags; in one dimension, where every process changes the whole mesh, all do.
template <int dim>
void share_flags(ParallelTriangulation<dim> &triangulation)
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

/// Cells that touch finer ones, or will, stay as they are. Otherwise it would be deal.II that keeps them because of the rule of one hanging node
/// per edge, which it cannot judge where the neighbours' families belong to other processes: the mesh would depend on the partition.
template <int dim>
void keep_beside_finer(ParallelTriangulation<dim> &triangulation)
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

} // namespace

template <int dim>
void set_flags(ParallelTriangulation<dim> &triangulation, const std::vector<unsigned int> &wanted,
               const std::vector<bool> &quiet)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const unsigned int level = cell->level(), wish = wanted[cell->active_cell_index()];
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (level < wish)
          cell->set_refine_flag();
        else if (quiet[cell->active_cell_index()] && level > wish)
          cell->set_coarsen_flag();
      }
  keep_beside_finer(triangulation);
  share_flags(triangulation);
  triangulation.prepare_coarsening_and_refinement();
}

#define ARENITE_INSTANTIATE(dim)                                                                              \
  template std::vector<unsigned int> layers_from(ParallelTriangulation<dim> &, const std::vector<bool> &,     \
                                                 unsigned int, unsigned int);                                 \
  template void keep_what_is_distorted(const Discretization<dim> &, const VectorType &, std::vector<bool> &); \
  template void set_flags(ParallelTriangulation<dim> &, const std::vector<unsigned int> &, const std::vector<bool> &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
