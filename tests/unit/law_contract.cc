// What every law of law_types.h must fulfil, on the examples of tests/data/laws. A new law is tested as soon as it has its line and
// its examples.

#include <arenite/materials/batch_law.h>
#include <arenite/materials/law_list.h>
#include <arenite/materials/law_types.h>
#include <arenite/materials/material_point.h>

#include <boost/mpl/list.hpp>
#include <boost/test/unit_test.hpp>

#include <Sacado_Fad_SimpleFad.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "law_example.h"

using namespace Arenite;

namespace
{
template <typename Tuple>
struct TypeList;
template <typename... Laws>
struct TypeList<std::tuple<Laws...>>
{
  using type = boost::mpl::list<Laws...>;
};
using Laws = TypeList<LawTypes>::type;

using Random = std::mt19937_64;
double uniform(Random &random, const double low, const double high)
{
  return low + (high - low) * (random() >> 11) * 0x1p-53; // the same numbers with every standard library
}
double log_uniform(Random &random, const double low, const double high)
{
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// Of size @p size; 15 % isotropic, 15 % without volume.
SymTensor<double> random_tensor(Random &random, const double size)
{
  SymTensor<double> a;
  for (int k = 0; k < 6; ++k)
    a[k] = uniform(random, -1., 1.);
  const double kind = uniform(random, 0., 1.);
  if (kind < 0.15)
    a = spherical(a[0]);
  else if (kind < 0.3)
    a = deviator(a);
  return a * (size / std::sqrt(contract(a, a)));
}

/// A state that a point has reached from rest, and the step that comes next.
template <typename Law>
struct Sample
{
  SymTensor<double>                      stress;
  typename Law::template History<double> history;
  PointIncrement<double>                 next;
};

template <typename Law>
double modulus(const Law &law)
{
  return law.density() * law.wave_speed_bound() * law.wave_speed_bound();
}

template <typename Law>
std::vector<Sample<Law>> samples(const Law &law, const unsigned int n, const double largest_strain = 3e-2)
{
  Random                   random(n);
  std::vector<Sample<Law>> result;
  const auto               increment = [&](const double volume_strain, const double density) {
    PointIncrement<double> next;
    do
      next.strain = random_tensor(random, log_uniform(random, 1e-8, largest_strain));
    while (std::abs(volume_strain + trace(next.strain)) > 0.1);
    next.density_old = density;
    next.density     = law.density() * std::exp(-volume_strain - trace(next.strain));
    next.dt          = log_uniform(random, 1e-8, 1e-1);
    return next;
  };
  for (unsigned int i = 0; i < n; ++i)
    {
      Sample<Law> sample;
      sample.history       = law.initial_history();
      double volume_strain = 0., density = law.density();
      for (int steps = int(uniform(random, 0., 7.)); steps > 0; --steps)
        {
          const auto step = increment(volume_strain, density);
          sample.stress   = law.update(sample.stress, step, sample.history).stress;
          volume_strain += trace(step.strain);
          density = step.density;
        }
      sample.next = increment(volume_strain, density);
      result.push_back(sample);
    }
  return result;
}

template <typename History>
std::vector<double> numbers(History history)
{
  std::vector<double> values;
  history.for_each([&](const char *, const double &value) { values.push_back(value); });
  return values;
}

double difference(const SymTensor<double> &a, const SymTensor<double> &b) { return std::sqrt(contract(a - b, a - b)); }
double size(const SymTensor<double> &a) { return std::sqrt(contract(a, a)); }

/// Size of the stresses of a step, among them the elastic trial.
template <typename Law>
double scale(const Law &law, const Sample<Law> &sample)
{
  return size(sample.stress) + modulus(law) * size(sample.next.strain);
}

/// Six variables that are one tensor: their names end in xx, yy, zz, xy, xz, yz.
bool begins_tensor(const std::string &name) { return name.size() > 3 && name.substr(name.size() - 3) == " xx"; }

template <typename History>
std::vector<std::string> names_of(History history)
{
  std::vector<std::string> names;
  history.for_each([&](const char *name, const double &) { names.emplace_back(name); });
  return names;
}

SymTensor<double> tensor_at(const std::vector<double> &values, const std::size_t i)
{
  SymTensor<double> tensor;
  std::copy_n(values.begin() + i, 6, tensor.v);
  return tensor;
}

/// Largest relative difference of the variables, tensors as a whole.
template <typename History>
double relative_difference(const History &a, const History &b)
{
  const auto names = names_of(a);
  const auto x = numbers(a), y = numbers(b);
  double     worst = 0.;
  for (std::size_t i = 0; i < x.size();)
    if (begins_tensor(names[i]))
      {
        const auto s = tensor_at(x, i), t = tensor_at(y, i);
        worst = std::max(worst, difference(s, t) / std::max({size(s), size(t), 1e-12}));
        i += 6;
      }
    else
      {
        worst = std::max(worst, std::abs(x[i] - y[i]) / std::max({std::abs(x[i]), std::abs(y[i]), 1e-12}));
        ++i;
      }
  return worst;
}

template <typename History>
History history_of(const std::vector<double> &values)
{
  History history;
  auto    from = values.begin();
  history.for_each([&](const char *, double &value) { value = *from++; });
  return history;
}

template <typename History>
History rotated_history(const History &history, const double (&Q)[3][3])
{
  const auto names  = names_of(history);
  auto       values = numbers(history);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (begins_tensor(names[i]))
      {
        const auto tensor = rotate(tensor_at(values, i), Q);
        std::copy_n(tensor.v, 6, values.begin() + i);
      }
  return history_of<History>(values);
}

/// Run @p test for the examples of a law.
template <typename Law, typename Test>
void for_each_example(const Test &test)
{
  for (const std::string &block : example_blocks(Law::name))
    BOOST_TEST_CONTEXT(Law::name << ", " << block) { test(law_of_block<Law>(example_file(Law::name), block), block); }
}
} // namespace

BOOST_AUTO_TEST_SUITE(law_contract)

// The list, the registry and the history agree: names are unique, arrays have one entry per variable.
BOOST_AUTO_TEST_CASE_TEMPLATE(names_and_history, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    for (const int lanes : {1, native_lanes})
      {
        const auto batch = material_laws(lanes).make(Law::name);
        BOOST_TEST(batch->n_lanes() == lanes);
        const auto names = batch->history_names();
        BOOST_TEST(std::set<std::string>(names.begin(), names.end()).size() == names.size());
        BOOST_TEST(numbers(law.initial_history()).size() == names.size());
      }
    // through an array and back
    const auto          values = numbers(law.initial_history());
    std::vector<double> copy(values.size());
    auto                history = law.initial_history();
    store_history<typename Law::template History<double>, double>(history, copy.data());
    typename Law::template History<double> other;
    load_history<typename Law::template History<double>, double>(other, copy.data());
    BOOST_TEST(numbers(other) == values);
  });
}

// Without strain and time nothing happens, and a transfer leaves states alone that the law has reached itself.
BOOST_AUTO_TEST_CASE_TEMPLATE(nothing_happens_without_a_cause, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    double stress = 0., history = 0., transfer = 0.;
    for (Sample<Law> sample : samples(law, 2000))
      {
        PointIncrement<double> none;
        none.density_old = none.density = sample.next.density_old;
        none.dt                         = 1e-300;
        auto       h                    = sample.history;
        const auto r                    = law.update(sample.stress, none, h);
        stress  = std::max(stress, difference(r.stress, sample.stress) / (size(sample.stress) + 1e-9 * modulus(law)));
        history = std::max(history, relative_difference(h, sample.history));

        SymTensor<double> s = sample.stress;
        h                   = sample.history;
        law.after_transfer(s, h);
        transfer =
          std::max({transfer, difference(s, sample.stress) / modulus(law), relative_difference(h, sample.history)});
      }
    BOOST_TEST_MESSAGE(Law::name << ": zero increment " << stress << ", history " << history << ", transfer "
                                 << transfer);
    BOOST_TEST(stress < 1e-12);
    BOOST_TEST(history < 1e-12);
    BOOST_TEST(transfer < 1e-14);
  });
}

// The law does not know the directions of the axes.
BOOST_AUTO_TEST_CASE_TEMPLATE(isotropy, Law, Laws)
{
  const double a = 0.7, b = 0.4;
  const double Q[3][3] = {{std::cos(a), -std::sin(a) * std::cos(b), std::sin(a) * std::sin(b)},
                          {std::sin(a), std::cos(a) * std::cos(b), -std::cos(a) * std::sin(b)},
                          {0., std::sin(b), std::cos(b)}};
  for_each_example<Law>([&](const Law &law, const std::string &) {
    double worst = 0., worst_history = 0.;
    for (const Sample<Law> &sample : samples(law, 3000))
      {
        auto       h = sample.history, h_rotated = rotated_history(h, Q);
        const auto r       = law.update(sample.stress, sample.next, h);
        auto       step    = sample.next;
        step.strain        = rotate(step.strain, Q);
        const auto rotated = law.update(rotate(sample.stress, Q), step, h_rotated);
        worst              = std::max(worst, difference(rotated.stress, rotate(r.stress, Q)) / scale(law, sample));
        worst_history      = std::max(worst_history, relative_difference(rotated_history(h, Q), h_rotated));
      }
    BOOST_TEST_MESSAGE(Law::name << ": rotation " << worst << ", history " << worst_history);
    BOOST_TEST(worst < 1e-11);
    BOOST_TEST(worst_history < 1e-9);
  });
}

namespace
{
/// Largest difference of W lanes from W scalar calls; lanes whose step is divided otherwise than alone are left out.
template <typename Law, int W>
void compare_lanes(const Law &law)
{
  using Number = Lanes<W>;
  BatchLawFor<Law, W> batch_law;
  batch_law.law              = law;
  const auto          points = samples(law, 250 * W);
  const unsigned int  n = points.size() / W, n_history = numbers(law.initial_history()).size();
  std::vector<double> strain(6 * points.size()), stress(strain.size()), history(n_history * points.size());
  std::vector<double> density(points.size()), old(points.size()), speed(points.size()), stored(points.size()),
    dissipated(points.size());
  double       worst = 0., worst_history = 0., worst_energy = 0.;
  unsigned int compared = 0;
  for (unsigned int i = 0; i < n; ++i) // one point per batch, so that the parts of each are known
    {
      for (int l = 0; l < W; ++l)
        {
          const auto &sample = points[i * W + l];
          for (int k = 0; k < 6; ++k)
            {
              strain[k * W + l] = sample.next.strain[k];
              stress[k * W + l] = sample.stress[k];
            }
          const auto values = numbers(sample.history);
          for (unsigned int k = 0; k < n_history; ++k)
            history[k * W + l] = values[k];
          old[l]     = sample.next.density_old;
          density[l] = sample.next.density;
        }
      PointBatch batch;
      batch.n_points    = 1;
      batch.dt          = points[i * W].next.dt;
      batch.strain      = strain.data();
      batch.density_old = old.data();
      batch.density     = density.data();
      batch.stress      = stress.data();
      batch.history     = history.data();
      batch.wave_speed  = speed.data();
      batch.stored      = stored.data();
      batch.dissipated  = dissipated.data();
      batch_law.update(batch);
      for (int l = 0; l < W; ++l)
        {
          auto sample    = points[i * W + l];
          sample.next.dt = batch.dt;
          const auto r   = law.update(sample.stress, sample.next, sample.history);
          if (r.substeps != batch.substeps)
            continue;
          ++compared;
          const double        s = scale(law, points[i * W + l]);
          SymTensor<double>   lane_stress;
          std::vector<double> lane_history;
          for (int k = 0; k < 6; ++k)
            lane_stress[k] = stress[k * W + l];
          for (unsigned int k = 0; k < n_history; ++k)
            lane_history.push_back(history[k * W + l]);
          worst         = std::max(worst, difference(lane_stress, r.stress) / s);
          worst_history = std::max(worst_history,
                                   relative_difference(history_of<typename Law::template History<double>>(lane_history),
                                                       sample.history));
          worst_energy =
            std::max(worst_energy, (std::abs(stored[l] - r.stored) + std::abs(dissipated[l] - r.dissipated)) /
                                     (s * (s / modulus(law))));
          BOOST_TEST(std::abs(speed[l] - r.wave_speed) < 1e-12 * r.wave_speed);
        }
    }
  BOOST_TEST_MESSAGE(Law::name << ", " << W << " lanes, " << compared << " of " << points.size() << " points: stress "
                               << worst << ", history " << worst_history << ", energy " << worst_energy);
  BOOST_TEST(compared > points.size() / 8);
  BOOST_TEST(worst < 1e-11);
  BOOST_TEST(worst_history < 1e-9);
  BOOST_TEST(worst_energy < 1e-10);
}
} // namespace

// Points that are computed side by side get what they get alone.
BOOST_AUTO_TEST_CASE_TEMPLATE(lanes_are_scalars, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    compare_lanes<Law, 1>(law);
    compare_lanes<Law, 4>(law);
    compare_lanes<Law, 8>(law);
  });
}

// No state is faster than the bound, apart from a lower density in tension; all numbers stay numbers, also from states that no law
// reaches. (Dissipation is not looked at here: with the mean stress of a step that reverses the load it may be negative.)
BOOST_AUTO_TEST_CASE_TEMPLATE(hard_states, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    Random       random(5);
    unsigned int not_finite = 0;
    double       fastest = 0., most_negative = 0.;
    for (Sample<Law> sample : samples(law, 10000, 1e-1))
      {
        const bool reached = uniform(random, 0., 1.) < 0.5;
        if (!reached)
          sample.stress = random_tensor(random, log_uniform(random, 1e-6, 10.) * modulus(law) * 1e-2);
        sample.next.dt = log_uniform(random, 1e-9, 1e3);
        const auto r   = law.update(sample.stress, sample.next, sample.history);
        bool       ok  = std::isfinite(r.wave_speed) && std::isfinite(r.stored) && std::isfinite(r.dissipated);
        for (int k = 0; k < 6; ++k)
          ok = ok && std::isfinite(r.stress[k]);
        for (const double value : numbers(sample.history))
          ok = ok && std::isfinite(value);
        not_finite += !ok;
        const double J = law.density() / sample.next.density;
        if (reached)
          fastest = std::max(fastest, r.wave_speed / (law.wave_speed_bound() * std::sqrt(std::max(1., J))));
      }
    BOOST_TEST_MESSAGE(Law::name << ": speed/bound " << fastest);
    BOOST_TEST(not_finite == 0u);
    BOOST_TEST(fastest <= 1. + 1e-12);
  });
}

// Steps of half the size come closer and closer: first order on the average of random paths.
BOOST_AUTO_TEST_CASE_TEMPLATE(halving_the_step_converges, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    constexpr int levels          = 6; // 32 to 1024 steps
    double        gap[levels - 1] = {};
    Random        random(9);
    for (int path = 0; path < 40; ++path)
      {
        SymTensor<double> legs[3];
        for (auto &leg : legs)
          leg = random_tensor(random, log_uniform(random, 1e-4, 1e-2));
        const double      duration = log_uniform(random, 1e-4, 1e-1);
        SymTensor<double> coarser;
        for (int level = 0; level < levels; ++level)
          {
            const int         n = 32 << level;
            SymTensor<double> stress;
            auto              history = law.initial_history();
            double            density = law.density(), volume_strain = 0., largest = 0.;
            for (const auto &leg : legs)
              for (int i = 0; i < n; ++i)
                {
                  PointIncrement<double> step;
                  step.strain      = leg * (1. / n);
                  step.dt          = duration / n;
                  step.density_old = density;
                  volume_strain += trace(step.strain);
                  step.density = density = law.density() * std::exp(-volume_strain);
                  stress                 = law.update(stress, step, history).stress;
                  largest                = std::max(largest, size(stress));
                }
            if (level > 0)
              gap[level - 1] += difference(stress, coarser) / largest / 40;
            coarser = stress;
          }
      }
    BOOST_TEST_MESSAGE(Law::name << ": " << gap[0] << ' ' << gap[1] << ' ' << gap[2] << ' ' << gap[3] << ' ' << gap[4]);
    BOOST_TEST(gap[4] <= 0.3 * gap[1] + 1e-12); // first order: 1/8
  });
}

// A closed cycle of strain wins no energy, and work is what is stored and dissipated, to second order in the step. Both hold per present volume, or per reference
// volume, as the law keeps its energy.
BOOST_AUTO_TEST_CASE_TEMPLATE(no_energy_from_closed_cycles, Law, Laws)
{
  for_each_example<Law>([](const Law &law, const std::string &) {
    Random random(13);
    double worst_cycle = 0., worst_balance = 0.;
    for (int cycle = 0; cycle < 60; ++cycle)
      {
        BatchLawFor<Law, 1> batch;
        batch.law = law;
        MaterialPoint                  point(batch);
        std::vector<SymTensor<double>> vertices(5);
        for (int i = 0; i < 4; ++i)
          vertices[i] = random_tensor(random, log_uniform(random, 1e-5, 1e-2));
        const double duration = log_uniform(random, 1e-5, 1e-1);
        const int    n        = 2000;
        double       work = 0., largest = 0., dissipated = 0.;
        const auto   present = [](const PointState &s) { return s.stored / s.volume_ratio(); };
        const double at_rest = present(point.state), at_rest_reference = point.state.stored;
        for (int round = 0; round < 2; ++round)
          for (const auto &vertex : vertices)
            {
              const SymTensor<double> step = (vertex - point.state.strain) * (1. / n);
              for (int i = 0; i < n; ++i)
                {
                  const PointState before = point.state;
                  point.advance(step, duration / n);
                  const PointState &now = point.state;
                  work += contract((before.stress + now.stress) * 0.5, step);
                  const double J_mean = 0.5 * (before.volume_ratio() + now.volume_ratio());
                  dissipated += (now.dissipated - before.dissipated) / J_mean;
                  largest = std::max({largest, std::abs(work), present(now)});
                  if (now.substeps != before.substeps + 1.) // the mean stress of a divided step is not the law's
                    largest = std::numeric_limits<double>::infinity();
                }
            }
        const PointState &end = point.state;
        worst_cycle           = std::min(worst_cycle, std::max(work, end.work) / largest);
        worst_balance =
          std::max(worst_balance, std::min(std::abs(work - (present(end) - at_rest) - dissipated),
                                           std::abs(end.work - (end.stored - at_rest_reference) - end.dissipated)) /
                                    largest);
      }
    BOOST_TEST_MESSAGE(Law::name << ": closed cycles win " << -worst_cycle << ", balance " << worst_balance);
    BOOST_TEST(worst_cycle > -1e-8);
    BOOST_TEST(worst_balance < 1e-4); // exact laws: round-off
  });
}

// The derivatives of a differentiable number are those of the law.
BOOST_AUTO_TEST_CASE_TEMPLATE(tangent_by_differentiable_numbers, Law, Laws)
{
  using AD = Sacado::Fad::SimpleFad<double>;
  for_each_example<Law>([](const Law &law, const std::string &) {
    unsigned int        kinks = 0, n = 0;
    double              worst = 0., value = 0.;
    const double        h = 1e-8;
    std::vector<double> errors;
    for (const Sample<Law> &sample : samples(law, 400))
      {
        SymTensor<AD>                      stress;
        PointIncrement<AD>                 step;
        typename Law::template History<AD> history;
        for (int k = 0; k < 6; ++k)
          {
            stress[k]      = AD(sample.stress[k]);
            step.strain[k] = AD(6, k, sample.next.strain[k]);
          }
        step.density_old = AD(sample.next.density_old);
        step.density     = AD(sample.next.density);
        step.dt          = sample.next.dt;
        {
          const auto values = numbers(sample.history);
          auto       from   = values.begin();
          history.for_each([&](const char *, AD &x) { x = AD(*from++); });
        }
        const auto ad = law.update(stress, step, history);

        auto       h_0   = sample.history;
        const auto r     = law.update(sample.stress, sample.next, h_0);
        double     error = 0., one_sided = 0.;
        for (int k = 0; k < 6; ++k)
          {
            auto plus = sample.next, minus = sample.next;
            plus.strain[k] += h;
            minus.strain[k] -= h;
            auto       h_plus = sample.history, h_minus = sample.history;
            const auto r_plus  = law.update(sample.stress, plus, h_plus),
                       r_minus = law.update(sample.stress, minus, h_minus);
            for (int i = 0; i < 6; ++i)
              {
                const double difference = (r_plus.stress[i] - r_minus.stress[i]) / (2. * h);
                error                   = std::max(error, std::abs(ad.stress[i].dx(k) - difference) / modulus(law));
                one_sided = std::max(one_sided, std::abs(r_plus.stress[i] - 2. * r.stress[i] + r_minus.stress[i]) / h /
                                                  modulus(law));
              }
          }
        for (int i = 0; i < 6; ++i)
          value = std::max(value, std::abs(ad.stress[i].val() - r.stress[i]) / scale(law, sample));
        ++n;
        if (one_sided > 1e-4) // a region switch within h
          ++kinks;
        else
          worst = std::max(worst, error);
      }
    BOOST_TEST_MESSAGE(Law::name << ": tangent " << worst << ", value " << value << ", " << kinks << " kinks of " << n);
    BOOST_TEST(worst < 1e-5);
    BOOST_TEST(value < 1e-11);
    BOOST_TEST(kinks < n / 8); // measured up to 43 of 400
  });
}

BOOST_AUTO_TEST_SUITE_END()
