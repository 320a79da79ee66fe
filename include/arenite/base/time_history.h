#pragma once

#include <arenite/base/parameters.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// A scalar function of time, dimensionless or with the unit of its amplitude: pressure histories, prescribed velocities.
/// Zero for t < 0.
class TimeHistory
{
public:
  virtual ~TimeHistory() = default;

  /// Value at time @p t [s], amplitude included.
  virtual double value(double t) const = 0;

  /// Times where a derivative jumps, ascending; quadrature panels must not cross them.
  virtual std::vector<double> break_points() const { return {0.}; }

  /// Number k of continuous derivatives on the whole time axis (C^k); -1 for a jump. Decides the attainable order.
  virtual int regularity() const = 0;

  virtual void declare_parameters(Parameters &) = 0;
  virtual void finalize() {}
};

/// Names for `set History = ...`, in the order of the manual.
const std::vector<std::string> &time_history_names();

/// The history called @p name; InputError with the nearest name otherwise.
std::unique_ptr<TimeHistory> make_time_history(const std::string &name);
} // namespace Arenite
