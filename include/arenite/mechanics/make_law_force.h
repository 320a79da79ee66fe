#pragma once

#include <arenite/materials/elasticity_at_rest.h>
#include <arenite/mechanics/law_force.h>

#include <deal.II/base/exceptions.h>

namespace Arenite
{
template <typename T>
struct TypeOf
{
  using type = T;
};

/// The kernel of an element with H hoop directions.
template <int dim, int n_hoop>
std::unique_ptr<InternalForce<dim>> make_law_kernel(const ElementChoice &element, const KinematicsChoice &kinematics,
                                                    std::unique_ptr<const BatchLaw>  law,
                                                    const dealii::types::material_id block, const Symmetry symmetry)
{
  constexpr int       W       = native_lanes;
  const LinearElastic at_rest = elasticity_at_rest(*law);
  const auto          make    = [&](auto kernel) -> std::unique_ptr<InternalForce<dim>> {
    using Element = typename decltype(kernel)::type;
    return std::make_unique<LawForce<Element, W>>(element, kinematics, std::move(law), at_rest, block, symmetry);
  };
  if (element.type == "spectral element")
    switch (element.degree)
      {
      case 1:
        if constexpr (dim < 3)
          return make(TypeOf<SpectralElement<dim, 1, n_hoop>>());
        break;
      case 2:
        return make(TypeOf<SpectralElement<dim, 2, n_hoop>>());
      case 3:
        return make(TypeOf<SpectralElement<dim, 3, n_hoop>>());
      case 4:
        return make(TypeOf<SpectralElement<dim, 4, n_hoop>>());
      }
  else if (element.type == "hexahedron" && element.volumetric_strain == "mean dilatation")
    return make(TypeOf<MeanDilatationElement<dim, n_hoop>>());
  else if (element.type == "hexahedron")
    return make(TypeOf<FullElement<dim, n_hoop>>());
  else if (element.type == "one-point hexahedron")
    return make(TypeOf<OnePointElement<dim, n_hoop>>());
  AssertThrow(false, dealii::ExcMessage("no kernel for element '" + element.type + "' of this degree"));
  return nullptr;
}

template <int dim>
std::unique_ptr<InternalForce<dim>> make_law_force(const ElementChoice &element, const KinematicsChoice &kinematics,
                                                   std::unique_ptr<const BatchLaw>  law,
                                                   const dealii::types::material_id block, const Symmetry symmetry)
{
  if constexpr (dim < 3)
    if (n_hoop_directions(symmetry) > 0)
      return make_law_kernel<dim, 3 - dim>(element, kinematics, std::move(law), block, symmetry);
  return make_law_kernel<dim, 0>(element, kinematics, std::move(law), block, symmetry);
}
} // namespace Arenite
