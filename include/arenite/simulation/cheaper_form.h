#pragma once

#include <arenite/base/reduction.h>
#include <arenite/simulation/scene.h>

#include <vector>

namespace Arenite
{
/// Forms in fewer dimensions with the motion of the scene, cheapest first: all parts of it, as they are declared, admit them. Before the
/// simulation takes the loads. A scene may be symmetric without being found here; what is found is symmetric.
template <int dim>
std::vector<Reduction> cheaper_forms(const Scene<dim> &, const Parameters &);
} // namespace Arenite
