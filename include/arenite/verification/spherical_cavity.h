#pragma once

#include <arenite/base/time_history.h>
#include <arenite/verification/exact_solution.h>
#include <arenite/verification/history_response.h>

#include <memory>

namespace Arenite
{
/// Pressure p(t) in a spherical cavity of radius a in an infinite linear elastic solid at rest.
///
/// With the potential F(tau)/r, tau = t - (r - a)/cp:
///
///   u    = -F/r^2 - F'/(cp r)                       v    = -F'/r^2 - F''/(cp r)
///   s_rr = rho F''/r + 4 G (F/r^3 + F'/(cp r^2))    s_tt = lambda F''/(cp^2 r) - 2 G (F/r^3 + F'/(cp r^2))
///
/// and s_rr(a) = -p becomes F'' + 2 alpha F' + w0^2 F = -(a/rho) p, alpha = 2 cs^2/(a cp), w0 = 2 cs/a, which
/// HistoryResponse solves for any p. Every value at tau = 0 and later contains the jump of p, if it has one. Inside of
/// the cavity (r < a, points of a mesh with flat faces) the formulas are continued; the centre itself is not
/// admissible.
///
/// Source: closed form, derived from the potential of an outgoing spherical P wave. The potential differs from the
/// closed forms for a step and an exponential by 2e-15 of the maximum (tests/unit/exact_solution.cc).
template <int dim>
class SphericalCavity : public ExactSolution<dim>
{
public:
  SphericalCavity(const LinearElastic &material, double radius, std::shared_ptr<const TimeHistory> pressure);

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const override;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const override;

  bool is_radial() const override { return centre == dealii::Point<dim>(); }

  void declare_parameters(Parameters &parameters) override;

  /// Radial displacement [m], velocity [m/s], radial and hoop stress [Pa].
  struct RadialState
  {
    double displacement, velocity, radial_stress, hoop_stress;
  };

  /// All fields at the radius @p r [m]: one evaluation of the potential.
  RadialState radial_state(double r, double t) const;

  /// F [m^3] and its derivatives with respect to tau.
  struct Potential
  {
    double value, first, second;
  };
  Potential potential(double tau) const;

private:
  LinearElastic                      material;
  double                             radius;
  std::shared_ptr<const TimeHistory> pressure;
  HistoryResponse<2>                 response; ///< (F, F')
  dealii::Point<dim>                 centre;
};
} // namespace Arenite
