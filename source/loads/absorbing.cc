#include <arenite/loads/absorbing.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void AbsorbingBoundary<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_list("Boundary", boundary_names, "Names of the boundaries behind which the solid goes on.");
  parameters.require("Boundary");
  parameters.add_choice(
    "Condition", condition, {"Lysmer", "spherical"},
    "Lysmer dashpots absorb plane waves at normal incidence; 'spherical' is exact for spherical P waves "
    "around 'Centre', so that the boundary may lie right behind the last receiver.");
  parameters.add_vector("Centre", centre, "m", "Centre of the waves, for 'spherical'.");
}

template <int dim>
void AbsorbingBoundary<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  ids = geometry.boundary_ids(parameters, path + "/Boundary", boundary_names);
}

template <int dim>
void AbsorbingBoundary<dim>::reinit(const Discretization<dim> &discretization, const NodalMass &,
                                    const MaterialOfBlock     &material)
{
  make_dashpots(discretization, material);
  springs.clear();
  if (memory.get_partitioner() !=
      discretization.node_partitioner) // a new mesh, whose values come by set_nodal_states()
    memory.reinit(discretization.node_partitioner);
  if (spherical())
    make_springs(discretization, material);
}

template <int dim>
void AbsorbingBoundary<dim>::make_dashpots(const Discretization<dim> &discretization, const MaterialOfBlock &material)
{
  // per node: the entries of the dashpot block, n dS, dS
  constexpr unsigned int n_entries = SymmetricTensor<2, dim>::n_independent_components;
  dashpots.clear();
  for (const types::boundary_id boundary : ids)
    for (const auto &[node, q] : integrate_on_boundary<n_entries + dim + 1>(
           discretization, {boundary}, true,
           [&](const Point<dim> &x, const Tensor<1, dim> &dA, const types::material_id id) {
             const LinearElastic     law = material(id);
             const double            z_p = law.density * law.p_wave_speed(), z_s = law.density * law.s_wave_speed();
             const double            dS = dA.norm(), b = (x - Point<dim>(centre)).norm();
             const Tensor<1, dim>    n = spherical() ? (x - Point<dim>(centre)) / b : dA / dS;
             SymmetricTensor<2, dim> D;
             for (unsigned int i = 0; i < dim; ++i)
               for (unsigned int j = i; j < dim; ++j)
                 D[i][j] = dS * ((z_p - z_s) * n[i] * n[j] + (i == j ? z_s : 0.));
             std::array<double, n_entries + dim + 1> q;
             for (unsigned int k = 0; k < n_entries; ++k)
               q[k] = D.access_raw_entry(k);
             for (unsigned int c = 0; c < dim; ++c)
               q[n_entries + c] = dA[c];
             q[n_entries + dim] = dS;
             return q;
           }))
      {
        DampingBlock<dim> block{node, {}, boundary, {}};
        for (unsigned int k = 0; k < n_entries; ++k)
          block.value.access_raw_entry(k) = q[k];
        for (unsigned int c = 0; c < dim; ++c)
          block.normal[c] = q[n_entries + c];
        if (const double size = block.normal.norm(); size > 0.)
          block.normal /= size;
        dashpots.push_back(block);
      }
}

template <int dim>
void AbsorbingBoundary<dim>::make_springs(const Discretization<dim> &discretization, const MaterialOfBlock &material)
{
  // per node: spring and push of the condition, cp dS, dS
  for (const auto &[node, q] : integrate_on_boundary<4>(
         discretization, ids, true, [&](const Point<dim> &x, const Tensor<1, dim> &dA, const types::material_id id) {
           const LinearElastic law = material(id);
           const double        dS = dA.norm(), b = (x - Point<dim>(centre)).norm(), cp = law.p_wave_speed();
           return std::array<double, 4>{{dS * 4. * law.shear_modulus / b, dS * law.density * cp * cp / b, dS * cp, dS}};
         }))
    {
      const Tensor<1, dim> from_centre = discretization.position(node) - Point<dim>(centre);
      const double         b           = from_centre.norm();
      springs.push_back({node, from_centre / b, q[0], q[1], q[2] / (q[3] * b)});
    }
}

template <int dim>
void AbsorbingBoundary<dim>::add(VectorType &force, const State<dim> &state)
{
  for (auto &s : springs)
    {
      double u = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        u += s.normal[c] * state.displacement.local_element(dim * s.node + c);
      s.force = s.push * memory.local_element(s.node) - s.spring * u;
      for (unsigned int c = 0; c < dim; ++c)
        force.local_element(dim * s.node + c) += s.force * s.normal[c];
    }
}

template <int dim>
double AbsorbingBoundary<dim>::power(const VectorType &half_velocity) const
{
  double sum = 0.;
  for (const auto &s : springs)
    for (unsigned int c = 0; c < dim; ++c)
      sum += s.force * s.normal[c] * half_velocity.local_element(dim * s.node + c);
  return sum;
}

/// On a sphere; it is rarely made of more boundaries than one, and the first has to stand for all of them.
template <int dim>
void AbsorbingBoundary<dim>::add_resultants(Resultants<dim> &sums) const
{
  if (springs.empty())
    return;
  Resultant<dim> &sum = sums[ids.front()];
  for (const auto &s : springs)
    sum += {s.force * s.normal, s.force};
}

template <int dim>
void AbsorbingBoundary<dim>::finish_step(const VectorType &half_velocity, const double dt)
{
  for (const auto &s : springs)
    {
      double v = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        v += s.normal[c] * half_velocity.local_element(dim * s.node + c);
      double      &w = memory.local_element(s.node);
      const double r = 0.5 * dt * s.rate;
      w              = (w * (1. - r) + dt * v) / (1. + r); // trapezoidal rule
    }
}

template <int dim>
std::vector<const VectorType *> AbsorbingBoundary<dim>::nodal_states() const
{
  if (spherical())
    return {&memory};
  return {};
}

template <int dim>
void AbsorbingBoundary<dim>::set_nodal_states(const std::vector<VectorType> &values)
{
  memory.reinit(values.front().get_partitioner());
  std::copy_n(values.front().begin(), values.front().locally_owned_size(), memory.begin());
}

template <int dim>
bool AbsorbingBoundary<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  form.absorbed.insert(form.absorbed.end(), ids.begin(), ids.end());
  form.shorten(parameters, path + "/Centre", centre);
  return !have_common(ids, form.cut) && !have_common(ids, form.bare) &&
         (!spherical() || (n_hoop_directions(form.form) > 0 && form.is_symmetric(centre)));
}

template <int dim>
std::string AbsorbingBoundary<dim>::description() const
{
  return condition + " boundary on " + join(boundary_names);
}

template <int dim>
void Sponge<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  parameters.add_choice("Shape", shape, {"sphere", "plane"},
                        "Depth is measured from a sphere around 'Origin', or along 'Direction' from 'Origin'.");
  parameters.add_vector("Origin", origin, "m", "Centre of the sphere or point of reference.");
  parameters.add_vector("Direction", direction, "-", "Unit vector into the layer, for 'plane'.");
  parameters.add_quantity("Start", start, "m", any_value, "Distance from the origin where damping begins.");
  parameters.add_quantity("End", end, "m", any_value, "Distance from the origin of the outer boundary.");
  parameters.add_quantity("Target reflection", reflection, "-", {0., 1., true, true},
                          "Amplitude that returns from the end. Smaller values damp more and reflect more at the "
                          "start: waves that are longer "
                          "than the layer, and pulses with a mean.");
}

template <int dim>
void Sponge<dim>::finalize(const Parameters &parameters, const Geometry<dim> &)
{
  if (end <= start)
    parameters.refuse(path + "/End", "must be larger than 'Start'");
  if (shape == "plane" && direction.norm() == 0.)
    parameters.refuse(path + "/Direction", "a plane sponge needs a direction");
  if (direction.norm() > 0.)
    direction /= direction.norm();
}

template <int dim>
bool Sponge<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  form.shorten(parameters, path + "/Origin", origin);
  form.shorten(parameters, path + "/Direction", direction);
  return shape == "sphere" ? n_hoop_directions(form.form) > 0 && form.is_symmetric(origin)
                           : form.is_symmetric(direction);
}

template <int dim>
void Sponge<dim>::reinit(const Discretization<dim> &discretization, const NodalMass &mass,
                         const MaterialOfBlock &material)
{
  // mean wave speed of the cells around a node
  VectorType speed = discretization.new_scalar(), count = discretization.new_scalar();
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
      {
        const unsigned int node = discretization.cell_nodes(cell)[i];
        speed.local_element(node) += material(discretization.cells()[cell]->material_id()).p_wave_speed();
        count.local_element(node) += 1.;
      }
  speed.compress(VectorOperation::add);
  count.compress(VectorOperation::add);
  dashpots.clear();
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    {
      const Tensor<1, dim> x        = discretization.position(node) - Point<dim>(origin);
      const double         distance = shape == "plane" ? x * direction : x.norm();
      const double         s        = std::min(1., (distance - start) / (end - start));
      if (s > 0. && mass.condensed.local_element(node) > 0.)
        {
          const double strength =
            3. * speed.local_element(node) / count.local_element(node) * std::log(1. / reflection) / (end - start);
          dashpots.push_back(
            {node, strength * s * s * mass.condensed.local_element(node) * unit_symmetric_tensor<dim>()});
        }
    }
}

template <int dim>
std::vector<std::string> absorbing_boundaries(const std::vector<std::unique_ptr<Load<dim>>> &loads)
{
  std::vector<std::string> names;
  for (const auto &load : loads)
    if (const auto *boundary = dynamic_cast<const AbsorbingBoundary<dim> *>(load.get()))
      names.insert(names.end(), boundary->boundaries().begin(), boundary->boundaries().end());
  return names;
}

template std::vector<std::string> absorbing_boundaries(const std::vector<std::unique_ptr<Load<1>>> &);
template std::vector<std::string> absorbing_boundaries(const std::vector<std::unique_ptr<Load<2>>> &);
template std::vector<std::string> absorbing_boundaries(const std::vector<std::unique_ptr<Load<3>>> &);
template class AbsorbingBoundary<1>;
template class AbsorbingBoundary<2>;
template class AbsorbingBoundary<3>;
template class Sponge<1>;
template class Sponge<2>;
template class Sponge<3>;
} // namespace Arenite
