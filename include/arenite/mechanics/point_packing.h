#pragma once

#include <arenite/mechanics/internal_force.h>

#include <utility>

namespace Arenite
{
/// The numbers of one cell in the arrays of a block with a law of its own, in an order of their own: [point][stress, history, bulk
/// viscosity, wave speed, stored energy, one that is not kept here], then frequency, 1/step, ratio, hourglass energy and forces of the cell.
struct PointPacking
{
  int          n_points, n_lanes;
  unsigned int n_history;
  unsigned int n_viscous;       ///< of the bulk viscosity: 1 or 6
  int          n_amplitudes;    ///< hourglass forces of a cell; 0: none
  bool         amplitudes_last; ///< they are elastic and come from increments, so that nothing else says what they are

  unsigned int n_values() const { return 6 + n_history + n_viscous + 2; }

  std::vector<CellRecord::OfCell> of_cell(const int dim) const
  {
    // frequency ~ 1/h^2, step ~ h, the ratio of shapes
    std::vector<CellRecord::OfCell> result{{4., false, 0.25}, {2., false, 0.5}, {1., false, 1.}};
    if (n_amplitudes > 0)
      result.push_back({1. / (1 << dim), true, 1.});
    if (!amplitudes_last) // viscous ones are taken anew
      result.resize(result.size() + n_amplitudes, {0., false, 0.});
    else
      for (int k = 0; k < n_amplitudes; ++k)
        {
          // In a child a product of n coordinates of the unit cell has 2^-n of its amplitude, the stiffness 2^-(dim - 2): the child takes its
          // share of the force. Smooth fields have the same shares, so that the cell has the sum again.
          const int    n     = dim == 3 && k % 4 == 3 ? 3 : 2;
          const double share = 1. / (1 << (n + dim - 2));
          result.push_back({share, true, 1. / (share * (1 << dim))});
        }
    return result;
  }

  /// Copy the cell at @p place (batch times lanes plus lane) to @p values, or back.
  template <bool pack, typename Record, typename Values>
  void exchange(Record &record, const unsigned int place, Values *values) const
  {
    auto             &points = record.points;
    const std::size_t batch = place / n_lanes, lane = place % n_lanes;
    const auto        copy = [](auto &stored, Values &value) {
      if constexpr (pack)
        value = stored;
      else
        stored = value;
    };
    for (int q = 0; q < n_points; ++q, ++values)
      {
        const std::size_t point = batch * n_points + q;
        for (unsigned int k = 0; k < 6; ++k)
          copy(points.stress[(6 * point + k) * n_lanes + lane], *values++);
        for (unsigned int k = 0; k < n_history; ++k)
          copy(points.history[(n_history * point + k) * n_lanes + lane], *values++);
        for (unsigned int k = 0; k < n_viscous; ++k)
          copy(points.bulk_viscosity[(n_viscous * point + k) * n_lanes + lane], *values++);
        for (auto *array : {&points.wave_speed, &points.stored})
          copy((*array)[point * n_lanes + lane], *values++);
      }
    for (auto *array : {&points.frequency, &points.inverse_step, &points.ratio})
      copy((*array)[place], *values++);
    if (n_amplitudes > 0)
      copy(points.hourglass[place], *values++);
    for (int k = 0; k < n_amplitudes; ++k)
      copy(record.amplitude[(batch * n_amplitudes + k) * n_lanes + lane], *values++);
  }

  unsigned int size() const { return n_points * (n_values() + 1) + 3 + (n_amplitudes > 0 ? 1 + n_amplitudes : 0); }
};

/// The cells of one batch, set aside.
class BatchCopy
{
public:
  BatchCopy(const PointPacking &packing, const BlockState &record, const unsigned int batch)
    : packing(packing)
    , values(packing.n_lanes, std::vector<double>(packing.size()))
  {
    for (int l = 0; l < packing.n_lanes; ++l)
      packing.exchange<true>(record, batch * packing.n_lanes + l, values[l].data());
  }
  void give_back(BlockState &record, const unsigned int place) const
  {
    packing.exchange<false>(record, place, values[place % packing.n_lanes].data());
  }

private:
  const PointPacking              &packing;
  std::vector<std::vector<double>> values;
};
} // namespace Arenite
