#include <arenite/adaptivity/momentum_transfer.h>

namespace Arenite
{
using namespace dealii;

template <int dim>
MomentumTransfer<dim>::MomentumTransfer(CellTransport<dim> &transport, const Dynamics<dim> &dynamics,
                                        const VectorType &velocity)
  : transport(transport)
  , dynamics(dynamics)
  , old(dynamics.discretization.triangulation.n_active_cells())
{
  const auto &cells = dynamics.discretization.cells();
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    old[cells[cell]->active_cell_index()] = momentum(cell, velocity);
  cargo = transport.add(
    [this](const Cell &cell, bool, Numbers &numbers) {
      const Tensor &p = old[cell->active_cell_index()];
      numbers.insert(numbers.end(), p.begin_raw(), p.end_raw());
    },
    [](const std::vector<Numbers> &children) {
      Numbers sum = children[0];
      for (std::size_t child = 1; child < children.size(); ++child)
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += children[child][c];
      return sum;
    });
}

template <int dim>
const std::vector<double> &MomentumTransfer<dim>::mass_of(const unsigned int cell)
{
  dynamics.blocks[block_of(dynamics, cell)]->cell_mass(cell, mass);
  return mass;
}

template <int dim>
dealii::Tensor<1, dim> MomentumTransfer<dim>::momentum(const unsigned int cell, const VectorType &velocity)
{
  const unsigned int *nodes = dynamics.discretization.cell_nodes(cell);
  Tensor              sum;
  const auto         &m = mass_of(cell);
  for (unsigned int i = 0; i < m.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      sum[c] += m[i] * velocity.local_element(dim * nodes[i] + c);
  return sum;
}

template <int dim>
void MomentumTransfer<dim>::restore(const State<dim> &state, VectorType &velocity)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  // the part of each component that is free
  VectorType free = discretization.new_vector();
  for (unsigned int c = 0; c < dim; ++c)
    {
      VectorType unit = discretization.new_vector();
      for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
        unit.local_element(dim * node + c) = 1.;
      dynamics.constraints.project(unit);
      for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
        free.local_element(dim * node + c) = unit.local_element(dim * node + c);
    }
  make_consistent(discretization, free);

  VectorType impulse = discretization.new_vector();
  const auto spread  = [&](const std::vector<unsigned int> &cells, const Numbers &before) {
    Tensor missing, total;
    for (unsigned int c = 0; c < dim; ++c)
      missing[c] = before[c];
    for (const unsigned int cell : cells)
      {
        missing -= momentum(cell, velocity);
        total += momentum(cell, free);
      }
    for (const unsigned int cell : cells)
      {
        const unsigned int *nodes = discretization.cell_nodes(cell);
        const auto         &m     = mass_of(cell);
        for (unsigned int i = 0; i < m.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            if (total[c] > 0.)
              impulse.local_element(dim * nodes[i] + c) +=
                missing[c] * m[i] * free.local_element(dim * nodes[i] + c) / total[c];
      }
  };
  const std::vector<unsigned int> index = index_of_active_cells(discretization);
  transport.unpack(cargo, [&](const Cell &cell, const Numbers &before,
                              const typename CellTransport<dim>::Change change) {
    std::vector<unsigned int> cells;
    if (change != CellTransport<dim>::Change::halved)
      cells = {index[cell->active_cell_index()]};
    else if (dim > 1) // on a line no node hangs, nothing is missing, and children may have different owners
      for (unsigned int child = 0; child < cell->n_children(); ++child)
        cells.push_back(index[cell->child(child)->active_cell_index()]);
    spread(cells, before);
  });
  discretization.hanging.template condense<dim>(impulse.begin());
  impulse.compress(VectorOperation::add);
  discretization.hanging.template condense<dim>(impulse.begin());
  for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
    velocity.local_element(i) += state.inverse_mass.local_element(i) * impulse.local_element(i);
  dynamics.constraints.project(velocity);
  make_consistent(discretization, velocity);
}

template class MomentumTransfer<1>;
template class MomentumTransfer<2>;
template class MomentumTransfer<3>;
} // namespace Arenite
