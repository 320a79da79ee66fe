#pragma once

#include <arenite/verification/buried_cavity.h>
#include <arenite/verification/exact_solution.h>
#include <arenite/verification/surface_load.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace Arenite
{
/// A motion that is known at the free surface of a half-space only, and symmetric about the vertical axis through the origin. The last
/// coordinate points up; in the meridian plane the first is the distance from the axis.
template <int dim>
class SurfaceMotion : public ExactSolution<dim>
{
public:
  explicit SurfaceMotion(const double height)
    : height(height)
  {}

  bool is_field() const override { return false; }
  bool known_at(const dealii::Point<dim> &x, const double t) const override
  {
    return std::abs(x[dim - 1] - height) < 1e-9 * (1. + std::abs(height)) && t <= known_until(distance(x));
  }

  dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x, const double t) const override
  {
    const double r              = distance(x);
    const auto [radial, upward] = components(r, t);
    dealii::Tensor<1, dim> u;
    u[dim - 1] = upward;
    for (unsigned int d = 0; d + 1 < dim; ++d)
      u[d] = r > 0. ? radial * x[d] / r : 0.;
    return u;
  }

  // never asked, because this is no field
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &, double) const override { return {}; }
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &, double) const override { return {}; }

protected:
  /// Radial and upward displacement [m] at the distance @p r from the axis.
  virtual std::pair<double, double> components(double r, double t) const = 0;
  virtual double                    known_until(double) const { return std::numeric_limits<double>::infinity(); }

private:
  double height; ///< of the surface above the origin [m]

  static double distance(const dealii::Point<dim> &x)
  {
    double square = 0.;
    for (unsigned int d = 0; d + 1 < dim; ++d)
      square += x[d] * x[d];
    return std::sqrt(square);
  }
};

/// Above a cavity at the origin, at the depth `height` of the surface above it.
template <int dim>
class BuriedCavityMotion : public SurfaceMotion<dim>
{
public:
  BuriedCavityMotion(const LinearElastic &material, const double radius, const double depth,
                     std::shared_ptr<const TimeHistory> pressure)
    : SurfaceMotion<dim>(depth)
    , cavity(material, radius, depth, std::move(pressure))
  {}

protected:
  std::pair<double, double> components(const double r, const double t) const override
  {
    const auto u = cavity.displacement(r, t);
    return {u.radial, u.upward};
  }
  double known_until(const double r) const override { return cavity.valid_until(r); }

private:
  BuriedCavity cavity;
};

/// Around a loaded disc whose centre is the origin.
template <int dim>
class SurfaceLoadMotion : public SurfaceMotion<dim>
{
public:
  SurfaceLoadMotion(const LinearElastic &material, const double radius, std::shared_ptr<const TimeHistory> pressure)
    : SurfaceMotion<dim>(0.)
    , radius(radius)
    , load(material, radius, std::move(pressure))
  {}

  bool known_at(const dealii::Point<dim> &x, const double t) const override
  {
    return SurfaceMotion<dim>::known_at(x, t) && x.norm() > radius;
  }

protected:
  std::pair<double, double> components(const double r, const double t) const override
  {
    const auto u = load.displacement(r, t);
    return {u.radial, u.upward};
  }

private:
  double      radius;
  SurfaceLoad load;
};
} // namespace Arenite
