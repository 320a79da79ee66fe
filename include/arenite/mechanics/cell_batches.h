#pragma once

#include <arenite/base/number.h>
#include <arenite/mechanics/discretization.h>
#include <arenite/mechanics/internal_force.h>

#include <deal.II/base/aligned_vector.h>

#include <array>

namespace Arenite
{
/// Owned cells of one block side by side, W at a time, ordered by part. The last batch of a part repeats its last cell in the
/// lanes that are left over; such lanes compute but never scatter.
template <int dim, int W>
struct CellBatches
{
  dealii::AlignedVector<unsigned int> entries; ///< [batch][node][lane]: first vector entry of the node
  std::vector<unsigned int>           cells; ///< [batch][lane]: index into Discretization::cells(), invalid when unused
  std::vector<unsigned char>          active; ///< lanes in use per batch
  std::array<unsigned int, 4>         part_begin{};
  unsigned int                        n_nodes = 0;

  unsigned int size() const { return part_begin[3]; }

  /// Of all blocks on this process.
  unsigned int n_cells() const { return static_cast<unsigned int>(place_of_cell.size()); }

  /// batch W + lane of a cell, invalid if it is of another block.
  unsigned int place(const unsigned int cell) const { return place_of_cell[cell]; }

  void reinit(const Discretization<dim> &discretization, const dealii::types::material_id block)
  {
    n_nodes = discretization.nodes_per_cell();
    entries.clear();
    cells.clear();
    active.clear();
    std::vector<unsigned int> lists[2];
    for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
      if (block == dealii::numbers::invalid_material_id || discretization.cells()[cell]->material_id() == block)
        lists[needs_ghosts(discretization, cell) ? 0 : 1].push_back(cell);
    part_begin[0] = 0;
    append(discretization, lists[0].begin(), lists[0].end());
    part_begin[1]   = active.size();
    const auto half = lists[1].begin() + ((lists[1].size() / 2 + W - 1) / W * W > lists[1].size()
                                            ? lists[1].size()
                                            : (lists[1].size() / 2 + W - 1) / W * W);
    append(discretization, lists[1].begin(), half);
    part_begin[2] = active.size();
    append(discretization, half, lists[1].end());
    part_begin[3] = active.size();
    place_of_cell.assign(discretization.cells().size(), dealii::numbers::invalid_unsigned_int);
    for (unsigned int place = 0; place < cells.size(); ++place)
      if (cells[place] != dealii::numbers::invalid_unsigned_int)
        place_of_cell[cells[place]] = place;
  }

private:
  std::vector<unsigned int> place_of_cell;

  /// A node of the cell is owned elsewhere, or hangs on one that is.
  static bool needs_ghosts(const Discretization<dim> &discretization, const unsigned int cell)
  {
    const unsigned int *nodes = discretization.cell_nodes(cell);
    for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
      if (nodes[i] >= discretization.n_owned_nodes() || discretization.hanging.depends_on_ghosts(nodes[i]))
        return true;
    return false;
  }

  template <typename Iterator>
  void append(const Discretization<dim> &discretization, Iterator begin, const Iterator end)
  {
    for (; begin < end; begin += std::min<std::ptrdiff_t>(W, end - begin))
      {
        const unsigned int n = std::min<std::ptrdiff_t>(W, end - begin);
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int l = 0; l < W; ++l)
            entries.push_back(dim * discretization.cell_nodes(*(begin + std::min(l, n - 1)))[i]);
        for (unsigned int l = 0; l < W; ++l)
          cells.push_back(l < n ? *(begin + l) : dealii::numbers::invalid_unsigned_int);
        active.push_back(n);
      }
  }
};

/// Nodal values of W cells: values[c][node] holds component c, one cell per lane.
template <int dim, int W, int n_nodes>
ARENITE_INLINE void gather(const double *vector, const unsigned int *entries, Lanes<W> (&values)[dim][n_nodes])
{
  for (int n = 0; n < n_nodes; ++n)
    for (int c = 0; c < dim; ++c)
      if constexpr (W == 1)
        values[c][n] = vector[entries[n] + c];
      else
        values[c][n] = Lanes<W>([&](auto l) { return vector[entries[n * W + l] + c]; });
}

/// vector += values, lane after lane because lanes may share a node.
template <int dim, int W, int n_nodes>
ARENITE_INLINE void scatter_add(double *vector, const unsigned int *entries, const Lanes<W> (&values)[dim][n_nodes],
                                const int active)
{
  for (int n = 0; n < n_nodes; ++n)
    for (int l = 0; l < active; ++l)
      for (int c = 0; c < dim; ++c)
        vector[entries[n * W + l] + c] += lane(values[c][n], l);
}
} // namespace Arenite
