// Energy of the caps in cycles of large volume and shear strain. The fluidity is 0: all that happens is elastic, or stiffening.

#include <arenite/materials/batch_law.h>
#include <arenite/materials/material_point.h>
#include <arenite/materials/soil_stiffness.h>
#include <arenite/materials/viscoplastic_cap.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

#include "law_example.h"

using namespace Arenite;

namespace
{
template <typename Stiffness>
BatchLawFor<ViscoplasticCap<Stiffness>, 1> elastic_example(const std::string &block)
{
  using Law = ViscoplasticCap<Stiffness>;
  BatchLawFor<Law, 1> batch;
  batch.law           = law_of_block<Law>(example_file(Law::name), block);
  batch.law.viscosity = Law::Viscosity::perzyna;
  batch.law.fluidity  = 0.;
  return batch;
}

constexpr double compression = 0.2, distortion = 0.05;

/// Compress, shear, expand, shear back; @p n steps each. @return the work of the cycle
double cycle(MaterialPoint &point, const int n)
{
  const double      before = point.state.work;
  SymTensor<double> shear;
  shear[3]                       = distortion / n;
  const SymTensor<double> volume = spherical(-compression / 3. / n);
  for (const auto &increment : {volume, shear, volume * -1., shear * -1.})
    for (int i = 0; i < n; ++i)
      point.advance(increment, 1e-6);
  return point.state.work - before;
}
} // namespace

BOOST_AUTO_TEST_SUITE(large_strain_cycles)

// With stiffening the first cycle costs energy, because K has grown; it is booked as dissipated. The second one, below the largest density,
// is elastic and costs and gives nothing. What both seem to win or lose is the trapezoidal rule of the bench: second order in the step.
BOOST_AUTO_TEST_CASE(stiffening)
{
  for (const std::string block : {"moist sand", "dry sand"})
    {
      const auto batch         = elastic_example<SoilStiffness>(block);
      double     coarse_second = 0., coarse_balance = 0.;
      for (const int n : {200, 400})
        {
          MaterialPoint point(batch);
          const double  first   = cycle(point, n);
          const double  balance = first - (point.state.stored + point.state.dissipated);
          const double  second  = cycle(point, n);
          const double  scale   = point.state.dissipated;
          BOOST_TEST_MESSAGE(block << ", n = " << n << ": first " << first << " J/m^3, second " << second
                                   << ", balance " << balance);
          BOOST_TEST(first > 0.);
          BOOST_TEST(std::abs(second) < 1e-4 * scale);
          BOOST_TEST(std::abs(balance) < 1e-4 * scale);
          if (n == 400)
            {
              BOOST_TEST(std::abs(second) < .27 * coarse_second + 1e-10 * scale);
              BOOST_TEST(std::abs(balance) < .27 * coarse_balance + 1e-10 * scale);
            }
          coarse_second  = std::abs(second);
          coarse_balance = std::abs(balance);
        }
    }
}

// A pressure that no compression reaches, as a start or a transfer may give it, has an energy that is a number.
BOOST_AUTO_TEST_CASE(pressure_without_a_density)
{
  using Law = ViscoplasticCap<SoilStiffness>;
  for (const auto viscosity : {Law::Viscosity::perzyna, Law::Viscosity::none})
    for (const double volume : {-1e-3, 0., 1e-3})
      {
        Law law                     = elastic_example<SoilStiffness>("moist sand").law;
        law.viscosity               = viscosity;
        auto                   h    = law.initial_history();
        const double           p    = 2000. * law.stiffness.soil.bulk_modulus;
        PointIncrement<double> step = {spherical(volume / 3.), law.density(), law.density() * std::exp(-volume), 1e-6};
        const auto             r    = law.update(spherical(-p), step, h);
        BOOST_TEST((std::isfinite(r.stored) && r.stored > 0.), r.stored);
        BOOST_TEST(std::isfinite(r.dissipated), r.dissipated);
        BOOST_TEST(std::isfinite(r.wave_speed), r.wave_speed);
      }
}

// Constant moduli of the Cauchy stress, the form of the source, are meant for small strain: the shear energy G gamma^2/2 belongs to the
// present volume, so that the cycle returns (1 - e^-0.2) of it more than it received. Exact but for the trapezoidal rule.
BOOST_AUTO_TEST_CASE(constant_moduli_win_the_change_of_volume)
{
  auto          batch = elastic_example<ConstantStiffness>(example_blocks("viscoplastic cap").front());
  MaterialPoint point(batch);
  const double  work = cycle(point, 400), G = batch.law.stiffness.elastic.shear_modulus;
  const double  shear_energy = 2. * G * distortion * distortion;
  BOOST_TEST(work == -(1. - std::exp(-compression)) * shear_energy, boost::test_tools::tolerance(1e-4));
}

BOOST_AUTO_TEST_SUITE_END()
