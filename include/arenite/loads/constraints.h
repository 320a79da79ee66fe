#pragma once

#include <arenite/loads/load.h>
#include <arenite/verification/exact_solution.h>

namespace Arenite
{
/// `subsection Constraints`: symmetry planes, fixed boundaries, prescribed velocities. Acts on nodal forces before the update,
/// so that the update itself knows nothing about them. Nodes on an axis or centre never move radially.
template <int dim>
class Constraints
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &, const Geometry<dim> &);

  /// Whether planes of symmetry hold all boundaries that the form cuts, and what is held otherwise keeps to it. After the geometry.
  bool admits(Reduction &, const Parameters &) const;

  /// Symmetry planes by boundary id, without a scene.
  void set_symmetry(const std::vector<dealii::types::boundary_id> &ids) { symmetry = ids; }

  /// Boundaries that follow @p solution, without a scene.
  void set_exact(const std::vector<dealii::types::boundary_id> &ids, const ExactSolution<dim> *solution)
  {
    exact          = ids;
    exact_solution = solution;
  }

  /// Hold boundaries besides, from the next reinit() on: along their mean normals or @p fully. No boundary: not any more.
  void hold(const std::vector<dealii::types::boundary_id> &ids, bool fully)
  {
    held       = ids;
    held_fully = fully;
  }

  /// Nodal lists for the present mesh. Dashpot blocks of constrained nodes lose their constrained directions.
  void reinit(const Discretization<dim> &);

  /// Replace the forces of constrained nodes so that the update over @p dt with mean step @p mean keeps them on their motion.
  void apply(State<dim> &, double dt, double mean);

  /// Sum of the forces that the last apply() put on the nodes of this process.
  const dealii::Tensor<1, dim> &reaction() const { return whole_reaction; }

  /// The same by boundary. What several boundaries hold at a node they share like springs side by side, of a stiffness that goes with
  /// their area there: planes along their normals, prescribed motions along their direction, others in all directions.
  void add_resultants(const Discretization<dim> &, Resultants<dim> &);

  /// Sum of (reaction . v) [W] of prescribed motions, from the last apply().
  double power(const VectorType &half_velocity) const;

  /// Project a velocity or displacement onto what the planes admit.
  void project(VectorType &) const;

  /// At each owned node that is held in some direction, by planes or by a prescribed motion, the projector onto those in which it is free.
  /// Ascending nodes.
  std::vector<NodeValue<dealii::SymmetricTensor<2, dim>>> freedom() const;

  /// Give the change of the displacement from one time to another its prescribed components: the integral of the velocity, or what is
  /// missing from @p displacement to an exact solution.
  void prescribe(VectorType &change, const VectorType &displacement, double from, double to) const;

  /// D -> P D P at constrained nodes.
  void project(DampingBlocks<dim> &) const;

  /// Boundaries with a prescribed velocity.
  std::vector<dealii::types::boundary_id> driven_boundaries() const;

  /// Largest prescribed speed at a time [m/s].
  double largest_speed(double time) const;

  bool follows_exact_solution() const { return !exact.empty(); }

  /// Boundaries that follow an exact solution (verification scenes).
  const ExactSolution<dim> *exact_solution = nullptr;

private:
  using Projectors = std::vector<NodeValue<dealii::SymmetricTensor<2, dim>>>; ///< ascending nodes

  struct PrescribedBoundary
  {
    std::string                             name;
    std::vector<dealii::types::boundary_id> ids;
    std::string                             along = "direction";
    dealii::Tensor<1, dim>                  direction;
    HistoryChoice                           history;
    bool                                    along_normal() const { return along == "normal"; }
  };
  struct PrescribedNode
  {
    unsigned int           node, boundary;
    dealii::Tensor<1, dim> direction, reaction;
  };

  /// What a boundary takes of the reaction of a node.
  struct Part
  {
    unsigned int               node; ///< position in held_nodes
    dealii::types::boundary_id boundary;
    dealii::Tensor<2, dim>     share;
    dealii::Tensor<1, dim>     normal;
  };

  void make_prescribed_nodes(const Discretization<dim> &);
  void make_parts(const Discretization<dim> &);

  std::vector<std::string>                         symmetry_names{"auto"}, fixed_names, prescribed_names, exact_names;
  std::vector<dealii::types::boundary_id>          symmetry, fixed, exact, held;
  bool                                             held_fully = false;
  std::vector<std::unique_ptr<PrescribedBoundary>> prescribed;
  Projectors                                       projectors;
  std::vector<PrescribedNode>                      prescribed_nodes;
  std::vector<std::pair<PrescribedNode, dealii::Point<dim>>> exact_nodes;
  dealii::Tensor<1, dim>                                     whole_reaction;
  std::vector<dealii::Tensor<1, dim>>                        plane_reactions; ///< at the nodes of projectors
  std::vector<Part>                                          parts;
  std::vector<unsigned int>                                  held_nodes; ///< with parts, ascending
  std::vector<dealii::Tensor<1, dim>>                        held_reactions;
  bool                                                       knows_parts = false;
};
} // namespace Arenite
