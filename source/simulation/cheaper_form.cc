#include <arenite/simulation/cheaper_form.h>

#include <algorithm>

namespace Arenite
{
namespace
{
std::vector<Symmetry> fewer_dimensions(const Symmetry symmetry)
{
  switch (symmetry)
    {
    case Symmetry::none:
      return {Symmetry::spherical, Symmetry::plane_wave, Symmetry::axisymmetric, Symmetry::plane_strain};
    case Symmetry::axisymmetric:
      return {Symmetry::spherical};
    case Symmetry::plane_strain:
      return {Symmetry::plane_wave};
    default:
      return {};
    }
}

template <int dim>
bool admits(const Scene<dim> &scene, Reduction &form, const Parameters &parameters)
{
  if (scene.blocks.size() != 1 || !scene.initial_velocity.at_rest() || !scene.mesh.geometry->admits(form, parameters) ||
      !scene.constraints.admits(form, parameters))
    return false;
  for (const auto &load : scene.loads)
    if (!load->admits(form, parameters))
      return false;
  for (const auto id : form.far)
    if (!have_common({id}, form.absorbed))
      return false;
  // solutions that are only compared with do not matter
  return !(scene.initial_state == "exact solution" || scene.constraints.follows_exact_solution()) ||
         (n_hoop_directions(form.form) > 0 && scene.exact_solution->is_radial());
}
} // namespace

template <int dim>
std::vector<Reduction> cheaper_forms(const Scene<dim> &scene, const Parameters &parameters)
{
  std::vector<Reduction> forms;
  for (const Symmetry symmetry : fewer_dimensions(scene.symmetry))
    if (Reduction form(symmetry); admits(scene, form, parameters))
      forms.push_back(form);
  return forms;
}

template std::vector<Reduction> cheaper_forms(const Scene<1> &, const Parameters &);
template std::vector<Reduction> cheaper_forms(const Scene<2> &, const Parameters &);
template std::vector<Reduction> cheaper_forms(const Scene<3> &, const Parameters &);
} // namespace Arenite
