#include <arenite/loads/constraints.h>
#include <arenite/loads/node_faces.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
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
      parameters.add_choice("Along", prescribed.back()->along, {"direction", "normal"},
                            "What the history is the velocity along: 'Direction', or at each node the normal of the "
                            "undeformed boundary, out of the body. A cavity whose velocity is negative grows.");
      parameters.add_vector("Direction", prescribed.back()->direction, "-",
                            "Direction of the prescribed component; the others are free.");
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
      if (boundary->along_normal() && parameters.is_set("Constraints/" + boundary->name + "/Direction"))
        parameters.refuse("Constraints/" + boundary->name + "/Direction", "has no meaning with 'Along = normal'");
      if (boundary->direction.norm() == 0.)
        parameters.refuse("Constraints/" + boundary->name + "/Direction", "must not be zero");
      boundary->direction /= boundary->direction.norm();
      boundary->history.finalize();
    }
}

template <int dim>
bool Constraints<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  std::vector<std::string> planes; // that the form has, too
  for (unsigned int i = 0; i < symmetry.size(); ++i)
    if (!have_common({symmetry[i]}, form.cut))
      planes.push_back(symmetry_names[i]);
  // planes on other boundaries hold nothing but their normals only if these are flat
  if ((!planes.empty() && n_hoop_directions(form.form) > 0) ||
      !std::all_of(form.cut.begin(), form.cut.end(), [&](const auto id) { return have_common({id}, symmetry); }))
    return false;
  const std::string entry = "Constraints/Symmetry planes";
  if (parameters.peek(entry, "auto") != "auto")
    form.changes.push_back(entry + "=" + (planes.empty() ? "auto" : join(planes)));

  if (!form.keeps(fixed) || !form.keeps(exact))
    return false;
  for (const auto &boundary : prescribed)
    {
      if (!form.keeps(boundary->ids))
        return false;
      if (boundary->along_normal()) // seen from all sides alike
        continue;
      if (!form.is_symmetric(boundary->direction))
        return false;
      form.shorten(parameters, "Constraints/" + boundary->name + "/Direction", boundary->direction);
    }
  return true;
}

namespace
{
/// What @p list (of ascending nodes) has for a node, or null.
template <int dim>
const SymmetricTensor<2, dim> *projector(const std::vector<NodeValue<SymmetricTensor<2, dim>>> &list,
                                         const unsigned int                                     node)
{
  const auto position = std::lower_bound(list.begin(), list.end(), node,
                                         [](const auto &entry, const unsigned int n) { return entry.node < n; });
  return position != list.end() && position->node == node ? &position->value : nullptr;
}

/// Of a velocity over a time, panel by panel between the times where a derivative jumps.
double integral(const TimeHistory &velocity, const double from, const double to)
{
  std::vector<double> ends{from};
  for (const double t : velocity.break_points())
    if (t > from && t < to)
      ends.push_back(t);
  ends.push_back(to);
  const QGauss<1> rule(8);
  double          sum = 0.;
  for (std::size_t panel = 0; panel + 1 < ends.size(); ++panel)
    for (unsigned int q = 0; q < rule.size(); ++q)
      sum += (ends[panel + 1] - ends[panel]) * rule.weight(q) *
             velocity.value(ends[panel] + rule.point(q)[0] * (ends[panel + 1] - ends[panel]));
  return sum;
}

/// Projector onto the directions that no face normal in @p normals (with trace 1) constrains.
template <int dim>
SymmetricTensor<2, dim> free_directions(const SymmetricTensor<2, dim> &normals, const double threshold = 1e-8)
{
  SymmetricTensor<2, dim> P = unit_symmetric_tensor<dim>();
  // planes that meet at an angle give eigenvalues of the order of one, the noise of flat faces 1e-30
  for (const auto &[value, m] : eigenvectors(normals))
    if (value > threshold)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          P[i][j] -= m[i] * m[j];
  return P;
}
} // namespace

template <int dim>
void Constraints<dim>::reinit(const Discretization<dim> &discretization)
{
  std::map<unsigned int, SymmetricTensor<2, dim>> free;
  for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, symmetry, false))
    free[faces.node] = free_directions<dim>(faces.dyad / faces.size);
  for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, fixed, false))
    free[faces.node] = SymmetricTensor<2, dim>();
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (discretization.on_axis(node)) // no radial motion, whatever the boundaries are called
      {
        auto &P = free.emplace(node, unit_symmetric_tensor<dim>()).first->second;
        for (unsigned int c = 0; c < dim; ++c)
          P[0][c] = 0.;
      }

  // the facets of a curved surface have one normal at a node, faces that meet at more than about 25 degrees several
  for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, held, false))
    {
      auto                         &P = free.emplace(faces.node, unit_symmetric_tensor<dim>()).first->second;
      const SymmetricTensor<2, dim> also =
        held_fully ? SymmetricTensor<2, dim>() : free_directions<dim>(faces.dyad / faces.size, 0.05);
      P = free_directions<dim>(unit_symmetric_tensor<dim>() - 0.5 * (P + also));
    }

  exact_nodes.clear();
  for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, exact, false))
    {
      const unsigned int node = faces.node;
      if (dim == 1 && discretization.on_axis(node)) // at rest, and perhaps without mass
        continue;
      free.erase(node);
      exact_nodes.push_back({{node, 0, {}, {}}, discretization.position(node)});
    }
  projectors.clear();
  for (const auto &[node, P] : free)
    projectors.push_back({node, P});
  plane_reactions.assign(projectors.size(), {});
  make_prescribed_nodes(discretization);
  knows_parts = false;
}

/// With the projectors of the present mesh.
template <int dim>
void Constraints<dim>::make_prescribed_nodes(const Discretization<dim> &discretization)
{
  prescribed_nodes.clear();
  for (unsigned int b = 0; b < prescribed.size(); ++b)
    for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, prescribed[b]->ids, false))
      {
        const auto &[node, dyad, area, size] = faces;
        if (dim == 1 && discretization.on_axis(node))
          continue;
        Tensor<1, dim> direction = prescribed[b]->direction;
        if (prescribed[b]->along_normal())
          {
            // the faces on this side of a plane of symmetry tilt the mean normal out of it
            direction = area;
            if (const auto *P = projector(projectors, node))
              direction = *P * direction;
            if (!(direction.norm() > 1e-8 * area.norm())) // held
              continue;
            direction /= direction.norm();
          }
        prescribed_nodes.push_back({node, b, direction, {}});
      }
}

template <int dim>
void Constraints<dim>::apply(State<dim> &state, const double dt, const double mean)
{
  whole_reaction = Tensor<1, dim>();
  for (auto &[node, boundary, d, reaction] : prescribed_nodes)
    {
      // mean velocity of the coming step, so that the displacement follows the integral of the history to second order
      const double target = prescribed[boundary]->history.value(state.time + 0.5 * dt);
      double       v = 0., f = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          v += d[c] * state.half_velocity.local_element(dim * node + c);
          f += d[c] * state.force.local_element(dim * node + c);
        }
      const double wanted = (target - v) / (mean * state.inverse_mass.local_element(dim * node));
      reaction            = (wanted - f) * d;
      for (unsigned int c = 0; c < dim; ++c)
        state.force.local_element(dim * node + c) += reaction[c];
      whole_reaction += reaction;
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
      whole_reaction += entry.reaction;
    }
  for (unsigned int i = 0; i < projectors.size(); ++i)
    {
      const auto &[node, P] = projectors[i];
      Tensor<1, dim> before;
      for (unsigned int c = 0; c < dim; ++c)
        before[c] = state.force.local_element(dim * node + c);
      const Tensor<1, dim> after = P * before;
      for (unsigned int c = 0; c < dim; ++c)
        state.force.local_element(dim * node + c) = after[c];
      plane_reactions[i] = after - before;
      whole_reaction += plane_reactions[i];
    }
}

/// With the nodal lists of the present mesh.
template <int dim>
void Constraints<dim>::make_parts(const Discretization<dim> &discretization)
{
  std::map<unsigned int, std::vector<Part>> of_node; // with stiffness instead of the share
  const auto                                add = [&](const types::boundary_id id, const auto &stiffness) {
    for (const NodeFaces<dim> &faces : faces_of_nodes(discretization, {id}, false))
      of_node[faces.node].push_back({0, id, Tensor<2, dim>(stiffness(faces)), faces.normal()});
  };
  for (const types::boundary_id id : symmetry)
    add(id, [](const NodeFaces<dim> &faces) { return faces.dyad; });
  for (const auto *ids : {&fixed, &exact})
    for (const types::boundary_id id : *ids)
      add(id, [](const NodeFaces<dim> &faces) { return faces.size * unit_symmetric_tensor<dim>(); });
  std::map<std::pair<unsigned int, unsigned int>, Tensor<1, dim>> direction;
  for (const PrescribedNode &entry : prescribed_nodes)
    direction[{entry.boundary, entry.node}] = entry.direction;
  for (unsigned int b = 0; b < prescribed.size(); ++b)
    for (const types::boundary_id id : prescribed[b]->ids)
      add(id, [&](const NodeFaces<dim> &faces) {
        const auto along = direction.find({b, faces.node});
        return along == direction.end() ? SymmetricTensor<2, dim>()
                                        : faces.size * symmetrize(outer_product(along->second, along->second));
      });

  parts.clear();
  held_nodes.clear();
  for (auto &[node, list] : of_node)
    {
      held_nodes.push_back(node);
      SymmetricTensor<2, dim> K;
      for (const Part &part : list)
        K += symmetrize(part.share);
      const Tensor<2, dim> flexibility(flexibility_where_held(K));
      for (Part &part : list)
        {
          part.share = part.share * flexibility;
          part.node  = held_nodes.size() - 1;
          parts.push_back(part);
        }
    }
  knows_parts = true;
}

template <int dim>
void Constraints<dim>::add_resultants(const Discretization<dim> &discretization, Resultants<dim> &sums)
{
  if (!knows_parts)
    make_parts(discretization);
  held_reactions.assign(held_nodes.size(), {});
  const auto add = [&](const unsigned int node, const Tensor<1, dim> &reaction) {
    const auto at = std::lower_bound(held_nodes.begin(), held_nodes.end(), node);
    if (at != held_nodes.end() && *at == node)
      held_reactions[at - held_nodes.begin()] += reaction;
  };
  for (unsigned int i = 0; i < projectors.size(); ++i)
    add(projectors[i].node, plane_reactions[i]);
  for (const PrescribedNode &entry : prescribed_nodes)
    add(entry.node, entry.reaction);
  for (const auto &[entry, x] : exact_nodes)
    add(entry.node, entry.reaction);
  Tensor<1, dim> rest = whole_reaction; // of the axis
  for (const Part &part : parts)
    {
      const Tensor<1, dim> force = part.share * held_reactions[part.node];
      sums[part.boundary] += {force, force * part.normal};
      rest -= force;
    }
  sums[inside].force += rest;
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
std::vector<types::boundary_id> Constraints<dim>::driven_boundaries() const
{
  std::vector<types::boundary_id> result;
  for (const auto &boundary : prescribed)
    result.insert(result.end(), boundary->ids.begin(), boundary->ids.end());
  return result;
}

template <int dim>
double Constraints<dim>::largest_speed(const double time) const
{
  double largest = 0.;
  for (const auto &boundary : prescribed)
    largest = std::max(largest, std::abs(boundary->history.value(time)));
  return largest;
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
std::vector<NodeValue<SymmetricTensor<2, dim>>> Constraints<dim>::freedom() const
{
  std::map<unsigned int, SymmetricTensor<2, dim>> free;
  for (const auto &[node, P] : projectors)
    free[node] = P;
  for (const PrescribedNode &entry : prescribed_nodes)
    {
      auto                &P = free.emplace(entry.node, unit_symmetric_tensor<dim>()).first->second;
      const Tensor<1, dim> d = P * entry.direction;
      if (d.norm() > 1e-8) // not held yet
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            P[i][j] -= d[i] * d[j] / d.norm_square();
    }
  for (const auto &[entry, x] : exact_nodes)
    free[entry.node] = SymmetricTensor<2, dim>();
  Projectors result;
  for (const auto &[node, P] : free)
    result.push_back({node, P});
  return result;
}

template <int dim>
void Constraints<dim>::prescribe(VectorType &change, const VectorType &displacement, const double from,
                                 const double to) const
{
  std::vector<double> distance;
  for (const auto &boundary : prescribed)
    distance.push_back(integral(*boundary->history.get(), from, to));
  for (const PrescribedNode &entry : prescribed_nodes)
    {
      double along = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        along += entry.direction[c] * change.local_element(dim * entry.node + c);
      for (unsigned int c = 0; c < dim; ++c)
        change.local_element(dim * entry.node + c) += (distance[entry.boundary] - along) * entry.direction[c];
    }
  for (const auto &[entry, x] : exact_nodes)
    {
      const Tensor<1, dim> u = exact_solution->displacement(x, to);
      for (unsigned int c = 0; c < dim; ++c)
        change.local_element(dim * entry.node + c) = u[c] - displacement.local_element(dim * entry.node + c);
    }
  project(change);
}

template <int dim>
void Constraints<dim>::project(DampingBlocks<dim> &blocks) const
{
  for (DampingBlock<dim> &block : blocks)
    if (const auto *P = projector(projectors, block.node))
      block.value = symmetrize(Tensor<2, dim>(*P) * Tensor<2, dim>(block.value) * Tensor<2, dim>(*P));
}

template class Constraints<1>;
template class Constraints<2>;
template class Constraints<3>;
} // namespace Arenite
