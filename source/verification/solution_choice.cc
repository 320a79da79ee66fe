#include <arenite/verification/free_vibration.h>
#include <arenite/verification/manufactured.h>
#include <arenite/verification/plane_wave.h>
#include <arenite/verification/solution_choice.h>
#include <arenite/verification/spherical_cavity.h>
#include <arenite/verification/surface_motion.h>

namespace Arenite
{
using namespace dealii;

template <int dim>
void SolutionChoice<dim>::declare_parameters(Parameters &parameters)
{
  const auto section = parameters.section("Verification");
  parameters.add_choice(
    "Exact solution", type,
    {"none", "spherical cavity", "plane wave", "breathing mode", "torsion mode", "Lame mode", "shear mode",
     "Rayleigh mode", "buried cavity", "surface load", "manufactured cube", "manufactured shell"},
    "Closed form to compare with; those of the buried cavity and the surface load hold for "
    "displacements of the surface. The waves take their pressure from the scene's first pressure load; manufactured "
    "solutions add their body force.");
  parameters.add_quantity("Inner radius", inner_radius, "m", non_negative,
                          "Cavity radius, or inner radius of a vibrating shell (0: ball).");
  parameters.add_quantity("Load radius", load_radius, "m", positive, "Of the disc that a surface load acts on.");
  parameters.add_quantity("Depth", depth, "m", positive, "Of a buried cavity's centre below the surface.");
  parameters.add_quantity("Outer radius", outer_radius, "m", positive, "Radius of a vibrating ball or shell.");
  parameters.add_quantity("Side", side, "m", positive,
                          "Side of the cube, height of the layer, half of a Rayleigh wave.");
  parameters.add_quantity("Amplitude", amplitude, "m", positive,
                          "Largest displacement of a mode or manufactured solution.");
  parameters.add_quantity("Angular frequency", frequency, "1/s", positive, "Of a manufactured solution.");
  parameters.add_integer("Mode", mode, 1, 100, "Number of the mode, from 1.");
}

/// Whether the motion is one that the symmetry allows: radial around a point, or in the directions of a Cartesian mesh.
template <int dim>
bool SolutionChoice<dim>::fits(const Symmetry symmetry) const
{
  if (type == "none" || symmetry == Symmetry::none)
    return true;
  if (type == "spherical cavity" || type == "breathing mode" || type == "manufactured shell")
    return n_hoop_directions(symmetry) > 0;
  if (type == "buried cavity" || type == "surface load")
    return symmetry == Symmetry::axisymmetric;
  if (type == "Lame mode" || type == "shear mode" || type == "Rayleigh mode")
    return symmetry == Symmetry::plane_strain;
  return n_hoop_directions(symmetry) == 0 && type != "torsion mode";
}

template <int dim>
std::shared_ptr<const ExactSolution<dim>> SolutionChoice<dim>::make(const Parameters                  &parameters,
                                                                    const LinearElastic               &material,
                                                                    std::shared_ptr<const TimeHistory> pressure,
                                                                    const Symmetry                     symmetry) const
{
  const std::string entry = "Verification/Exact solution";
  if (!fits(symmetry))
    parameters.refuse(entry, "is no motion of a scene with 'Symmetry = " + name(symmetry) + "'");
  if ((type == "spherical cavity" || type == "plane wave" || type == "buried cavity" || type == "surface load") &&
      !pressure)
    parameters.refuse(entry, "needs a load of type 'pressure' in the scene");
  if ((type == "spherical cavity" || type == "manufactured shell") && inner_radius == 0.)
    parameters.refuse("Verification/Inner radius", "must be positive for '" + type + "'");
  if (type == "spherical cavity")
    return std::make_shared<SphericalCavity<dim>>(material, inner_radius, pressure);
  if (type == "buried cavity")
    {
      if (depth <= inner_radius)
        parameters.refuse("Verification/Depth", "must be larger than 'Inner radius'");
      if constexpr (dim > 1)
        return std::make_shared<BuriedCavityMotion<dim>>(material, inner_radius, depth, pressure);
    }
  if constexpr (dim > 1)
    if (type == "surface load")
      {
        if (pressure->regularity() < 0 || pressure->break_points().size() < 2)
          parameters.refuse(entry,
                            "needs a pressure that rises without a jump and in finite time, such as 'C3 step' or "
                            "'sin^n pulse'");
        return std::make_shared<SurfaceLoadMotion<dim>>(material, load_radius, pressure);
      }
  if (type == "plane wave")
    {
      auto wave = std::make_shared<PlaneWave<dim>>(material, pressure);
      wave->finalize();
      return wave;
    }
  std::shared_ptr<FreeVibration<dim>> vibration;
  if (type == "breathing mode")
    {
      if (inner_radius >= outer_radius)
        parameters.refuse("Verification/Outer radius", "must be larger than 'Inner radius'");
      vibration = std::make_shared<BreathingMode<dim>>(material, inner_radius, outer_radius, mode);
    }
  if constexpr (dim > 1)
    {
      if (type == "Lame mode")
        vibration = std::make_shared<LameMode<dim>>(material, side, mode);
      else if (type == "shear mode")
        vibration = std::make_shared<ShearMode<dim>>(material, side, mode);
      else if (type == "Rayleigh mode")
        vibration = std::make_shared<RayleighMode<dim>>(material, side, mode);
    }
  if constexpr (dim == 3)
    if (type == "torsion mode")
      vibration = std::make_shared<TorsionMode>(material, outer_radius, mode);
  if (vibration)
    {
      vibration->amplitude = amplitude;
      vibration->finalize();
      return vibration;
    }
  if (type == "manufactured cube")
    {
      Tensor<1, dim> d, k;
      for (unsigned int i = 0; i < dim; ++i)
        {
          d[i] = amplitude * (1. - 0.3 * i);
          k[i] = numbers::PI / side;
        }
      return std::make_shared<ManufacturedCube<dim>>(material, d, k, frequency, 0.4);
    }
  if (type == "manufactured shell")
    {
      typename ManufacturedShell<dim>::Motion motion;
      motion.breathing           = amplitude;
      motion.twist               = dim == 3 ? amplitude / inner_radius : 0.;
      motion.breathing_number    = 2. / inner_radius;
      motion.twist_number        = 1.5 / inner_radius;
      motion.breathing_frequency = frequency;
      motion.twist_frequency     = 0.8 * frequency;
      return std::make_shared<ManufacturedShell<dim>>(material, inner_radius, motion);
    }
  return nullptr;
}

template class SolutionChoice<1>;
template class SolutionChoice<2>;
template class SolutionChoice<3>;
} // namespace Arenite
