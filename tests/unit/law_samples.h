#pragma once

#include <arenite/materials/batch_law.h>
#include <arenite/materials/law_types.h>

#include <boost/mpl/list.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "law_example.h"

// Random states and steps for what every law of law_types.h must fulfil, on the examples of tests/data/laws: law_contract_*.cc. A new
// law is tested as soon as it has its line and its examples.

namespace LawSamples
{
using namespace Arenite;

template <typename Tuple>
struct TypeList;
template <typename... Laws>
struct TypeList<std::tuple<Laws...>>
{
  using type = boost::mpl::list<Laws...>;
};
using Laws = TypeList<LawTypes>::type;

using Random = std::mt19937_64;
inline double uniform(Random &random, const double low, const double high)
{
  return low + (high - low) * (random() >> 11) * 0x1p-53; // the same numbers with every standard library
}
inline double log_uniform(Random &random, const double low, const double high)
{
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

/// Of size @p size; 15 % isotropic, 15 % without volume.
inline SymTensor<double> random_tensor(Random &random, const double size)
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

inline double difference(const SymTensor<double> &a, const SymTensor<double> &b)
{
  return std::sqrt(contract(a - b, a - b));
}
inline double size(const SymTensor<double> &a) { return std::sqrt(contract(a, a)); }

/// Size of the stresses of a step, among them the elastic trial.
template <typename Law>
double scale(const Law &law, const Sample<Law> &sample)
{
  return size(sample.stress) + modulus(law) * size(sample.next.strain);
}

/// Six variables that are one tensor: their names end in xx, yy, zz, xy, xz, yz.
inline bool begins_tensor(const std::string &name) { return name.size() > 3 && name.substr(name.size() - 3) == " xx"; }

template <typename History>
std::vector<std::string> names_of(History history)
{
  std::vector<std::string> names;
  history.for_each([&](const char *name, const double &) { names.emplace_back(name); });
  return names;
}

inline SymTensor<double> tensor_at(const std::vector<double> &values, const std::size_t i)
{
  SymTensor<double> tensor;
  std::copy_n(values.begin() + i, 6, tensor.v);
  return tensor;
}

/// Largest relative difference of the variables, tensors as a whole. Small ones count as zero: strains and ratios below 1e-12, energies per
/// mass below 1e-11 c^2. (A deviator has the digits of the pressure beside it: its work is uncertain by 1e-16 p eps/rho, or 1e-20 c^2 for
/// p = 1e-2 rho c^2 and a strain of 1 %.)
template <typename Law, typename History>
double relative_difference(const Law &law, const History &a, const History &b)
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
        const bool energy = names[i].find("energy") != std::string::npos || names[i].find("heat") != std::string::npos;
        const double zero = energy ? 1e-11 * std::pow(law.wave_speed_bound(), 2) : 1e-12;
        worst             = std::max(worst, std::abs(x[i] - y[i]) / std::max({std::abs(x[i]), std::abs(y[i]), zero}));
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
} // namespace LawSamples
