// Contract of the laws: names, single steps from all kinds of states.

#include <arenite/materials/law_list.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "law_samples.h"

using namespace Arenite;
using namespace LawSamples;

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
        // a pressure that is found as a root of the density has the digits of the density
        const double jump = difference(r.stress, sample.stress);
        if (jump > 4. * std::numeric_limits<double>::epsilon() * modulus(law))
          stress = std::max(stress, jump / (size(sample.stress) + 1e-9 * modulus(law)));
        history = std::max(history, relative_difference(law, h, sample.history));

        SymTensor<double> s = sample.stress;
        h                   = sample.history;
        law.after_transfer(s, h);
        transfer = std::max(
          {transfer, difference(s, sample.stress) / modulus(law), relative_difference(law, h, sample.history)});
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
        worst_history      = std::max(worst_history, relative_difference(law, rotated_history(h, Q), h_rotated));
      }
    BOOST_TEST_MESSAGE(Law::name << ": rotation " << worst << ", history " << worst_history);
    BOOST_TEST(worst < 1e-11);
    BOOST_TEST(worst_history < 1e-9);
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

BOOST_AUTO_TEST_SUITE_END()
