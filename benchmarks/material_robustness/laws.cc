// Random updates of every law of law_types.h, with the examples of tests/data/laws, in lanes as on a mesh: none may fail. Started by
// study.py, and in short form by ctest:
//
//   material_robustness_laws --updates 10000000 [--seed 1] [--only "geologic cap"] [--output result.json]
//
// --updates is for each example. Exit code 1 if anything failed. A new law is covered by its line and its examples; what is
// asked of it beyond finite numbers is in law_checks.h.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <tuple>
#include <type_traits>

#include "../../tests/unit/law_example.h"
#include "law_checks.h"

namespace Arenite
{
/// Classes 0, 1, 2, 4, 8, ... of a count.
unsigned int up_to(const double count)
{
  unsigned int upper = 1;
  while (upper < count)
    upper *= 2;
  return count == 0. ? 0 : upper;
}

/// Laws with substeps are also asked with whole steps, whose equations can be checked.
template <typename Law, typename = void>
struct WholeSteps
{
  static Law of(const Law &law) { return law; }
};
template <typename Law>
struct WholeSteps<Law, std::void_t<decltype(std::declval<Law &>().substep_size)>>
{
  static Law of(Law law)
  {
    law.substep_size = 0.;
    return law;
  }
};

template <typename Law>
class LawRun
{
public:
  static constexpr int W = native_lanes;
  using Number           = Lanes<W>;
  using History          = typename Law::template History<double>;
  using Checks           = LawChecks<Law>;

  LawRun(const Law &law, const std::string &example, const unsigned long seed)
    : law(law)
    , whole(WholeSteps<Law>::of(law))
    , example(example)
    , random(seed)
  {}

  void run(const unsigned long n_updates)
  {
    for (unsigned long batch = 0; batch < n_updates / W + 1; ++batch)
      {
        const Law                 &used = random.uniform() < 0.1 ? law : whole;
        std::array<Update<Law>, W> updates{};
        const double               dt = random.time_step();
        for (auto &u : updates)
          start(used, u, dt);
        update(used, updates);
        for (const auto &u : updates)
          judge(used, u);
      }
  }

  nlohmann::ordered_json results() const
  {
    nlohmann::ordered_json passes, parts;
    for (const auto &entry : passes_up_to)
      passes[std::to_string(entry.first)] = entry.second;
    for (const auto &entry : parts_up_to)
      parts[std::to_string(entry.first)] = entry.second;
    return {{"law", Law::name},
            {"example", example},
            {"updates", n},
            {"inelastic", n_inelastic},
            {"failed", n_failed},
            {"residual", worst_residual},
            {"dissipation", lowest_dissipation},
            {"reported_dissipation", lowest_reported},
            {"history", worst_history},
            {"corners", n_corners},
            {"passes_up_to", passes},
            {"parts_up_to", parts}};
  }

  unsigned long n = 0, n_failed = 0;

private:
  const Law         law, whole;
  const std::string example;
  RandomTensors     random;

  unsigned long n_inelastic = 0, n_corners = 0, n_reported_negative = 0;
  double        worst_residual = 0., lowest_dissipation = 0., lowest_reported = 0., worst_history = 0.;
  std::map<unsigned int, unsigned long> passes_up_to, parts_up_to; ///< per batch; passes of whole steps

  void start(const Law &used, Update<Law> &u, const double dt)
  {
    PointIncrement<double> &next = u.increment;
    if constexpr (Checks::has_corners)
      {
        Checks::state(used, random, u);
        next.strain = random.strain(u.stress_n);
      }
    else
      {
        u.history_n      = used.initial_history();
        double volume    = 0.;
        next.density_old = used.density();
        for (unsigned int steps = random.one_of(4);; --steps)
          {
            do
              next.strain = random.strain(u.stress_n);
            while (std::abs(volume + trace(next.strain)) > 0.1);
            volume += trace(next.strain);
            next.density = used.density() * std::exp(-volume);
            if (steps == 0)
              break;
            next.dt          = random.time_step();
            u.stress_n       = used.update(u.stress_n, next, u.history_n).stress;
            next.density_old = next.density;
          }
      }
    next.density = next.density_old * std::exp(-trace(next.strain));
    next.dt      = dt;
  }

  void update(const Law &used, std::array<Update<Law>, W> &updates)
  {
    SymTensor<Number>                      stress;
    PointIncrement<Number>                 increment;
    typename Law::template History<Number> history;
    std::array<std::vector<double>, W>     values;
    for (int l = 0; l < W; ++l)
      {
        for (int k = 0; k < 6; ++k)
          {
            set_lane(stress[k], l, updates[l].stress_n[k]);
            set_lane(increment.strain[k], l, updates[l].increment.strain[k]);
          }
        set_lane(increment.density_old, l, updates[l].increment.density_old);
        set_lane(increment.density, l, updates[l].increment.density);
        History h = updates[l].history_n;
        h.for_each([&](const char *, const double &value) { values[l].push_back(value); });
      }
    increment.dt   = updates[0].increment.dt;
    unsigned int i = 0;
    history.for_each([&](const char *, Number &value) {
      for (int l = 0; l < W; ++l)
        set_lane(value, l, values[l][i]);
      ++i;
    });

    const Response<Number> response = used.update(stress, increment, history);

    if (response.substeps == 1.)
      ++passes_up_to[up_to(response.iterations.passes)];
    ++parts_up_to[up_to(response.substeps)];
    for (int l = 0; l < W; ++l)
      {
        Update<Law> &u = updates[l];
        for (int k = 0; k < 6; ++k)
          u.stress[k] = lane(response.stress[k], l);
        u.wave_speed = lane(response.wave_speed, l);
        u.stored     = lane(response.stored, l);
        u.dissipated = lane(response.dissipated, l);
        u.substeps   = response.substeps;
        i            = 0;
        values[l].clear();
        history.for_each([&](const char *, const Number &value) { values[l].push_back(lane(value, l)); });
        u.history.for_each([&](const char *, double &value) { value = values[l][i++]; });
      }
  }

  void judge(const Law &used, const Update<Law> &u)
  {
    ++n;
    const double strain = std::sqrt(contract(u.increment.strain, u.increment.strain));
    const double scale  = std::sqrt(contract(u.stress_n, u.stress_n)) + std::sqrt(contract(u.stress, u.stress)) +
                         used.density() * std::pow(used.wave_speed_bound(), 2) * strain;
    bool finite = std::isfinite(u.wave_speed) && std::isfinite(u.stored) && std::isfinite(u.dissipated);
    for (int k = 0; k < 6; ++k)
      finite = finite && std::isfinite(u.stress[k]);
    History h = u.history;
    h.for_each([&](const char *, const double &value) { finite = finite && std::isfinite(value); });

    Verdict verdict;
    if (finite)
      verdict = Checks::check(used, u, scale);
    const double reported       = u.dissipated * Checks::smallest_modulus(used) / (scale * scale);
    double       lowest_allowed = -1e-12; // round-off of a difference of two stresses
    if (!Checks::has_corners && verdict.dissipation < lowest_allowed)
      {
        // the first hundred, then one of a thousand, because it takes thousands of updates
        ++n_reported_negative;
        const bool look     = n_reported_negative <= 100 || n_reported_negative % 1000 == 0;
        verdict.dissipation = look ? in_small_steps(used, u, scale) : 0.;
        lowest_allowed      = -1e-7; // of the square of 1/2^12
      }
    worst_residual     = std::max(worst_residual, verdict.residual);
    worst_history      = std::max(worst_history, verdict.history);
    lowest_dissipation = std::min(lowest_dissipation, verdict.dissipation);
    lowest_reported    = std::min(lowest_reported, reported);
    n_inelastic += std::abs(reported) > 1e-14;
    n_corners += verdict.corner;
    const bool fine =
      finite && verdict.residual < 1e-10 && verdict.history < 1e-12 && verdict.dissipation > lowest_allowed;
    if (!fine && ++n_failed <= 3)
      complain(u, verdict, finite);
  }

  /// The mean stress of a step that reverses the load may take from a law what it has not given; the error falls with the square of the
  /// step. The same strain in 2^10 and 2^12 parts, extrapolated.
  double in_small_steps(const Law &used, const Update<Law> &u, const double scale) const
  {
    const auto dissipated = [&](const unsigned int parts) {
      SymTensor<double>      stress  = u.stress_n;
      History                history = u.history_n;
      PointIncrement<double> step    = u.increment;
      step.strain                    = u.increment.strain * (1. / parts);
      step.dt                        = u.increment.dt / parts;
      double       sum               = 0.;
      const double ratio             = std::pow(u.increment.density / u.increment.density_old, 1. / parts);
      for (unsigned int i = 0; i < parts; ++i)
        {
          step.density        = step.density_old * ratio;
          const auto response = used.update(stress, step, history);
          stress              = response.stress;
          sum += response.dissipated;
          step.density_old = step.density;
        }
      return sum * Checks::smallest_modulus(used) / (scale * scale);
    };
    const double coarse = dissipated(1u << 10), fine = dissipated(1u << 12);
    return std::max(fine, fine + (fine - coarse) / 3.);
  }

  void complain(const Update<Law> &u, const Verdict &verdict, const bool finite) const
  {
    std::cerr.precision(17);
    std::cerr << Law::name << ", " << example << ": " << (finite ? "" : "not finite, ") << "residual "
              << verdict.residual << ", dissipation " << verdict.dissipation << ", history " << verdict.history
              << "\n  stress_n";
    for (int k = 0; k < 6; ++k)
      std::cerr << ' ' << u.stress_n[k];
    std::cerr << "\n  strain";
    for (int k = 0; k < 6; ++k)
      std::cerr << ' ' << u.increment.strain[k];
    std::cerr << "\n  stress";
    for (int k = 0; k < 6; ++k)
      std::cerr << ' ' << u.stress[k];
    std::cerr << "\n  dt " << u.increment.dt << ", density " << u.increment.density_old << " -> " << u.increment.density
              << ", parts " << u.substeps << ", history";
    History h = u.history_n;
    h.for_each([](const char *name, const double &value) { std::cerr << ' ' << name << ' ' << value; });
    std::cerr << " ->";
    h = u.history;
    h.for_each([](const char *, const double &value) { std::cerr << ' ' << value; });
    std::cerr << '\n';
  }
};

template <typename Law>
unsigned long run_examples(const unsigned long n_updates, const unsigned long seed, const std::string &only,
                           nlohmann::ordered_json &results)
{
  unsigned long failed = 0;
  if (!only.empty() && only != Law::name)
    return 0;
  for (const std::string &example : example_blocks(Law::name))
    {
      LawRun<Law> law(law_of_block<Law>(example_file(Law::name), example), example, seed);
      law.run(n_updates);
      results.push_back(law.results());
      failed += law.n_failed;
      std::cout << results.back().dump() << std::endl;
    }
  return failed;
}

template <typename... Laws>
unsigned long run_all(const std::tuple<Laws...> *, const unsigned long n_updates, const unsigned long seed,
                      const std::string &only, nlohmann::ordered_json &results)
{
  return (run_examples<Laws>(n_updates, seed, only, results) + ...);
}
} // namespace Arenite

int main(int argc, char **argv)
{
  unsigned long n_updates = 20000, seed = 1;
  std::string   output, only;
  CLI::App      app("Random updates of all material laws, checked one by one.");
  app.add_option("--updates", n_updates, "Number of updates for each example")->capture_default_str();
  app.add_option("--seed", seed, "Start of the random numbers")->capture_default_str();
  app.add_option("--only", only, "One law");
  app.add_option("--output", output, "File for the results (JSON)");
  CLI11_PARSE(app, argc, argv);
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  const auto failed = Arenite::run_all(static_cast<const Arenite::LawTypes *>(nullptr), n_updates, seed, only, results);
  if (!output.empty())
    std::ofstream(output) << results.dump(2) << '\n';
  return failed == 0 ? 0 : 1;
}
