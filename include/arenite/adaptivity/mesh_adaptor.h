#pragma once

#include <arenite/adaptivity/refinement_indicator.h>
#include <arenite/mesh/geometry.h>
#include <arenite/mesh/parallel_triangulation.h>
#include <arenite/time/stable_time_step.h>

#include <limits>
#include <memory>

namespace Arenite
{
class StateArchive;

/// Decides when and where the mesh changes, and carries the fields over.
///
/// Cells one of whose indicators exceeds a part of its global maximum (at least 2 % of the largest so far) are the front. They and `Buffer layers` of cells around them are
/// refined to the finest level; cells outside with a small indicator are coarsened, never below the initial mesh. The mesh is
/// adapted again before the front has crossed the buffer, which it may do with the speed of P waves, so that it never meets a coarse cell: the front is looked
/// at again as soon as it may have crossed what room it had at the last look.
///
/// Displacement, velocity, positions and boundary scalars are interpolated. Positions are a field like the others: refined cells
/// keep the polynomial shape of their parents, fields are transferred exactly under refinement, and the mass changes only as far as
/// the quadrature of curved cells does (measured: 4e-5 at degree 2 on a coarse shell, 6e-8 at degree 3).
template <int dim>
class MeshAdaptor
{
public:
  using Triangulation = ParallelTriangulation<dim>;

  void declare_parameters(Parameters &);
  void finalize(const Parameters &, const MeshChoice<dim> &, const Geometry<dim> &);

  bool active() const { return levels > 0; }

  /// Refine around the boundaries that loads or prescribed velocities push, before the first step: fills the discretization and its positions.
  void initial_refinement(Triangulation &, Discretization<dim> &,
                          const std::vector<dealii::types::boundary_id> &loaded);

  /// A step of length @p dt was done, in which a P wave would need @p crossing for the smallest cell of blocks that store points.
  void follow(const double dt, const double crossing) { crossed += dt / std::min(crossing, crossing_at_rest); }

  bool due() const { return active() && crossed >= layers_until_next_look(); }

  /// Flags for the present state. Returns whether the mesh will change on any process. Collective.
  ///
  /// In the first @p pass of an adaptation the fields come from a run on the present mesh, so that coarse cells in the front are ones that it has met; the
  /// mesh stays as it is while the front keeps its distance from them and not much could be coarsened. Further passes refine what lacks more than one level
  /// of the same front: fields that were just moved tell nothing new, and forces of the new mesh are not yet those of a step.
  bool mark(Triangulation &, const Dynamics<dim> &, const State<dim> &, unsigned int pass);

  /// Cells below the finest level that were part of the front when the mesh was adapted, over the run: the buffer was too thin,
  /// or something started away from the front. Summed over processes.
  unsigned long coarse_cells_met() const { return n_met; }

  /// Change the mesh as flagged; transfers state, positions, boundary scalars, step ratios and the trail; rebuilds
  /// everything. The stable step still has to be updated.
  void execute(Triangulation &, Dynamics<dim> &, State<dim> &, StableTimeStep<dim> &);

  /// The next look at the front is due when a P wave may have crossed some layers.
  void schedule(const Dynamics<dim> &);

  unsigned int max_passes() const { return levels; }

  /// What is known of the front, but for the trail.
  void exchange(StateArchive &);

  /// Where the front was when the mesh last changed, per active cell: 1 in it, -1 behind it, 0 elsewhere; empty before.
  dealii::Vector<double> trail;

private:
  double layers_until_next_look() const { return std::max(room - 1., 0.5); }

  unsigned int              layers_around(double mark) const { return mark < 0. ? layers_behind : layers; }
  std::vector<unsigned int> wanted_levels(const std::vector<unsigned int> &layers_of,
                                          const std::vector<unsigned int> &finest,
                                          const dealii::Vector<double>    &marks) const;
  dealii::Vector<double>    marks_of(Triangulation &, const std::vector<bool> &front,
                                     const std::vector<unsigned int> &layers_of) const;

  void find_front(const Dynamics<dim> &, const State<dim> &, std::vector<bool> &front, std::vector<bool> &quiet);
  std::vector<unsigned int> obey_boxes(const Discretization<dim> &, std::vector<bool> &front) const;
  void                      check_size(const Triangulation &, double time) const;

  struct Indicator
  {
    std::unique_ptr<RefinementIndicator<dim>> kind;
    float                                     peak = 0.f; ///< largest so far, faded
  };

  std::vector<std::string>                types{"wave front"};
  std::vector<Indicator>                  indicators;
  std::vector<dealii::Point<dim>>         fine_boxes, coarse_boxes; ///< two corners each
  std::vector<std::string>                boundary_names{"auto"};
  std::vector<dealii::types::boundary_id> initial_boundaries;
  bool                                    automatic_boundaries = true, refine_geometry = false;
  unsigned int levels = 0, base_level = 0, layers = 8, layers_behind = 8, levels_in_boxes = 0, cell_limit = 50000000;
  double       refine_above = 0.2, coarsen_below = 0.05;
  double       marked_at = 0.;                                                     ///< time of the last mark() [s]
  double crossed = 0., crossing_at_rest = std::numeric_limits<double>::infinity(); ///< layers; [s] of the smallest cell
  unsigned int room =
    0; ///< layers of fine cells between the front and the nearest coarse cell not behind it, of a buffer at most, at the last look
  unsigned long n_met = 0;
};
} // namespace Arenite
