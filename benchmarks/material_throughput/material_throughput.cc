// Nanoseconds per update of a point for the laws of the bench, one by one and in lanes. Started by study.py:
//
//   material_throughput --repetitions 7 --output result.json
//
// Workloads: `elastic`, strains that stay inside of the surface, so that the price of the check is seen; `oedometer`, small steps of
// uniaxial compression, where every point yields and the cap hardens; `random`, steps of 3e-4 in random directions from random
// states, where the lanes of a batch need different branches.

#include <arenite/materials/geologic_cap.h>
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
          const double size = workload == Workload::elastic ? (step % 2 ? -1e-5 : 1e-5) : 3e-4;
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

struct Timing
{
  double nanoseconds, plastic; ///< per update; share of updates that dissipate
};

template <typename V, typename Law>
Timing measure(const Law &law, const std::vector<SymTensor<double>> &strain, const unsigned int repetitions)
{
  constexpr int W = n_lanes<V>();
  using History   = typename Law::template History<V>;
  std::vector<PointIncrement<V>> increments(n_points / W * n_steps);
  for (unsigned int step = 0; step < n_steps; ++step)
    for (unsigned int point = 0; point < n_points; ++point)
      {
        auto &increment = increments[step * (n_points / W) + point / W];
        for (int k = 0; k < 6; ++k)
          set_lane(increment.strain[k], point % W, strain[step * n_points + point][k]);
        increment.density_old = increment.density = V(law.density());
        increment.dt                              = dt;
      }
  History initial;
  {
    std::vector<double> values;
    auto                start = law.initial_history();
    start.for_each([&](const char *, double &value) { values.push_back(value); });
    unsigned int k = 0;
    initial.for_each([&](const char *, V &value) { value = V(values[k++]); });
  }

  Timing best{1e300, 0.};
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      std::vector<SymTensor<V>> stress(n_points / W);
      std::vector<History>      history(n_points / W, initial);
      unsigned long             plastic = 0;
      const auto                start   = std::chrono::steady_clock::now();
      for (unsigned int step = 0; step < n_steps; ++step)
        for (unsigned int batch = 0; batch < n_points / W; ++batch)
          {
            const auto response = law.update(stress[batch], increments[step * (n_points / W) + batch], history[batch]);
            stress[batch]       = response.stress;
            if (repetition == 0)
              for (int l = 0; l < W; ++l)
                plastic += lane(response.dissipated, l) > 1e-9 * lane(response.stored, l);
          }
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (repetition == 0)
        best.plastic = double(plastic) / (n_points * n_steps);
      else
        best.nanoseconds = std::min(best.nanoseconds, 1e9 * seconds / (n_points * n_steps));
    }
  return best;
}

int run(const unsigned int repetitions, const std::string &output)
{
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const auto             law  = [&](const std::string &name, const auto &law) {
    for (const Workload workload : {Workload::elastic, Workload::oedometer, Workload::random})
      {
        const auto   strain = strains(workload);
        const Timing one    = measure<double>(law, strain, repetitions),
                     all    = measure<Lanes<native_lanes>>(law, strain, repetitions);
        rows.push_back({{"law", name},
                        {"workload", workload_names[static_cast<int>(workload)]},
                        {"plastic", one.plastic},
                        {"scalar_ns", one.nanoseconds},
                        {"lanes_ns", all.nanoseconds},
                        {"lanes", native_lanes}});
        std::cout << name << ", " << workload_names[static_cast<int>(workload)] << ": " << 100. * one.plastic
                  << " % plastic, " << one.nanoseconds << " ns scalar, " << all.nanoseconds << " ns in " << native_lanes
                  << " lanes" << std::endl;
      }
  };
  law("viscoplastic cap, N = 1", clayey_soil(1.));
  law("viscoplastic cap, N = 1.5", clayey_soil(1.5));
  law("viscoplastic cap, Duvaut-Lions", clayey_soil(1., Cap::Viscosity::duvaut_lions));
  law("viscoplastic cap, rate independent", clayey_soil(1., Cap::Viscosity::none));
  law("geologic cap", geologic_soil());
  law("viscoelastic, standard linear solid", standard_solid());
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
