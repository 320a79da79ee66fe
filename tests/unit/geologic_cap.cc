// The geologic cap against published and closed-form results.

#include <arenite/materials/geologic_cap.h>

#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <random>

using namespace Arenite;

namespace
{
constexpr double ksi = 6.894757e6;

GeologicCap mccormick_ranch_sand()
{
  GeologicCap law;
  law.elastic                  = {2000., 66.67 * ksi, 40. * ksi};
  law.surface.alpha            = 0.25 * ksi;
  law.surface.gamma            = 0.18 * ksi;
  law.surface.beta             = 0.67 / ksi;
  law.surface.axis_ratio       = 2.5;
  law.surface.hardening_rate   = 0.67 / ksi;
  law.surface.hardening_limit  = 0.066;
  law.surface.initial_position = 0.;
  law.tension_cutoff           = 0.3 * ksi;
  BOOST_TEST_REQUIRE(law.surface.finalize() == "");
  law.derive();
  return law;
}

struct Row
{
  double strain, axial, lateral, kappa; ///< stresses in ksi, compression positive
};

/// Uniaxial strain to 6 % in steps of one size; the largest differences from @p rows.
std::array<double, 3> largest_difference(const GeologicCap &law, const unsigned int n_steps,
                                         const std::vector<Row> &rows)
{
  std::array<double, 3> worst{};
  auto                  history = law.initial_history();
  SymTensor<double>     stress;
  std::size_t           row = 0;
  for (unsigned int step = 1; step <= n_steps; ++step)
    {
      PointIncrement<double> increment;
      increment.strain[0]   = -0.06 / n_steps;
      increment.density_old = increment.density = 2000.;
      stress                                    = law.update(stress, increment, history).stress;
      if (row < rows.size() && std::abs(0.06 * step / n_steps - rows[row].strain) < 1e-9)
        {
          worst[0] = std::max(worst[0], std::abs(-stress[0] / ksi - rows[row].axial));
          worst[1] = std::max(worst[1], std::abs(-stress[1] / ksi - rows[row].lateral));
          worst[2] = std::max(worst[2], std::abs(history.kappa / ksi - rows[row].kappa));
          ++row;
        }
    }
  BOOST_TEST(row == rows.size());
  return worst;
}
} // namespace

BOOST_AUTO_TEST_SUITE(geologic_cap)

// McCormick Ranch sand in uniaxial strain, Sandler & Rubin (1979): the published rows with the published steps of 0.5 %. The axial
// stress agrees to the digits of the table, the lateral one and kappa to those that the algorithms differ by at this step.
BOOST_AUTO_TEST_CASE(mccormick_ranch_published_rows)
{
  const auto worst = largest_difference(mccormick_ranch_sand(), 12,
                                        {{0.005, .06221, .00277, -.05027},
                                         {0.010, .11918, .01548, .03880},
                                         {0.020, .21683, .07752, .23829},
                                         {0.030, .32943, .15587, .47886},
                                         {0.040, .46264, .25259, .77786},
                                         {0.050, .62496, .37575, 1.16256},
                                         {0.060, .83043, .53906, 1.67941}});
  BOOST_TEST(worst[0] < 1e-5);
  BOOST_TEST(worst[1] < 5e-5);
  BOOST_TEST(worst[2] < 5e-5);
}

// The same with small steps: an independent closest-point integration with 12 000 steps, to its five digits and the first-order
// difference between the two step sizes.
BOOST_AUTO_TEST_CASE(mccormick_ranch_converged)
{
  const auto worst = largest_difference(mccormick_ranch_sand(), 6000,
                                        {{0.005, .06220, .00284, 0.},
                                         {0.010, .11945, .01244, 0.},
                                         {0.020, .21684, .07726, 0.},
                                         {0.030, .32945, .15556, 0.},
                                         {0.040, .46268, .25205, 0.},
                                         {0.050, .62503, .37480, 0.},
                                         {0.060, .83058, .53737, 0.}});
  BOOST_TEST(worst[0] < 1.5e-5);
  BOOST_TEST(worst[1] < 1.5e-5);
}

// In isotropic compression k follows X = I1: volume strain = I1/(3K) + W (1 - exp(-D I1)); exact in every step.
BOOST_AUTO_TEST_CASE(isotropic_compression)
{
  const GeologicCap law     = mccormick_ranch_sand();
  auto              history = law.initial_history();
  SymTensor<double> stress;
  for (unsigned int step = 1; step <= 5; ++step)
    {
      PointIncrement<double> increment;
      increment.density_old = increment.density = 2000.;
      for (int k = 0; k < 3; ++k)
        increment.strain[k] = -0.01 / 3.;
      stress           = law.update(stress, increment, history).stress;
      const double I1  = -trace(stress);
      const double sum = I1 / (3. * law.elastic.bulk_modulus) +
                         law.surface.hardening_limit * (1. - std::exp(-law.surface.hardening_rate * I1));
      BOOST_TEST(sum == 0.01 * step, boost::test_tools::tolerance(1e-12));
    }
}

// On random paths: the state ends inside of the surfaces (to round-off of the stress scale), nothing is created, the cap of a rock
// never contracts, that of a soil not below its start; lanes give what the points give one by one.
BOOST_AUTO_TEST_CASE(random_paths)
{
  std::mt19937_64 random(7);
  const auto      uniform = [&]() { return std::uniform_real_distribution<double>(-1., 1.)(random); };
  constexpr int   W       = 4;
  for (const std::string type : {"soil", "rock"})
    {
      GeologicCap law = mccormick_ranch_sand();
      law.type        = type;
      for (unsigned int path = 0; path < 200; ++path)
        {
          const double                                size = std::pow(10., -3. + 2. * uniform());
          std::array<SymTensor<double>, W>            stress;
          std::array<GeologicCap::History<double>, W> history;
          SymTensor<Lanes<W>>                         stress_l;
          GeologicCap::History<Lanes<W>>              history_l;
          history.fill(law.initial_history());
          history_l.kappa = Lanes<W>(law.initial_history().kappa);
          for (unsigned int step = 0; step < 30; ++step)
            {
              PointIncrement<Lanes<W>> increment_l;
              increment_l.density_old = increment_l.density = Lanes<W>(2000.);
              std::array<PointIncrement<double>, W> increment;
              for (int l = 0; l < W; ++l)
                for (int k = 0; k < 6; ++k)
                  {
                    increment[l].strain[k] = size * (uniform() - (k < 3 ? 0.3 : 0.));
                    set_lane(increment_l.strain[k], l, increment[l].strain[k]);
                    increment[l].density_old = increment[l].density = 2000.;
                  }
              const auto response_l = law.update(stress_l, increment_l, history_l);
              stress_l              = response_l.stress;
              for (int l = 0; l < W; ++l)
                {
                  const double kappa_n  = history[l].kappa;
                  const double scale    = law.surface.F0 + 3. * law.elastic.bulk_modulus * size;
                  const auto   response = law.update(stress[l], increment[l], history[l]);
                  stress[l]             = response.stress;
                  const double I1 = -trace(stress[l]), j = std::sqrt(second_invariant(deviator(stress[l])));
                  const auto   cap = law.surface.cap(history[l].kappa);
                  BOOST_TEST_REQUIRE(std::isfinite(I1 + j + history[l].kappa));
                  BOOST_TEST_REQUIRE(I1 >= -law.tension_cutoff - 1e-9 * scale);
                  if (I1 < cap.L)
                    BOOST_TEST_REQUIRE(j <= law.surface.failure(I1).value + 1e-9 * scale);
                  else
                    BOOST_TEST_REQUIRE(std::hypot(j, (I1 - cap.L) / cap.R) <= cap.b + 1e-9 * scale);
                  BOOST_TEST_REQUIRE(history[l].kappa >= law.smallest_kappa - 1e-9 * scale);
                  if (type == "rock")
                    BOOST_TEST_REQUIRE(history[l].kappa >= kappa_n - 1e-9 * scale);
                  for (int k = 0; k < 6; ++k)
                    BOOST_TEST_REQUIRE(std::abs(stress[l][k] - lane(stress_l[k], l)) < 1e-9 * scale);
                }
            }
        }
    }
}

// What is surely inside of the surface is inside; and it is most of the inside, so that the question is worth asking. Caps that begin at
// I1 = 0 are taken for their first one: they have their own count.
BOOST_AUTO_TEST_CASE(surely_inside)
{
  std::mt19937_64 random(11);
  const auto      uniform   = [&]() { return (random() >> 11) * 0x1p-53; };
  unsigned int    inside[2] = {0, 0}, sure[2] = {0, 0}, wrong = 0;
  for (unsigned int set = 0; set < 100; ++set)
    {
      GeologicCapSurface s;
      s.alpha            = std::pow(10., 4. + 3. * uniform());
      s.gamma            = set % 5 ? s.alpha * 0.9 * uniform() : 0.;
      s.beta             = set % 7 ? std::pow(10., -8. + 3. * uniform()) : 0.;
      s.theta            = set % 11 ? 0.3 * uniform() : 0.;
      s.axis_ratio       = 1. + 5. * uniform();
      s.hardening_rate   = 1e-8;
      s.hardening_limit  = 0.2;
      s.initial_position = 0.2 * s.alpha * uniform();
      BOOST_TEST_REQUIRE(s.finalize() == "");
      for (unsigned int i = 0; i < 2000; ++i)
        {
          const double X     = s.initial_position + s.smallest_position * (i % 2 ? uniform() : 10. * uniform());
          const double kappa = s.junction(X), I1 = -0.3 * s.alpha + uniform() * (1.1 * X + 0.3 * s.alpha);
          const double j   = 1.5 * uniform() * s.failure(std::max(I1, 0.)).value;
          const auto   cap = s.cap(kappa);
          const double f   = I1 < cap.L ? j - s.failure(I1).value : std::hypot(j, (I1 - cap.L) / cap.R) - cap.b;
          const bool   yes = s.surely_inside(I1, j * j, kappa), first = kappa < 0.;
          inside[first] += f < 0.;
          sure[first] += yes;
          wrong += yes && f > 1e-12 * (j + std::abs(I1));
        }
    }
  BOOST_TEST_MESSAGE(sure[0] << " of " << inside[0] << ", caps at 0: " << sure[1] << " of " << inside[1]);
  BOOST_TEST(inside[0] > 20000u);
  BOOST_TEST(inside[1] > 2000u);
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(sure[0] > 0.8 * inside[0]);
  BOOST_TEST(sure[1] > 0u);
}

BOOST_AUTO_TEST_SUITE_END()
