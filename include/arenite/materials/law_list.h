#pragma once

#include <arenite/base/registry.h>
#include <arenite/materials/batch_law.h>

namespace Arenite
{
/// The laws of law_types.h on 1 lane, for the bench, or on native_lanes, for meshes. Names do not depend on the lanes.
const Registry<BatchLaw> &material_laws(int lanes);
} // namespace Arenite
