#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <vector>

namespace Arenite
{
/// Quadrature over the faces of named boundaries, on the geometry of the node positions.
///
/// visit(nodes, N, x, dA) is called for each quadrature point of each owned face: local node numbers of the cell (lexicographic),
/// values of their shape functions, position, and the outward area vector n dA [m^2]. Spectral elements use the
/// Gauss-Lobatto points of the face (the rule of the cell, so that constant stress is in equilibrium to round-off), trilinear
/// ones 2x2 Gauss points.
template <int dim, typename Visit>
void for_each_face_point(const Discretization<dim> &discretization, const std::vector<dealii::types::boundary_id> &ids,
                         const Visit &visit)
{
  using namespace dealii;
  const unsigned int        p = discretization.degree(), n = discretization.nodes_per_cell();
  const Quadrature<1>       line = p == 1 ? Quadrature<1>(QGauss<1>(2)) : Quadrature<1>(QGaussLobatto<1>(p + 1));
  const Quadrature<dim - 1> rule(line);

  // shape functions at the points of each face of the unit cell
  std::vector<std::vector<double>>         value(2 * dim, std::vector<double>(rule.size() * n));
  std::vector<std::vector<Tensor<1, dim>>> gradient(2 * dim, std::vector<Tensor<1, dim>>(rule.size() * n));
  for (unsigned int f = 0; f < 2 * dim; ++f)
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        Point<dim> xi;
        for (unsigned int d = 0, k = 0; d < dim; ++d)
          xi[d] = d == f / 2 ? f % 2 : rule.point(q)[k++];
        for (unsigned int i = 0; i < n; ++i)
          {
            value[f][q * n + i]    = discretization.fe.shape_value(discretization.lexicographic[i], xi);
            gradient[f][q * n + i] = discretization.fe.shape_grad(discretization.lexicographic[i], xi);
          }
      }

  std::vector<Point<dim>> x;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    for (const unsigned int f : discretization.cells()[cell]->face_indices())
      {
        const auto &face = discretization.cells()[cell]->face(f);
        if (!face->at_boundary() || std::find(ids.begin(), ids.end(), face->boundary_id()) == ids.end())
          continue;
        discretization.cell_positions(cell, x);
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point<dim>     at;
            Tensor<2, dim> J;
            for (unsigned int i = 0; i < n; ++i)
              {
                at += value[f][q * n + i] * x[i];
                J += outer_product(x[i], gradient[f][q * n + i]);
              }
            // n dA = det(J) J^-T N: the column of the cofactor matrix that belongs to the face's direction
            Tensor<1, dim> unit_normal;
            unit_normal[f / 2]      = f % 2 ? 1. : -1.;
            const Tensor<1, dim> dA = rule.weight(q) * determinant(J) * (transpose(invert(J)) * unit_normal);
            visit(discretization.cell_nodes(cell), &value[f][q * n], at, dA);
          }
      }
}

/// One entry per owned node of a nodal list.
template <typename Value>
struct NodeValue
{
  unsigned int node;
  Value        value;
};
} // namespace Arenite
