#pragma once

#include <arenite/mechanics/internal_force.h>

#include <array>
#include <vector>

namespace Arenite
{
/// Records of cells (CellRecord) when cells are halved or put together. Values stay within the bounds of what they come from, except that
/// stress continues to boundaries, so that a body in equilibrium under its weight stays there.
template <int dim>
class CellRecords
{
public:
  static constexpr unsigned int n_children = 1u << dim;

  explicit CellRecords(const CellRecord &layout);

  /// What a child of a cell needs to know about the neighbours of its parent: slopes over the unit cell, bounds.
  struct Surroundings
  {
    std::vector<double> slope, lower, upper; ///< [direction][value], [value], [value]
  };

  /// Means over the points of a cell, weighted with their volumes: [value].
  std::vector<double> means(const double *record) const;

  /// @p own, @p neighbour: means of the cell and of its neighbours, in the order of faces; empty where there is none of the same block. @p distance: from
  /// the centre of the cell to that of the neighbour in sizes of the cell: 1 for equal ones, 3/2 and 3/4 for larger and smaller ones.
  Surroundings look_around(const std::vector<double> &own, const std::vector<double> (&neighbour)[2 * dim],
                           const double (&distance)[2 * dim]) const;

  /// Record of child @p child of a cell. Elements of degree 1 take mean and slopes, with what the nearest point of the parent differs from
  /// its own linear field; higher ones the polynomial through the points of the parent. Both are cut off at the bounds.
  void refine(const double *parent, const Surroundings &, unsigned int child, double *record) const;

  /// Record of a cell from those of its children. Elements of degree 1: points take the mean, weighted with volumes, over the points of the
  /// children in their part of the cell; higher ones the polynomial of the child there, cut off, so that linear fields survive.
  void coarsen(const std::vector<const double *> &children, double *record) const;

  const CellRecord layout;

private:
  std::array<unsigned int, dim> index(unsigned int point) const;
  double                        polynomial(const double *record, const double (&place)[dim], unsigned int k) const;
  void                          take_means(const std::vector<const double *> &children, double *record) const;
  void                          take_polynomials(const std::vector<const double *> &children, double *record) const;
  double                        volume(const double *record, const unsigned int point) const
  {
    return record[(point + 1) * layout.n_values - 1];
  }

  const unsigned int  n_line, n_points, n_values; ///< points of a line and of a cell, values without the volume
  std::vector<double> ends;                       ///< of the points' parts of the line
};
} // namespace Arenite
