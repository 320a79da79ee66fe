#pragma once

#include <arenite/base/symmetry.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <string>
#include <vector>

namespace Arenite
{
/// A form in fewer dimensions that a scene may have. The parts of the scene, geometry first, are asked in turn whether they admit it:
/// whether what they do looks the same from all sides that the form takes for equal. Each enters here what the others must know.
///
/// Axis of revolution: z. Plane waves run along x, plane strain leaves out z. Centre: the origin.
struct Reduction
{
  using Boundaries = std::vector<dealii::types::boundary_id>;

  explicit Reduction(Symmetry form);

  Symmetry form;

  Boundaries cut;      ///< inside of the full body, where the form needs planes of symmetry
  Boundaries far;      ///< of another shape in the form: must absorb, so that it does not matter
  Boundaries bare;     ///< of another extent in the form: nothing may act there
  Boundaries absorbed; ///< entered by absorbing boundaries

  std::vector<std::string> changes; ///< "Section/Entry=value" that turn the scene into its form

  unsigned int dimension() const;

  /// Whether every one of @p ids is the same surface in the form.
  bool keeps(const Boundaries &ids) const;

  /// Whether a uniform vector or the centre of spheres looks the same from all equal sides.
  template <int dim>
  bool is_symmetric(const dealii::Tensor<1, dim> &vector) const;

  /// Coordinates of a mesh in @p dim dimensions that the form has too.
  std::vector<unsigned int> coordinates(unsigned int dim) const;

  /// Where the user has set a list of one word per coordinate of the mesh, it has fewer of them in the form.
  void shorten(const Parameters &, const std::string &path, const std::vector<std::string> &words);
  template <int dim>
  void shorten(const Parameters &, const std::string &path, const dealii::Tensor<1, dim> &vector);
};

/// Whether any of @p ids is among @p others.
bool have_common(const Reduction::Boundaries &ids, const Reduction::Boundaries &others);
} // namespace Arenite
