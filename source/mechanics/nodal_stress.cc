#include <arenite/mechanics/nodal_stress.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
/// [i][j] = l_j'(x_i) of the Lagrange polynomials on the Gauss-Lobatto points.
FullMatrix<double> derivative_matrix(const unsigned int degree)
{
  const auto         points = QGaussLobatto<1>(degree + 1).get_points();
  const auto         basis  = Polynomials::generate_complete_Lagrange_basis(points);
  FullMatrix<double> matrix(degree + 1);
  for (unsigned int i = 0; i <= degree; ++i)
    for (unsigned int j = 0; j <= degree; ++j)
      {
        std::vector<double> value_and_derivative(2);
        basis[j].value(points[i][0], value_and_derivative);
        matrix(i, j) = value_and_derivative[1];
      }
  return matrix;
}

/// Derivatives of nodal vectors f along the reference directions at lexicographic node n: [i][d] = d f_i / d xi_d.
template <int dim>
Tensor<2, dim> reference_gradient(const FullMatrix<double> &derivative, const std::vector<Tensor<1, dim>> &f,
                                  const unsigned int n)
{
  Tensor<2, dim>     gradient;
  const unsigned int n_1d   = derivative.m();
  unsigned int       stride = 1;
  for (unsigned int d = 0; d < dim; ++d, stride *= n_1d)
    {
      const unsigned int c = n / stride % n_1d, line = n - c * stride;
      for (unsigned int m = 0; m < n_1d; ++m)
        for (unsigned int i = 0; i < dim; ++i)
          gradient[i][d] += derivative(c, m) * f[line + m * stride][i];
    }
  return gradient;
}
} // namespace

double pressure(const SymmetricTensor<2, 3> &stress) { return -trace(stress) / 3.; }

double von_mises_stress(const SymmetricTensor<2, 3> &stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

namespace
{
/// Sums over cells become means; ghosts and hanging nodes follow.
template <int dim>
void divide(const Discretization<dim> &discretization, VectorType &sum, const VectorType &count)
{
  sum.compress(VectorOperation::add);
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (count.local_element(node) > 0.)
      sum.local_element(node) /= count.local_element(node);
  make_consistent(discretization, sum);
}
} // namespace

template <int dim>
NodalStress<dim> nodal_stress(const Discretization<dim> &discretization, const VectorType &displacement,
                              const std::vector<LinearElastic> &materials, const StoredFields<dim> &stored,
                              std::vector<VectorType> *others)
{
  NodalStress<dim> sums;
  for (VectorType &component : sums)
    component.reinit(discretization.node_partitioner);
  VectorType count = discretization.new_scalar(), stored_count = count;
  if (others)
    others->assign(stored.names.size(), count);

  const FullMatrix<double>    derivative = derivative_matrix(discretization.degree());
  const unsigned int          n_nodes    = discretization.nodes_per_cell();
  std::vector<Tensor<1, dim>> x(n_nodes), u(n_nodes);
  std::vector<double>         values;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      const unsigned int *nodes = discretization.cell_nodes(cell);
      if (stored.values && stored.values(cell, values))
        {
          const std::size_t n_values = values.size() / n_nodes;
          for (unsigned int n = 0; n < n_nodes; ++n)
            {
              for (unsigned int k = 0; k < sums.size(); ++k)
                sums[k].local_element(nodes[n]) += values[n * n_values + k];
              for (unsigned int k = 0; others && k < others->size(); ++k)
                (*others)[k].local_element(nodes[n]) += values[n * n_values + 6 + k];
              count.local_element(nodes[n]) += 1.;
              stored_count.local_element(nodes[n]) += 1.;
            }
          continue;
        }
      const LinearElastic &material =
        materials.size() == 1 ? materials.front() : materials.at(discretization.cells()[cell]->material_id());
      for (unsigned int n = 0; n < n_nodes; ++n)
        for (unsigned int i = 0; i < dim; ++i)
          {
            x[n][i] = discretization.positions.local_element(dim * nodes[n] + i);
            u[n][i] = displacement.local_element(dim * nodes[n] + i);
          }
      for (unsigned int n = 0; n < n_nodes; ++n)
        {
          const Tensor<2, dim>        jacobian = reference_gradient(derivative, x, n);
          const Tensor<2, dim>        gradient = reference_gradient(derivative, u, n) * invert(jacobian);
          const SymmetricTensor<2, 3> stress =
            material.stress(full_gradient(discretization.symmetry, gradient, u[n], Point<dim>(x[n])));
          for (unsigned int k = 0; k < sums.size(); ++k)
            sums[k].local_element(nodes[n]) += stress.access_raw_entry(k);
          count.local_element(nodes[n]) += 1.;
        }
    }

  count.compress(VectorOperation::add);
  stored_count.compress(VectorOperation::add);
  for (VectorType &component : sums)
    divide(discretization, component, count);
  for (unsigned int k = 0; others && k < others->size(); ++k)
    divide(discretization, (*others)[k], stored_count);
  if constexpr (dim == 2)
    for (unsigned int node = 0; node < discretization.n_local_nodes(); ++node)
      if (discretization.on_axis(node))
        sums[3].local_element(node) = 0.; // the shear stress rz is odd there
  return sums;
}

template NodalStress<1> nodal_stress(const Discretization<1> &, const VectorType &, const std::vector<LinearElastic> &,
                                     const StoredFields<1> &, std::vector<VectorType> *);
template NodalStress<2> nodal_stress(const Discretization<2> &, const VectorType &, const std::vector<LinearElastic> &,
                                     const StoredFields<2> &, std::vector<VectorType> *);
template NodalStress<3> nodal_stress(const Discretization<3> &, const VectorType &, const std::vector<LinearElastic> &,
                                     const StoredFields<3> &, std::vector<VectorType> *);
} // namespace Arenite
