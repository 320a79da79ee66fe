#pragma once

#include <arenite/statics/free_motion.h>
#include <arenite/time/dynamics.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace Arenite
{
/// Algebraic multigrid (ML, smoothed aggregation) for the stiffness of all blocks with their elasticity at rest, assembled from
/// InternalForce::cell_stiffness(). With C for nodes that hang and the projectors P of FreeMotion
///
///   K = P C^T K_cells C P + (1 - P) d,   d of the order of the diagonal:
///
/// the inverse does not mix what is free with what is held. The near-null space are the motions of a rigid body; in reduced symmetries
/// the same constants and rotations, although only some of them are without energy there: what matters to the coarse levels is that they vary
/// slowly.
template <int dim>
class ElasticPreconditioner
{
public:
  /// For the present mesh. Collective.
  void reinit(const Dynamics<dim> &, const FreeMotion<dim> &);

  /// z ~ K^-1 r; what is held and what hangs is zero.
  void vmult(VectorType &z, const VectorType &r) const;

  /// Root of the sum of squares over nodes of the forces that a strain of one gives, without what cancels at a node [N]. Times the round-off of
  /// strains it is that of forces.
  double force_of_unit_strain() const { return unit_force; }

private:
  void assemble(const Dynamics<dim> &);
  void build_multigrid(const Discretization<dim> &);

  const FreeMotion<dim>                    *free = nullptr;
  dealii::TrilinosWrappers::SparseMatrix    matrix;
  dealii::TrilinosWrappers::PreconditionAMG multigrid;
  double                                    unit_force = 0.;
};
} // namespace Arenite
