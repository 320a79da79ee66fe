#pragma once

#include <arenite/base/parameters.h>
#include <arenite/materials/linear_elastic.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace Arenite
{
/// A motion of a linear elastic solid with known displacement, velocity and stress at every place and time.
///
/// The stress always has 3 x 3 components: dim = 1 and 2 mean uniaxial and plane strain in Cartesian problems.
/// Solutions with spherical symmetry read dim = 1 as x = r with the stress (rr, tt, tt), and dim = 2 as the meridian
/// plane with the hoop stress last.
template <int dim>
class ExactSolution
{
public:
  virtual ~ExactSolution() = default;

  /// u [m]
  virtual dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x, double t) const = 0;

  /// du/dt [m/s]
  virtual dealii::Tensor<1, dim> velocity(const dealii::Point<dim> &x, double t) const = 0;

  /// sigma [Pa], tension positive
  virtual dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const = 0;

  /// Force per volume f = rho u'' - div sigma [N/m^3]; zero except in manufactured solutions.
  virtual dealii::Tensor<1, dim> body_force(const dealii::Point<dim> &, double) const { return {}; }
  virtual bool                   has_body_force() const { return false; }

  /// False if the displacement alone is known, and only where known_at() says so: no volume errors, initial states or boundary values.
  virtual bool is_field() const { return true; }
  virtual bool known_at(const dealii::Point<dim> &, double) const { return true; }

  /// Motion towards and away from the origin, the same in all directions.
  virtual bool is_radial() const { return false; }

  virtual void declare_parameters(Parameters &) {}
  virtual void finalize() {}
};

/// Stress of a spherically symmetric state: s_tt I + (s_rr - s_tt) n n^T with the radial direction @p n.
template <int dim>
dealii::SymmetricTensor<2, 3> spherical_stress(const double radial_stress, const double hoop_stress,
                                               const dealii::Tensor<1, dim> &n)
{
  dealii::SymmetricTensor<2, 3> stress;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      stress[i][j] = (radial_stress - hoop_stress) * n[i] * n[j];
  for (unsigned int i = 0; i < 3; ++i)
    stress[i][i] += hoop_stress;
  return stress;
}
} // namespace Arenite
