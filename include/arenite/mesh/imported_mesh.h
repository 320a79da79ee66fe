#pragma once

#include <arenite/mesh/geometry.h>

namespace Arenite
{
/// Hexahedra, or quadrilaterals in two dimensions, from a Gmsh file (format 2.2 or 4.1). deal.II reads damaged meshes without a word, so the mesh is audited:
/// only hexahedra, positive Jacobians at all corners, no vertices that lie on each other without being the same.
template <int dim>
class ImportedMesh : public Geometry<dim>
{
public:
  void declare_parameters(Parameters &) override;
  void finalize(const Parameters &) override;
  void create(dealii::Triangulation<dim> &) const override;

private:
  std::string                file, path;
  std::vector<std::string>   boundary_list; ///< "id: name"
  double                     scale = 1.;
  dealii::Triangulation<dim> mesh; ///< read and audited in finalize()
};
} // namespace Arenite
