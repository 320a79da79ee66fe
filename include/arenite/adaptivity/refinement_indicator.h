#pragma once

#include <arenite/base/registry.h>
#include <arenite/mechanics/cell_fields.h>
#include <arenite/mechanics/state.h>

#include <deal.II/lac/vector.h>

namespace Arenite
{
/// How badly a cell resolves what happens in it: one non-negative number per owned cell, in the order of
/// Discretization::cells(). Only ratios between cells matter.
template <int dim>
class RefinementIndicator
{
public:
  virtual ~RefinementIndicator() = default;

  /// @p velocity and the displacement of @p state have valid ghosts and hanging nodes.
  virtual void evaluate(const Discretization<dim> &, const State<dim> &, const VectorType &velocity,
                        const MaterialOfBlock &, dealii::Vector<float> &per_cell) const = 0;
};

template <int dim>
const Registry<RefinementIndicator<dim>> &refinement_indicators();
} // namespace Arenite
