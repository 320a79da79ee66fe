#include <arenite/adaptivity/field_transfer.h>

#include <deal.II/lac/full_matrix.h>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Row @p node of a matrix of the element, between nodes in lexicographic order.
template <int dim>
std::vector<std::pair<unsigned int, double>> row(const FullMatrix<double>  &matrix,
                                                 const Discretization<dim> &discretization, const unsigned int node)
{
  const auto                                  &hierarchic = discretization.lexicographic;
  std::vector<std::pair<unsigned int, double>> result;
  for (unsigned int j = 0; j < discretization.nodes_per_cell(); ++j)
    if (const double weight = matrix(hierarchic[node], hierarchic[j]); weight != 0.)
      result.emplace_back(j, weight);
  return result;
}
} // namespace

template <int dim>
FieldTransfer<dim>::FieldTransfer(CellTransport<dim> &transport, const Discretization<dim> &discretization)
  : transport(transport)
  , discretization(discretization)
  , index(index_of_active_cells(discretization))
  , of_child(GeometryInfo<dim>::max_children_per_cell)
  , of_parent(discretization.nodes_per_cell())
  , child_of_node(discretization.nodes_per_cell())
{
  for (unsigned int child = 0; child < of_child.size(); ++child)
    for (unsigned int node = 0; node < discretization.nodes_per_cell(); ++node)
      {
        of_child[child].push_back(row(discretization.fe.get_prolongation_matrix(child), discretization, node));
        if (const auto weights = row(discretization.fe.get_restriction_matrix(child), discretization, node);
            !weights.empty())
          {
            of_parent[node]     = weights;
            child_of_node[node] = child;
          }
      }
  cargo = transport.add(
    [this](const Cell &cell, bool, Numbers &numbers) {
      const unsigned int *nodes = this->discretization.cell_nodes(index[cell->active_cell_index()]);
      for (const Field &field : fields)
        for (unsigned int i = 0; i < this->discretization.nodes_per_cell(); ++i)
          for (unsigned int c = 0; c < field.n_components; ++c)
            numbers.push_back(field.before->local_element(field.n_components * nodes[i] + c));
    },
    [this](const std::vector<Numbers> &children) {
      return combine(of_parent,
                     [&](const unsigned int node) -> const Numbers & { return children[child_of_node[node]]; });
    });
}

template <int dim>
void FieldTransfer<dim>::add(const VectorType &field)
{
  const bool is_scalar = field.get_partitioner().get() == discretization.node_partitioner.get();
  fields.push_back({&field, is_scalar ? 1u : dim, VectorType()});
}

/// Values of all fields at the nodes of a cell, of which node i follows from those of the cell with the numbers @p of_cell(i).
template <int dim>
template <typename OfCell>
std::vector<double> FieldTransfer<dim>::combine(const std::vector<Weights> &weights, const OfCell &of_cell) const
{
  Numbers     result(of_cell(0).size(), 0.);
  std::size_t first = 0;
  for (const Field &field : fields)
    {
      const unsigned int n = field.n_components;
      for (unsigned int node = 0; node < weights.size(); ++node)
        for (const auto &[i, weight] : weights[node])
          for (unsigned int c = 0; c < n; ++c)
            result[first + n * node + c] += weight * of_cell(node)[first + n * i + c];
      first += n * weights.size();
    }
  return result;
}

template <int dim>
void FieldTransfer<dim>::put(const unsigned int cell, const Numbers &values)
{
  const unsigned int *nodes = discretization.cell_nodes(cell);
  const double       *value = values.data();
  for (Field &field : fields)
    for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i, value += field.n_components)
      if (nodes[i] < discretization.n_owned_nodes())
        for (unsigned int c = 0; c < field.n_components; ++c)
          field.after.local_element(field.n_components * nodes[i] + c) = value[c];
}

template <int dim>
void FieldTransfer<dim>::interpolate()
{
  for (Field &field : fields)
    field.after.reinit(field.n_components == 1 ? discretization.node_partitioner : discretization.vector_partitioner);
  const std::vector<unsigned int> new_index = index_of_active_cells(discretization);
  transport.unpack(cargo, [&](const Cell &cell, const Numbers &numbers,
                              const typename CellTransport<dim>::Change change) {
    if (change != CellTransport<dim>::Change::halved)
      return put(new_index[cell->active_cell_index()], numbers);
    const auto of_parent_cell = [&](unsigned int) -> const Numbers & { return numbers; };
    for (unsigned int child = 0; child < cell->n_children(); ++child)
      if (cell->child(child)->is_locally_owned())
        put(new_index[cell->child(child)->active_cell_index()], combine(of_child[child], of_parent_cell));
  });
}

template <int dim>
void FieldTransfer<dim>::next(VectorType &field)
{
  const VectorType &after = fields.front().after;
  for (unsigned int i = 0; i < after.locally_owned_size(); ++i)
    field.local_element(i) = after.local_element(i);
  fields.pop_front();
}

template class FieldTransfer<1>;
template class FieldTransfer<2>;
template class FieldTransfer<3>;
} // namespace Arenite
