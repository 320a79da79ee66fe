#pragma once

#include <arenite/base/parameters.h>
#include <arenite/base/reduction.h>
#include <arenite/base/registry.h>
#include <arenite/base/symmetry.h>

#include <deal.II/grid/tria.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// The coarse mesh of a scene and the names of its boundaries. A boundary's id is the position of its name in the list.
template <int dim>
class Geometry
{
public:
  virtual ~Geometry() = default;

  virtual void declare_parameters(Parameters &) = 0;
  virtual void finalize(const Parameters &) {}

  /// Fill an empty triangulation: cells, boundary and material ids, manifolds.
  virtual void create(dealii::Triangulation<dim> &) const = 0;

  /// How many copies of the modelled sector make up the full body.
  virtual double symmetry_factor() const { return 1.; }

  /// Whether the form is one of this body, whose boundaries are then entered. Not known is no.
  virtual bool admits(Reduction &, const Parameters &) const { return false; }

  const std::vector<std::string> &boundary_names() const { return names; }

  /// Ids of the boundaries in @p list, each once; refuses unknown names at @p path with the nearest known one.
  std::vector<dealii::types::boundary_id> boundary_ids(const Parameters &, const std::string &path,
                                                       const std::vector<std::string> &list) const;

  Symmetry symmetry = cartesian<dim>();

protected:
  std::vector<std::string> names;
};

template <int dim>
const Registry<Geometry<dim>> &geometries();

/// `subsection Mesh`: which geometry, and how finely it is divided.
template <int dim>
struct MeshChoice
{
  explicit MeshChoice(const Parameters &);

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  std::string                    type;
  std::unique_ptr<Geometry<dim>> geometry;
  unsigned int                   refinement      = 0; ///< global refinements of the coarse mesh
  bool                           refine_geometry = false;
};
} // namespace Arenite
