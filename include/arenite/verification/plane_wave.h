#pragma once

#include <arenite/base/time_history.h>
#include <arenite/verification/exact_solution.h>
#include <arenite/verification/history_response.h>

#include <memory>

namespace Arenite
{
/// Pressure p(t) on the surface of a half-space at rest: the plane P wave of uniaxial strain (d'Alembert).
///
/// With the depth s = n.(x - origin) and tau = t - s/cp:
///
///   v = n p(tau)/(rho cp),   u = n integral_0^tau p/(rho cp),   s_nn = -p(tau),   s_tt = lambda/(lambda + 2 G) s_nn
///
/// Valid in a bar of uniaxial strain (no lateral displacement) until the wave returns from the far end. By default n =
/// e_x and the surface is x = 0. Above the surface (s < 0) the formulas are continued.
template <int dim>
class PlaneWave : public ExactSolution<dim>
{
public:
  PlaneWave(const LinearElastic &material, std::shared_ptr<const TimeHistory> pressure);

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const override;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const override;

  void declare_parameters(Parameters &parameters) override;
  /// Normalises the direction; InputError if it is zero.
  void finalize() override;

private:
  LinearElastic                      material;
  std::shared_ptr<const TimeHistory> pressure;
  HistoryResponse<1>                 response; ///< integral of the velocity of the surface
  dealii::Point<dim>                 origin;
  dealii::Tensor<1, dim>             direction;

  double arrival_age(const dealii::Point<dim> &x, double t) const;
};
} // namespace Arenite
