#pragma once

#include <arenite/io/receiver_file.h>
#include <arenite/verification/exact_solution.h>

#include <map>

namespace Arenite
{
class StateArchive;

/// Completes rows with the velocity at t_n, from the displacements of the steps around it:
///
///   v_{n+1/2} = (u_{n+1} - u_n) / dt_n,   v_n = v_{n-1/2} + dt_{n-1}/(dt_{n-1} + dt_n) (v_{n+1/2} - v_{n-1/2}),
///
/// which is the velocity of the central differences; a row is complete one step later. A chain of differences begins with a
/// given v_{n-1/2}; at the start of a run it is v_0 with dt_{n-1} = 0, hence exact. The last row of a run has no step behind it:
/// v_N = v_{N-1/2} + dt_{N-1}/2 a_{N-1}, second order like the others.
template <int dim>
class VelocityHistory
{
public:
  using Vectors = std::vector<dealii::Tensor<1, dim>>;

  /// Begin a new chain at step n with v_{n-1/2}, the velocity of the step of length @p dt that led to t_n.
  template <typename Emit>
  void begin(unsigned int step, double dt, const Vectors &half_velocity, const Emit &emit);

  /// u_n at t_n, reached by a step of length @p dt. Consecutive steps continue the chain; the same step again replaces u_n, as
  /// after a transfer to a new mesh. Rows are only emitted for steps with @p row.
  template <typename Emit>
  void add(unsigned int step, double dt, const Vectors &displacement, const ReceiverRow<dim> *row, const Emit &emit);

  template <typename Emit>
  void finish(const Emit &emit);

  /// @p n_own points from @p first on are here.
  void exchange(StateArchive &, std::size_t first, std::size_t n_own);

private:
  template <typename Emit>
  void complete(const Vectors &after, double dt_after, const Emit &emit);

  bool             chained = false, pending = false, has_acceleration = false;
  unsigned int     step = 0, pending_step = 0;
  double           dt_before = 0., pending_dt = 0.;
  Vectors          last, before, pending_before, acceleration, after;
  ReceiverRow<dim> pending_row;
};

/// Errors against an exact solution over the time of a run, trapezoidal rule over the rows:
///
///   E_t = sqrt(sum_k int |q_h - q|^2 dt / sum_k int |q|^2 dt),   q = u, v or the whole tensor sigma; k = points.
template <int dim>
class ReceiverErrors
{
public:
  /// @p points are the places where the exact solution is wanted: those that the user asked for.
  void reinit(const ExactSolution<dim> &, const std::vector<dealii::Point<dim>> &points, const ReceiverQuantities &);
  void add(const ReceiverRow<dim> &);

  void exchange(StateArchive &, std::size_t first);

  /// E_t of each recorded quantity for one point.
  std::map<std::string, double> of_point(unsigned int point) const;

  /// The same for the points of all processes together. Collective.
  std::map<std::string, double> of_set(MPI_Comm) const;

private:
  struct Square
  {
    double error = 0., exact = 0.;
  };
  struct Quantity
  {
    std::string         name;
    std::vector<Square> last, integral; ///< per point
  };

  const ExactSolution<dim>       *exact = nullptr;
  std::vector<dealii::Point<dim>> points;
  std::vector<Quantity>           quantities;
  double                          last_time = 0.;
  bool                            started   = false;
};

/// How large the signals of a set are, for comparisons between runs without an exact solution:
///
///   rms = sqrt(sum_k integral |q|^2 dt / (K T)),   peak = max |q| over points and rows.
template <int dim>
class ReceiverNorms
{
public:
  void add(const ReceiverRow<dim> &row);

  /// "displacement.rms" ... over the points of all processes; quantities that are not recorded are left out. Collective.
  std::map<std::string, double> of_set(MPI_Comm) const;

  void exchange(StateArchive &);

private:
  struct Norm
  {
    double      integral = 0., last = 0., peak = 0.; ///< integral of the sum over points
    std::size_t n_points = 0;
  };
  Norm   displacement, velocity, stress;
  double first_time = 0., last_time = 0.;
  bool   started = false;
};

template <int dim>
template <typename Emit>
void VelocityHistory<dim>::complete(const Vectors &after, const double dt_after, const Emit &emit)
{
  const double w = dt_after > 0. ? pending_dt / (pending_dt + dt_after) : 0.;
  for (unsigned int i = 0; i < after.size(); ++i)
    pending_row.velocity[i] = pending_before[i] + w * (after[i] - pending_before[i]);
  emit(pending_row);
  pending = false;
}

template <int dim>
template <typename Emit>
void VelocityHistory<dim>::begin(const unsigned int n, const double dt, const Vectors &half_velocity, const Emit &emit)
{
  if (pending && pending_step + 1 == n)
    complete(half_velocity, dt, emit);
  else if (pending && pending_step != n) // steps are missing: v_{n+1/2} is unknown
    finish(emit);
  before           = half_velocity;
  dt_before        = dt;
  chained          = false;
  has_acceleration = false;
}

template <int dim>
template <typename Emit>
void VelocityHistory<dim>::add(const unsigned int n, const double dt, const Vectors &displacement,
                               const ReceiverRow<dim> *row, const Emit &emit)
{
  if (chained && n == step + 1)
    {
      after.resize(displacement.size());
      acceleration.resize(displacement.size());
      for (unsigned int i = 0; i < after.size(); ++i)
        {
          after[i]        = (displacement[i] - last[i]) / dt;
          acceleration[i] = (after[i] - before[i]) / (0.5 * (dt_before + dt));
        }
      has_acceleration = true;
      if (pending)
        complete(after, dt, emit);
      before.swap(after);
      dt_before = dt;
    }
  last    = displacement;
  step    = n;
  chained = true;
  if (row)
    {
      pending_row          = *row;
      pending_row.velocity = before;
      pending_before       = before;
      pending_dt           = dt_before;
      pending_step         = n;
      pending              = true;
    }
}

template <int dim>
template <typename Emit>
void VelocityHistory<dim>::finish(const Emit &emit)
{
  if (!pending)
    return;
  for (unsigned int i = 0; i < pending_before.size(); ++i)
    pending_row.velocity[i] =
      pending_before[i] + (has_acceleration ? 0.5 * pending_dt * acceleration[i] : dealii::Tensor<1, dim>());
  emit(pending_row);
  pending = false;
}
} // namespace Arenite
