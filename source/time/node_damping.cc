#include <arenite/time/node_damping.h>

#include <map>

namespace Arenite
{
using namespace dealii;

template <int dim>
void NodeDamping<dim>::reinit(const std::vector<std::unique_ptr<Load<dim>>> &loads, const Constraints<dim> &constraints)
{
  nodes.clear();
  per_load.assign(loads.size(), {});
  std::map<unsigned int, unsigned int> position;
  for (unsigned int l = 0; l < loads.size(); ++l)
    if (const auto *damping = loads[l]->damping())
      {
        DampingBlocks<dim> blocks = *damping;
        constraints.project(blocks);
        for (DampingBlock<dim> &block : blocks)
          {
            const auto [entry, is_new] = position.emplace(block.node, nodes.size());
            if (is_new)
              nodes.push_back({block.node, SymmetricTensor<2, dim>(), Tensor<1, dim>()});
            nodes[entry->second].damping += block.value;
            block.node = entry->second;
          }
        per_load[l].swap(blocks);
      }
}

template <int dim>
void NodeDamping<dim>::apply(State<dim> &state, const double mean)
{
  for (auto &[node, D, velocity] : nodes)
    {
      const double            mass = 1. / state.inverse_mass.local_element(dim * node);
      Tensor<1, dim>          v, f;
      SymmetricTensor<2, dim> matrix = 0.5 * mean * D;
      for (unsigned int c = 0; c < dim; ++c)
        {
          v[c] = state.half_velocity.local_element(dim * node + c);
          f[c] = state.force.local_element(dim * node + c);
          matrix[c][c] += mass;
        }
      const Tensor<1, dim> acceleration = invert(matrix) * (f - D * v);
      velocity                          = v + 0.5 * mean * acceleration;
      for (unsigned int c = 0; c < dim; ++c)
        state.force.local_element(dim * node + c) = mass * acceleration[c];
    }
}

template <int dim>
double NodeDamping<dim>::power(const unsigned int index, const VectorType &half_velocity) const
{
  double sum = 0.;
  for (const DampingBlock<dim> &block : per_load[index])
    {
      const Node          &node  = nodes[block.node];
      const Tensor<1, dim> force = block.value * node.velocity;
      for (unsigned int c = 0; c < dim; ++c)
        sum -= force[c] * half_velocity.local_element(dim * node.node + c);
    }
  return sum;
}

template <int dim>
void NodeDamping<dim>::add_resultants(const unsigned int index, Resultants<dim> &sums) const
{
  for (const DampingBlock<dim> &block : per_load[index])
    {
      const Tensor<1, dim> force = -1. * (block.value * nodes[block.node].velocity);
      sums[block.boundary] += {force, force * block.normal};
    }
}

template class NodeDamping<1>;
template class NodeDamping<2>;
template class NodeDamping<3>;
} // namespace Arenite
