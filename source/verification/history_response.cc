#include <arenite/verification/gauss_rule.h>
#include <arenite/verification/history_response.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

namespace Arenite
{
namespace
{
constexpr double       panel_tolerance = 1e-14;
constexpr unsigned int most_halvings   = 45; // reaches the rounding of t at a jump that no break point announces
constexpr std::size_t  most_parts = 50000;   // of one panel; a Gaussian of 1/1000 of it without break points needs 5000

// Less counts as zero: in the far tail of a Gaussian, denormal numbers have no relative accuracy to ask for.
constexpr double smallest_size = 1e-200;
} // namespace

template <int n>
HistoryResponse<n>::HistoryResponse(std::shared_ptr<const TimeHistory> history, const Propagator &propagator,
                                    const State &load, const State &weights, const double longest_panel)
  : time_history(std::move(history))
  , propagator(propagator)
  , load(load)
  , weights(weights)
  , longest_panel(longest_panel)
  , breaks(time_history->break_points())
  , ends({0.})
  , states({State{}})
{}

template <int n>
double HistoryResponse<n>::size(const State &y) const
{
  double result = 0.;
  for (unsigned int i = 0; i < n; ++i)
    result = std::max(result, weights[i] * std::abs(y[i]));
  return result;
}

template <int n>
typename HistoryResponse<n>::State HistoryResponse<n>::advance(const State &y, const double t0, const double t1) const
{
  const auto  &rule   = gauss_rule();
  const double length = t1 - t0;
  State        result = propagator(y, length);
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double s = rule.point(q)[0] * length;
      const double p = time_history->value(t0 + s);
      if (p == 0.)
        continue;
      const State response = propagator(load, length - s);
      for (unsigned int i = 0; i < n; ++i)
        result[i] += rule.weight(q) * length * p * response[i];
    }
  return result;
}

template <int n>
void HistoryResponse<n>::append(const double t1, const unsigned int halvings, const std::size_t most_ends) const
{
  const double t0     = ends.back();
  const State  y0     = states.back();
  const double middle = 0.5 * (t0 + t1);
  const State  whole  = advance(y0, t0, t1);
  const State  half   = advance(y0, t0, middle);
  const State  halves = advance(half, middle, t1);

  State difference;
  for (unsigned int i = 0; i < n; ++i)
    difference[i] = halves[i] - whole[i];
  const double scale = std::max({largest, size(half), size(halves), smallest_size});
  if (size(difference) > panel_tolerance * scale && halvings < most_halvings && middle > t0 && middle < t1)
    {
      append(middle, halvings + 1, most_ends);
      append(t1, halvings + 1, most_ends);
      return;
    }
  if (ends.size() >= most_ends)
    throw InputError("The exact solution cannot integrate the time history near t = " + std::to_string(t0) +
                     " s: it is too rough (noise?). A history with kinks or jumps must announce them as break points.");
  largest = scale;
  ends.push_back(t1);
  states.push_back(halves);
}

template <int n>
void HistoryResponse<n>::grow(const double t) const
{
  // at least twice the length so far: many small requests then need no more panels than one large
  const double target = std::max(t, 2. * ends.back());
  while (ends.back() < target)
    {
      const double start = ends.back();
      const auto   next  = std::upper_bound(breaks.begin(), breaks.end(), start);
      const double end   = next == breaks.end() ? target : std::min(*next, target);
      const double parts = std::max(1., std::ceil((end - start) / longest_panel * (1. - 1e-12)));
      append(parts == 1. ? end : start + (end - start) / parts, 0, ends.size() + most_parts);
    }
}

template <int n>
typename HistoryResponse<n>::State HistoryResponse<n>::operator()(const double t) const
{
  if (!(t > 0.))
    return State{};

  std::shared_lock<std::shared_mutex> reading(mutex);
  while (t > ends.back())
    {
      reading.unlock();
      {
        const std::unique_lock<std::shared_mutex> writing(mutex);
        if (t > ends.back())
          grow(t);
      }
      reading.lock();
    }
  const std::size_t panel = std::upper_bound(ends.begin(), ends.end(), t) - ends.begin() - 1;
  const double      start = ends[panel];
  const State       y     = states[panel];
  reading.unlock();
  return t == start ? y : advance(y, start, t);
}

template <int n>
std::size_t HistoryResponse<n>::panels() const
{
  const std::shared_lock<std::shared_mutex> reading(mutex);
  return ends.size() - 1;
}

template class HistoryResponse<1>;
template class HistoryResponse<2>;
} // namespace Arenite
