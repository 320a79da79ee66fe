#include <arenite/mechanics/make_law_force.h>

namespace Arenite
{
template std::unique_ptr<InternalForce<1>> make_law_force<1>(const ElementChoice &, const KinematicsChoice &,
                                                             std::unique_ptr<const BatchLaw>,
                                                             dealii::types::material_id, Symmetry);
} // namespace Arenite
