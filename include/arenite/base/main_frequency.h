#pragma once

#include <arenite/base/time_history.h>

namespace Arenite
{
/// Root mean square frequency of the rate p' from 0 to @p end [Hz]: 1/(2 pi) sqrt(int p''^2 dt/int p'^2 dt), by differences. Infinite
/// if p' is not continuous, 0 if p is constant.
double main_frequency(const TimeHistory &, double end);
} // namespace Arenite
