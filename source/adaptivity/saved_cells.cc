#include <arenite/adaptivity/cell_transport.h>
#include <arenite/adaptivity/saved_cells.h>
#include <arenite/base/errors.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <fstream>
#include <list>
#include <map>
#include <set>

namespace Arenite
{
using namespace dealii;

namespace
{
CheckpointError unusable(const std::string &file)
{
  return CheckpointError(file + ": the cells in it are not those of this scene.");
}

/// A nodal field with its entries per node.
struct Field
{
  VectorType  *vector;
  unsigned int n_components;
};

/// Numbers of one cell, one after the other, on their way out or in.
template <int dim>
class CellNumbers
{
public:
  CellNumbers(const Discretization<dim> &discretization, const unsigned int cell)
    : nodes(discretization.cell_nodes(cell))
    , n_nodes(discretization.nodes_per_cell())
    , n_owned(discretization.n_owned_nodes())
  {}

  void append(const Field &field, std::vector<double> &numbers) const
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int c = 0; c < field.n_components; ++c)
        numbers.push_back(field.vector->local_element(field.n_components * nodes[i] + c));
  }

  /// The owned ones among the nodes.
  const double *take(const Field &field, const double *number) const
  {
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int c = 0; c < field.n_components; ++c, ++number)
        if (nodes[i] < n_owned)
          field.vector->local_element(field.n_components * nodes[i] + c) = *number;
    return number;
  }

private:
  const unsigned int *nodes;
  const unsigned int  n_nodes, n_owned;
};

/// Numbers of a cell but for its positions, which are read before there is a Dynamics.
template <int dim>
std::size_t n_numbers(const Discretization<dim> &discretization, const std::vector<Field> &fields,
                      const std::size_t n_of_cell, const CellRecord &record)
{
  std::size_t n = n_of_cell + record.size(dim);
  for (const Field &field : fields)
    n += field.n_components * discretization.nodes_per_cell();
  return n;
}
} // namespace

template <int dim>
std::function<void(std::ostream &)> SavedCells<dim>::writer(const Dynamics<dim> &dynamics, const State<dim> &state,
                                                            const std::vector<const Vector<double> *> &of_cells)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  // copies whose ghosts are valid
  const auto         copies = std::make_shared<std::list<VectorType>>();
  std::vector<Field> fields;
  const auto         add = [&](const VectorType &vector, const unsigned int n_components, const bool has_ghosts) {
    copies->emplace_back();
    copy_with_ghosts(vector, copies->back());
    if (!has_ghosts)
      {
        copies->back().zero_out_ghost_values();
        copies->back().update_ghost_values();
      }
    fields.push_back({&copies->back(), n_components});
  };
  add(discretization.positions, dim, true);
  add(state.displacement, dim, false);
  add(state.half_velocity, dim, false);
  if (dynamics.stores_points())
    add(state.last_displacement, dim, true);
  for (const auto &load : dynamics.loads)
    for (const VectorType *scalar : load->nodal_states())
      add(*scalar, 1, false);

  return [copies, fields, of_cells, &dynamics, &state](std::ostream &stream) {
    const auto                      &cells = dynamics.discretization.cells();
    std::vector<CellId::binary_type> own_ids;
    for (const auto &cell : cells)
      own_ids.push_back(cell->id().template to_binary<dim>());
    boost::archive::binary_oarchive archive(stream);
    archive << own_ids;
    std::vector<unsigned int> record_size;
    for (const auto &block : dynamics.blocks)
      record_size.push_back(block->cell_record().size(dim));
    Numbers record, numbers;
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      {
        numbers.clear();
        const CellNumbers<dim> of_nodes(dynamics.discretization, cell);
        for (const Field &field : fields)
          of_nodes.append(field, numbers);
        for (const Vector<double> *of_cell : of_cells)
          numbers.push_back(of_cell->size() > 0 ? (*of_cell)[cells[cell]->active_cell_index()] : 0.);
        const unsigned int b = block_of(dynamics, cell);
        record.resize(record_size[b]);
        if (!record.empty())
          dynamics.blocks[b]->pack(state.blocks[b], cell, record.data());
        numbers.insert(numbers.end(), record.begin(), record.end());
        archive << numbers;
      }
  };
}

template <int dim>
SavedCells<dim>::SavedCells(const std::vector<std::string> &files, const MPI_Comm communicator)
  : files(files)
{
  // few processes may read many files; each needs all ids, because cells move while the mesh is made
  const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator),
                     n_ranks = Utilities::MPI::n_mpi_processes(communicator);
  std::vector<std::vector<CellId::binary_type>> own;
  for (std::size_t i = rank; i < files.size(); i += n_ranks)
    {
      std::ifstream                   stream(files[i], std::ios::binary);
      boost::archive::binary_iarchive archive(stream);
      own.emplace_back();
      archive >> own.back();
    }
  const auto all = Utilities::MPI::all_gather(communicator, own);
  for (std::size_t i = 0; i < files.size(); ++i)
    ids.push_back(all[i % n_ranks][i / n_ranks]);
}

template <int dim>
void SavedCells<dim>::make_mesh(ParallelTriangulation<dim> &triangulation) const
{
  std::set<CellId> divided;
  std::size_t      n_cells = 0;
  for (const auto &of_file : ids)
    for (const auto &binary : of_file)
      {
        const CellId              id(binary);
        const auto                way = id.get_child_indices();
        std::vector<std::uint8_t> path(way.begin(), way.end());
        while (!path.empty())
          {
            path.pop_back();
            if (!divided.insert(CellId(id.get_coarse_cell_id(), path)).second)
              break; // and so were those above
          }
        ++n_cells;
      }
  for (bool changes = true; changes;)
    {
      unsigned int flags = 0;
      for (const auto &cell : triangulation.active_cell_iterators())
        if ((dim == 1 || cell->is_locally_owned()) && divided.count(cell->id()) > 0)
          {
            cell->set_refine_flag();
            ++flags;
          }
      changes = Utilities::MPI::max(flags, triangulation.get_communicator()) > 0;
      if (changes)
        triangulation.execute_coarsening_and_refinement();
    }
  if (triangulation.n_global_active_cells() != n_cells)
    throw unusable(files.front());
}

template <int dim>
void SavedCells<dim>::read(Discretization<dim> &discretization)
{
  std::map<CellId, unsigned int> own;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    own[discretization.cells()[cell]->id()] = cell;
  numbers.assign(own.size(), {});
  for (std::size_t i = 0; i < files.size(); ++i)
    {
      std::size_t last = 0; // own cell, counted from 1
      for (std::size_t k = 0; k < ids[i].size(); ++k)
        if (own.count(CellId(ids[i][k])) > 0)
          last = k + 1;
      if (last == 0)
        continue;
      std::ifstream                    stream(files[i], std::ios::binary);
      boost::archive::binary_iarchive  archive(stream);
      std::vector<CellId::binary_type> skipped;
      Numbers                          of_cell;
      archive >> skipped;
      for (std::size_t k = 0; k < last; ++k)
        {
          archive >> of_cell;
          if (const auto cell = own.find(CellId(ids[i][k])); cell != own.end())
            numbers[cell->second] = of_cell;
        }
    }
  ids.clear();
  const Field positions{&discretization.positions, dim};
  for (unsigned int cell = 0; cell < numbers.size(); ++cell)
    {
      if (numbers[cell].size() < dim * discretization.nodes_per_cell())
        throw unusable(files.front());
      CellNumbers<dim>(discretization, cell).take(positions, numbers[cell].data());
    }
  discretization.complete_positions();
}

template <int dim>
void SavedCells<dim>::set_fields(Dynamics<dim> &dynamics, State<dim> &state,
                                 const std::vector<Vector<double> *> &of_cells)
{
  Discretization<dim> &discretization = dynamics.discretization;
  std::vector<Field>   fields{{&state.displacement, dim}, {&state.half_velocity, dim}};
  if (dynamics.stores_points())
    fields.push_back({&state.last_displacement, dim});
  std::vector<std::vector<VectorType>> states; // of each load
  for (const auto &load : dynamics.loads)
    states.emplace_back(load->nodal_states().size(), discretization.new_scalar());
  for (std::vector<VectorType> &of_load : states)
    for (VectorType &scalar : of_load)
      fields.push_back({&scalar, 1});
  for (Vector<double> *of_cell : of_cells)
    of_cell->reinit(discretization.triangulation.n_active_cells());
  const std::size_t n_positions = dim * discretization.nodes_per_cell();
  for (unsigned int cell = 0; cell < numbers.size(); ++cell)
    {
      const unsigned int b      = block_of(dynamics, cell);
      const CellRecord   record = dynamics.blocks[b]->cell_record();
      if (numbers[cell].size() != n_positions + n_numbers(discretization, fields, of_cells.size(), record))
        throw unusable(files.front());
      const CellNumbers<dim> of_nodes(discretization, cell);
      const double          *number = numbers[cell].data() + n_positions;
      for (const Field &field : fields)
        number = of_nodes.take(field, number);
      for (Vector<double> *of_cell : of_cells)
        (*of_cell)[discretization.cells()[cell]->active_cell_index()] = *number++;
      if (record.size(dim) > 0)
        dynamics.blocks[b]->unpack(state.blocks[b], cell, number);
      numbers[cell] = Numbers();
    }
  if (dynamics.stores_points())
    state.last_displacement.update_ghost_values();
  for (std::size_t l = 0; l < states.size(); ++l)
    if (!states[l].empty())
      dynamics.loads[l]->set_nodal_states(states[l]);
}

template class SavedCells<1>;
template class SavedCells<2>;
template class SavedCells<3>;
} // namespace Arenite
