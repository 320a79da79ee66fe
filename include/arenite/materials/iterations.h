#pragma once

#include <arenite/base/number.h>

namespace Arenite
{
/// Passes of the iterations inside of an update, and the lanes that still needed each. The rest of lanes x passes is what the
/// lanes lose by waiting for the slowest. Nobody reads it in a run of a mesh, where the compiler removes it.
struct Iterations
{
  unsigned int passes = 0, lanes = 0;

  template <typename M>
  ARENITE_INLINE void count(const M &active)
  {
    ++passes;
    lanes += count_of(active);
  }
  Iterations &operator+=(const Iterations &other)
  {
    passes += other.passes;
    lanes += other.lanes;
    return *this;
  }
};
} // namespace Arenite
