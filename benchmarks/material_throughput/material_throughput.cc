// Nanoseconds per update of a point for the laws of the bench, one by one and in lanes. Started by study.py:
//
//   material_throughput --repetitions 7 --output result.json
//
// Workloads: `elastic`, strains that stay inside of the surface, so that the price of the check is seen; `oedometer`, small steps of
// uniaxial compression, where every point yields and the cap hardens; `random`, for the caps, steps of 3e-4 in random directions,
// where the lanes of a batch need different branches. The laws are examples of tests/data/laws.

#include <arenite/materials/batch_law.h>
#include <arenite/materials/law_types.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "../../tests/unit/law_example.h"

namespace Arenite
{
enum class Workload
{
  elastic,
  oedometer,
  random
};
constexpr const char *workload_names[] = {"elastic", "oedometer", "random"};

constexpr unsigned int n_points = 256, n_steps = 64;
constexpr double       dt = 1e-6;

/// Strain increments [step][point], the same for every width.
std::vector<SymTensor<double>> strains(const Workload workload)
{
  std::mt19937_64                random(3);
  std::normal_distribution<>     normal;
  std::vector<SymTensor<double>> result(n_points * n_steps);
  for (unsigned int i = 0; i < result.size(); ++i)
    {
      const unsigned int step = i / n_points;
      SymTensor<double> &e    = result[i];
      if (workload == Workload::oedometer)
        e[0] = -2e-4 * (1. + 0.1 * (i % 7));
      else
        {
          double norm = 0.;
          for (int k = 0; k < 6; ++k)
            {
              e[k] = normal(random);
              norm += e[k] * e[k];
            }
          // elastic: to and fro around the unstressed state
          e *= (workload == Workload::elastic ? 2e-6 : 3e-4) / std::sqrt(norm);
          if (workload == Workload::elastic && step % 2)
            e = result[i - n_points] * -1.;
          if (workload == Workload::random)
            for (int k = 0; k < 3; ++k)
              e[k] -= 5e-5; // compaction on the whole
        }
    }
  return result;
}

/// [step][point], one step more than there are strains.
std::vector<double> densities(const std::vector<SymTensor<double>> &strain, const double at_rest)
{
  std::vector<double> result(n_points, at_rest);
  for (unsigned int i = 0; i < strain.size(); ++i)
    result.push_back(result[i] * std::exp(-trace(strain[i])));
  return result;
}

/// Stress plus strain and nothing else: what the traffic of the arrays costs, the limit of every law with a history of two numbers.
struct Traffic
{
  static constexpr const char *name        = "traffic";
  static constexpr const char *description = "Reads and writes a batch.";

  template <typename Number>
  struct History
  {
    Number a = Number(0.), b = Number(0.);
    template <typename F>
    void for_each(F &&f)
    {
      f("a", a);
      f("b", b);
    }
  };

  void            declare_parameters(Parameters &) {}
  void            finalize(const Parameters &) {}
  double          density() const { return 1.; }
  double          wave_speed_bound() const { return 1.; }
  History<double> initial_history() const { return {}; }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress, const PointIncrement<Number> &increment,
                          History<Number> &) const
  {
    Response<Number> response;
    response.stress     = stress + increment.strain;
    response.wave_speed = increment.density;
    response.stored = response.dissipated = increment.density_old;
    return response;
  }
  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &) const
  {}
};

/// Arrays of n_points points, the lane as last index, as the kernels of a mesh keep them.
template <int W, typename Law>
struct Points
{
  explicit Points(const Law &law_of_points)
  {
    batch_law.law = law_of_points;
    n_history     = batch_law.initial_history().size();
    for (auto *array : {&wave_speed, &stored, &dissipated})
      array->resize(n_points);
    reset();
  }
  void reset()
  {
    stress.assign(6 * n_points, 0.);
    history.resize(n_history * n_points);
    const auto initial = batch_law.initial_history();
    for (unsigned int i = 0; i < history.size(); ++i)
      history[i] = initial[i / W % n_history];
  }

  /// All points in one call, with strains [point][6][lane] and the densities of two steps.
  void update(const double *strain, const double *density)
  {
    PointBatch batch;
    batch.n_points    = n_points / W;
    batch.dt          = dt;
    batch.strain      = strain;
    batch.density_old = density;
    batch.density     = density + n_points;
    batch.stress      = stress.data();
    batch.history     = history.data();
    batch.wave_speed  = wave_speed.data();
    batch.stored      = stored.data();
    batch.dissipated  = dissipated.data();
    static_cast<const BatchLaw &>(batch_law).update(batch);
  }

  BatchLawFor<Law, W> batch_law;
  unsigned int        n_history;
  std::vector<double> stress, history, wave_speed, stored, dissipated;
};

struct Timing
{
  double nanoseconds = 1e300; ///< per update of a point
  double plastic     = 0.;    ///< share of updates that dissipate
  double waiting     = 0.;    ///< share of lanes x passes of the law's iterations in which a lane had nothing to do
  double passes      = 0.;    ///< of these iterations, per update of a batch
};

template <int W, typename Law>
Timing measure(const Law &law, const std::vector<SymTensor<double>> &strain, const unsigned int repetitions)
{
  std::vector<double> strains(6 * strain.size());
  for (unsigned int i = 0; i < strain.size(); ++i)
    for (unsigned int k = 0; k < 6; ++k)
      strains[(i / W * 6 + k) * W + i % W] = strain[i][k];

  const std::vector<double> density = densities(strain, law.density());
  Points<W, Law>            points(law);
  Timing                    timing;
  const auto update = [&](const unsigned int step) { points.update(&strains[step * 6 * n_points], &density[step * n_points]); };
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      points.reset();
      const auto start = std::chrono::steady_clock::now();
      for (unsigned int step = 0; step < n_steps; ++step)
        update(step);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      timing.nanoseconds   = std::min(timing.nanoseconds, 1e9 * seconds / (n_points * n_steps));
    }

  // once more, to look at what the points do; dissipation below round-off of the energy of the step does not count
  points.reset();
  const double stiffness = law.density() * std::pow(law.wave_speed_bound(), 2);
  unsigned long plastic = 0;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      update(step);
      for (unsigned int i = 0; i < n_points; ++i)
        {
          const SymTensor<double> &e = strain[step * n_points + i];
          plastic += points.dissipated[i] > 1e-9 * stiffness * contract(e, e);
        }
    }
  timing.plastic = double(plastic) / (n_points * n_steps);

  using Number  = Lanes<W>;
  using History = typename Law::template History<Number>;
  double passes = 0., lanes = 0.;
  points.reset();
  for (unsigned int batch = 0; batch < n_points / W; ++batch)
    {
      SymTensor<Number>      stress;
      PointIncrement<Number> increment;
      History                history;
      increment.dt = dt;
      load_history<History, Number>(history, points.history.data() + batch * points.n_history * W);
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          for (unsigned int k = 0; k < 6; ++k)
            increment.strain[k] = load<Number>(&strains[(step * n_points / W + batch) * 6 * W + k * W]);
          increment.density_old = load<Number>(&density[step * n_points + batch * W]);
          increment.density     = load<Number>(&density[(step + 1) * n_points + batch * W]);
          const auto response   = law.update(stress, increment, history);
          stress                = response.stress;
          passes += response.iterations.passes;
          lanes += response.iterations.lanes;
        }
    }
  timing.passes  = passes / (n_points / W * n_steps);
  timing.waiting = passes > 0. ? 1. - lanes / (passes * W) : 0.;
  return timing;
}

int run(const unsigned int repetitions, const std::string &only, const std::string &output)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const auto law = [&](const std::string &name, const auto &law, const std::vector<Workload> &workloads) {
    if (name.find(only) != 0)
      return;
    for (const Workload workload : workloads)
      {
        const auto   strain = strains(workload);
        const Timing one = measure<1>(law, strain, repetitions), all = measure<native_lanes>(law, strain, repetitions);
        rows.push_back({{"law", name},
                        {"workload", workload_names[static_cast<int>(workload)]},
                        {"plastic", one.plastic},
                        {"scalar_ns", one.nanoseconds},
                        {"lanes_ns", all.nanoseconds},
                        {"passes", one.passes},
                        {"lanes_passes", all.passes},
                        {"waiting", all.waiting},
                        {"lanes", native_lanes}});
        std::cout << name << ", " << workload_names[static_cast<int>(workload)] << ": " << 100. * one.plastic
                  << " % plastic, " << one.nanoseconds << " ns scalar, " << all.nanoseconds << " ns in " << native_lanes
                  << " lanes; passes of iterations: " << one.passes << " alone, " << all.passes << " in lanes, "
                  << 100. * all.waiting << " % waiting" << std::endl;
      }
  };
  const std::vector<Workload> simple = {Workload::elastic, Workload::oedometer},
                              all    = {Workload::elastic, Workload::oedometer, Workload::random};
  const auto example = [](auto law, const std::string &block) {
    return law_of_block<decltype(law)>(example_file(decltype(law)::name), block);
  };
  const auto examples = [&](const auto &kind, const std::vector<Workload> &workloads,
                            const std::vector<std::string> &blocks) {
    for (const std::string &block : blocks)
      law(std::string(kind.name) + ", " + block, example(kind, block), workloads);
  };

  using Cap = ViscoplasticCap<ConstantStiffness>;
  Cap sand  = example(Cap(), "loose sand");
  for (const double exponent : {1., 1.5})
    {
      sand.exponent = exponent;
      law(exponent == 1. ? "viscoplastic cap, N = 1" : "viscoplastic cap, N = 1.5", sand, all);
    }
  sand.relaxation_time = 1e-5;
  sand.viscosity       = Cap::Viscosity::duvaut_lions;
  law("viscoplastic cap, Duvaut-Lions", sand, all);
  sand.viscosity = Cap::Viscosity::none;
  law("viscoplastic cap, rate independent", sand, all);
  examples(ViscoplasticCap<SoilStiffness>(), all, {"moist sand"});
  examples(UndrainedCap(), all, {"saturated sand"});
  examples(GeologicCap(), all, {"soil"});
  examples(EquationOfStateWithStrength<SoilStiffening>(), simple, {"moist sand", "saturated clay", "dry sand"});
  examples(EquationOfStateWithStrength<TabulatedCompaction>(), simple, {"sand"});
  examples(EquationOfStateWithStrength<PorousCompaction>(), simple, {"stone", "sand"});
  examples(EquationOfStateWithStrength<ThreePhaseMixture>(), simple, {"air 4 per cent", "saturated"});
  examples(EquationOfStateWithStrength<MieGrueneisen>(), simple, {"liquid", "clay", "sand"});
  examples(Viscoelastic(), simple, {"standard"});
  examples(LinearElasticLaw(), simple, {"soil"});
  law("traffic of the arrays", Traffic(), simple);
  if (!output.empty())
    std::ofstream(output) << rows.dump(2) << '\n';
  return 0;
}
} // namespace Arenite

int main(int argc, char **argv)
{
  unsigned int repetitions = 7;
  std::string  only, output;
  CLI::App     app("Nanoseconds per update of the material laws.");
  app.add_option("--repetitions", repetitions, "Timed repetitions, of which the best counts")
    ->capture_default_str()
    ->check(CLI::Range(2u, 1000u));
  app.add_option("--only", only, "Laws whose name begins so");
  app.add_option("--output", output, "File for the results (JSON)");
  CLI11_PARSE(app, argc, argv);
  return Arenite::run(repetitions, only, output);
}
