#pragma once

#include <arenite/base/registry.h>
#include <arenite/time/dynamics.h>

#include <deal.II/lac/vector.h>

namespace Arenite
{
/// How badly a cell resolves what happens in it: one non-negative number per owned cell, in the order of
/// Discretization::cells(). Only ratios between cells matter. Rounded to float, so that the same state on another number of processes gives
/// the same mesh.
template <int dim>
class RefinementIndicator
{
public:
  virtual ~RefinementIndicator() = default;

  /// Entries of `subsection Adaptivity` that only this indicator has.
  virtual void declare_parameters(Parameters &) {}

  /// @p velocity and the displacement of @p state have valid ghosts and hanging nodes. Collective.
  virtual void evaluate(const Dynamics<dim> &, const State<dim> &, const VectorType &velocity,
                        dealii::Vector<float> &per_cell) const = 0;
};

template <int dim>
const Registry<RefinementIndicator<dim>> &refinement_indicators();
} // namespace Arenite
