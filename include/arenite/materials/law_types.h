#pragma once

#include <arenite/materials/geologic_cap.h>
#include <arenite/materials/linear_elastic_law.h>
#include <arenite/materials/soil_stiffness.h>
#include <arenite/materials/undrained_cap.h>
#include <arenite/materials/viscoelastic.h>

#include <tuple>

namespace Arenite
{
/// Every law that `set Law` can choose, in the order of the manual. A line here registers a law for scenes, bench and manual, and
/// puts it under the tests of the contract.
using LawTypes = std::tuple<LinearElasticLaw,                   //
                            ViscoplasticCap<ConstantStiffness>, //
                            ViscoplasticCap<SoilStiffness>,     //
                            UndrainedCap,                       //
                            GeologicCap,                        //
                            Viscoelastic                        //
                            >;
} // namespace Arenite
