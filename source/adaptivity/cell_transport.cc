#include <arenite/adaptivity/cell_transport.h>
#include <arenite/adaptivity/field_transfer.h>

#include <boost/range/iterator_range.hpp>

#include <cstring>
#include <numeric>

namespace Arenite
{
using namespace dealii;

namespace
{
using Bytes = boost::iterator_range<std::vector<char>::const_iterator>;

std::vector<char> to_bytes(const std::vector<double> &numbers)
{
  std::vector<char> bytes(numbers.size() * sizeof(double));
  if (!numbers.empty())
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::vector<double> to_numbers(const Bytes &bytes)
{
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!numbers.empty())
    std::memcpy(numbers.data(), &*bytes.begin(), bytes.size());
  return numbers;
}

/// A child of a cell that has none.
template <typename Cell>
CellId child_of(const Cell &cell, const unsigned int child)
{
  const CellId              id  = cell->id();
  const auto                way = id.get_child_indices();
  std::vector<std::uint8_t> indices(way.begin(), way.end());
  indices.push_back(static_cast<std::uint8_t>(child));
  return CellId(id.get_coarse_cell_id(), indices);
}
} // namespace

template <int dim>
CellTransport<dim>::CellTransport(ParallelTriangulation<dim> &triangulation, const Discretization<dim> &discretization,
                                  std::function<Numbers(const Cell &, bool)>           pack_,
                                  std::function<Numbers(const std::vector<Numbers> &)> join_, const bool equal_sizes)
  : triangulation(triangulation)
  , discretization(discretization)
  , pack(std::move(pack_))
  , join(std::move(join_))
{
  (void)equal_sizes;
  if constexpr (dim == 1)
    gather();
  else
    handle = triangulation.register_data_attach(
      [this](const Cell &cell, const typename ParallelTriangulation<dim>::CellStatus status) {
        if (status != ParallelTriangulation<dim>::CELL_COARSEN)
          return to_bytes(pack(cell, status == ParallelTriangulation<dim>::CELL_REFINE));
        std::vector<Numbers> children;
        for (unsigned int child = 0; child < cell->n_children(); ++child)
          children.push_back(pack(cell->child(child), false));
        return to_bytes(join(children));
      },
      !equal_sizes);
}

/// Numbers of all cells on all processes, which know the cells alike.
template <int dim>
void CellTransport<dim>::gather()
{
  const MPI_Comm            communicator = discretization.communicator;
  std::vector<Numbers>      own(triangulation.n_active_cells());
  std::vector<unsigned int> first(own.size() + 1, 0);
  for (const auto &cell : discretization.cells())
    {
      const unsigned int index = cell->active_cell_index();
      own[index]               = pack(cell, true);
      first[index + 1]         = static_cast<unsigned int>(own[index].size());
    }
  Utilities::MPI::sum(first, communicator, first);
  std::partial_sum(first.begin(), first.end(), first.begin());
  Vector<double> all(first.back());
  for (std::size_t i = 0; i < own.size(); ++i)
    std::copy(own[i].begin(), own[i].end(), all.begin() + first[i]);
  sum_over_processes(all, communicator);
  for (const auto &cell : triangulation.active_cell_iterators())
    by_id[cell->id()].assign(all.begin() + first[cell->active_cell_index()],
                             all.begin() + first[cell->active_cell_index() + 1]);
}

template <int dim>
void CellTransport<dim>::unpack(const std::function<void(const Cell &, const Numbers &, Change)> &take)
{
  if constexpr (dim == 1)
    unpack_by_id(take);
  else
    triangulation.notify_ready_to_unpack(handle, [&](const Cell                                           &cell,
                                                     const typename ParallelTriangulation<dim>::CellStatus status,
                                                     const Bytes                                          &bytes) {
      take(cell, to_numbers(bytes),
           status == ParallelTriangulation<dim>::CELL_REFINE    ? Change::halved
           : status == ParallelTriangulation<dim>::CELL_COARSEN ? Change::joined
                                                                : Change::none);
    });
}

/// Each owned cell looks for its own numbers, its parent's or its children's.
template <int dim>
void CellTransport<dim>::unpack_by_id(const std::function<void(const Cell &, const Numbers &, Change)> &take) const
{
  for (const auto &cell : discretization.cells())
    if (const auto own = by_id.find(cell->id()); own != by_id.end())
      take(cell, own->second, Change::none);
    else if (const auto parent = cell->level() > 0 ? by_id.find(cell->parent()->id()) : by_id.end();
             parent != by_id.end())
      {
        // once, by the process that owns the first child here
        bool is_first = true;
        for (unsigned int child = 0; is_first && cell->parent()->child(child) != cell; ++child)
          is_first = !cell->parent()->child(child)->is_locally_owned();
        if (is_first)
          take(cell->parent(), parent->second, Change::halved);
      }
    else
      {
        std::vector<Numbers> children;
        for (unsigned int child = 0; child < GeometryInfo<dim>::max_children_per_cell; ++child)
          children.push_back(by_id.at(child_of(cell, child)));
        take(cell, join(children), Change::joined);
      }
}

template class CellTransport<1>;
template class CellTransport<2>;
template class CellTransport<3>;
} // namespace Arenite
