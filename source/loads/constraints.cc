#include <arenite/loads/constraints.h>

#include <algorithm>
#include <map>
#include <set>

namespace Arenite
{
using namespace dealii;

template <int dim>
void Constraints<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Constraints");
  parameters.add_list(
    "Symmetry planes", symmetry_names,
    "Flat boundaries without normal motion. 'auto' takes all boundaries whose name begins with 'symmetry'.");
  parameters.add_list("Fixed boundaries", fixed_names, "Boundaries without any motion.");
  parameters.add_list("Exact boundaries", exact_names,
                      "Boundaries that move like the exact solution of 'Verification'.");
  prescribed_names = parameters.peek_list("Constraints/Prescribed velocities");
  parameters.add_list("Prescribed velocities", prescribed_names,
                      "Boundaries whose velocity along a direction is a history; each has a subsection of its name.");
  for (const std::string &name : prescribed_names)
    {
      const auto subsection = parameters.section(name);
      prescribed.push_back(std::make_unique<PrescribedBoundary>());
      prescribed.back()->name         = name;
      prescribed.back()->direction[0] = 1.;
      parameters.add_vector("Direction", prescribed.back()->direction, "-", "Direction of the prescribed component.");
      prescribed.back()->history.declare_parameters(parameters, "m/s");
    }
}

template <int dim>
void Constraints<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  if (symmetry_names == std::vector<std::string>{"auto"})
    {
      symmetry_names.clear();
      for (const std::string &name : geometry.boundary_names())
        if (name.rfind("symmetry", 0) == 0)
          symmetry_names.push_back(name);
    }
  symmetry = geometry.boundary_ids(parameters, "Constraints/Symmetry planes", symmetry_names);
  fixed    = geometry.boundary_ids(parameters, "Constraints/Fixed boundaries", fixed_names);
  exact    = geometry.boundary_ids(parameters, "Constraints/Exact boundaries", exact_names);
  for (auto &boundary : prescribed)
    {
      boundary->ids = geometry.boundary_ids(parameters, "Constraints/Prescribed velocities", {boundary->name});
      if (boundary->direction.norm() == 0.)
        parameters.refuse("Constraints/" + boundary->name + "/Direction", "must not be zero");
      boundary->direction /= boundary->direction.norm();
      boundary->history.finalize();
    }
}

namespace
{
/// Owned free nodes on the faces of @p ids with the sum of the outward area vectors around them.
template <int dim>
std::map<unsigned int, Tensor<1, dim>> boundary_nodes(const Discretization<dim>             &discretization,
                                                      const std::vector<types::boundary_id> &ids)
{
  std::map<unsigned int, Tensor<1, dim>> nodes;
  if (ids.empty())
    return nodes;
  VectorType sum = discretization.new_vector(), touched = discretization.new_scalar();
  for_each_face_point(discretization, ids,
                      [&](const unsigned int *cell_nodes, const double *N, const Point<dim> &,
                          const Tensor<1, dim> &dA) {
                        for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
                          if (N[i] > 1e-12) // trilinear and Gauss-Lobatto functions are not negative at these points
                            {
                              touched.local_element(cell_nodes[i]) += 1.;
                              for (unsigned int c = 0; c < dim; ++c)
                                sum.local_element(dim * cell_nodes[i] + c) += N[i] * dA[c];
                            }
                      });
  sum.compress(VectorOperation::add);
  touched.compress(VectorOperation::add);
  const std::set<unsigned int> hanging(discretization.hanging.list().begin(), discretization.hanging.list().end());
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (touched.local_element(node) > 0. && hanging.count(node) == 0)
      for (unsigned int c = 0; c < dim; ++c)
        nodes[node][c] = sum.local_element(dim * node + c);
  return nodes;
}

template <int dim>
SymmetricTensor<2, dim> dyad(const Tensor<1, dim> &n)
{
  SymmetricTensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      result[i][j] = n[i] * n[j];
  return result;
}

/// Constrain one more direction: P <- P - m m^T with m the part of n that is still free.
template <int dim>
void remove_direction(SymmetricTensor<2, dim> &P, const Tensor<1, dim> &n)
{
  const Tensor<1, dim> m = P * n;
  if (m.norm() > 1e-6 * n.norm())
    P -= dyad(m / m.norm());
}
} // namespace

template <int dim>
void Constraints<dim>::reinit(const Discretization<dim> &discretization)
{
  std::map<unsigned int, SymmetricTensor<2, dim>> free_directions;
  const auto projector_of = [&](const unsigned int node) -> SymmetricTensor<2, dim> & {
    return free_directions.emplace(node, unit_symmetric_tensor<dim>()).first->second;
  };
  for (const auto id : symmetry)
    for (const auto &[node, area] : boundary_nodes(discretization, {id}))
      remove_direction(projector_of(node), area);
  for (const auto &[node, area] : boundary_nodes(discretization, fixed))
    projector_of(node) = SymmetricTensor<2, dim>();

  prescribed_nodes.clear();
  for (unsigned int b = 0; b < prescribed.size(); ++b)
    for (const auto &[node, area] : boundary_nodes(discretization, prescribed[b]->ids))
      prescribed_nodes.push_back({node, b, Tensor<1, dim>()});
  exact_nodes.clear();
  for (const auto &[node, area] : boundary_nodes(discretization, exact))
    {
      free_directions.erase(node);
      exact_nodes.push_back({{node, 0, Tensor<1, dim>()}, discretization.position(node)});
    }
  projectors.clear();
  for (const auto &[node, P] : free_directions)
    projectors.push_back({node, P});
}

template <int dim>
void Constraints<dim>::apply(State<dim> &state, const double dt, const double mean)
{
  for (auto &[node, boundary, reaction] : prescribed_nodes)
    {
      // mean velocity of the coming step, so that the displacement follows the integral of the history to second order
      const auto          &motion = *prescribed[boundary];
      const double         target = motion.history.value(state.time + 0.5 * dt);
      const Tensor<1, dim> d      = motion.direction;
      double               v = 0., f = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          v += d[c] * state.half_velocity.local_element(dim * node + c);
          f += d[c] * state.force.local_element(dim * node + c);
        }
      const double wanted = (target - v) / (mean * state.inverse_mass.local_element(dim * node));
      reaction            = (wanted - f) * d;
      for (unsigned int c = 0; c < dim; ++c)
        state.force.local_element(dim * node + c) += reaction[c];
    }
  for (auto &[entry, x] : exact_nodes)
    {
      const Tensor<1, dim> velocity =
        (exact_solution->displacement(x, state.time + dt) - exact_solution->displacement(x, state.time)) / dt;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const unsigned int i = dim * entry.node + c;
          double            &f = state.force.local_element(i);
          const double       wanted =
            (velocity[c] - state.half_velocity.local_element(i)) / (mean * state.inverse_mass.local_element(i));
          entry.reaction[c] = wanted - f;
          f                 = wanted;
        }
    }
  project(state.force);
}

template <int dim>
double Constraints<dim>::power(const VectorType &half_velocity) const
{
  double     sum = 0.;
  const auto add = [&](const PrescribedNode &entry) {
    for (unsigned int c = 0; c < dim; ++c)
      sum += entry.reaction[c] * half_velocity.local_element(dim * entry.node + c);
  };
  for (const auto &entry : prescribed_nodes)
    add(entry);
  for (const auto &entry : exact_nodes)
    add(entry.first);
  return sum;
}

template <int dim>
void Constraints<dim>::project(VectorType &vector) const
{
  for (const auto &[node, P] : projectors)
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = vector.local_element(dim * node + c);
      value = P * value;
      for (unsigned int c = 0; c < dim; ++c)
        vector.local_element(dim * node + c) = value[c];
    }
}

template <int dim>
void Constraints<dim>::project(DampingBlocks<dim> &blocks) const
{
  for (auto &[node, D] : blocks)
    {
      const unsigned int wanted   = node;
      const auto         position = std::lower_bound(projectors.begin(), projectors.end(), wanted,
                                                     [](const auto &entry, const unsigned int n) { return entry.node < n; });
      if (position != projectors.end() && position->node == node)
        D = symmetrize(Tensor<2, dim>(position->value) * Tensor<2, dim>(D) * Tensor<2, dim>(position->value));
    }
}

template class Constraints<3>;
} // namespace Arenite
