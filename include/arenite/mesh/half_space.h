#pragma once

#include <arenite/mesh/geometry.h>

#include <string>
#include <vector>

namespace Arenite
{
/// Half-space with a spherical cavity below its surface: the quarter x, y > 0, or the meridian plane r > 0. The cavity's centre is the
/// origin, the last coordinate points up, the surface lies at z = depth.
///
/// A cube-shaped core [-s, s] around the cavity, halfway between cavity and surface and at most twice the radius, is blended
/// between sphere and faces; around it bricks, as wide as the core's half-side s next to it and longer by the factor `Growth` from one
/// to the next, out to the distance `Outer distance` at the sides and below.
template <int dim>
class HalfSpace : public Geometry<dim>
{
public:
  HalfSpace();
  void   declare_parameters(Parameters &) override;
  void   finalize(const Parameters &) override;
  void   create(dealii::Triangulation<dim> &) const override;
  double symmetry_factor() const override;

  /// Turned around the z axis the brick of the mesh becomes a cylinder.
  bool admits(Reduction &form, const Parameters &parameters) const override
  {
    if (dim < 3 || form.form != Symmetry::axisymmetric)
      return false;
    form.cut  = this->boundary_ids(parameters, path, {"symmetry x", "symmetry y"});
    form.far  = this->boundary_ids(parameters, path, {"outer"});
    form.bare = this->boundary_ids(parameters, path, {"surface"});
    return true;
  }

private:
  double      radius = 0.1, depth = 0.5, outer_distance = 2., growth = 1.2;
  std::string path;

  double              core() const; ///< s [m]
  std::vector<double> lines(bool upwards) const;
};

/// Half-space z < 0 under a load on its surface: the meridian plane with a disc r < R around the origin, or half of a plane with a
/// strip (plane strain). The last coordinate points up.
///
/// Rectangles: square ones under the load, from there on longer by the factor `Growth` from one to the next, out to the distance
/// `Outer distance` at the side and below.
class LoadedHalfSpace : public Geometry<2>
{
public:
  LoadedHalfSpace() { names = {"load", "surface", "outer", "symmetry x"}; }
  void declare_parameters(Parameters &) override;
  void finalize(const Parameters &) override;
  void create(dealii::Triangulation<2> &) const override;

private:
  double       radius = 0.1, outer_distance = 2., growth = 1.;
  unsigned int across = 1; ///< cells under the load
  std::string  path;
};
} // namespace Arenite
