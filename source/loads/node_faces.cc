#include <arenite/loads/boundary_faces.h>
#include <arenite/loads/node_faces.h>

namespace Arenite
{
using namespace dealii;

template <int dim>
std::vector<NodeFaces<dim>> faces_of_nodes(const Discretization<dim>             &discretization,
                                           const std::vector<types::boundary_id> &ids, const bool condense)
{
  constexpr unsigned int      n_entries = SymmetricTensor<2, dim>::n_independent_components, n = n_entries + dim + 1;
  std::vector<NodeFaces<dim>> result;
  for (const NodeValue<std::array<double, n>> &entry :
       integrate_on_boundary<n>(discretization, ids, condense,
                                [](const Point<dim> &, const Tensor<1, dim> &dA, const types::material_id) {
                                  std::array<double, n>   values;
                                  SymmetricTensor<2, dim> dyad;
                                  const double            dS = dA.norm();
                                  for (unsigned int i = 0; i < dim; ++i)
                                    for (unsigned int j = i; j < dim; ++j)
                                      dyad[i][j] = dA[i] * dA[j] / dS;
                                  for (unsigned int k = 0; k < n_entries; ++k)
                                    values[k] = dyad.access_raw_entry(k);
                                  for (unsigned int c = 0; c < dim; ++c)
                                    values[n_entries + c] = dA[c];
                                  values[n - 1] = dS;
                                  return values;
                                }))
    {
      NodeFaces<dim> faces{entry.node, {}, {}, entry.value[n - 1]};
      for (unsigned int k = 0; k < n_entries; ++k)
        faces.dyad.access_raw_entry(k) = entry.value[k];
      for (unsigned int c = 0; c < dim; ++c)
        faces.area[c] = entry.value[n_entries + c];
      result.push_back(faces);
    }
  return result;
}

template <int dim>
SymmetricTensor<2, dim> flexibility_where_held(const SymmetricTensor<2, dim> &K)
{
  SymmetricTensor<2, dim> inverse;
  for (const auto &[value, m] : eigenvectors(K))
    if (value > 1e-8 * trace(K))
      inverse += symmetrize(outer_product(m, m)) / value;
  return inverse;
}

template SymmetricTensor<2, 1>     flexibility_where_held(const SymmetricTensor<2, 1> &);
template SymmetricTensor<2, 2>     flexibility_where_held(const SymmetricTensor<2, 2> &);
template SymmetricTensor<2, 3>     flexibility_where_held(const SymmetricTensor<2, 3> &);
template std::vector<NodeFaces<1>> faces_of_nodes(const Discretization<1> &, const std::vector<types::boundary_id> &,
                                                  bool);
template std::vector<NodeFaces<2>> faces_of_nodes(const Discretization<2> &, const std::vector<types::boundary_id> &,
                                                  bool);
template std::vector<NodeFaces<3>> faces_of_nodes(const Discretization<3> &, const std::vector<types::boundary_id> &,
                                                  bool);
} // namespace Arenite
