// Closed forms of the viscoplastic cap. Parameters: a loose sand (K = 106.4 MPa).

#include <arenite/materials/batch_law.h>
#include <arenite/materials/material_point.h>
#include <arenite/materials/viscoplastic_cap.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>

#include "loose_sand.h"

using namespace Arenite;

namespace
{
using Law = ViscoplasticCap<ConstantStiffness>;

const double K = 106.4e6, G = 63.85e6;

BatchLawFor<Law, 1> sand(const double exponent)
{
  BatchLawFor<Law, 1> batch;
  Law                &law = batch.law;
  law.stiffness.elastic   = {2000., K, G};
  law.surface             = loose_sand();
  law.fluidity            = 200.;
  law.overstress          = 1e6;
  law.exponent            = exponent;
  law.substep_size        = 0.;
  law.gap_closure         = false;
  BOOST_REQUIRE(law.surface.finalize() == "");
  return batch;
}

double first_invariant(const MaterialPoint &point) { return -trace(point.state.stress); }
double shear(const MaterialPoint &point) { return std::sqrt(second_invariant(deviator(point.state.stress))); }
double position(const Law &law, const MaterialPoint &point) { return law.surface.cap(point.state.history[0]).X; }

/// Value of a first-order method after @p n steps, extrapolated from n and 2n: the error that is left is of second order.
double extrapolated(const unsigned int n, const std::function<double(unsigned int)> &after)
{
  return 2. * after(2 * n) - after(n);
}
} // namespace

BOOST_AUTO_TEST_SUITE(cap_closed_forms)

// Rate-independent isotropic compression: y = 1 + D (X - X0) is the positive root of a quadratic, I1 = X; exact in one step.
BOOST_AUTO_TEST_CASE(rate_independent_compression)
{
  auto batch          = sand(1.);
  batch.law.viscosity = Law::Viscosity::none;
  const CapSurface &s = batch.law.surface;
  for (const double compression : {0.005, 0.02, 0.1, 0.4})
    {
      MaterialPoint point(batch);
      point.advance(spherical(-compression / 3.), 1.);
      const double D = s.hardening_rate, W = s.hardening_limit, X0 = s.initial_position;
      const double a = 1. / (3. * K * D), b = X0 / (3. * K) - a + W - compression;
      const double y = (-b + std::sqrt(b * b + 4. * a * W)) / (2. * a), X = X0 + (y - 1.) / D;
      BOOST_TEST(first_invariant(point) == X, boost::test_tools::tolerance(1e-11));
      BOOST_TEST(position(batch.law, point) == X, boost::test_tools::tolerance(1e-11));
      BOOST_TEST(shear(point) < 1e-9 * X);
    }
}

// Hydrostatic tension at fixed strain: f_dot = -c f^N.
BOOST_AUTO_TEST_CASE(relaxation_of_tension)
{
  for (const double N : {1., 1.5, 2.})
    {
      const auto        batch = sand(N);
      const CapSurface &s     = batch.law.surface;
      const double      A = s.tension_limit + s.tension_center, ratio = s.tension_axis / A; // B/A
      const double      c  = 9. * K * ratio * ratio * batch.law.fluidity / std::pow(batch.law.overstress, N);
      const double      fi = 1e5, I1_i = -s.tension_limit - fi / ratio;
      const double duration = N == 1. ? 2. / c : (std::pow(0.3 * fi, 1. - N) - std::pow(fi, 1. - N)) / ((N - 1.) * c);
      const double f        = N == 1. ? fi * std::exp(-c * duration)
                                      : std::pow(std::pow(fi, 1. - N) + (N - 1.) * c * duration, 1. / (1. - N));
      const double result   = extrapolated(2000, [&](const unsigned int n) {
        MaterialPoint point(batch);
        point.state.stress = spherical(-I1_i / 3.);
        for (unsigned int i = 0; i < n; ++i)
          point.advance(SymTensor<double>(), duration / n);
        return ratio * (-s.tension_limit - first_invariant(point));
      });
      BOOST_TEST(result == f, boost::test_tools::tolerance(2e-6)); // (c dt)^2
    }
}

// Tension at a constant rate of volume strain, N = 1: f = (a/c) (1 - exp(-c (t - t0))).
BOOST_AUTO_TEST_CASE(tension_at_constant_rate)
{
  const auto        batch = sand(1.);
  const CapSurface &s     = batch.law.surface;
  const double      ratio = s.tension_axis / (s.tension_limit + s.tension_center), rate = 50.;
  const double      c = 9. * K * ratio * ratio * batch.law.fluidity / batch.law.overstress;
  const double      a = ratio * 3. * K * rate, t0 = s.tension_limit / (3. * K * rate), duration = 2. / c;
  const double      f      = a / c * (1. - std::exp(-c * duration));
  const double      result = extrapolated(2000, [&](const unsigned int n) {
    MaterialPoint point(batch);
    point.advance(spherical(rate * t0 / 3.), t0); // elastic
    for (unsigned int i = 0; i < n; ++i)
      point.advance(spherical(rate * duration / n / 3.), duration / n);
    return ratio * (-s.tension_limit - first_invariant(point));
  });
  BOOST_TEST(result == f, boost::test_tools::tolerance(2e-6));
}

// Relaxation onto a straight failure surface, N = 1: exponential in f, the stress moves along a straight line.
BOOST_AUTO_TEST_CASE(relaxation_to_the_failure_surface)
{
  auto         batch = sand(1.);
  CapSurface  &s     = batch.law.surface;
  const double theta = s.theta;
  s.gamma            = 0.;
  s.initial_position = 5e7; // far away
  BOOST_REQUIRE(s.finalize() == "");
  const double stiffness = G + 9. * K * theta * theta, I1_i = 2e6, f_i = 3e5, j_i = s.alpha + theta * I1_i + f_i;
  const double duration = 1.5 * batch.law.overstress / (stiffness * batch.law.fluidity);
  const double f = f_i * std::exp(-1.5), multiplier = (f_i - f) / stiffness;
  BOOST_REQUIRE(I1_i + 9. * K * theta * multiplier < s.cap(s.junction(s.initial_position)).L);
  const auto after = [&](const unsigned int n) {
    MaterialPoint point(batch);
    point.state.stress    = spherical(-I1_i / 3.);
    point.state.stress[3] = j_i;
    for (unsigned int i = 0; i < n; ++i)
      point.advance(SymTensor<double>(), duration / n);
    return point;
  };
  BOOST_TEST(extrapolated(2000, [&](const unsigned int n) { return shear(after(n)); }) == j_i - G * multiplier,
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(extrapolated(2000, [&](const unsigned int n) { return first_invariant(after(n)); }) ==
               I1_i + 9. * K * theta * multiplier,
             boost::test_tools::tolerance(1e-6));
}

// An isotropic state in front of the cap relaxes until I1 = X, with X + 3 K k(X) = I1_i + 3 K k_i; one step of 1e9 s.
BOOST_AUTO_TEST_CASE(relaxation_to_the_cap)
{
  const auto        batch = sand(1.5);
  const CapSurface &s     = batch.law.surface;
  MaterialPoint     point(batch);
  const double      I1_i = 2e7;
  point.state.stress     = spherical(-I1_i / 3.);
  point.advance(SymTensor<double>(), 1e9);
  const double X = position(batch.law, point);
  // the overstress of a step of 1e9 s is 1e-7 of f0 and less for this exponent; see the identity below
  BOOST_TEST(first_invariant(point) + 3. * K * s.compaction(X) == I1_i, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(first_invariant(point) == X, boost::test_tools::tolerance(1e-7));
}

// Steady compression: (I1 - X)/R = f0 (R k_dot/(3 eta))^(1/N), in every step.
BOOST_AUTO_TEST_CASE(overstress_of_steady_compression)
{
  for (const double N : {1., 1.5, 3.})
    {
      const auto        batch = sand(N);
      const CapSurface &s     = batch.law.surface;
      MaterialPoint     point(batch);
      const double      rate = 20., dt = 1e-5;
      double            k = 0.;
      for (int i = 0; i < 500; ++i)
        {
          point.advance(spherical(-rate * dt / 3.), dt);
          const double X = position(batch.law, point), k_dot = (s.compaction(X) - k) / dt;
          k = s.compaction(X);
          if (i > 100)
            BOOST_TEST((first_invariant(point) - X) / s.axis_ratio ==
                         batch.law.overstress * std::pow(s.axis_ratio * k_dot / (3. * batch.law.fluidity), 1. / N),
                       boost::test_tools::tolerance(1e-7));
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
