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
        for (const auto &[node, D] : blocks)
          {
            const auto [entry, is_new] = position.emplace(node, nodes.size());
            if (is_new)
              nodes.push_back({node, SymmetricTensor<2, dim>(), Tensor<1, dim>()});
            nodes[entry->second].damping += D;
            per_load[l].push_back({entry->second, D});
          }
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
  for (const auto &[position, D] : per_load[index])
    {
      const Tensor<1, dim> force = D * nodes[position].velocity;
      for (unsigned int c = 0; c < dim; ++c)
        sum -= force[c] * half_velocity.local_element(dim * nodes[position].node + c);
    }
  return sum;
}

template class NodeDamping<1>;
template class NodeDamping<2>;
template class NodeDamping<3>;
} // namespace Arenite
