#pragma once

#include <arenite/base/tensor_tools.h>
#include <arenite/materials/material_law.h>

#include <cmath>
#include <random>

namespace Arenite
{
/// Random numbers, tensors and strains of the study.
class RandomTensors
{
public:
  explicit RandomTensors(const unsigned long seed)
    : random(seed)
  {}

  double uniform() { return (random() >> 11) * 0x1p-53; } ///< the same numbers with every standard library
  double uniform(const double low, const double high) { return low + (high - low) * uniform(); }
  double logarithmic(const double lowest, const double decades) { return lowest * std::pow(10., decades * uniform()); }
  unsigned int one_of(const unsigned int n) { return random() % n; }

  /// A deviator of Euclidean norm 1.
  SymTensor<double> direction()
  {
    SymTensor<double> s;
    for (int k = 0; k < 6; ++k)
      s[k] = uniform(-1., 1.);
    s = deviator(s);
    return s * (1. / std::sqrt(contract(s, s)));
  }

  /// Of norm 1e-10 to 1 in any direction of the (volume, shear) plane; half of them with the shear along @p stress.
  SymTensor<double> strain(const SymTensor<double> &stress)
  {
    const double            size = logarithmic(1e-10, 10.), angle = uniform(0., 2. * M_PI);
    const SymTensor<double> s = deviator(stress);
    const double            j = std::sqrt(contract(s, s));
    const SymTensor<double> n = j > 0. && uniform() < 0.5 ? s * (1. / j) : direction();
    return n * (size * (uniform() < 0.1 ? 0. : std::sin(angle))) + spherical(size * std::cos(angle) / std::sqrt(3.));
  }

  /// Zero, or 1e-16 to 1e10 s: with fluidities of 200 to 1e4 1/s eta dt covers 0 and 1e-12 to 1e12.
  double time_step() { return uniform() < 0.02 ? 0. : logarithmic(1e-16, 26.); }

private:
  std::mt19937_64 random;
};

/// One update of one point.
template <typename Law>
struct Update
{
  using History = typename Law::template History<double>;

  SymTensor<double>      stress_n;
  History                history_n;
  PointIncrement<double> increment;

  SymTensor<double> stress;
  History           history;
  double            wave_speed = 0., stored = 0., dissipated = 0., substeps = 1.;
};

/// What a law can be asked beyond finite numbers; all relative to the stresses of the step, energies to their square over the
/// smallest modulus. Numbers below zero are what must not be.
struct Verdict
{
  double residual    = 0.; ///< of the law's equations: flow rule, surface, compaction
  double dissipation = 0.; ///< with the stress at the end of the step
  double history     = 0.; ///< how far outside of its bounds
  bool   corner = false, checked = true;
};
} // namespace Arenite
