#pragma once

#include <arenite/base/parameters.h>

#include <string>

namespace Arenite
{
/// What a mesh of fewer dimensions stands for in three.
///
///   dimension  symmetry       coordinates      the body
///   3          none           x, y, z
///   2          plane strain   x, y             one metre along z, no motion along z
///   2          axisymmetric   r, z             the meridian half-plane r >= 0 turned around the z axis, no motion around it
///   1          plane wave     x                one square metre along y and z, uniaxial strain
///   1          spherical      r                all directions of r >= 0
///
/// The first coordinate of axisymmetric and spherical meshes is the radius; components without a coordinate of the mesh follow
/// after those with one: stresses are rr, zz, tt (theta) and rr, tt, pp (theta, phi).
enum class Symmetry
{
  none,
  plane_strain,
  axisymmetric,
  plane_wave,
  spherical
};

/// Symmetry of a Cartesian mesh.
template <int dim>
constexpr Symmetry cartesian()
{
  return dim == 3 ? Symmetry::none : (dim == 2 ? Symmetry::plane_strain : Symmetry::plane_wave);
}

/// Directions along which a material line is a circle around the axis or centre: its strain is u_r/r.
constexpr unsigned int n_hoop_directions(const Symmetry symmetry)
{
  return symmetry == Symmetry::axisymmetric ? 1 : (symmetry == Symmetry::spherical ? 2 : 0);
}

/// Components of a stress tensor that need not vanish in dim dimensions: the first of xx, yy, zz, xy, xz, yz, the order of
/// dealii::SymmetricTensor<2, 3>.
constexpr unsigned int n_stress_components(const int dim) { return dim == 3 ? 6 : (dim == 2 ? 4 : 3); }

/// `Dimension` and `Symmetry` of a scene, before anything else of it exists.
struct DimensionChoice
{
  /// Reads both entries; refuses unknown ones and pairs that do not belong together.
  explicit DimensionChoice(const Parameters &);

  unsigned int dimension;
  Symmetry     symmetry;
};

/// Words of `set Symmetry`, in the order of the enumeration.
const std::vector<std::string> &symmetry_names();

/// "plane strain" ...
std::string name(Symmetry);

/// Letters of the three directions: "xyz", "rzt", "rtp".
const char *direction_letters(Symmetry);

/// What masses, energies and forces of the body count for: "", "/m" (one metre along z) or "/m^2".
std::string per_extent(Symmetry);

/// Place of a point of the body (x, y, z) in the mesh. Axis of rotation: z.
template <int dim>
dealii::Point<dim> reduce(Symmetry, const dealii::Point<3> &);
} // namespace Arenite
