#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Arenite
{
/// Tensor product of a rule for the faces of dim-dimensional cells; a single point in one dimension.
template <int dim>
dealii::Quadrature<dim - 1> face_rule(const dealii::Quadrature<1> &line)
{
  if constexpr (dim == 1)
    return (void)line, dealii::QGauss<0>(1);
  else
    return dealii::Quadrature<dim - 1>(line);
}

/// Points per direction of the faces of elements of degree @p p.
inline dealii::Quadrature<1> face_points(const unsigned int p)
{
  return p == 1 ? dealii::Quadrature<1>(dealii::QGauss<1>(2)) : dealii::Quadrature<1>(dealii::QGaussLobatto<1>(p + 1));
}

/// Quadrature over the faces of named boundaries, on the geometry of the node positions.
///
/// visit(nodes, N, x, dA, material id of the cell) is called for each quadrature point of each owned face: local node numbers of the cell (lexicographic),
/// values of their shape functions, position, and the outward area vector n dA [m^2] of the body: that of the mesh times the measure of
/// kinematics.h, or without it when @p of_the_mesh. Spectral elements use the
/// Gauss-Lobatto points of the face (the rule of the cell; on cells with straight edges constant stress is then in equilibrium to round-off), trilinear
/// ones 2x2 Gauss points.
template <int dim, typename Visit>
void for_each_face_point(const Discretization<dim> &discretization, const std::vector<dealii::types::boundary_id> &ids,
                         const Visit &visit, const bool of_the_mesh = false)
{
  using namespace dealii;
  const unsigned int n    = discretization.nodes_per_cell();
  const auto         rule = face_rule<dim>(face_points(discretization.degree()));

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
            unit_normal[f / 2] = f % 2 ? 1. : -1.;
            Tensor<1, dim> dA  = rule.weight(q) * determinant(J) * (transpose(invert(J)) * unit_normal);
            if (!of_the_mesh)
              dA *= measure(discretization.symmetry, at);
            visit(discretization.cell_nodes(cell), &value[f][q * n], at, dA,
                  discretization.cells()[cell]->material_id());
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

/// integral of N_i q dS over boundaries, for K numbers q = integrand(x, dA, material id) that carry dS already: one entry per owned
/// node where the last of them is positive. Hanging nodes give theirs to their masters (row sums) or, without @p condense,
/// are left out; areas are then those of the mesh, which do not vanish on an axis.
template <std::size_t K, int dim, typename Integrand>
std::vector<NodeValue<std::array<double, K>>> integrate_on_boundary(const Discretization<dim> &discretization,
                                                                    const std::vector<dealii::types::boundary_id> &ids,
                                                                    const bool condense, const Integrand &integrand)
{
  std::vector<NodeValue<std::array<double, K>>> result;
  if (ids.empty())
    return result;
  std::vector<VectorType> sum;
  for (std::size_t k = 0; k < K; ++k)
    sum.emplace_back(discretization.node_partitioner);
  for_each_face_point(
    discretization, ids,
    [&](const unsigned int *nodes, const double *N, const dealii::Point<dim> &x, const dealii::Tensor<1, dim> &dA,
        const dealii::types::material_id id) {
      if (dA.norm_square() == 0.) // on the axis
        return;
      const std::array<double, K> q = integrand(x, dA, id);
      for (unsigned int i = 0; i < discretization.nodes_per_cell(); ++i)
        if (std::abs(N[i]) > 1e-12)
          for (std::size_t k = 0; k < K; ++k)
            sum[k].local_element(nodes[i]) += N[i] * q[k];
    },
    !condense);
  for (VectorType &vector : sum)
    {
      if (condense)
        discretization.hanging.template condense<1>(vector.begin());
      vector.compress(dealii::VectorOperation::add);
      if (!condense)
        zero_at_hanging_nodes(discretization, vector);
    }
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (sum[K - 1].local_element(node) > 0.)
      {
        result.push_back({node, {}});
        for (std::size_t k = 0; k < K; ++k)
          result.back().value[k] = sum[k].local_element(node);
      }
  return result;
}
} // namespace Arenite
