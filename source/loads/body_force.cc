#include <arenite/loads/body_force.h>

namespace Arenite
{
using namespace dealii;

// The condensed mass cannot be used: the force of a hanging node at its own place goes to its masters, C^T V b(x), which differs
// from (C^T V) b by the variation of b over a cell.
template <int dim>
void BodyForce<dim>::reinit(const Discretization<dim> &mesh, const NodalMass &mass, const MaterialOfBlock &material)
{
  discretization = &mesh;
  // a manufactured solution has one material
  const double density = material(mesh.cells().empty() ? 0 : mesh.cells().front()->material_id()).density;
  copy_with_ghosts(mass.partial, volume);
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    volume.local_element(node) /= density;
  current.reinit(mesh.vector_partitioner);
}

template <int dim>
void BodyForce<dim>::add(VectorType &force, const State<dim> &state)
{
  current = 0.;
  for (unsigned int node = 0; node < discretization->n_local_nodes(); ++node)
    if (const double V = volume.local_element(node); V != 0.)
      {
        const Tensor<1, dim> b = solution->body_force(discretization->position(node), state.time);
        for (unsigned int c = 0; c < dim; ++c)
          current.local_element(dim * node + c) = V * b[c];
      }
  discretization->hanging.template condense<dim>(current.begin());
  current.compress(VectorOperation::add);
  force += current;
}

template <int dim>
double BodyForce<dim>::power(const VectorType &half_velocity) const
{
  double sum = 0.;
  for (unsigned int i = 0; i < current.locally_owned_size(); ++i)
    sum += current.local_element(i) * half_velocity.local_element(i);
  return sum;
}

template <int dim>
void BodyForce<dim>::add_resultants(Resultants<dim> &sums) const
{
  Tensor<1, dim> &force = sums[inside].force;
  for (unsigned int i = 0; i < current.locally_owned_size(); ++i)
    force[i % dim] += current.local_element(i);
}

template class BodyForce<1>;
template class BodyForce<2>;
template class BodyForce<3>;
} // namespace Arenite
