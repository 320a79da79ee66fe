// Contract of the laws: points side by side.

#include <cmath>
#include <vector>

#include "law_samples.h"

using namespace Arenite;
using namespace LawSamples;

BOOST_AUTO_TEST_SUITE(law_contract)

namespace
{
/// Largest difference of W lanes from W scalar calls, whatever the parts of their steps.
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
  double worst = 0., worst_history = 0., worst_energy = 0.;
  for (unsigned int i = 0; i < n; ++i)
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
      double most_parts = 1.;
      for (int l = 0; l < W; ++l)
        {
          auto sample           = points[i * W + l];
          sample.next.dt        = batch.dt;
          const auto r          = law.update(sample.stress, sample.next, sample.history);
          most_parts            = std::max(most_parts, r.substeps);
          const double        s = scale(law, points[i * W + l]);
          SymTensor<double>   lane_stress;
          std::vector<double> lane_history;
          for (int k = 0; k < 6; ++k)
            lane_stress[k] = stress[k * W + l];
          for (unsigned int k = 0; k < n_history; ++k)
            lane_history.push_back(history[k * W + l]);
          worst = std::max(worst, difference(lane_stress, r.stress) / s);
          worst_history =
            std::max(worst_history,
                     relative_difference(law, history_of<typename Law::template History<double>>(lane_history),
                                         sample.history));
          worst_energy =
            std::max(worst_energy, (std::abs(stored[l] - r.stored) + std::abs(dissipated[l] - r.dissipated)) /
                                     (s * (s / modulus(law))));
          BOOST_TEST(std::abs(speed[l] - r.wave_speed) < 1e-12 * r.wave_speed);
        }
      BOOST_TEST(batch.substeps == most_parts);
    }
  BOOST_TEST_MESSAGE(Law::name << ", " << W << " lanes: stress " << worst << ", history " << worst_history
                               << ", energy " << worst_energy);
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

BOOST_AUTO_TEST_SUITE_END()
