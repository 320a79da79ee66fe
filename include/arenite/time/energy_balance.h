#pragma once

#include <arenite/loads/load.h>
#include <arenite/mechanics/internal_force.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Arenite
{
class StateArchive;

/// Momentum of the modelled part at t_n and what explains it, by direction [N s]; see MomentumBalance.
struct MomentumLedger
{
  std::vector<std::pair<std::string, double>> columns;
  double                                      imbalance = 0., scale = 0.; ///< scale: of the largest momentum or impulse
};

/// Where energy came from and went to, up to t_n [J], summed over processes.
struct EnergyReport
{
  double time = 0., kinetic = 0., strain = 0., hourglass = 0.;
  double dissipated = 0., bulk_viscosity = 0., volume_change = 0.; ///< of blocks that store points, see BlockEnergy
  bool   stores_points = false;                                    ///< there are such blocks
  double initial       = 0.;                                       ///< kinetic + strain at the start
  std::vector<std::pair<std::string, double>> work; ///< by load and by prescribed motion, positive into the body
  double                                      step_changes = 0., adaptation = 0.;
  std::vector<LoadValue>                      values; ///< of the loads, with their names
  MomentumLedger                              momentum;

  /// Two independent ledgers: what loads gave must be what points and nodes hold.
  double imbalance() const;

  /// All that the points of the body hold and have turned into heat.
  double internal() const { return strain + hourglass + dissipated + bulk_viscosity + volume_change; }
  double scale() const; ///< max(total energy, |external work|)
};

/// Accumulates the work of all forces in half steps: f_n does dt_{n-1}/2 f_n . v_{n-1/2} + dt_n/2 f_n . v_{n+1/2}.
///
/// With it the leapfrog kinetic energy 1/2 v_{n-1/2} M v_{n+1/2} and the strain energy of the points add up to the external work
/// to round-off for linear elasticity and constant steps; the terms of unequal steps and of adaptations are booked separately.
/// Whether the internal force is the derivative of the strain energy is what the balance checks: a wrong kernel breaks it.
class EnergyBalance
{
public:
  void set_names(const std::vector<std::string> &names);

  /// Work of account @p index over half a step.
  void add_work(const unsigned int index, const double work) { accounts[index] += work; }
  /// Half-step terms of the kinetic energy that unequal steps leave over; total power of all forces.
  void add_step_change(const double energy) { step_changes += energy; }
  /// Jump of the stored energies over an adaptation (sum over processes).
  void add_adaptation(const double energy) { adaptation += energy; }
  void set_initial(const double energy) { initial = energy; }

  /// Reduce over processes; the largest relative imbalance so far is kept. Collective.
  EnergyReport report(double time, double kinetic, const BlockEnergy &, MPI_Comm);
  double       largest_error() const;

  void exchange(StateArchive &);

private:
  std::vector<std::string> names;
  std::vector<double>      accounts;
  double                   step_changes = 0., adaptation = 0., initial = 0., largest_imbalance = 0., largest_scale = 0.;
};
} // namespace Arenite
