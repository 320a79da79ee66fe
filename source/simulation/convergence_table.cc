#include <arenite/simulation/convergence_table.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Arenite
{
namespace
{
std::string number(const double x)
{
  std::ostringstream text;
  text << std::scientific << std::setprecision(3) << x;
  return text.str();
}

std::string fixed(const double x)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << x;
  return text.str();
}

std::string row(const std::string &name, const std::vector<std::string> &cells)
{
  std::ostringstream text;
  text << "  " << std::left << std::setw(34) << name;
  for (const std::string &cell : cells)
    text << std::setw(19) << cell;
  return text.str() + "\n";
}
} // namespace

std::string convergence_table(const std::vector<RunRecord> &records)
{
  std::string text;
  const auto  add = [&](const std::string &name, const auto &value) {
    std::vector<std::string> cells;
    for (const RunRecord &record : records)
      cells.push_back(number(value(record)));
    text += row(name, cells);
  };
  add("cells", [](const RunRecord &r) { return static_cast<double>(r.cells); });
  add("core-seconds of the time loop", [](const RunRecord &r) { return r.core_seconds; });

  if (!records.front().errors.empty())
    text += "\nError, and observed order in the cell size\n";
  for (const auto &first : records.front().errors)
    {
      std::vector<std::string> cells;
      for (unsigned int i = 0; i < records.size(); ++i)
        {
          const double error = records[i].errors.at(first.first);
          cells.push_back(number(error));
          if (i > 0)
            cells.back() += " (" + fixed(std::log2(records[i - 1].errors.at(first.first) / error)) + ")";
        }
      text += row(first.first, cells);
    }

  if (!records.front().values.empty())
    text += "\nValue on each mesh, and its limit with error bar (Richardson)\n";
  for (const auto &first : records.front().values)
    {
      std::vector<std::string> cells;
      std::vector<double>      f;
      for (const RunRecord &record : records)
        {
          f.push_back(record.values.at(first.first));
          cells.push_back(number(f.back()));
        }
      const std::size_t n = f.size();
      if (n >= 3)
        {
          const double last = f[n - 1] - f[n - 2], q = std::log2((f[n - 2] - f[n - 3]) / last);
          if (std::isfinite(q) && q > 0.5 && q < 2. * records.front().degree + 2.)
            {
              const double correction = last / (std::pow(2., q) - 1.);
              cells.push_back(number(f[n - 1] + correction) + " +- " + number(1.25 * std::abs(correction)) +
                              ", order " + fixed(q));
            }
          else
            cells.push_back(number(f[n - 1]) + " +- " + number(3. * std::abs(last)) + ", not asymptotic");
        }
      text += row(first.first, cells);
    }
  return text;
}
} // namespace Arenite
