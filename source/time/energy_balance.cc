#include <arenite/base/state_archive.h>
#include <arenite/time/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
double EnergyReport::imbalance() const
{
  double sum = kinetic + internal() - initial - step_changes - adaptation;
  for (const auto &account : work)
    sum -= account.second;
  return sum;
}

double EnergyReport::scale() const
{
  double largest = kinetic + internal();
  for (const auto &account : work)
    largest = std::max(largest, std::abs(account.second));
  return largest;
}

void EnergyBalance::set_names(const std::vector<std::string> &new_names)
{
  names = new_names;
  accounts.assign(names.size(), 0.);
}

EnergyReport EnergyBalance::report(const double time, const double kinetic, const BlockEnergy &blocks,
                                   const MPI_Comm communicator)
{
  std::vector<double> sums  = {kinetic,           blocks.strain,         blocks.hourglass,
                               blocks.dissipated, blocks.bulk_viscosity, blocks.volume_change,
                               step_changes};
  const std::size_t   n_own = sums.size();
  sums.insert(sums.end(), accounts.begin(), accounts.end());
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  EnergyReport report;
  report.time           = time;
  report.kinetic        = sums[0];
  report.strain         = sums[1];
  report.hourglass      = sums[2];
  report.dissipated     = sums[3];
  report.bulk_viscosity = sums[4];
  report.volume_change  = sums[5];
  report.step_changes   = sums[6];
  report.initial        = initial;
  report.adaptation     = adaptation;
  for (unsigned int i = 0; i < names.size(); ++i)
    report.work.emplace_back(names[i], sums[n_own + i]);
  largest_imbalance = std::max(largest_imbalance, std::abs(report.imbalance()));
  largest_scale     = std::max(largest_scale, report.scale());
  return report;
}

void EnergyBalance::exchange(StateArchive &archive)
{
  for (double &account : accounts)
    archive.sum(account);
  archive.sum(step_changes);
  archive.common(adaptation);
  archive.common(initial);
  archive.common(largest_imbalance);
  archive.common(largest_scale);
}

double EnergyBalance::largest_error() const { return largest_scale > 0. ? largest_imbalance / largest_scale : 0.; }
} // namespace Arenite
