#pragma once

#include <arenite/materials/linear_elastic.h>
#include <arenite/mechanics/discretization.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <functional>

namespace Arenite
{
/// Law of the cells with a material id, as output and norms need it to turn strain into stress.
using MaterialOfBlock = std::function<LinearElastic(dealii::types::material_id)>;

/// Largest degree of an element.
constexpr unsigned int largest_degree = 9;

/// Shape functions of one point of the unit cell, kept as their 1-D factors: N_i(xi) = prod_d value[d][i_d].
template <int dim>
struct ShapeFactors
{
  std::array<std::array<double, largest_degree + 1>, dim> value, derivative;
};

/// Nodal fields between the nodes: each cell's own polynomial through its Gauss-Lobatto nodes, in field and geometry alike.
/// Works on the nodes of a Discretization that outlives it; must be built anew after a change of the mesh.
template <int dim>
class CellFields
{
public:
  /// Place of a point in a cell.
  struct Place
  {
    dealii::Point<dim> xi;                ///< in the unit cell, or outside of it
    bool               converged = false; ///< x(xi) is the point; false if the polynomial has no inverse there
  };

  /// Nearest point of a cell.
  struct Nearest
  {
    dealii::Point<dim> xi, x;
    double             distance;
  };

  explicit CellFields(const Discretization<dim> &);

  /// Values and derivatives (with respect to xi) of the shape functions; @p xi may lie outside of the unit cell.
  ShapeFactors<dim> shape(const dealii::Point<dim> &xi) const;

  dealii::Point<dim> position(unsigned int cell, const ShapeFactors<dim> &) const;

  /// J_ij = dx_i / dxi_j
  dealii::Tensor<2, dim> jacobian(unsigned int cell, const ShapeFactors<dim> &) const;

  /// Solve x(xi) = @p x by Newton's method from the node nearest to @p x.
  Place invert(unsigned int cell, const dealii::Point<dim> &x) const;

  /// Nearest point of the cell to @p x, by projected Gauss-Newton steps.
  Nearest nearest(unsigned int cell, const dealii::Point<dim> &x) const;

  /// Polynomial through the values at the nodes of a cell, which stand @p stride apart from @p nodal on.
  double interpolate(const double *nodal, std::size_t stride, const ShapeFactors<dim> &) const;

  /// Value of a vector field with valid ghosts and hanging nodes.
  dealii::Tensor<1, dim> value(const VectorType &, unsigned int cell, const ShapeFactors<dim> &) const;

  /// d field_i / d xi_j of such a field.
  dealii::Tensor<2, dim> reference_gradient(const VectorType &, unsigned int cell, const ShapeFactors<dim> &) const;

  /// d field_i / d x_j of such a field.
  dealii::Tensor<2, dim> gradient(const VectorType &, unsigned int cell, const ShapeFactors<dim> &) const;

  /// Small-strain elastic stress of a displacement [Pa], in three dimensions.
  dealii::SymmetricTensor<2, 3> stress(const LinearElastic &material, const VectorType &displacement,
                                       const unsigned int cell, const ShapeFactors<dim> &factors) const
  {
    return material.stress(full_gradient(discretization.symmetry, gradient(displacement, cell, factors),
                                         value(displacement, cell, factors), position(cell, factors)));
  }

  /// Box around the nodes of a cell, enlarged by a tenth of its longest side because curved cells leave it.
  dealii::BoundingBox<dim> enlarged_box(unsigned int cell) const;

  /// Longest side of the box around the nodes [m].
  double size(unsigned int cell) const;

  const Discretization<dim> &discretization;

private:
  unsigned int        n;                     ///< nodes per line
  std::vector<double> node, inverse_product; ///< 1-D nodes x_i and prod_{k != i} 1/(x_i - x_k)
};
} // namespace Arenite
