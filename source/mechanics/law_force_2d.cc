#include <arenite/mechanics/make_law_force.h>

namespace Arenite
{
template std::unique_ptr<InternalForce<2>> make_law_force<2>(const ElementChoice &, const KinematicsChoice &,
                                                             std::unique_ptr<const BatchLaw>,
                                                             dealii::types::material_id, Symmetry);
} // namespace Arenite
