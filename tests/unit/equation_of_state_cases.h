#pragma once

#include <arenite/materials/barotropic.h>
#include <arenite/materials/ideal_gas.h>
#include <arenite/materials/mie_grueneisen.h>
#include <arenite/materials/porous_compaction.h>
#include <arenite/materials/soil_stiffening.h>
#include <arenite/materials/tabulated_compaction.h>
#include <arenite/materials/three_phase_mixture.h>

#include <boost/test/unit_test.hpp>

// One sensible material per equation of state, shared by the tests, and one point that follows a path of densities.

namespace EquationOfStateCases
{
using namespace Arenite;

inline LinearCompression linear()
{
  LinearCompression eos;
  eos.density       = 1800.;
  eos.bulk_modulus  = 4e8;
  eos.tension_limit = 1e6;
  return eos;
}

inline PolynomialCompression polynomial()
{
  PolynomialCompression eos;
  eos.density         = 1000.;
  eos.K1              = 2.2e9;
  eos.K2              = 9.5e9;
  eos.K3              = 14.6e9;
  eos.tension_modulus = 2e9;
  eos.tension_limit   = 5e6;
  eos.finalize(Parameters());
  return eos;
}

inline SoilStiffening stiffening(const unsigned int exponent = 3)
{
  SoilStiffening eos; // porosity 0.4, saturation 0.5
  eos.density           = 1790.;
  eos.compacted_density = 1790. / .8;
  eos.bulk_modulus      = 1.2e8;
  eos.compacted_modulus = 7.46e9;
  eos.exponent          = exponent;
  eos.tension_limit     = 1e5;
  BOOST_TEST_REQUIRE(eos.prepare() == "");
  return eos;
}

/// Dry sand of Laine and Sandvik (2001); the pressures are those of the paper, the speeds those of the AUTODYN library.
inline TabulatedCompaction dry_sand()
{
  TabulatedCompaction eos;
  eos.loading   = {{1674., 0.},       {1739.5, 4.577e6},  {1873.8, 14.98e6},  {1997., 29.151e6},  {2143.8, 59.175e6},
                   {2250., 98.098e6}, {2380., 179.443e6}, {2485., 289.443e6}, {2585., 450.198e6}, {2671.3, 650.66e6}};
  eos.unloading = {{1674., 265.2},  {1745.6, 852.1}, {2086.3, 1721.7}, {2146.8, 1875.5}, {2300., 2264.8},
                   {2572., 2956.1}, {2598., 3112.2}, {2635., 4600.},   {2641., 4634.},   {2800., 4634.}};
  eos.tension_limit = 1e3;
  BOOST_TEST_REQUIRE(eos.prepare() == "");
  return eos;
}

inline MieGrueneisen wet_soil()
{
  MieGrueneisen eos;
  eos.density       = 1800.;
  eos.sound_speed   = 1500.;
  eos.slope         = 1.8;
  eos.gamma         = 1.2;
  eos.tension_limit = 2e6;
  BOOST_TEST_REQUIRE(eos.prepare() == "");
  return eos;
}

/// Dry quartz sand; the solid by its usual constants.
inline PorousCompaction porous_sand()
{
  PorousCompaction eos;
  eos.solid.density     = 2650.;
  eos.solid.sound_speed = 3700.;
  eos.solid.slope       = 1.8;
  eos.solid.gamma       = .6;
  eos.density           = 1700.;
  eos.elastic_speed     = 1000.;
  eos.crush_onset       = 1e6;
  eos.crush_end         = 1e9;
  eos.tension_limit     = 1e4;
  BOOST_TEST_REQUIRE(eos.prepare() == "");
  return eos;
}

/// 4 % of air.
inline ThreePhaseMixture mixture(const double air = .04)
{
  ThreePhaseMixture eos;
  eos.fraction[0]   = air;
  eos.fraction[1]   = .40 - air;
  eos.fraction[2]   = .60;
  eos.density       = 1000. * eos.fraction[1] + 2650. * .60;
  eos.air_pressure  = 101325.;
  eos.modulus_of[0] = 1.4 * 101325.;
  eos.modulus_of[1] = 2.25e9;
  eos.modulus_of[2] = 36.6e9;
  eos.tension_limit = air > 0. ? 5e4 : 1e6;
  BOOST_TEST_REQUIRE(eos.prepare() == "");
  return eos;
}

template <typename EOS, typename Number = double>
struct Point
{
  const EOS                             *eos;
  typename EOS::template History<Number> history;
  Number                          density, pressure = Number(0.), work = Number(0.); ///< [J/kg] done on the point
  EquationOfStateResponse<Number> response = {Number(0.), Number(0.), Number(0.)};

  explicit Point(const EOS &eos)
    : eos(&eos)
    , density(Number(eos.reference_density()))
  {
    auto                initial = eos.initial_history();
    std::vector<double> values;
    initial.for_each([&](const char *, const double value) { values.push_back(value); });
    std::size_t k = 0;
    history.for_each([&](const char *, Number &value) { value = Number(values[k++]); });
  }

  void move_to(const Number &next)
  {
    response = eos->update(VolumeChange<Number>{density, next, pressure}, history);
    work     = work - Number(.5) * (pressure + response.pressure) * (Number(1.) / next - Number(1.) / density);
    density  = next;
    pressure = response.pressure;
  }
  /// In steps of at most 0.5 % of density.
  void walk_to(const Number &target, const int steps = 100)
  {
    const Number start = density;
    for (int i = 1; i <= steps; ++i)
      move_to(start + Number(double(i) / steps) * (target - start));
  }
};

/// Call @p test with every equation of state and the range of densities [lower, upper]/rho_0 in which it is exercised.
template <typename Test>
void for_every_equation_of_state(const Test &test)
{
  test(linear(), .9, 1.5);
  test(polynomial(), .9, 1.5);
  for (const unsigned int m : {1u, 2u, 3u, 4u})
    test(stiffening(m), .9, 1.5);
  test(dry_sand(), .9, 1.65);
  test(wet_soil(), .9, 1.5); // 8.4 GPa on the Hugoniot, 10 GPa is the end of the range
  test(IdealGas(), .5, 4.);
  test(porous_sand(), .9, 1.7);
  test(mixture(), .9, 1.35);
  test(mixture(0.), .9, 1.35);
}
} // namespace EquationOfStateCases
