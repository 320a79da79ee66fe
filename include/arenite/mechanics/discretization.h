#pragma once

#include <arenite/mechanics/kinematics.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace Arenite
{
/// Nodal vectors: `dim` consecutive entries per node, or one (boundary scalars). Entry of component c of local node n: dim n + c.
using VectorType = dealii::LinearAlgebra::distributed::Vector<double>;

/// Hanging nodes as an explicit list in local node numbers: u_h = sum_m c_m u_m over its masters, f_m += c_m f_h. On the axis of a
/// body of revolution also nodes without mass, see even_line_weights(). The radial component of vectors is odd there and has weights
/// of its own, the others and scalars are even.
class HangingNodes
{
public:
  struct Master
  {
    unsigned int node;
    double       weight, radial_weight;
  };

  void clear(bool with_radial_weights);
  void add(unsigned int node, const std::vector<Master> &masters);

  /// Lines before this one have masters on this process only; they can be resolved before ghost values arrive.
  unsigned int n_local = 0;
  unsigned int size() const { return static_cast<unsigned int>(nodes.size()); }

  template <int dim>
  void interpolate(double *u, unsigned int begin, unsigned int end) const;
  template <int dim>
  void interpolate(double *u) const
  {
    interpolate<dim>(u, 0, size());
  }
  /// Move the forces of hanging nodes to their masters; the hanging entries become zero.
  template <int dim>
  void condense(double *f) const;

  const std::vector<unsigned int> &list() const { return nodes; }

  /// Of the node at @p line of the list.
  std::vector<Master> masters(unsigned int line) const;

  /// True if @p node hangs and one of its masters is owned by another process.
  bool depends_on_ghosts(unsigned int node) const;

private:
  /// Weights of the first component of a vector.
  const double *first_weights() const { return radial_weight.empty() ? weight.data() : radial_weight.data(); }

  std::vector<unsigned int> nodes, start{0}, master;
  std::vector<double>       weight, radial_weight; ///< the second empty where both are the same
  bool                      with_radial_weights = false;
};

/// Nodes, geometry and parallel layout of one mesh: what kernels, loads, receivers and output share.
///
/// The geometry is the vector of node positions x = C x and nothing else: every cell is the polynomial through its
/// Gauss-Lobatto nodes. The triangulation only knows the topology, so that refined cells can keep the shape of their parents.
template <int dim>
class Discretization
{
public:
  using Triangulation = dealii::Triangulation<dim>;
  using CellIterator  = typename dealii::DoFHandler<dim>::active_cell_iterator;

  Discretization(Triangulation &, unsigned int degree, Symmetry = cartesian<dim>());

  /// Number the nodes of the present mesh and build the layout; positions are left zero.
  void distribute_nodes();

  /// Positions from the manifolds of the triangulation (MappingQ of the element's degree), made consistent at hanging nodes.
  void positions_from_manifolds();

  /// Replace each position of an unconstrained node by map(position), then make hanging nodes consistent.
  void transform(const std::function<dealii::Point<dim>(const dealii::Point<dim> &)> &map);

  unsigned int degree() const { return fe.degree; }
  unsigned int nodes_per_cell() const { return fe.n_dofs_per_cell(); }

  /// Owned active cells in an order that depends on nothing but the mesh, and their local node numbers in lexicographic order.
  const std::vector<CellIterator> &cells() const { return cell_list; }
  const unsigned int *cell_nodes(const unsigned int cell) const { return &node_table[cell * nodes_per_cell()]; }

  unsigned int n_owned_nodes() const { return node_partitioner->locally_owned_size(); }
  unsigned int n_local_nodes() const { return n_owned_nodes() + node_partitioner->n_ghost_indices(); }
  dealii::types::global_dof_index n_nodes() const { return dofs.n_dofs(); }

  VectorType new_vector() const { return VectorType(vector_partitioner); }
  VectorType new_scalar() const { return VectorType(node_partitioner); }

  dealii::Point<dim> position(const unsigned int node) const;
  /// A node without radial motion: r = 0 to the last bit, in the symmetries that have an axis or centre.
  bool on_axis(const unsigned int node) const
  {
    return n_hoop_directions(symmetry) > 0 && positions.local_element(dim * node) == 0.;
  }

  /// After the owned entries of the positions have changed: nodes within round-off of the axis lie on it, and all is consistent.
  void complete_positions();

  /// Node coordinates of one cell, lexicographic.
  void cell_positions(unsigned int cell, std::vector<dealii::Point<dim>> &x) const;

  const MPI_Comm            communicator;
  Triangulation            &triangulation;
  const Symmetry            symmetry;
  const dealii::FE_Q<dim>   fe;
  dealii::DoFHandler<dim>   dofs;          ///< one scalar unknown per node
  std::vector<unsigned int> lexicographic; ///< deal.II's cell-wise number of lexicographic node i
  HangingNodes              hanging;
  VectorType                positions; ///< ghosts always up to date, hanging nodes consistent
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> node_partitioner, vector_partitioner;

private:
  void number_by_cells();
  void add_axis_lines(dealii::AffineConstraints<double> &) const;
  void make_hanging_nodes(const std::vector<dealii::types::global_dof_index> &lines,
                          const dealii::AffineConstraints<double>            &constraints,
                          const dealii::AffineConstraints<double>            &radial);

  std::vector<CellIterator> cell_list;
  std::vector<unsigned int> node_table;
};

/// Exchange ghosts of a nodal vector, then fill its hanging nodes.
template <int dim>
void make_consistent(const Discretization<dim> &, VectorType &);

/// Owned entries at hanging nodes become zero: they are not unknowns, so sums over nodes and the update must not see them.
template <int dim>
void zero_at_hanging_nodes(const Discretization<dim> &, VectorType &);

/// Copy with the ghost entries: deal.II's constructors and assignments leave out what waits there for compress().
inline void copy_with_ghosts(const VectorType &from, VectorType &to)
{
  to.reinit(from.get_partitioner());
  std::copy_n(from.begin(), from.locally_owned_size() + from.get_partitioner()->n_ghost_indices(), to.begin());
}

template <int dim>
void HangingNodes::interpolate(double *u, const unsigned int begin, const unsigned int end) const
{
  const double *first = dim == 1 ? weight.data() : first_weights();
  for (unsigned int h = begin; h < end; ++h)
    {
      double sum[dim] = {};
      for (unsigned int k = start[h]; k < start[h + 1]; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += (c == 0 ? first : weight.data())[k] * u[dim * master[k] + c];
      for (unsigned int c = 0; c < dim; ++c)
        u[dim * nodes[h] + c] = sum[c];
    }
}

template <int dim>
void HangingNodes::condense(double *f) const
{
  const double *first = dim == 1 ? weight.data() : first_weights();
  for (unsigned int h = 0; h < size(); ++h)
    for (unsigned int c = 0; c < dim; ++c)
      {
        double &force = f[dim * nodes[h] + c];
        for (unsigned int k = start[h]; k < start[h + 1]; ++k)
          f[dim * master[k] + c] += (c == 0 ? first : weight.data())[k] * force;
        force = 0.;
      }
}
} // namespace Arenite
