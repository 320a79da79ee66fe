// Nanoseconds per update of a point for the laws of the bench, one by one and in lanes. Started by study.py:
//
//   material_throughput --repetitions 7 --output result.json
//
// Workloads: `elastic`, strains that stay inside of the surface, so that the price of the check is seen; `oedometer`, small steps of
// uniaxial compression, where every point yields and the cap hardens; `random`, steps of 3e-4 in random directions from random
// states, where the lanes of a batch need different branches.

#include <arenite/materials/batch_law.h>
#include <arenite/materials/geologic_cap.h>
#include <arenite/materials/linear_elastic_law.h>
#include <arenite/materials/viscoelastic.h>
#include <arenite/materials/viscoplastic_cap.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace Arenite
{
using Cap = ViscoplasticCap<ConstantStiffness>;

/// What both caps have in common; the tension limits differ.
template <typename Surface>
void set_clayey_surface(Surface &surface)
{
  surface.alpha            = 64.2e3;
  surface.gamma            = 5.89e3;
  surface.beta             = 0.34283e-6;
  surface.theta            = 0.18257;
  surface.axis_ratio       = 5.;
  surface.initial_position = 1e6;
  surface.hardening_rate   = 9.52e-9;
  surface.hardening_limit  = 0.2142;
}

Cap clayey_soil(const double exponent, const Cap::Viscosity viscosity = Cap::Viscosity::perzyna)
{
  Cap law;
  law.stiffness.elastic = {1800., 106.4e6, 63.85e6};
  set_clayey_surface(law.surface);
  law.surface.tension_limit = 5e3;
  law.fluidity              = 200.;
  law.overstress            = 1e6;
  law.exponent              = exponent;
  law.relaxation_time       = 1e-5;
  law.viscosity             = viscosity;
  if (const std::string problem = law.surface.finalize(); !problem.empty())
    throw std::runtime_error(problem);
  return law;
}

GeologicCap geologic_soil()
{
  GeologicCap law;
  law.elastic = {1800., 106.4e6, 63.85e6};
  set_clayey_surface(law.surface);
  law.tension_cutoff = 5e3;
  if (const std::string problem = law.surface.finalize(); !problem.empty())
    throw std::runtime_error(problem);
  law.derive();
  return law;
}

Viscoelastic standard_solid()
{
  Viscoelastic law;
  law.spring          = {1800., 106.4e6, 63.85e6};
  law.relaxation_time = 1e-4;
  return law;
}

LinearElasticLaw linear_elastic()
{
  LinearElasticLaw law;
  law.elastic = {1800., 106.4e6, 63.85e6};
  return law;
}

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
          const double size = workload == Workload::elastic ? (step % 2 ? -8e-6 : 8e-6) : 3e-4;
          if (workload == Workload::elastic && step % 2)
            e = result[i - n_points] * -1.;
          else
            e *= size / std::sqrt(norm);
          if (workload == Workload::random)
            for (int k = 0; k < 3; ++k)
              e[k] -= 5e-5; // compaction on the whole
        }
    }
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
    density.assign(n_points, batch_law.law.density());
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

  /// All points in one call, with strains [point][6][lane].
  void update(const double *strain)
  {
    PointBatch batch;
    batch.n_points    = n_points / W;
    batch.dt          = dt;
    batch.strain      = strain;
    batch.density_old = batch.density = density.data();
    batch.stress                      = stress.data();
    batch.history                     = history.data();
    batch.wave_speed                  = wave_speed.data();
    batch.stored                      = stored.data();
    batch.dissipated                  = dissipated.data();
    static_cast<const BatchLaw &>(batch_law).update(batch);
  }

  BatchLawFor<Law, W> batch_law;
  unsigned int        n_history;
  std::vector<double> density, stress, history, wave_speed, stored, dissipated;
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

  Points<W, Law> points(law);
  Timing         timing;
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      points.reset();
      const auto start = std::chrono::steady_clock::now();
      for (unsigned int step = 0; step < n_steps; ++step)
        points.update(&strains[step * 6 * n_points]);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      timing.nanoseconds   = std::min(timing.nanoseconds, 1e9 * seconds / (n_points * n_steps));
    }

  // once more, to look at what the points do
  points.reset();
  unsigned long plastic = 0;
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      points.update(&strains[step * 6 * n_points]);
      for (unsigned int i = 0; i < n_points; ++i)
        plastic += points.dissipated[i] > 1e-9 * points.stored[i];
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
      increment.density_old = increment.density = Number(law.density());
      increment.dt                              = dt;
      load_history<History, Number>(history, points.history.data() + batch * points.n_history * W);
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          for (unsigned int k = 0; k < 6; ++k)
            increment.strain[k] = load<Number>(&strains[(step * n_points / W + batch) * 6 * W + k * W]);
          const auto response = law.update(stress, increment, history);
          stress              = response.stress;
          passes += response.iterations.passes;
          lanes += response.iterations.lanes;
        }
    }
  timing.passes  = passes / (n_points / W * n_steps);
  timing.waiting = passes > 0. ? 1. - lanes / (passes * W) : 0.;
  return timing;
}

int run(const unsigned int repetitions, const std::string &output)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const auto             law  = [&](const std::string &name, const auto &law) {
    for (const Workload workload : {Workload::elastic, Workload::oedometer, Workload::random})
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
  law("viscoplastic cap, N = 1", clayey_soil(1.));
  law("viscoplastic cap, N = 1.5", clayey_soil(1.5));
  law("viscoplastic cap, Duvaut-Lions", clayey_soil(1., Cap::Viscosity::duvaut_lions));
  law("viscoplastic cap, rate independent", clayey_soil(1., Cap::Viscosity::none));
  law("geologic cap", geologic_soil());
  law("viscoelastic, standard linear solid", standard_solid());
  law("linear elastic", linear_elastic());
  law("traffic of the arrays", Traffic());
  if (!output.empty())
    std::ofstream(output) << rows.dump(2) << '\n';
  return 0;
}
} // namespace Arenite

int main(int argc, char **argv)
{
  unsigned int repetitions = 7;
  std::string  output;
  CLI::App     app("Nanoseconds per update of the material laws.");
  app.add_option("--repetitions", repetitions, "Timed repetitions, of which the best counts")
    ->capture_default_str()
    ->check(CLI::Range(2u, 1000u));
  app.add_option("--output", output, "File for the results (JSON)");
  CLI11_PARSE(app, argc, argv);
  return Arenite::run(repetitions, output);
}
