#include <arenite/adaptivity/cell_transport.h>

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
  const char *const first = reinterpret_cast<const char *>(numbers.data());
  return std::vector<char>(first, first + numbers.size() * sizeof(double));
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
CellTransport<dim>::CellTransport(ParallelTriangulation<dim> &triangulation, const Discretization<dim> &discretization)
  : triangulation(triangulation)
  , discretization(discretization)
{}

template <int dim>
unsigned int CellTransport<dim>::add(Pack pack, Join join)
{
  cargoes.push_back({std::move(pack), std::move(join)});
  return static_cast<unsigned int>(cargoes.size() - 1);
}

template <int dim>
void CellTransport<dim>::pack(const Cell &cell, const bool halved, Numbers &parcel) const
{
  parcel.assign(cargoes.size(), 0.);
  for (std::size_t i = 0; i < cargoes.size(); ++i)
    {
      const std::size_t before = parcel.size();
      cargoes[i].pack(cell, halved, parcel);
      parcel[i] = double(parcel.size() - before);
    }
}

template <int dim>
void CellTransport<dim>::join(const std::vector<Numbers> &children, Numbers &parcel) const
{
  parcel.assign(cargoes.size(), 0.);
  std::vector<std::size_t> first(children.size(), cargoes.size());
  std::vector<Numbers>     of_cargo(children.size());
  for (std::size_t i = 0; i < cargoes.size(); ++i)
    {
      for (std::size_t child = 0; child < children.size(); ++child)
        {
          const auto from = children[child].begin() + first[child];
          of_cargo[child].assign(from, from + static_cast<std::size_t>(children[child][i]));
          first[child] += of_cargo[child].size();
        }
      const Numbers joined = cargoes[i].join(of_cargo);
      parcel.insert(parcel.end(), joined.begin(), joined.end());
      parcel[i] = double(joined.size());
    }
}

template <int dim>
void CellTransport<dim>::send()
{
  if constexpr (dim == 1)
    gather();
  else
    handle = triangulation.register_data_attach(
      [this](const Cell &cell, const typename ParallelTriangulation<dim>::CellStatus status) {
        Numbers parcel;
        if (status != ParallelTriangulation<dim>::CELL_COARSEN)
          pack(cell, status == ParallelTriangulation<dim>::CELL_REFINE, parcel);
        else
          {
            std::vector<Numbers> children(cell->n_children());
            for (unsigned int child = 0; child < cell->n_children(); ++child)
              pack(cell->child(child), false, children[child]);
            join(children, parcel);
          }
        return to_bytes(parcel);
      },
      true);
}

/// Parcels of all cells on all processes, which know the cells alike.
template <int dim>
void CellTransport<dim>::gather()
{
  const MPI_Comm            communicator = discretization.communicator;
  std::vector<Numbers>      own(triangulation.n_active_cells());
  std::vector<unsigned int> first(own.size() + 1, 0);
  for (const auto &cell : discretization.cells())
    {
      const unsigned int index = cell->active_cell_index();
      pack(cell, true, own[index]);
      first[index + 1] = static_cast<unsigned int>(own[index].size());
    }
  Utilities::MPI::sum(first, communicator, first);
  std::partial_sum(first.begin(), first.end(), first.begin());
  Numbers all(first.back(), 0.);
  for (std::size_t i = 0; i < own.size(); ++i)
    std::copy(own[i].begin(), own[i].end(), all.begin() + first[i]);
  Utilities::MPI::sum(all, communicator, all);
  for (const auto &cell : triangulation.active_cell_iterators())
    by_id[cell->id()].assign(all.begin() + first[cell->active_cell_index()],
                             all.begin() + first[cell->active_cell_index() + 1]);
}

template <int dim>
void CellTransport<dim>::receive()
{
  if constexpr (dim == 1)
    receive_by_id();
  else
    {
      using Status = typename ParallelTriangulation<dim>::CellStatus;
      Numbers parcel;
      triangulation.notify_ready_to_unpack(handle, [&](const Cell &cell, const Status status, const Bytes &bytes) {
        parcel.resize(bytes.size() / sizeof(double));
        std::memcpy(parcel.data(), &*bytes.begin(), bytes.size());
        arrive(cell,
               status == ParallelTriangulation<dim>::CELL_REFINE    ? Change::halved
               : status == ParallelTriangulation<dim>::CELL_COARSEN ? Change::joined
                                                                    : Change::none,
               parcel.data(), parcel.size());
      });
    }
}

template <int dim>
void CellTransport<dim>::arrive(const Cell &cell, const Change change, const double *parcel, const std::size_t size)
{
  if (arrivals.empty())
    numbers.reserve(size * discretization.cells().size()); // or more where cells were halved
  arrivals.push_back({cell, change, numbers.size()});
  numbers.insert(numbers.end(), parcel, parcel + size);
}

/// Each owned cell looks for its own parcel, its parent's or its children's.
template <int dim>
void CellTransport<dim>::receive_by_id()
{
  const auto take = [this](const Cell &cell, const Numbers &parcel, const Change change) {
    arrive(cell, change, parcel.data(), parcel.size());
  };
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
        Numbers parcel;
        join(children, parcel);
        take(cell, parcel, Change::joined);
      }
  by_id.clear();
}

template <int dim>
void CellTransport<dim>::unpack(const unsigned int cargo, const Take &take) const
{
  Numbers of_cargo;
  for (const Arrival &arrival : arrivals)
    {
      const auto sizes = numbers.begin() + arrival.first;
      const auto first = sizes + cargoes.size() + static_cast<std::size_t>(std::accumulate(sizes, sizes + cargo, 0.));
      of_cargo.assign(first, first + static_cast<std::size_t>(sizes[cargo]));
      take(arrival.cell, of_cargo, arrival.change);
    }
}

template class CellTransport<1>;
template class CellTransport<2>;
template class CellTransport<3>;
} // namespace Arenite
