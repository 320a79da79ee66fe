// Random updates of the cap model, from admissible states on and next to every corner of its surface, by strains of any size and
// at any viscosity: none may fail. Started by study.py, and in short form by ctest:
//
//   material_robustness --updates 10000000 [--seed 1] [--output result.json]
//
// Every update is checked against the equations of backward Euler, by a path that does not use the solver's own unknowns; each
// batch of lanes is compared with the same updates one by one. Exit code 1 if anything failed.

#include <arenite/materials/cap_return.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace Arenite
{
struct ParameterSet
{
  std::string name;
  double      K, G;
  CapSurface  surface;
  double      f0, exponent;
};

/// Soft and stiff soils, small caps (X0 below X_min), exponents from 1 to 3, and a rock-like set that reaches tens of GPa.
std::vector<ParameterSet> parameter_sets()
{
  const auto make = [](const std::string &name, double K, double G, double alpha, double beta, double gamma,
                       double theta, double W, double D, double R, double X0, double T, double f0, double N) {
    ParameterSet set{name, K, G, CapSurface(), f0, N};
    set.surface.alpha            = alpha;
    set.surface.beta             = beta;
    set.surface.gamma            = gamma;
    set.surface.theta            = theta;
    set.surface.hardening_limit  = W;
    set.surface.hardening_rate   = D;
    set.surface.axis_ratio       = R;
    set.surface.initial_position = X0;
    set.surface.tension_limit    = T;
    set.surface.small_cap_rule   = true;
    if (const std::string problem = set.surface.finalize(); !problem.empty())
      throw std::runtime_error(name + ": " + problem);
    return set;
  };
  return {make("clayey soil", 106.4e6, 63.85e6, 64.2e3, .34283e-6, 5.89e3, .18257, .2142, 9.52e-9, 5., 1e6, 5e3, 1e6,
               1.5),
          make("clayey soil, 10 kPa cap", 106.4e6, 63.85e6, 64.2e3, .34283e-6, 5.89e3, .18257, .2142, 9.52e-9, 5., 1e4,
               5e3, 1e6, 1.5),
          make("dense sand", 1.2e9, .55e9, 100e3, .5e-6, 40e3, .22, .18, 2e-9, 3., 3e6, 20e3, .5e6, 1.),
          make("dense sand at high pressure", 20e9, 9e9, 1e6, .05e-6, .2e6, .15, .3, 1e-9, 4., 10e6, .1e6, 10e6, 2.),
          make("10 kPa cap under tens of GPa", 20e9, 9e9, 1e6, .05e-6, .2e6, .15, .3, 1e-9, 4., 1e4, .1e6, 10e6, 2.),
          make("silt", 60e6, 20e6, 45e3, 1.2e-6, 15e3, .09, .12, .05e-6, 2.2, .4e6, 30e3, .05e6, 3.),
          make("sand", 450e6, 200e6, 30e3, .2e-6, 10e3, .28, .25, .015e-6, 4., 1.5e6, 2e3, .2e6, 1.),
          make("sand, 5 kPa cap", 450e6, 200e6, 30e3, .2e-6, 10e3, .28, .25, .015e-6, 4., 5e3, 2e3, .2e6, 1.3),
          make("soft rock", 9e9, 5e9, 2.5e6, .02e-6, 1e6, .2, .35, 3e-10, 6., 60e6, .5e6, 20e6, 1.7)};
}

/// A trial state and the junction it starts from.
struct Update
{
  double I1, j, xi;
};

class Generator
{
public:
  explicit Generator(const unsigned long seed)
    : random(seed)
  {}

  double uniform() { return std::uniform_real_distribution<double>(0., 1.)(random); }
  double logarithmic(const double lowest, const double decades) { return lowest * std::pow(10., decades * uniform()); }

  /// The cap anywhere between X0 and 99.7 % of its compaction; the state at random or within 1e-3 of -T, 0, L, M, X, on the
  /// axis, inside or up to the surface; the strain of size 1e-10 to 1 in any direction of the (volume, shear) plane.
  Update update(const ParameterSet &set)
  {
    const CapSurface &surface = set.surface;
    const double X = uniform() < 0.9 ? surface.initial_position + (logarithmic(1., 2.5) - 1.) / surface.hardening_rate
                                     : surface.initial_position * (1. + 1e-7);
    Update       u;
    u.xi                   = surface.junction(X);
    const auto   cap       = surface.cap(u.xi);
    const double T         = surface.tension_limit;
    const double corners[] = {-T, 0., cap.L, cap.M, cap.X};
    double       I1 =
      uniform() < 0.6 ? -T + uniform() * (cap.X + T) : corners[random() % 5] * (1. + 1e-3 * (2. * uniform() - 1.));
    I1                  = std::min(std::max(I1, -T), cap.X);
    const double height = I1 < 0. ? surface.tension_axis * surface.tension_axis -
                                      std::pow((I1 - surface.tension_center) / surface.tension_ratio, 2)
                                  : (I1 < cap.L ? std::pow(surface.failure(I1).value, 2)
                                                : cap.b * cap.b - std::pow((I1 - cap.M) / cap.R, 2));
    const double part   = uniform(),
                 j      = std::sqrt(std::max(height, 0.)) * (part < 0.25 ? 0. : (part < 0.75 ? uniform() : 1.));

    const double size = logarithmic(1e-10, 10.), angle = 2. * M_PI * uniform();
    u.I1 = I1 + 3. * set.K * size * std::cos(angle);
    u.j  = uniform() < 0.1 ? 0. : std::abs(j + 2. * set.G * size * std::sin(angle));
    return u;
  }

  /// eta dt = 0 or 1e-12 to 1e12, or rate independent.
  CapFlow flow(const ParameterSet &set)
  {
    CapFlow flow;
    flow.f0               = set.f0;
    flow.exponent         = set.exponent;
    const double part     = uniform();
    flow.rate_independent = part < 0.15;
    flow.fluidity_dt      = part > 0.98 ? 0. : logarithmic(1e-12, 24.);
    return flow;
  }

private:
  std::mt19937_64 random;
};

/// How well (I1, j, xi) solves the equations of the step; all relative to the stresses involved.
struct Check
{
  double residual = 0.; ///< of flow rule, overstress and compaction
  double excess   = 0.; ///< of dissipation below zero, and of the history outside of its bounds
  bool   plastic = false, corner = false;
};

Check check(const ParameterSet &set, const CapFlow &flow, const Update &trial, const double I1, const double j,
            const double xi)
{
  const CapSurface &surface = set.surface;
  const auto        cap_n = surface.cap(trial.xi), cap = surface.cap(xi);
  const double      scale = std::abs(trial.I1) + trial.j + surface.F0;
  Check             result;
  result.plastic =
    surface.yield_function(trial.I1, trial.j, cap_n) > 0. && (flow.rate_independent || flow.fluidity_dt > 0.);
  if (!result.plastic)
    {
      result.residual = (std::abs(I1 - trial.I1) + std::abs(j - trial.j)) / scale;
      return result;
    }

  const double dissipation = j * (trial.j - j) / set.G + I1 * (trial.I1 - I1) / (9. * set.K);
  result.excess            = std::max(-dissipation * set.G / (scale * scale), (trial.xi - xi) / scale);
  const double k           = surface.compaction<double>(cap.X);
  if (!(k >= 0. && k < surface.hardening_limit && std::isfinite(xi)))
    result.excess = 1.;

  double compaction = 0.;
  if (trial.I1 > cap_n.M && !(trial.I1 < cap_n.L))
    compaction = std::abs(3. * set.K * surface.compaction<double>(cap.X, cap_n.X) - (trial.I1 - I1)) / scale;
  else if (xi != trial.xi)
    compaction = 1.;

  // at a corner any mixture of the two normals is allowed
  result.corner = std::abs(I1 - cap.L) < 1e-9 * scale || std::abs(I1) < 1e-9 * scale;
  if (result.corner)
    {
      result.residual = compaction;
      return result;
    }
  double f_I, f_j;
  if (I1 >= 0. && I1 < cap.L)
    {
      f_I = -surface.failure(I1).slope;
      f_j = 1.;
    }
  else
    {
      const double center = I1 < 0. ? surface.tension_center : cap.M, ratio = I1 < 0. ? surface.tension_ratio : cap.R;
      const double v = (I1 - center) / ratio, Q = std::sqrt(j * j + v * v);
      f_I = v / (ratio * Q);
      f_j = j / Q;
    }
  // The overstress gives the multiplier, or the multiplier the overstress: the one that loses no digits is the measure.
  const double a = 9. * set.K * f_I, b = set.G * f_j;
  const double f = surface.yield_function(I1, j, cap), overstress = std::max(f, 0.);
  const auto   direction = [&](const double multiplier) {
    return std::max(std::abs(I1 - trial.I1 + a * multiplier), std::abs(j - trial.j + b * multiplier)) / scale;
  };
  const double found = ((trial.I1 - I1) * a + (trial.j - j) * b) / (a * a + b * b);
  const double wanted =
    flow.rate_independent ? 0. : set.f0 * std::pow(std::max(found, 0.) / flow.fluidity_dt, 1. / flow.exponent);
  double residual = std::max(direction(found), std::abs(f - wanted) / (scale + wanted + cap.X));
  if (!flow.rate_independent)
    residual = std::min(residual, direction(flow.fluidity_dt * std::pow(overstress / set.f0, flow.exponent)));
  result.residual = std::max(residual, compaction);
  if (!std::isfinite(I1) || !std::isfinite(j) || !std::isfinite(result.residual))
    result.residual = 1.;
  return result;
}

int run(const unsigned long n_updates, const unsigned long seed, const std::string &output)
{
  constexpr int W                 = native_lanes;
  using V                         = Lanes<W>;
  nlohmann::ordered_json sets     = nlohmann::ordered_json::array();
  unsigned long          n_failed = 0, n_plastic_all = 0;
  double                 worst_all = 0., worst_lanes_all = 0.;
  Generator              generator(seed);
  const auto             all = parameter_sets();
  for (const ParameterSet &set : all)
    {
      unsigned long plastic = 0, corners = 0, fallbacks = 0, failed = 0;
      double        worst = 0., worst_lanes = 0., iterations = 0.;
      std::map<unsigned int, unsigned long>
        histogram; // iterations of one update, in classes 0, 1-2, 3-4, 5-8, 9-16, ...
      for (unsigned long batch = 0; batch < n_updates / all.size() / W + 1; ++batch)
        {
          const CapFlow         flow = generator.flow(set);
          std::array<Update, W> trial;
          V                     I1 = V(0.), j = V(0.), xi = V(0.);
          for (int l = 0; l < W; ++l)
            {
              trial[l] = generator.update(set);
              set_lane(I1, l, trial[l].I1);
              set_lane(j, l, trial[l].j);
              set_lane(xi, l, trial[l].xi);
            }
          CapReturn<V> lanes(set.surface, flow, V(set.K), V(set.G));
          lanes.solve(I1, j, xi);
          for (int l = 0; l < W; ++l)
            {
              CapReturn<double> one(set.surface, flow, set.K, set.G);
              one.solve(trial[l].I1, trial[l].j, trial[l].xi);
              const Check  result = check(set, flow, trial[l], one.I1, one.j, one.xi);
              const double scale  = std::abs(trial[l].I1) + trial[l].j + set.surface.F0;
              worst_lanes =
                std::max(worst_lanes, (std::abs(one.I1 - lane(lanes.I1, l)) + std::abs(one.j - lane(lanes.j, l)) +
                                       std::abs(one.xi - lane(lanes.xi, l))) /
                                        scale);
              worst          = std::max(worst, result.residual);
              const bool bad = !(result.residual < 1e-10) || result.excess > 1e-12 || !(worst_lanes < 1e-9);
              if (bad && ++failed <= 3)
                std::cerr.precision(17), std::cerr << set.name << ": residual " << result.residual << ", excess "
                                                   << result.excess << " for I1 = " << trial[l].I1
                                                   << ", j = " << trial[l].j << ", xi = " << trial[l].xi
                                                   << ", eta dt = " << flow.fluidity_dt
                                                   << (flow.rate_independent ? ", rate independent\n" : "\n");
              if (!result.plastic)
                continue;
              ++plastic;
              corners += result.corner;
              fallbacks += one.fallbacks();
              iterations += one.iterations().passes;
              unsigned int upper = 1;
              while (upper < one.iterations().passes)
                upper *= 2;
              ++histogram[upper];
            }
        }
      nlohmann::ordered_json counts;
      for (const auto &entry : histogram)
        counts[std::to_string(entry.first)] = entry.second;
      sets.push_back({{"set", set.name},
                      {"plastic", plastic},
                      {"failed", failed},
                      {"worst_residual", worst},
                      {"worst_lanes", worst_lanes},
                      {"mean_iterations", iterations / std::max(plastic, 1ul)},
                      {"fallbacks", fallbacks},
                      {"corners", corners},
                      {"iterations_up_to", counts}});
      std::cout << set.name << ": " << plastic << " plastic updates, " << failed << " failed, worst residual " << worst
                << ", lanes differ by " << worst_lanes << ", " << iterations / std::max(plastic, 1ul)
                << " iterations, nested brackets " << fallbacks << ", corners " << corners << '\n';
      n_failed += failed;
      n_plastic_all += plastic;
      worst_all       = std::max(worst_all, worst);
      worst_lanes_all = std::max(worst_lanes_all, worst_lanes);
    }
  std::cout << n_plastic_all << " plastic updates, " << n_failed << " failed, worst residual " << worst_all
            << ", lanes differ by " << worst_lanes_all << std::endl;
  if (!output.empty())
    std::ofstream(output) << sets.dump(2) << '\n';
  return n_failed == 0 ? 0 : 1;
}
} // namespace Arenite

int main(int argc, char **argv)
{
  unsigned long n_updates = 100000, seed = 1;
  std::string   output;
  CLI::App      app("Random updates of the cap model, checked one by one.");
  app.add_option("--updates", n_updates, "Number of updates over all parameter sets")->capture_default_str();
  app.add_option("--seed", seed, "Start of the random numbers")->capture_default_str();
  app.add_option("--output", output, "File for the results (JSON)");
  CLI11_PARSE(app, argc, argv);
  return Arenite::run(n_updates, seed, output);
}
