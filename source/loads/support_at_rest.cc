#include <arenite/base/state_archive.h>
#include <arenite/loads/support_at_rest.h>

#include <cmath>
#include <map>

namespace Arenite
{
using namespace dealii;

template <int dim>
void SupportAtRest<dim>::reinit(const Discretization<dim> &mesh, const NodalMass &, const MaterialOfBlock &)
{
  discretization = &mesh;
  faces.clear();
  for (const types::boundary_id id : ids)
    faces.push_back(faces_of_nodes(mesh, {id}, true));
  // a new mesh, whose values come by set_nodal_states()
  traction.assign(dim * ids.size(), mesh.new_scalar());
  find_forces();
}

template <int dim>
void SupportAtRest<dim>::find_forces()
{
  whole.assign(ids.size(), {});
  forces.clear();
  for (unsigned int b = 0; b < ids.size(); ++b)
    for (const NodeFaces<dim> &at : faces[b])
      {
        Tensor<1, dim> f;
        for (unsigned int c = 0; c < dim; ++c)
          f[c] = at.size * traction[dim * b + c].local_element(at.node);
        forces.push_back({at.node, f});
        whole[b] += {f, f * at.normal()};
      }
}

template <int dim>
void SupportAtRest<dim>::take_up(const VectorType &reactions, const bool along_normals)
{
  const auto stiffness = [&](const NodeFaces<dim> &at) {
    return along_normals ? at.dyad : at.size * unit_symmetric_tensor<dim>();
  };
  std::map<unsigned int, SymmetricTensor<2, dim>> all;
  for (const auto &of_boundary : faces)
    for (const NodeFaces<dim> &at : of_boundary)
      all[at.node] += stiffness(at);
  force_on.assign(ids.size(), {});
  for (unsigned int b = 0; b < ids.size(); ++b)
    for (const NodeFaces<dim> &at : faces[b])
      {
        Tensor<1, dim> R;
        for (unsigned int c = 0; c < dim; ++c)
          R[c] = reactions.local_element(dim * at.node + c);
        // faces of one boundary whose normals differ a little hold the node in the mean direction only
        const SymmetricTensor<2, dim> &K         = all.at(at.node);
        const Tensor<1, dim>           extension = flexibility_where_held(K) * R, rest = R - K * extension;
        const Tensor<1, dim>           f = stiffness(at) * extension + trace(stiffness(at)) / trace(K) * rest;
        for (unsigned int c = 0; c < dim; ++c)
          traction[dim * b + c].local_element(at.node) = f[c] / at.size;
        force_on[b] += f;
      }
  for (Tensor<1, dim> &force : force_on)
    force = Utilities::MPI::sum(force, discretization->communicator);
  has_forces = true;
  find_forces();
}

template <int dim>
std::vector<const VectorType *> SupportAtRest<dim>::nodal_states() const
{
  std::vector<const VectorType *> states;
  for (const VectorType &component : traction)
    states.push_back(&component);
  return states;
}

template <int dim>
void SupportAtRest<dim>::set_nodal_states(const std::vector<VectorType> &values)
{
  for (unsigned int k = 0; k < traction.size(); ++k)
    std::copy_n(values[k].begin(), traction[k].locally_owned_size(), traction[k].begin());
  find_forces();
  if (!has_forces) // those of a checkpoint, as they were
    return;
  for (unsigned int b = 0; b < ids.size(); ++b)
    {
      double size = 0.;
      for (const NodeFaces<dim> &at : faces[b])
        size += at.size;
      const Tensor<1, dim> lacks = force_on[b] - Utilities::MPI::sum(whole[b].force, discretization->communicator);
      size                       = Utilities::MPI::sum(size, discretization->communicator);
      for (const NodeFaces<dim> &at : faces[b])
        for (unsigned int c = 0; c < dim; ++c)
          traction[dim * b + c].local_element(at.node) += lacks[c] / size;
    }
  find_forces();
}

template <int dim>
void SupportAtRest<dim>::exchange(StateArchive &archive)
{
  for (Tensor<1, dim> &force : force_on)
    for (unsigned int c = 0; c < dim; ++c)
      archive.common(force[c]);
  archive.common(has_forces);
}

template <int dim>
void SupportAtRest<dim>::add(VectorType &force, const State<dim> &)
{
  add_forces(forces, 1., force);
}

template <int dim>
double SupportAtRest<dim>::power(const VectorType &half_velocity) const
{
  return power_of(forces, 1., half_velocity);
}

template <int dim>
void SupportAtRest<dim>::add_resultants(Resultants<dim> &sums) const
{
  for (unsigned int b = 0; b < ids.size(); ++b)
    sums[ids[b]] += whole[b];
}

template <int dim>
std::string SupportAtRest<dim>::description() const
{
  return "what held " + join(boundary_names) + " in the equilibrium of the start";
}

template class SupportAtRest<1>;
template class SupportAtRest<2>;
template class SupportAtRest<3>;
} // namespace Arenite
