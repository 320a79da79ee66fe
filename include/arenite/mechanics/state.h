#pragma once

#include <arenite/mechanics/discretization.h>

#include <deal.II/base/aligned_vector.h>

#include <limits>
#include <vector>

namespace Arenite
{
class StateArchive;

/// What the points of a block with a law of its own remember, structure of arrays in the order of the block's kernel with the lane as
/// last index. Empty for linear elasticity at small strain. A state without them, on which forces are only tried out, makes the block
/// answer with its elastic stiffness at rest.
struct PointData
{
  dealii::AlignedVector<double> stress;  ///< [batch][point][6][lane], Cauchy [Pa]
  dealii::AlignedVector<double> history; ///< [batch][point][n_history][lane]
  dealii::AlignedVector<double>
    bulk_viscosity; ///< [batch][point][n][lane], q, or of the directional form -sigma_q with n = 6 [Pa]
  dealii::AlignedVector<double> wave_speed;   ///< [batch][point][lane] [m/s]
  dealii::AlignedVector<double> stored;       ///< [batch][point][lane], per present volume [J/m^3]
  dealii::AlignedVector<double> frequency;    ///< [batch][lane], square of the cell's largest, without damping [1/s^2]
  dealii::AlignedVector<double> inverse_step; ///< [batch][lane], of the longest stable step of the cell [1/s]
  dealii::AlignedVector<double>
    dissipation;                           ///< [batch][lane], of the law in the last step, per volume and time [W/m^3]
  dealii::AlignedVector<double> ratio;     ///< [batch][lane], largest eigenvalue of the cell over c^2 |A|^2
  dealii::AlignedVector<double> hourglass; ///< [batch][lane], work that went into the patterns of the cell [J]

  bool         stores_points = false;
  bool         advances      = false; ///< the next forces begin a new step
  bool         quasi_static  = false; ///< steps are those of a load: there is no bulk viscosity
  unsigned int step          = std::numeric_limits<unsigned int>::max(); ///< State::step that the points belong to

  // sums over the points of this process [J]: the first two at t_n, the others since the start
  double stored_energy = 0., hourglass_work = 0.;
  double dissipated    = 0.; ///< by the law
  double viscous_work  = 0.; ///< of the bulk viscosity
  double volume_change = 0.; ///< see BlockEnergy

  void exchange(StateArchive &); ///< what does not belong to cells

  // of the last step, over the points of this process
  double       stable_step       = std::numeric_limits<double>::infinity(); ///< [s]
  double       largest_frequency = 0.; ///< square of the largest of all cells [1/s^2]
  unsigned int limiting_cell     = 0;  ///< that allows no longer step
  double       substeps          = 1.; ///< most parts into which the law divided a step, since the start
  unsigned int failed_cell =
    std::numeric_limits<unsigned int>::max(); ///< one where the state is no state; none if the largest number

  // where the time goes, if that is wanted [s]
  bool   is_timed    = false;
  double law_seconds = 0., scatter_seconds = 0.; ///< of the time in the cells: in the law; gathering and scattering
};

/// What a block keeps in the state.
///
/// Viscous hourglass forces are kept from one evaluation to the next: the velocity v_{n-1/2} meets the forces of t_{n-1} and of t_n.
/// Without room for amplitudes no record is kept: states on which forces are only tried out have none.
struct BlockState
{
  dealii::AlignedVector<double>
         amplitude;  ///< of the forces on hourglass patterns in the last evaluation, in the order of the kernel
  double power = 0.; ///< that the mean of the last two viscous hourglass forces takes out of the cells at v_{n-1/2} [W]
  PointData points;
};

/// What a step changes. Between two steps displacement and force belong to t, the velocity to t - dt_last/2.
template <int dim>
struct State
{
  VectorType displacement;  ///< u_n [m], ghosts and hanging nodes valid after the forces were computed
  VectorType half_velocity; ///< v_{n-1/2} [m/s], owned unconstrained nodes only
  VectorType force;         ///< f_n [N], zero between steps: the update consumes it
  VectorType inverse_mass;  ///< 1/m per entry [1/kg]; zero at hanging nodes

  std::vector<BlockState> blocks;            ///< sized by Dynamics::reinit()
  VectorType              last_displacement; ///< u_{n-1} with ghosts, if some block stores points

  double       time    = 0.;
  double       dt_last = 0.; ///< length of the step that led to t; 0 at the start, where half_velocity is v_0
  unsigned int step    = 0;

  void reinit(const Discretization<dim> &discretization)
  {
    // not by assignment, which keeps the old ghosts where the owned ranges happen to be the same
    displacement.reinit(discretization.vector_partitioner);
    half_velocity.reinit(discretization.vector_partitioner);
    force.reinit(discretization.vector_partitioner);
    inverse_mass.reinit(discretization.vector_partitioner);
    blocks.clear();
  }
};
} // namespace Arenite
