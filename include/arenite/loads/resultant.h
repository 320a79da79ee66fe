#pragma once

#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>

namespace Arenite
{
/// What acts on the body through a boundary, or inside of it, on the part of this process.
template <int dim>
struct Resultant
{
  dealii::Tensor<1, dim> force;     ///< [N]
  double                 pull = 0.; ///< integral of t . n dS, n out of the body: minus pressure times area [N]

  Resultant &operator+=(const Resultant &other)
  {
    force += other.force;
    pull += other.pull;
    return *this;
  }
  friend Resultant operator*(const double factor, const Resultant &r) { return {factor * r.force, factor * r.pull}; }
};

/// By the boundary on which it acts; what acts inside of the body is under `inside`.
template <int dim>
using Resultants = std::map<dealii::types::boundary_id, Resultant<dim>>;

constexpr dealii::types::boundary_id inside = dealii::numbers::invalid_boundary_id;

template <int dim>
Resultant<dim> total(const Resultants<dim> &resultants)
{
  Resultant<dim> sum;
  for (const auto &[id, resultant] : resultants)
    sum += resultant;
  return sum;
}
} // namespace Arenite
