#pragma once

#include <arenite/base/time_history.h>

#include <array>
#include <functional>
#include <memory>
#include <shared_mutex>
#include <vector>

namespace Arenite
{
/// Response of a linear ordinary differential equation, at rest before t = 0, to a time history p:
///
///   y' = A y + b p(t),   y(t) = integral_0^t exp(A (t - s)) b p(s) ds.
///
/// y is marched with the exact exponential over panels that end at the break points of p, with a 24-point
/// Gauss-Legendre rule in each. A panel is halved until the rule agrees with that of its two halves to 1e-14 of the
/// largest y so far. The states at the ends of the panels are kept, so that any time costs 24 exponentials and values
/// of p (about 1 us), however late it is. Throws InputError if p is too rough for that. Thread safe.
template <int n>
class HistoryResponse
{
public:
  using State = std::array<double, n>;

  /// exp(A s) y
  using Propagator = std::function<State(const State &y, double s)>;

  /// @param load        b
  /// @param weights     factors that give the components of y one unit, for the comparison above
  /// @param longest_panel  upper limit for panels [s], the shortest time scale of exp(A s); infinity if there is none
  HistoryResponse(std::shared_ptr<const TimeHistory> history, const Propagator &propagator, const State &load,
                  const State &weights, double longest_panel);

  /// y(t), zero for t <= 0.
  State operator()(double t) const;

  /// Number of panels computed so far.
  std::size_t panels() const;

private:
  std::shared_ptr<const TimeHistory> time_history;
  Propagator                         propagator;
  State                              load, weights;
  double                             longest_panel;
  std::vector<double>                breaks;

  mutable std::shared_mutex   mutex;
  mutable std::vector<double> ends;   ///< ends of the panels, from 0
  mutable std::vector<State>  states; ///< y there
  mutable double              largest = 0.;

  /// One panel from (t0, y) to t1 without control.
  State advance(const State &y, double t0, double t1) const;
  /// The same with halving; appends to the table, which may grow to @p most_ends.
  void append(double t1, unsigned int halvings, std::size_t most_ends) const;
  void grow(double t) const;
  /// Largest weighted component.
  double size(const State &y) const;
};
} // namespace Arenite
