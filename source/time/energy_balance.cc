#include <arenite/time/energy_balance.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
double EnergyReport::imbalance() const
{
  double sum = kinetic + strain + hourglass - initial - step_changes - adaptation;
  for (const auto &account : work)
    sum -= account.second;
  return sum;
}

double EnergyReport::scale() const
{
  double largest = kinetic + strain + hourglass;
  for (const auto &account : work)
    largest = std::max(largest, std::abs(account.second));
  return largest;
}

void EnergyBalance::set_names(const std::vector<std::string> &new_names)
{
  names = new_names;
  accounts.assign(names.size(), 0.);
}

EnergyReport EnergyBalance::report(const double time, const double kinetic, const double strain, const double hourglass,
                                   const MPI_Comm communicator)
{
  std::vector<double> sums = {kinetic, strain, hourglass, step_changes};
  sums.insert(sums.end(), accounts.begin(), accounts.end());
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  EnergyReport report;
  report.time         = time;
  report.kinetic      = sums[0];
  report.strain       = sums[1];
  report.hourglass    = sums[2];
  report.step_changes = sums[3];
  report.initial      = initial;
  report.adaptation   = adaptation;
  for (unsigned int i = 0; i < names.size(); ++i)
    report.work.emplace_back(names[i], sums[4 + i]);
  largest_imbalance = std::max(largest_imbalance, std::abs(report.imbalance()));
  largest_scale     = std::max(largest_scale, report.scale());
  return report;
}

double EnergyBalance::largest_error() const { return largest_scale > 0. ? largest_imbalance / largest_scale : 0.; }
} // namespace Arenite
