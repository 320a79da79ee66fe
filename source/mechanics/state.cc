#include <arenite/base/state_archive.h>
#include <arenite/mechanics/state.h>

namespace Arenite
{
void PointData::exchange(StateArchive &archive)
{
  archive.common(step);
  for (double *value : {&stored_energy, &hourglass_work, &dissipated, &viscous_work, &volume_change})
    archive.sum(*value);
}
} // namespace Arenite
