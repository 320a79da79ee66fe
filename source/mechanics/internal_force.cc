#include <arenite/mechanics/elastic_force.h>
#include <arenite/mechanics/point_motion.h>

namespace Arenite
{
BlockEnergy &BlockEnergy::operator+=(const BlockEnergy &other)
{
  strain += other.strain;
  hourglass += other.hourglass;
  dissipated += other.dissipated;
  bulk_viscosity += other.bulk_viscosity;
  volume_change += other.volume_change;
  note_hourglass(other.largest_hourglass, other.hourglass_cell);
  return *this;
}

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
  parameters.add_choice(
    "Volumetric strain", volumetric_strain, {"pointwise", "mean dilatation"},
    "Only hexahedra. With mean dilatation all points of a cell have its mean change of volume: nearly incompressible "
    "material does not lock.");
  parameters.add_quantity(
    "Linear bulk viscosity", linear_viscosity, "-", {0., 10., false, false},
    "b1 in q = rho l (b2^2 l |D| + b1 c) |D|, for blocks that are not linear elastic at small "
    "strain. Damps the ringing behind shocks; larger values widen waves and lower the stable step. Soil that compacts "
    "keeps the overshoot of its front for ever: give it 0.6, and 2 for the quadratic one.");
  parameters.add_quantity("Quadratic bulk viscosity", quadratic_viscosity, "-", {0., 10., false, false},
                          "b2: spreads strong shocks over a few cells. 0 with b1 = 0 switches the viscosity off.");
  parameters.add_flag("Bulk viscosity in expansion", viscosity_in_expansion,
                      "Let the linear part act in expansion, too: releases into yielding material do not ring.");
  parameters.add_choice(
    "Bulk viscosity form", viscosity_form, {"volumetric", "directional"},
    "Volumetric: a pressure over the rate of volume. Directional: a stress along the directions in which "
    "the mesh is compressed, for shocks in gas that converge or spread. At second order it also holds "
    "shear and the flow around a cavity back: cavities in soil are better off without.");
}

void KinematicsChoice::declare_parameters(Parameters &parameters)
{
  const std::vector<std::string> known{"small strain", "finite strain"};
  kinematics = parameters.peek_choice("Kinematics", kinematics, known); // decides which entries blocks have
  parameters.add_choice("Kinematics", kinematics, known,
                        "Strain measure. Finite strain: logarithmic increments on the deformed shape, Cauchy stress.");
  parameters.add_choice("Objective rate", rate, {"Jaumann", "Green-Naghdi"},
                        "How the stress turns at finite strain: with the spin, or with the polar rotation.");
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
  if (volumetric_strain == "mean dilatation" && type != "hexahedron")
    parameters.refuse("Element/Volumetric strain",
                      "'mean dilatation' is for 'Type = hexahedron'; one point has no other, and "
                      "higher degrees do not need it");
  if (type != "spectral element" && degree != 1)
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
