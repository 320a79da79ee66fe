#pragma once

#include <arenite/time/dynamics.h>

#include <algorithm>
#include <limits>

namespace Arenite
{
class StateArchive;

/// Courant limit dt < 2/omega_max of the central difference, omega_max^2 the largest eigenvalue of M^-1 K.
///
/// Viscous hourglass forces -C v_{n-1/2} act with lag and shorten the step: it is stable as long as dt^2/4 K + dt/2 C <= M, hence up to
/// dt = 2/sqrt(lambda) with lambda the largest eigenvalue of M^-1 (K + sqrt(lambda) C), for one mode dt = (2/omega)(sqrt(1 + xi^2) - xi).
/// The right-hand side grows less than lambda, so that any lambda above its right-hand side is safe, and that side is the better value.
///
/// Two estimates. (1) The largest eigenvalue of each element alone bounds the assembled one from above (Irons & Treharne, 1971),
/// hanging nodes with row-sum masses included; it is cheap and knows the place, but wastes a quarter to a half of the step.
/// (2) Lanczos iterations on the assembled system come from below; the residual and a margin are added. They go on
/// until the residual is a thousandth: at 3 % a smaller eigenvalue may pass for the largest (seen: a limit 4.5 % too long). The smaller of the two eigenvalues is used.
///
/// Each element's eigenvalue comes from a power iteration with the kernel itself on the first mesh. On later meshes a cell
/// inherits the ratio lambda_e / |J^-1|^2 from its parent, and only the metric |J^-1|^2 (largest over its points) is new.
template <int dim>
class StableTimeStep
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// Both estimates for the first mesh. Collective, like update().
  void calibrate(Dynamics<dim> &);

  /// Both estimates for a later mesh, with the ratios of its cells in place. The second takes as long as up to 80 steps: it pays for a mesh of
  /// @p expected_steps that are some hundreds, else the elements alone say how long a step is.
  void update(Dynamics<dim> &, unsigned int expected_steps = std::numeric_limits<unsigned int>::max());

  /// Largest step of the present mesh, 2/omega_max, without the Courant number [s].
  double limit() const { return follows_points ? std::min(elastic_step, step_of_points) : critical_step; }

  /// The same from the elements alone: never above the true limit.
  double element_limit() const { return element_step; }

  /// Blocks that store points say after every step how long the next one may be [s].
  void follow(const double point_step) { step_of_points = point_step; }

  /// The first step lets nobody who moves with @p speed cross more than a small part of the smallest cell [m/s].
  void limit_first(double speed);

  /// Step below which a run is given up, of a run of this length [s].
  double smallest(double end_time) const { return least > 0. ? least : 1e-12 * end_time; }

  /// Step to use: divides the time that is left into equal parts, so that the end is hit without a small last step. Where it follows
  /// the points, it grows from the last one, @p dt_last, by a limited factor.
  double next(double time, double end_time, double dt_last = 0.) const;

  /// The step of most of the run, as far as the present state knows it.
  double usual() const;

  /// Everything but the ratios, which belong to cells. A mesh from a checkpoint needs no calibration.
  void exchange(StateArchive &);

  /// Centre of the cell that limits the step.
  dealii::Point<dim> limiting_place() const { return place; }

  /// lambda_e / |J^-1|^2 per active cell index, for the transfer to a new mesh.
  dealii::Vector<double> ratio;

private:
  double element_bound(const Dynamics<dim> &, bool without_points = false);
  double assembled_bound(Dynamics<dim> &, double elements);

  double courant = 0.9, fixed = 0., largest = 0., least = 0., first = 0., growth = 1.1;
  double first_by_motion = std::numeric_limits<double>::infinity(), largest_inverse_size = 0.;
  bool   follows_points = false;
  double step_of_points = 0., elastic_step = 0.; ///< of blocks with and without points, if there are some with
  double critical_step = 0., element_step = 0.;
  double rate_ratio = 1.; ///< omega_max over that of the elements on the last mesh, where the next search starts
  dealii::Point<dim> place;
};

/// Largest eigenvalue of M^-1 (K + @p rate C), C v the viscous forces, by Lanczos' method, until the residual is @p tolerance of it
/// or @p n_iterations are done: the Ritz value plus its residual [1/s^2]. The start vector is a function of place, so that the
/// result does not depend on the partition (but for round-off). Collective.
template <int dim>
double largest_eigenvalue(Dynamics<dim> &, unsigned int n_iterations, double tolerance, double rate = 0.);
} // namespace Arenite
