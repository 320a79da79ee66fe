#include <arenite/base/errors.h>
#include <arenite/materials/material_point.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace Arenite
{
namespace
{
using Vector6 = std::array<double, 6>;
using Matrix6 = std::array<Vector6, 6>;

/// Solve A x = b by elimination with row pivots. @return false for a singular matrix.
bool eliminate(Matrix6 A, Vector6 b, Vector6 &x)
{
  for (int column = 0; column < 6; ++column)
    {
      int pivot = column;
      for (int row = column + 1; row < 6; ++row)
        if (std::abs(A[row][column]) > std::abs(A[pivot][column]))
          pivot = row;
      if (!(std::abs(A[pivot][column]) > 0.))
        return false;
      std::swap(A[pivot], A[column]);
      std::swap(b[pivot], b[column]);
      for (int row = column + 1; row < 6; ++row)
        {
          const double factor = A[row][column] / A[column][column];
          for (int k = column; k < 6; ++k)
            A[row][k] -= factor * A[column][k];
          b[row] -= factor * b[column];
        }
    }
  for (int row = 5; row >= 0; --row)
    {
      x[row] = b[row];
      for (int k = row + 1; k < 6; ++k)
        x[row] -= A[row][k] * x[k];
      x[row] /= A[row][row];
    }
  return std::all_of(x.begin(), x.end(), [](const double value) { return std::isfinite(value); });
}

double norm(const Vector6 &a)
{
  double sum = 0.;
  for (const double value : a)
    sum += value * value;
  return std::sqrt(sum);
}

double largest(const SymTensor<double> &a)
{
  double result = 0.;
  for (int k = 0; k < 6; ++k)
    result = std::max(result, std::abs(a[k]));
  return result;
}
} // namespace

double PointState::volume_ratio() const { return std::exp(trace(strain)); }

double Condition::value(const SymTensor<double> &tensor) const
{
  double sum = 0.;
  for (int k = 0; k < 6; ++k)
    sum += weights[k] * tensor[k];
  return sum;
}

MaterialPoint::MaterialPoint(const BatchLaw &law)
  : law(law)
  , stiffness(law.density() * law.wave_speed_bound() * law.wave_speed_bound())
{
  state.density = law.density();
  state.history = law.initial_history();
  // energy and wave speed at rest, by a step without strain and, as far as a double can say it, without time
  const PointState rest = after({}, std::numeric_limits<double>::min());
  state.wave_speed      = rest.wave_speed;
  state.stored          = rest.stored;
}

PointState MaterialPoint::after(const SymTensor<double> &increment, const double dt) const
{
  PointState next = state;
  next.time += dt;
  next.strain += increment;
  next.density  = law.density() / next.volume_ratio();
  double stored = 0., dissipated = 0., by_volume = 0.;

  PointBatch batch;
  batch.n_points    = 1;
  batch.dt          = dt;
  batch.strain      = increment.v;
  batch.density_old = &state.density;
  batch.density     = &next.density;
  batch.stress      = next.stress.v;
  batch.history     = next.history.data();
  batch.wave_speed  = &next.wave_speed;
  batch.stored      = &stored;
  batch.dissipated  = &dissipated;

  batch.stored_by_volume = &by_volume;
  law.update(batch);

  const double J_n = state.volume_ratio(), J_n1 = next.volume_ratio(), J_mean = 0.5 * (J_n + J_n1);
  const double stored_n = state.stored / J_n;
  next.work += J_mean * contract((state.stress + next.stress) * 0.5, increment);
  next.stored = J_n1 * stored;
  next.stored_by_volume +=
    law.energy_per_present_volume() ? 0.5 * (stored_n + stored) * (J_n1 - J_n) : J_mean * by_volume;
  next.dissipated += J_mean * dissipated;
  next.substeps += batch.substeps;
  return next;
}

void MaterialPoint::advance(const SymTensor<double> &increment, const double dt)
{
  PointState next   = after(increment, dt);
  bool       finite = std::isfinite(next.stored) && std::isfinite(next.wave_speed);
  for (int k = 0; k < 6; ++k)
    finite = finite && std::isfinite(next.stress[k]);
  if (!finite)
    {
      std::ostringstream message;
      message << "t = " << next.time << " s: the stress is not a number after a strain increment of "
              << largest(increment) << ". Use more steps per row.";
      throw PhysicsAlarm(message.str());
    }
  state = std::move(next);
}

void MaterialPoint::advance(const Conditions &conditions, const double dt)
{
  Conditions absolute = conditions;
  for (Condition &condition : absolute)
    if (condition.relative)
      {
        condition.target += condition.value(condition.on == Condition::On::strain ? state.strain : state.stress);
        condition.relative = false;
      }
  advance_parts(absolute, dt, 0);
}

void MaterialPoint::advance_parts(const Conditions &conditions, const double dt, const unsigned int depth)
{
  SymTensor<double> increment;
  if (solve(conditions, dt, increment))
    {
      advance(increment, dt);
      return;
    }
  if (depth == 10)
    {
      std::ostringstream message;
      message << "t = " << state.time << " s: no strain increment gives the prescribed stress, also after "
              << (1 << depth) << "-fold division of the step (p = " << pressure(state.stress)
              << " Pa, q = " << std::sqrt(3. * second_invariant(deviator(state.stress)))
              << " Pa). Is the stress beyond the strength? Prescribe strain instead, or lower the stress.";
      throw PhysicsAlarm(message.str());
    }
  Conditions half = conditions;
  for (Condition &condition : half)
    condition.target =
      0.5 * (condition.target + condition.value(condition.on == Condition::On::strain ? state.strain : state.stress));
  advance_parts(half, 0.5 * dt, depth + 1);
  advance_parts(conditions, 0.5 * dt, depth + 1);
}

bool MaterialPoint::solve(const Conditions &conditions, const double dt, SymTensor<double> &increment) const
{
  // residuals in units of stress
  const auto residual = [&](const PointState &next) {
    Vector6 r;
    for (int i = 0; i < 6; ++i)
      r[i] = conditions[i].on == Condition::On::strain
               ? stiffness * (conditions[i].value(next.strain) - conditions[i].target)
               : conditions[i].value(next.stress) - conditions[i].target;
    return r;
  };

  increment           = {};
  PointState   next   = after(increment, dt);
  Vector6      r      = residual(next);
  const double change = norm(r); // of stress over the step
  for (unsigned int iteration = 0; iteration < 40; ++iteration)
    {
      // the strain itself carries round-off of the size epsilon |strain|
      const double scale = largest(next.stress) + std::min(change, stiffness * largest(increment));
      if (norm(r) <= tolerance * scale + 4e-16 * stiffness * largest(next.strain))
        return true;

      Matrix6      A;
      const double h = 1e-7 * std::max(1e-3, largest(increment) * 10.);
      for (int k = 0; k < 6; ++k)
        {
          SymTensor<double> plus = increment, minus = increment;
          plus[k] += h;
          minus[k] -= h;
          const Vector6 r_plus = residual(after(plus, dt)), r_minus = residual(after(minus, dt));
          for (int i = 0; i < 6; ++i)
            A[i][k] = (r_plus[i] - r_minus[i]) / (2. * h);
        }
      Vector6 direction;
      if (!eliminate(A, r, direction))
        return false;

      bool   improved = false;
      double length   = 1.;
      for (unsigned int halving = 0; halving < 12 && !improved; ++halving, length *= 0.5)
        {
          SymTensor<double> trial = increment;
          for (int k = 0; k < 6; ++k)
            trial[k] -= length * direction[k];
          PointState    trial_state = after(trial, dt);
          const Vector6 trial_r     = residual(trial_state);
          if (norm(trial_r) < norm(r) || norm(r) == 0.)
            {
              increment = trial;
              next      = std::move(trial_state);
              r         = trial_r;
              improved  = true;
            }
        }
      if (!improved) // at the end of the digits, or stuck
        return norm(r) <= 100. * tolerance * scale;
    }
  return false;
}
} // namespace Arenite
