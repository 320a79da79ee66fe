#pragma once

#include <arenite/time/dynamics.h>

namespace Arenite
{
/// Courant limit dt < 2/omega_max of the central difference.
///
/// The largest eigenvalue of the assembled system is bounded by the largest eigenvalue of its elements (Irons & Treharne, 1971);
/// hanging nodes with row-sum masses included. Each element's eigenvalue lambda_e comes from a power iteration with the kernel
/// itself on the first mesh. On later meshes a cell inherits the ratio lambda_e / |J^-1|^2 from its parent, and only the cheap
/// metric |J^-1|^2 (largest over its points) is computed again.
template <int dim>
class StableTimeStep
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// Power iteration on every cell of the present mesh.
  void calibrate(const Dynamics<dim> &);

  /// Bound for the present mesh from the ratios. Collective.
  void update(const Dynamics<dim> &);

  /// Largest step of the present mesh, 2/omega_max, without the Courant number [s].
  double limit() const { return critical_step; }

  /// Step to use: divides the time that is left into equal parts, so that the end is hit without a small last step.
  double next(double time, double end_time) const;

  /// Cell (index in Discretization::cells()) that limits the step on this process, and whether it is the global one.
  dealii::Point<dim> limiting_place() const { return place; }

  /// lambda_e / |J^-1|^2 per active cell index, for the transfer to a new mesh.
  dealii::Vector<double> ratio;

private:
  double             courant = 0.9, fixed = 0., largest = 0.;
  double             critical_step = 0.;
  dealii::Point<dim> place;
};
} // namespace Arenite
