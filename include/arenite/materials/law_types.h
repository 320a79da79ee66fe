#pragma once

#include <arenite/materials/barotropic.h>
#include <arenite/materials/eos_with_strength.h>
#include <arenite/materials/geologic_cap.h>
#include <arenite/materials/ideal_gas.h>
#include <arenite/materials/linear_elastic_law.h>
#include <arenite/materials/mie_grueneisen.h>
#include <arenite/materials/neo_hookean.h>
#include <arenite/materials/porous_compaction.h>
#include <arenite/materials/soil_stiffening.h>
#include <arenite/materials/soil_stiffness.h>
#include <arenite/materials/tabulated_compaction.h>
#include <arenite/materials/three_phase_mixture.h>
#include <arenite/materials/undrained_cap.h>
#include <arenite/materials/viscoelastic.h>

#include <tuple>

namespace Arenite
{
/// Every law that `set Law` can choose, in the order of the manual. A line here registers a law for scenes, bench and manual, and
/// puts it under the tests of the contract.
using LawTypes = std::tuple<LinearElasticLaw,                                   //
                            NeoHookean,                                         //
                            ViscoplasticCap<ConstantStiffness>,                 //
                            ViscoplasticCap<SoilStiffness>,                     //
                            UndrainedCap,                                       //
                            GeologicCap,                                        //
                            Viscoelastic,                                       //
                            EquationOfStateWithStrength<SoilStiffening>,        //
                            EquationOfStateWithStrength<TabulatedCompaction>,   //
                            EquationOfStateWithStrength<PorousCompaction>,      //
                            EquationOfStateWithStrength<ThreePhaseMixture>,     //
                            EquationOfStateWithStrength<MieGrueneisen>,         //
                            EquationOfStateWithStrength<LinearCompression>,     //
                            EquationOfStateWithStrength<PolynomialCompression>, //
                            EquationOfStateWithStrength<IdealGas>               //
                            >;
} // namespace Arenite
