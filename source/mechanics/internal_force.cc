#include <arenite/mechanics/elastic_force.h>

namespace Arenite
{
void ElementChoice::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Element");
  parameters.add_choice("Type", type, {"one-point hexahedron", "hexahedron", "spectral element"},
                        "One-point hexahedra are the cheapest per cell, spectral elements the cheapest per accuracy in "
                        "smooth waves. In two "
                        "dimensions a hexahedron is a quadrilateral, in one a segment.");
  parameters.add_integer(
    "Degree", degree, 1, 4,
    "Polynomial degree: 1 for hexahedra, 2 to 4 for spectral elements, which may also have 1 in fewer "
    "than three dimensions.");
  parameters.add_choice(
    "Hourglass control", hourglass_control, {"stiffness", "viscous"},
    "Only one-point hexahedra. Stiffness keeps second order; viscous damps hourglass motion in flowing material.");
  parameters.add_quantity(
    "Hourglass coefficient", hourglass_coefficient, "-", {0., 0.2, false, false},
    "Strength of the hourglass control. Larger values stiffen bending and lower the stable step.");
}

void ElementChoice::finalize(const Parameters &parameters)
{
  if (type == "spectral element")
    {
      if (!parameters.is_set("Element/Degree"))
        degree = 4;
      if (degree < 2 && DimensionChoice(parameters).dimension == 3)
        parameters.refuse("Element/Degree", "spectral elements have degree 2, 3 or 4; degree 1 is 'Type = hexahedron'");
    }
  else if (degree != 1)
    parameters.refuse("Element/Degree", "'" + type + "' has degree 1; higher degrees need 'Type = spectral element'");
}

#define ARENITE_INSTANTIATE(dim)                                                                                 \
  template std::unique_ptr<InternalForce<dim>> make_elastic_force<dim, native_lanes>(const ElementChoice &,      \
                                                                                     const LinearElastic &,      \
                                                                                     dealii::types::material_id, \
                                                                                     const Symmetry);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
