// The tangent of the cap's return mapping against differences of the return and against differentiable numbers.

#include <arenite/materials/cap_tangent.h>
#include <arenite/materials/viscoplastic_cap.h>

#include <boost/test/unit_test.hpp>

#include <Sacado_Fad_SimpleFad.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "loose_sand.h"

using namespace Arenite;

namespace
{
using Law = ViscoplasticCap<ConstantStiffness>;
using D   = TwoDerivatives<double>;

const double K = 106.4e6, G = 63.85e6;

struct Flow
{
  Law::Viscosity viscosity;
  double         exponent = 1.;
};
const Flow rate_independent{Law::Viscosity::none}, linear{Law::Viscosity::perzyna},
  between{Law::Viscosity::perzyna, 1.5}, cubic{Law::Viscosity::perzyna, 3.}, relaxing{Law::Viscosity::duvaut_lions};

Law sand(const double X0, const Flow &flow)
{
  Law law;
  law.stiffness.elastic      = {2000., K, G};
  law.surface                = loose_sand(X0);
  law.surface.small_cap_rule = true;
  law.viscosity              = flow.viscosity;
  law.relaxation_time        = 1e-3;
  law.fluidity               = 1e4;
  law.overstress             = 1e5;
  law.exponent               = flow.exponent;
  law.substep_size           = 0.;
  law.gap_closure            = false;
  BOOST_TEST_REQUIRE(law.surface.finalize() == "");
  return law;
}

/// Trial invariants in the region of a cap at @p xi and around it.
struct State
{
  double I1, j, xi, dt;
};

std::vector<State> states(const Law &law, const unsigned int n)
{
  std::mt19937_64    random(3);
  const auto         uniform = [&]() { return (random() >> 11) * 0x1p-53; };
  std::vector<State> result;
  while (result.size() < n)
    {
      const double X = law.surface.initial_position * (1. + 5. * uniform());
      State        s;
      s.xi              = law.surface.junction(X);
      const auto   cap  = law.surface.cap(s.xi);
      const double part = uniform();
      s.I1              = part < 0.25 ? -X * std::pow(uniform(), 3) : 2. * X * uniform();
      s.j               = 3. * law.surface.failure(std::max(s.I1, 0.)).value * uniform();
      s.dt              = std::pow(10., -6. + 6. * uniform());
      if (law.surface.yield_function(s.I1, s.j, cap) > 0.)
        result.push_back(s);
    }
  return result;
}

template <typename Number>
CapReturn<Number> solved(const CapSurface &surface, const CapFlow &flow, const Number &I1, const Number &j,
                         const Number &xi)
{
  CapReturn<Number> step(surface, flow, Number(K), Number(G));
  step.solve(I1, j, xi);
  return step;
}

/// Where a step began and ended.
std::string region(const CapSurface &surface, const State &s, const CapReturn<double> &end)
{
  const auto cap  = surface.cap(s.xi);
  const auto name = [&](const double I1) { return I1 < 0. ? "tension" : (I1 < cap.L ? "failure" : "cap"); };
  if (s.I1 > cap.M && s.I1 >= cap.L)
    return "hardening cap";
  if (end.I1 == cap.L)
    return "sliding";
  return std::string(name(s.I1)) + " to " + name(end.I1);
}
} // namespace

BOOST_AUTO_TEST_SUITE(cap_tangent)

// The four derivatives are those of the return, in every region, rate independent, Perzyna and Duvaut-Lions: differences of fourth order of two step
// sizes; states where these disagree lie next to a switch of the region. Symmetric where nothing hardens, and only there.
BOOST_AUTO_TEST_CASE(derivatives_of_the_invariants)
{
  std::map<std::string, unsigned int> visited;
  unsigned int                        kinks = 0, n = 0;
  double                              worst = 0., worst_symmetry = 0., hardening_asymmetry = 0.;
  for (const double X0 : {1e6, 1e4})
    for (const Flow &kind : {rate_independent, linear, between, cubic, relaxing})
      {
        const Law         law     = sand(X0, kind);
        const CapSurface &surface = law.surface;
        for (const State &s : states(law, 2000))
          {
            const CapFlow flow        = law.flow(s.dt);
            const auto    step        = solved<D>(surface, flow, D(s.I1, 1., 0.), D(s.j, 0., 1.), D(s.xi));
            const double  exact[2][2] = {{step.I1.d[0], step.j.d[0]}, {step.I1.d[1], step.j.d[1]}}; // [trial][end]
            const double  scale       = std::abs(s.I1) + s.j;
            double        error = 0., disagreement = 0.;
            for (int trial = 0; trial < 2; ++trial)
              {
                const auto difference = [&](const double h) {
                  std::array<double, 2> sum{};
                  for (const int i : {-2, -1, 1, 2})
                    {
                      const auto   end = solved<double>(surface, flow, s.I1 + (trial == 0 ? i * h : 0.),
                                                      s.j + (trial == 1 ? i * h : 0.), s.xi);
                      const double w   = (std::abs(i) == 1 ? 8. : -1.) * (i > 0 ? 1. : -1.) / (12. * h);
                      sum[0] += w * end.I1;
                      sum[1] += w * end.j;
                    }
                  return sum;
                };
                const auto coarse = difference(2e-4 * scale), fine = difference(1e-4 * scale);
                for (int end = 0; end < 2; ++end)
                  {
                    error        = std::max(error, std::abs(fine[end] - exact[trial][end]));
                    disagreement = std::max(disagreement, std::abs(fine[end] - coarse[end]));
                  }
              }
            ++n;
            const auto        end  = solved<double>(surface, flow, s.I1, s.j, s.xi);
            const std::string name = region(surface, s, end);
            ++visited[name];
            const double asymmetry = std::abs(G * step.I1.d[1] - 9. * K * step.j.d[0]) / K;
            if (name == "hardening cap")
              hardening_asymmetry = std::max(hardening_asymmetry, asymmetry);
            else if (name != "sliding")
              worst_symmetry = std::max(worst_symmetry, asymmetry);
            if (disagreement > 1e-7)
              ++kinks;
            else
              worst = std::max(worst, error);
          }
      }
  for (const auto &entry : visited)
    BOOST_TEST_MESSAGE(entry.first << ": " << entry.second);
  BOOST_TEST_MESSAGE("error " << worst << ", kinks " << kinks << " of " << n << ", asymmetry " << worst_symmetry
                              << ", of the hardening cap " << hardening_asymmetry);
  for (const std::string name : {"tension to tension", "tension to failure", "failure to failure", "failure to cap",
                                 "cap to cap", "hardening cap", "sliding"})
    BOOST_TEST(visited[name] > 0u, name);
  BOOST_TEST(worst < 1e-8);
  BOOST_TEST(kinks < n / 20);
  BOOST_TEST(worst_symmetry < 1e-8);
  BOOST_TEST(hardening_asymmetry > 1e-2);
}

// C : strain is what differentiable numbers find for the whole law, and lanes give what the points give alone.
BOOST_AUTO_TEST_CASE(tensor_against_differentiable_numbers)
{
  using AD              = Sacado::Fad::SimpleFad<double>;
  constexpr int W       = 4;
  using V               = Lanes<W>;
  double          worst = 0., worst_lanes = 0.;
  std::mt19937_64 random(5);
  const auto      uniform = [&]() { return 2. * (random() >> 11) * 0x1p-53 - 1.; };
  for (const Flow &kind : {rate_independent, linear, between, relaxing})
    {
      const Law  law = sand(1e6, kind);
      const auto all = states(law, 400);
      for (unsigned int first = 0; first < all.size(); first += W)
        {
          const double                          dt = all[first].dt;
          std::array<SymTensor<double>, W>      s_t;
          std::array<std::array<double, 36>, W> C;
          SymTensor<V>                          s_t_l;
          V                                     I1_l, j_l, xi_l;
          for (int l = 0; l < W; ++l)
            {
              const State &s = all[first + l];
              for (int k = 0; k < 6; ++k)
                s_t[l][k] = uniform();
              s_t[l]         = deviator(s_t[l]);
              s_t[l]         = s_t[l] * (s.j / std::sqrt(second_invariant(s_t[l])));
              const double j = std::sqrt(second_invariant(s_t[l]));
              for (int k = 0; k < 6; ++k)
                set_lane(s_t_l[k], l, s_t[l][k]);
              set_lane(I1_l, l, s.I1);
              set_lane(j_l, l, j);
              set_lane(xi_l, l, s.xi);

              const CapFlow            flow = law.flow(dt);
              const auto               step = solved<D>(law.surface, flow, D(s.I1, 1., 0.), D(j, 0., 1.), D(s.xi));
              const CapTangent<double> tangent(s_t[l], K, G, j, step.I1, step.j);

              // the law from the trial stress, by a strain of zero
              SymTensor<AD>      stress;
              PointIncrement<AD> increment;
              Law::History<AD>   history;
              for (int k = 0; k < 6; ++k)
                {
                  stress[k]           = AD(s_t[l][k] - (k < 3 ? s.I1 / 3. : 0.));
                  increment.strain[k] = AD(6, k, 0.);
                }
              increment.density_old = increment.density = AD(2000.);
              increment.dt                              = dt;
              history.cap_junction                      = AD(s.xi);
              const auto response                       = law.update(stress, increment, history);
              for (int k = 0; k < 6; ++k)
                {
                  SymTensor<double> unit;
                  unit[k]           = 1.;
                  const auto column = tangent.apply(unit);
                  for (int i = 0; i < 6; ++i)
                    {
                      C[l][6 * k + i] = column[i];
                      worst           = std::max(worst, std::abs(column[i] - response.stress[i].dx(k)) / K);
                    }
                }
            }
          using DV           = TwoDerivatives<V>;
          const CapFlow flow = law.flow(dt);
          CapReturn<DV> step(law.surface, flow, DV(V(K)), DV(V(G)));
          step.solve(DV(I1_l, V(1.), V(0.)), DV(j_l, V(0.), V(1.)), DV(xi_l));
          const CapTangent<V> tangent(s_t_l, V(K), V(G), j_l, step.I1, step.j);
          for (int k = 0; k < 6; ++k)
            {
              SymTensor<V> unit;
              unit[k]           = V(1.);
              const auto column = tangent.apply(unit);
              for (int i = 0; i < 6; ++i)
                for (int l = 0; l < W; ++l)
                  worst_lanes = std::max(worst_lanes, std::abs(lane(column[i], l) - C[l][6 * k + i]) / K);
            }
        }
    }
  BOOST_TEST_MESSAGE("against differentiable numbers " << worst << ", lanes " << worst_lanes);
  BOOST_TEST(worst < 1e-10);
  BOOST_TEST(worst_lanes < 1e-8);
}

// Duvaut-Lions mixes the elastic and the rate-independent tangent as it mixes the stresses.
BOOST_AUTO_TEST_CASE(mixture_of_duvaut_lions)
{
  const Law law = sand(1e6, relaxing), inviscid = sand(1e6, rate_independent);
  double    worst = 0.;
  for (const State &s : states(law, 2000))
    {
      const auto mixed = solved<D>(law.surface, law.flow(s.dt), D(s.I1, 1., 0.), D(s.j, 0., 1.), D(s.xi)),
                 end   = solved<D>(law.surface, inviscid.flow(s.dt), D(s.I1, 1., 0.), D(s.j, 0., 1.), D(s.xi));
      const double w   = s.dt / (law.relaxation_time + s.dt);
      for (int trial = 0; trial < 2; ++trial)
        worst = std::max({worst, std::abs(mixed.I1.d[trial] - w * end.I1.d[trial] - (trial == 0 ? 1. - w : 0.)),
                          std::abs(mixed.j.d[trial] - w * end.j.d[trial] - (trial == 1 ? 1. - w : 0.))});
    }
  BOOST_TEST(worst < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
