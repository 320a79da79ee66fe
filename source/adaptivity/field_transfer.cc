#include <arenite/adaptivity/field_transfer.h>

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
    [this](const std::vector<Numbers> &children) { return join(children); });
}

template <int dim>
void FieldTransfer<dim>::add(const VectorType &field)
{
  const bool is_scalar = field.get_partitioner().get() == discretization.node_partitioner.get();
  fields.push_back({&field, is_scalar ? 1u : dim, VectorType()});
}

/// Values of all fields at the nodes of a parent.
template <int dim>
std::vector<double> FieldTransfer<dim>::join(const std::vector<Numbers> &children) const
{
  Numbers      result(children[0].size(), 0.);
  unsigned int first = 0;
  for (const Field &field : fields)
    {
      for (unsigned int node = 0; node < of_parent.size(); ++node)
        for (const auto &[i, weight] : of_parent[node])
          for (unsigned int c = 0; c < field.n_components; ++c)
            result[first + field.n_components * node + c] +=
              weight * children[child_of_node[node]][first + field.n_components * i + c];
      first += field.n_components * static_cast<unsigned int>(of_parent.size());
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
  Numbers                         values;
  transport.unpack(cargo,
                   [&](const Cell &cell, const Numbers &numbers, const typename CellTransport<dim>::Change change) {
                     if (change != CellTransport<dim>::Change::halved)
                       return put(new_index[cell->active_cell_index()], numbers);
                     for (unsigned int child = 0; child < cell->n_children(); ++child)
                       if (cell->child(child)->is_locally_owned())
                         {
                           values.assign(numbers.size(), 0.);
                           unsigned int first = 0;
                           for (const Field &field : fields)
                             {
                               for (unsigned int node = 0; node < of_child[child].size(); ++node)
                                 for (const auto &[i, weight] : of_child[child][node])
                                   for (unsigned int c = 0; c < field.n_components; ++c)
                                     values[first + field.n_components * node + c] +=
                                       weight * numbers[first + field.n_components * i + c];
                               first += field.n_components * static_cast<unsigned int>(of_child[child].size());
                             }
                           put(new_index[cell->child(child)->active_cell_index()], values);
                         }
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
