#pragma once

#include <chrono>

namespace Arenite
{
/// Adds the wall time of its life to a sum [s]; without a sum it does not look at the clock.
class Stopwatch
{
public:
  explicit Stopwatch(double *const sum)
    : sum(sum)
  {
    if (sum)
      start = std::chrono::steady_clock::now();
  }
  ~Stopwatch()
  {
    if (sum)
      *sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  Stopwatch(const Stopwatch &)            = delete;
  Stopwatch &operator=(const Stopwatch &) = delete;

private:
  double *const                         sum;
  std::chrono::steady_clock::time_point start;
};
} // namespace Arenite
