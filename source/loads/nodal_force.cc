#include <arenite/loads/nodal_force.h>

#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
NodalForces<dim> assemble(const Discretization<dim> &discretization, VectorType &vector)
{
  discretization.hanging.template condense<dim>(vector.begin());
  vector.compress(VectorOperation::add);
  NodalForces<dim> list;
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = vector.local_element(dim * node + c);
      if (value.norm_square() > 0.)
        list.push_back({node, value});
    }
  return list;
}

template <int dim>
void UniformPressure<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_list("Boundary", boundary_names, "Names of the boundaries that carry the pressure.");
  parameters.require("Boundary");
}

template <int dim>
void UniformPressure<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  ids = geometry.boundary_ids(parameters, path + "/Boundary", boundary_names);
}

template <int dim>
void UniformPressure<dim>::reinit(const Discretization<dim> &discretization, const NodalMass &, const MaterialOfBlock &)
{
  whole.assign(ids.size(), {});
  if (follows_surface)
    {
      faces.reinit(discretization, ids);
      area.clear();
      for (const unsigned int node : faces.nodes())
        area.push_back({node, Tensor<1, dim>()});
      return;
    }
  VectorType         sum = discretization.new_vector();
  const unsigned int n   = discretization.nodes_per_cell();
  for (unsigned int b = 0; b < ids.size(); ++b)
    for_each_face_point(discretization, {ids[b]},
                        [&](const unsigned int *nodes, const double *N, const Point<dim> &, const Tensor<1, dim> &dA,
                            const types::material_id) {
                          for (unsigned int i = 0; i < n; ++i)
                            for (unsigned int c = 0; c < dim; ++c)
                              sum.local_element(dim * nodes[i] + c) += N[i] * dA[c];
                          whole[b] += {dA, dA.norm()};
                        });
  area = assemble(discretization, sum);
}

template <int dim>
void UniformPressure<dim>::find_areas(const State<dim> &state)
{
  if (!follows_surface)
    return;
  const VectorType &now = faces.areas(state.displacement);
  for (auto &[node, value] : area)
    for (unsigned int c = 0; c < dim; ++c)
      value[c] = now.local_element(dim * node + c);
  whole = faces.sums();
}

template <int dim>
void UniformPressure<dim>::add_resultants(Resultants<dim> &sums) const
{
  for (unsigned int b = 0; b < ids.size(); ++b)
    sums[ids[b]] += factor * whole[b];
}

template <int dim>
std::string UniformPressure<dim>::description() const
{
  return "on " + join(boundary_names) + (follows_surface ? ", on the deformed surface" : "");
}

template <int dim>
void Pressure<dim>::declare_parameters(Parameters &parameters)
{
  UniformPressure<dim>::declare_parameters(parameters);
  history.declare_parameters(parameters, "Pa");
}

template <int dim>
void Pressure<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  UniformPressure<dim>::finalize(parameters, geometry);
  history.finalize();
}

template <int dim>
void Pressure<dim>::add(VectorType &force, const State<dim> &state)
{
  this->find_areas(state);
  this->push(force, history.value(state.time));
}

template <int dim>
std::string Pressure<dim>::description() const
{
  return "pressure '" + history.name() + "' " + UniformPressure<dim>::description();
}

template <int dim>
void Gravity<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_vector("Acceleration", acceleration, "m/s^2", "Acceleration of gravity, for example 0, 0, -9.81.");
  history.declare_parameters(parameters, "-");
}

template <int dim>
void Gravity<dim>::finalize(const Parameters &, const Geometry<dim> &)
{
  history.finalize();
}

template <int dim>
void Gravity<dim>::reinit(const Discretization<dim> &discretization, const NodalMass &mass, const MaterialOfBlock &)
{
  weight.clear();
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (mass.condensed.local_element(node) > 0.)
      weight.push_back({node, mass.condensed.local_element(node) * acceleration});
  whole = resultant_of(weight, 1.);
}

template <int dim>
void Gravity<dim>::add(VectorType &force, const State<dim> &state)
{
  factor = history.value(state.time);
  add_forces(weight, factor, force);
}

template <int dim>
bool Gravity<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  form.shorten(parameters, path + "/Acceleration", acceleration);
  return form.is_symmetric(acceleration);
}

template <int dim>
std::string Gravity<dim>::description() const
{
  std::ostringstream text;
  text << "gravity " << acceleration << " m/s^2";
  return text.str();
}

template class UniformPressure<1>;
template class UniformPressure<2>;
template class UniformPressure<3>;
template class Pressure<1>;
template class Pressure<2>;
template class Pressure<3>;
template class Gravity<1>;
template class Gravity<2>;
template class Gravity<3>;
template NodalForces<1> assemble(const Discretization<1> &, VectorType &);
template NodalForces<2> assemble(const Discretization<2> &, VectorType &);
template NodalForces<3> assemble(const Discretization<3> &, VectorType &);
} // namespace Arenite
