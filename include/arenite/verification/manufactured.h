#pragma once

#include <arenite/verification/exact_solution.h>

#include <vector>

namespace Arenite
{
// Manufactured solutions: a chosen motion u with the body force f = rho u'' - (lambda + G) grad div u - G lap u that
// drives it. They test operator, boundary terms and time integration on any mesh. Small strain.

/// Sum of plane waves, for any domain (traction from the exact stress):
///
///   u = sum_w d sin(k.x - w t + phi),   f = sum_w [-rho w^2 d + (lambda + G)(k.d) k + G |k|^2 d] sin(.)
///
/// f = 0 if d || k and w = cp |k|, or d perpendicular to k and w = cs |k|: then a free wave.
template <int dim>
class ManufacturedPlane : public ExactSolution<dim>
{
public:
  struct Wave
  {
    dealii::Tensor<1, dim> amplitude;         ///< d [m]
    dealii::Tensor<1, dim> wave_vector;       ///< k [1/m]
    double                 angular_frequency; ///< w [1/s]
    double                 phase = 0.;        ///< phi
  };

  ManufacturedPlane(const LinearElastic &material, const std::vector<Wave> &waves);

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const override;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        body_force(const dealii::Point<dim> &x, double t) const override;
  bool                          has_body_force() const override { return true; }

  /// Subsections Wave 1, Wave 2, ... as many as were given to the constructor.
  void declare_parameters(Parameters &parameters) override;

private:
  LinearElastic     material;
  std::vector<Wave> waves;
};

/// Standing wave u = d sin(w t + phi) prod_i sin(k_i x_i): zero on the faces of a cube of side pi n/k_i.
///
///   f = -rho w^2 u - sin(w t + phi) [(lambda + G) H d - G |k|^2 d prod_i sin(k_i x_i)],   H_ij = d2(prod)/dx_i dx_j
template <int dim>
class ManufacturedCube : public ExactSolution<dim>
{
public:
  ManufacturedCube(const LinearElastic &material, const dealii::Tensor<1, dim> &amplitude,
                   const dealii::Tensor<1, dim> &wave_numbers, double angular_frequency, double phase = 0.);

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const override;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        body_force(const dealii::Point<dim> &x, double t) const override;
  bool                          has_body_force() const override { return true; }

  void declare_parameters(Parameters &parameters) override;

private:
  LinearElastic          material;
  dealii::Tensor<1, dim> amplitude, wave_numbers;
  double                 angular_frequency, phase;

  double                 product(const dealii::Point<dim> &x) const;
  dealii::Tensor<1, dim> product_gradient(const dealii::Point<dim> &x) const;
  dealii::Tensor<2, dim> product_hessian(const dealii::Point<dim> &x) const;
};

/// Breathing and twisting of a hollow sphere, for curved boundaries; the tractions on spheres follow from the stress:
///
///   u = U B(r) sin(w1 t) e_r + V C(r) sin(w2 t) (e_z x x),   B = sin(kr (r - a)) + 1/2,   C = cos(kc r)
///   f = U sin(w1 t) [-rho w1^2 B - (lambda + 2 G)(B'' + 2 B'/r - 2 B/r^2)] e_r
///     + V sin(w2 t) [-rho w2^2 C - G (C'' + 4 C'/r)] (e_z x x)
///
/// Not for points at r = 0. In fewer dimensions the breathing alone, V = 0: sections of it on the radius or in the meridian plane.
template <int dim>
class ManufacturedShell : public ExactSolution<dim>
{
public:
  struct Motion
  {
    double breathing           = 1e-4; ///< U [m]
    double twist               = 1e-4; ///< V, a rotation [1]
    double breathing_number    = 3.;   ///< kr [1/m]
    double twist_number        = 2.;   ///< kc [1/m]
    double breathing_frequency = 100.; ///< w1 [1/s]
    double twist_frequency     = 80.;  ///< w2 [1/s]
  };

  ManufacturedShell(const LinearElastic &material, double inner_radius, const Motion &motion);

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const override;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const override;
  dealii::Tensor<1, dim>        body_force(const dealii::Point<dim> &x, double t) const override;
  bool                          has_body_force() const override { return true; }
  bool                          is_radial() const override { return motion.twist == 0.; }

  void declare_parameters(Parameters &parameters) override;

private:
  LinearElastic material;
  double        inner_radius;
  Motion        motion;
};
} // namespace Arenite
