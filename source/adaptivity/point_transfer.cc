#include <arenite/adaptivity/point_transfer.h>

#include <deal.II/grid/grid_tools.h>

#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
/// A number that changes with the displacement of any node of a cell, and its size.
template <int dim>
std::pair<double, double> fingerprint(const Discretization<dim> &discretization, const VectorType &displacement,
                                      const unsigned int cell)
{
  const unsigned int *nodes = discretization.cell_nodes(cell);
  double              sum = 0., size = 0.;
  for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double u = displacement.local_element(dim * nodes[i] + c);
        sum += (1. + 0.37 * c + 0.11 * i) * u;
        size += (1. + 0.37 * c + 0.11 * i) * std::abs(u);
      }
  return {sum, size};
}
} // namespace

template <int dim>
PointTransfer<dim>::PointTransfer(CellTransport<dim> &transport, ParallelTriangulation<dim> &triangulation,
                                  Dynamics<dim> &dynamics, State<dim> &state)
  : transport(transport)
  , dynamics(dynamics)
{
  if (!dynamics.stores_points())
    return;
  for (const auto &block : dynamics.blocks)
    rules.emplace_back(block->cell_record());
  const auto &cells = dynamics.discretization.cells();
  old.resize(triangulation.n_active_cells());
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      const unsigned int b    = block_of(dynamics, cell);
      OldCell           &here = old[cells[cell]->active_cell_index()];
      here.block              = b;
      here.record.resize(rules[b].layout.size(dim));
      if (here.record.empty())
        continue;
      dynamics.blocks[b]->pack(state.blocks[b], cell, here.record.data());
      here.mean  = rules[b].means(here.record.data());
      here.moved = fingerprint(dynamics.discretization, state.displacement, cell).first;
    }
  for (BlockState &record : state.blocks)
    {
      sums.push_back(std::move(record.points));
      PointData &points = sums.back();
      for (auto *array :
           {&points.stress, &points.history, &points.bulk_viscosity, &points.wave_speed, &points.stored,
            &points.frequency, &points.inverse_step, &points.dissipation, &points.ratio, &points.hourglass})
        *array = AlignedVector<double>();
    }
  share_means(triangulation);
  cargo = transport.add([this](const Cell &cell, const bool halved, Numbers &numbers) { pack(cell, halved, numbers); },
                        [this](const std::vector<Numbers> &children) { return join(children); });
}

/// Block and means of cells that other processes own: of those next to own ones, in one dimension of all.
template <int dim>
void PointTransfer<dim>::share_means(const ParallelTriangulation<dim> &triangulation)
{
  if constexpr (dim == 1)
    {
      std::size_t longest = 0;
      for (const auto &rule : rules)
        longest = std::max<std::size_t>(longest, rule.layout.n_values);
      Numbers all(old.size() * (longest + 1), 0.);
      for (std::size_t cell = 0; cell < old.size(); ++cell)
        if (old[cell].block != numbers::invalid_unsigned_int)
          {
            all[cell * (longest + 1)] = old[cell].block;
            std::copy(old[cell].mean.begin(), old[cell].mean.end(), all.begin() + cell * (longest + 1) + 1);
          }
      Utilities::MPI::sum(all, dynamics.discretization.communicator, all);
      for (std::size_t cell = 0; cell < old.size(); ++cell)
        {
          const auto from          = all.begin() + static_cast<std::ptrdiff_t>(cell * (longest + 1));
          old[cell].block          = static_cast<unsigned int>(*from);
          const CellRecord &layout = rules[old[cell].block].layout;
          old[cell].mean.assign(from + 1, from + 1 + (layout.points.empty() ? 0 : layout.n_values - 1));
        }
    }
  else
    GridTools::exchange_cell_data_to_ghosts<Numbers, dealii::Triangulation<dim>>(
      triangulation,
      [this](const auto &cell) {
        const OldCell &here = old[cell->active_cell_index()];
        Numbers        numbers{double(here.block)};
        numbers.insert(numbers.end(), here.mean.begin(), here.mean.end());
        return numbers;
      },
      [this](const auto &cell, const Numbers &numbers) {
        OldCell &here = old[cell->active_cell_index()];
        here.block    = static_cast<unsigned int>(numbers.front());
        here.mean.assign(numbers.begin() + 1, numbers.end());
      });
}

template <int dim>
typename CellRecords<dim>::Surroundings PointTransfer<dim>::surroundings(const Cell &cell) const
{
  const OldCell &here = old[cell->active_cell_index()];
  Numbers        neighbour[2 * dim];
  double         distance[2 * dim] = {};
  for (unsigned int f = 0; f < 2 * dim; ++f)
    {
      if (cell->at_boundary(f))
        continue;
      std::vector<Cell> others;
      if (cell->neighbor(f)->is_active())
        others = {cell->neighbor(f)};
      else if constexpr (dim == 1)
        {
          others = {cell->neighbor(f)};
          while (others[0]->has_children())
            others[0] = others[0]->child(1 - f);
        }
      else
        for (unsigned int part = 0; part < cell->face(f)->n_children(); ++part)
          others.push_back(cell->neighbor_child_on_subface(f, part));
      distance[f] = 0.5 + 0.5 * std::pow(2., cell->level() - others[0]->level());
      neighbour[f].assign(here.mean.size(), 0.);
      for (const Cell &other : others)
        {
          const OldCell &there = old[other->active_cell_index()];
          if (there.block != here.block)
            {
              neighbour[f].clear();
              break;
            }
          for (std::size_t k = 0; k < here.mean.size(); ++k)
            neighbour[f][k] += there.mean[k] / double(others.size());
        }
    }
  return rules[here.block].look_around(here.mean, neighbour, distance);
}

/// Block and record of a cell; for its children with what they need to know about its surroundings.
template <int dim>
void PointTransfer<dim>::pack(const Cell &cell, const bool halved, Numbers &result) const
{
  const OldCell &here = old[cell->active_cell_index()];
  if (here.record.empty())
    return;
  result.insert(result.end(), {double(here.block), here.moved});
  result.insert(result.end(), here.record.begin(), here.record.end());
  if (halved)
    {
      const auto around = surroundings(cell);
      for (const Numbers *numbers : {&around.slope, &around.lower, &around.upper})
        result.insert(result.end(), numbers->begin(), numbers->end());
    }
}

template <int dim>
std::vector<double> PointTransfer<dim>::join(const std::vector<Numbers> &children) const
{
  if (children[0].empty())
    return {};
  std::vector<const double *> records;
  for (const Numbers &child : children)
    records.push_back(child.data() + 2);
  const auto &rule = rules[static_cast<unsigned int>(children[0][0])];
  Numbers     result(2 + rule.layout.size(dim), children[0][0]);
  rule.coarsen(records, result.data() + 2);
  return result;
}

template <int dim>
void PointTransfer<dim>::put_children(const Cell &parent, const Numbers &packed, const std::vector<unsigned int> &index,
                                      State<dim> &state)
{
  const unsigned int                      b    = static_cast<unsigned int>(packed[0]);
  const CellRecords<dim>                 &rule = rules[b];
  const unsigned int                      size = rule.layout.size(dim), n = rule.layout.n_values - 1;
  typename CellRecords<dim>::Surroundings around;
  const auto                              from = packed.begin() + 2 + size;
  around.slope.assign(from, from + dim * n);
  around.lower.assign(from + dim * n, from + (dim + 1) * n);
  around.upper.assign(from + (dim + 1) * n, from + (dim + 2) * n);
  Numbers record(size);
  for (unsigned int child = 0; child < parent->n_children(); ++child)
    if (parent->child(child)->is_locally_owned())
      {
        rule.refine(packed.data() + 2, around, child, record.data());
        const unsigned int cell = index[parent->child(child)->active_cell_index()];
        dynamics.blocks[b]->unpack(state.blocks[b], cell, record.data());
        changed[b].push_back(cell);
      }
}

template <int dim>
void PointTransfer<dim>::unpack(State<dim> &state)
{
  if (!cargo)
    return;
  const std::vector<unsigned int> index = index_of_active_cells(dynamics.discretization);
  changed.assign(rules.size(), {});
  transport.unpack(*cargo, [&](const Cell &cell, const Numbers &packed,
                               const typename CellTransport<dim>::Change change) {
    if (packed.empty())
      return;
    if (change == CellTransport<dim>::Change::halved)
      return put_children(cell, packed, index, state);
    const unsigned int b = static_cast<unsigned int>(packed[0]), own = index[cell->active_cell_index()];
    dynamics.blocks[b]->unpack(state.blocks[b], own, packed.data() + 2);
    // nodes that hang now where they were free, or the other way round, have moved a little
    const auto [moved, size] = fingerprint(dynamics.discretization, state.displacement, own);
    if (change == CellTransport<dim>::Change::joined || std::abs(moved - packed[1]) > 1e-13 * size)
      changed[b].push_back(own);
  });
  for (unsigned int b = 0; b < rules.size(); ++b)
    {
      PointData &points      = state.blocks[b].points;
      points.hourglass_work  = sums[b].hourglass_work;
      points.dissipated      = sums[b].dissipated;
      points.viscous_work    = sums[b].viscous_work;
      points.volume_change   = sums[b].volume_change;
      points.substeps        = sums[b].substeps;
      points.law_seconds     = sums[b].law_seconds;
      points.scatter_seconds = sums[b].scatter_seconds;
      dynamics.blocks[b]->restore(state, state.blocks[b], changed[b]);
    }
  copy_with_ghosts(state.displacement, state.last_displacement);
}

template class PointTransfer<1>;
template class PointTransfer<2>;
template class PointTransfer<3>;
} // namespace Arenite
