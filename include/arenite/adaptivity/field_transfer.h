#pragma once

#include <arenite/adaptivity/cell_transport.h>

#include <list>
#include <vector>

namespace Arenite
{
/// Interpolates nodal fields from one mesh to the next, on any number of processes:
///
///   FieldTransfer<dim> fields(transport, discretization);
///   fields.add(state.displacement);                         // ghosts and hanging nodes valid, until the mesh has changed
///   transport.send();
///   triangulation.execute_coarsening_and_refinement();
///   discretization.distribute_nodes();
///   transport.receive();
///   fields.interpolate();
///   fields.next(state.displacement);                        // owned entries, in the order of add()
///
/// Refinement reproduces the polynomial of the parent, coarsening keeps the values at the parent's nodes.
template <int dim>
class FieldTransfer
{
public:
  FieldTransfer(CellTransport<dim> &, const Discretization<dim> &);
  FieldTransfer(const FieldTransfer &) = delete;

  /// A vector with dim entries per node, or a scalar one.
  void add(const VectorType &);
  void interpolate();
  void next(VectorType &);

private:
  using Cell    = typename CellTransport<dim>::Cell;
  using Numbers = std::vector<double>;
  /// Value at a node as a combination of values at the nodes of some other cell.
  using Weights = std::vector<std::pair<unsigned int, double>>;

  struct Field
  {
    const VectorType *before; ///< dangles once the mesh has changed
    unsigned int      n_components;
    VectorType        after;
  };

  template <typename OfCell>
  Numbers combine(const std::vector<Weights> &, const OfCell &of_cell) const;
  void    put(unsigned int cell, const Numbers &values);

  CellTransport<dim>               &transport;
  const Discretization<dim>        &discretization;
  const std::vector<unsigned int>   index; ///< of active cells of the old mesh
  std::list<Field>                  fields;
  std::vector<std::vector<Weights>> of_child;      ///< [child][its node]: of the parent's nodes
  std::vector<Weights>              of_parent;     ///< [its node]: of the nodes of child_of_node
  std::vector<unsigned int>         child_of_node; ///< a child that has that place
  unsigned int                      cargo;
};
} // namespace Arenite
