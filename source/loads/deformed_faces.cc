#include <arenite/loads/boundary_faces.h>
#include <arenite/loads/deformed_faces.h>

#include <deal.II/base/tensor.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace Arenite
{
using namespace dealii;

namespace
{
/// n dA per dxi of a face whose normal points along the last direction of the right-handed system of its tangents.
template <int dim, std::size_t n_tangents>
Tensor<1, dim> area_vector(const std::array<Tensor<1, dim>, n_tangents> &t)
{
  if constexpr (dim == 1)
    return (void)t, Tensor<1, 1>({1.});
  else if constexpr (dim == 2)
    return cross_product_2d(t[0]);
  else
    return cross_product_3d(t[0], t[1]);
}

/// Sign of area_vector() on face @p f of a cell: +1 where it points outward.
template <int dim>
double outward_sign(const unsigned int f)
{
  const double side = f % 2 ? 1. : -1.;
  // the tangents of a face are the other directions in ascending order: with the normal in front, they are left-handed for y
  return f / 2 == 1 ? -side : side;
}
} // namespace

template <int dim>
void DeformedFaces<dim>::reinit(const Discretization<dim>             &new_discretization,
                                const std::vector<types::boundary_id> &ids)
{
  discretization = &new_discretization;
  make_shares();
  const unsigned int p = discretization->degree(), per_line = p + 1;
  face_nodes.clear();
  sign.clear();
  boundary.clear();
  sum.assign(ids.size(), {});
  for (unsigned int cell = 0; cell < discretization->cells().size(); ++cell)
    for (const unsigned int f : discretization->cells()[cell]->face_indices())
      {
        const auto &face = discretization->cells()[cell]->face(f);
        const auto  id   = face->at_boundary() ? std::find(ids.begin(), ids.end(), face->boundary_id()) : ids.end();
        if (id == ids.end())
          continue;
        boundary.push_back(id - ids.begin());
        unsigned int step = 1;
        for (unsigned int d = 0; d < f / 2; ++d)
          step *= per_line;
        for (unsigned int i = 0; i < discretization->nodes_per_cell(); ++i)
          if (i / step % per_line == (f % 2 ? p : 0)) // ascending i: lexicographic on the face
            face_nodes.push_back(discretization->cell_nodes(cell)[i]);
        sign.push_back(outward_sign<dim>(f));
      }
  area.reinit(discretization->vector_partitioner);
  find_nodes();
}

/// Products of the shape functions along the lines of the face.
template <int dim>
void DeformedFaces<dim>::make_shares()
{
  const unsigned int p = discretization->degree(), per_line = p + 1;
  const FE_Q<1>      line(QGaussLobatto<1>(p + 1)); // of the element's nodes
  const auto         of_line = FETools::lexicographic_to_hierarchic_numbering<1>(p);
  const auto         rule    = face_rule<dim>(face_points(p));
  weight                     = rule.get_weights();
  n                          = Utilities::pow(per_line, dim - 1);
  position.resize(n);
  part.resize(n);
  shares.clear();
  start.assign(1, 0);
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      for (unsigned int a = 0; a < n; ++a)
        {
          Share share{a, 1., {}};
          share.slope.fill(dim == 1 ? 0. : 1.);
          if constexpr (dim > 1)
            for (unsigned int k = 0, i = a; k < dim - 1; ++k, i /= per_line)
              {
                const Point<1>     xi(rule.point(q)[k]);
                const unsigned int index = of_line[i % per_line];
                const double       value = line.shape_value(index, xi);
                share.value *= value;
                for (unsigned int d = 0; d < dim - 1; ++d)
                  share.slope[d] *= d == k ? line.shape_grad(index, xi)[0] : value;
              }
          double largest = std::abs(share.value);
          for (const double slope : share.slope)
            largest = std::max(largest, std::abs(slope));
          if (largest > 1e-12)
            shares.push_back(share);
        }
      start.push_back(shares.size());
    }
}

/// Nodes that can carry an area: those of the faces, the masters of hanging ones, and what of both lies on other processes.
template <int dim>
void DeformedFaces<dim>::find_nodes()
{
  // marks without relation to each other, so that no sum of them over hanging nodes cancels
  std::mt19937                     random;
  std::uniform_real_distribution<> number(0.5, 1.);
  VectorType                       mark = discretization->new_scalar();
  for (const unsigned int node : face_nodes)
    mark.local_element(node) = number(random);
  discretization->hanging.template condense<1>(mark.begin());
  const auto is_marked = [&](const unsigned int node) { return std::abs(mark.begin()[node]) > 1e-10; };
  touched_nodes.clear();
  for (unsigned int node = 0; node < discretization->n_local_nodes(); ++node)
    if (is_marked(node))
      touched_nodes.push_back(node);
  mark.compress(VectorOperation::add);
  owned_nodes.clear();
  for (unsigned int node = 0; node < discretization->n_owned_nodes(); ++node)
    if (is_marked(node))
      owned_nodes.push_back(node);
  touched_nodes.insert(touched_nodes.end(), owned_nodes.begin(), owned_nodes.end());
}

template <int dim>
const VectorType &DeformedFaces<dim>::areas(const VectorType &displacement)
{
  double       *A = area.begin();
  const double *X = discretization->positions.begin(), *u = displacement.begin();
  for (const unsigned int node : touched_nodes)
    std::fill_n(A + dim * node, dim, 0.);
  std::fill(sum.begin(), sum.end(), Resultant<dim>());
  for (unsigned int face = 0; face < sign.size(); ++face)
    {
      const unsigned int *nodes = &face_nodes[face * n];
      for (unsigned int a = 0; a < n; ++a)
        {
          for (unsigned int c = 0; c < dim; ++c)
            position[a][c] = X[dim * nodes[a] + c] + u[dim * nodes[a] + c];
          part[a] = Tensor<1, dim>();
        }
      for (unsigned int q = 0; q < weight.size(); ++q)
        {
          Point<dim>                             x;
          std::array<Tensor<1, dim>, n_tangents> t;
          for (unsigned int s = start[q]; s < start[q + 1]; ++s)
            for (unsigned int c = 0; c < dim; ++c)
              {
                const double value = position[shares[s].node][c];
                x[c] += shares[s].value * value;
                for (unsigned int k = 0; k < n_tangents; ++k)
                  t[k][c] += shares[s].slope[k] * value;
              }
          const Tensor<1, dim> dA = sign[face] * weight[q] * measure(discretization->symmetry, x) * area_vector<dim>(t);
          sum[boundary[face]] += {dA, dA.norm()};
          for (unsigned int s = start[q]; s < start[q + 1]; ++s)
            part[shares[s].node] += shares[s].value * dA;
        }
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          A[dim * nodes[a] + c] += part[a][c];
    }
  discretization->hanging.template condense<dim>(A);
  area.compress(VectorOperation::add);
  return area;
}

template class DeformedFaces<1>;
template class DeformedFaces<2>;
template class DeformedFaces<3>;
} // namespace Arenite
