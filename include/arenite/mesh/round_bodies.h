#pragma once

#include <arenite/mesh/geometry.h>

namespace Arenite
{
/// Spherical shell a < r < b around the origin: the cavity scene. Layers in geometric progression keep the cells' aspect.
///
/// Axisymmetric: half a ring in the half-plane r > 0, or a quarter of it for the octant; spherical: the segment a < r < b. In plane
/// strain the body is a pipe. Boundaries keep their names, 'symmetry x' is the axis.
template <int dim>
class SphericalShell : public Geometry<dim>
{
public:
  SphericalShell();
  void   declare_parameters(Parameters &) override;
  void   finalize(const Parameters &) override;
  void   create(dealii::Triangulation<dim> &) const override;
  double symmetry_factor() const override;
  bool   admits(Reduction &, const Parameters &) const override;

private:
  std::string  sector = "octant", spacing = "geometric", path;
  double       inner_radius = 0.1, outer_radius = 0.4;
  unsigned int layers = 0;
};

/// Solid ball r < b around the origin, or its section as of SphericalShell. Cells are blended between the sphere and a flat core.
template <int dim>
class Ball : public Geometry<dim>
{
public:
  Ball();
  void   declare_parameters(Parameters &) override;
  void   create(dealii::Triangulation<dim> &) const override;
  double symmetry_factor() const override;
  bool   admits(Reduction &, const Parameters &) const override;

private:
  std::string sector = "octant";
  double      radius = 1.;
};

/// Solid circular cylinder along x, centred at the origin.
class Cylinder : public Geometry<3>
{
public:
  Cylinder();
  void declare_parameters(Parameters &) override;
  void create(dealii::Triangulation<3> &) const override;

private:
  double       radius = 0.1, length = 1.;
  unsigned int cells_along = 4;
};
} // namespace Arenite
