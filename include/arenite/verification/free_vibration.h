#pragma once

#include <arenite/verification/exact_solution.h>

namespace Arenite
{
/// A mode of a body without load: u = A phi(x) cos(w t), starting from the deflected state at rest.
template <int dim>
class FreeVibration : public ExactSolution<dim>
{
public:
  explicit FreeVibration(const LinearElastic &material);

  /// w [1/s]
  virtual double angular_frequency() const = 0;

  /// phi(x), dimensionless, largest value about 1.
  virtual dealii::Tensor<1, dim> mode(const dealii::Point<dim> &x) const = 0;

  /// Stress of the displacement 1 m times phi [Pa/m].
  virtual dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<dim> &x) const = 0;

  dealii::Tensor<1, dim>        displacement(const dealii::Point<dim> &x, double t) const final;
  dealii::Tensor<1, dim>        velocity(const dealii::Point<dim> &x, double t) const final;
  dealii::SymmetricTensor<2, 3> stress(const dealii::Point<dim> &x, double t) const final;

  /// Entries Amplitude and Mode; call finalize() afterwards.
  void declare_parameters(Parameters &parameters) override;

  double amplitude = 1e-3; ///< A [m]

protected:
  LinearElastic material;
  unsigned int  number = 1; ///< of the mode, from 1
};

/// Breathing of a ball (inner radius 0) or a hollow sphere with free surfaces, centre at the origin:
///
///   phi = [A j1(k r) + B y1(k r)] e_r,   k = w/cp,   s_rr = A T_j(k r) + B T_y(k r) times k,
///   T_j(z) = (lambda + 2 G) j0(z) - 4 G j1(z)/z and the same with y.
///
/// Ball: T_j(k b) = 0, which is tan x = x/(1 - (cp/cs)^2 x^2/4), x = w b/cp. Hollow sphere: T_j(k a) T_y(k b) =
/// T_j(k b) T_y(k a). phi = e_r at r = b. Source: closed form (Lamb, 1882); values in tests/unit/exact_solution.cc.
template <int dim>
class BreathingMode : public FreeVibration<dim>
{
public:
  BreathingMode(const LinearElastic &material, double inner_radius, double outer_radius, unsigned int number = 1);

  bool                          is_radial() const override { return true; }
  double                        angular_frequency() const override;
  dealii::Tensor<1, dim>        mode(const dealii::Point<dim> &x) const override;
  dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<dim> &x) const override;
  void                          finalize() override;

private:
  double inner_radius, outer_radius;
  double wave_number = 0.;            ///< k [1/m]
  double regular = 1., singular = 0.; ///< A, B
};

/// Twisting of a ball about the z axis, degree l = 1, free surface: phi = j1(k r)/j1(k b) e_z x x/r, k = w/cs, with
/// j2(k b) = 0, that is tan x = 3 x/(3 - x^2). Independent of the bulk modulus: tests curved geometry and shear.
class TorsionMode : public FreeVibration<3>
{
public:
  TorsionMode(const LinearElastic &material, double radius, unsigned int number = 1);

  double                        angular_frequency() const override;
  dealii::Tensor<1, 3>          mode(const dealii::Point<3> &x) const override;
  dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<3> &x) const override;
  void                          finalize() override;

private:
  double radius;
  double wave_number = 0.;
};

/// A mode that is harmonic along the axes, with n half waves on a length L: k = n pi/L [1/m].
template <int dim>
class HarmonicMode : public FreeVibration<dim>
{
public:
  HarmonicMode(const LinearElastic &material, double length, unsigned int number = 1);

protected:
  double wave_number() const;

private:
  double length;
};

/// Lame mode of the free cube [0, L]^dim (dim >= 2): phi = (cos kx sin ky, -sin kx cos ky, 0), k = n pi/L, w = sqrt(2)
/// cs k. No traction on any face and no change of volume, for every bulk modulus: shows volumetric locking.
template <int dim>
class LameMode : public HarmonicMode<dim>
{
public:
  using HarmonicMode<dim>::HarmonicMode;

  double                        angular_frequency() const override;
  dealii::Tensor<1, dim>        mode(const dealii::Point<dim> &x) const override;
  dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<dim> &x) const override;
};

/// Shear of a layer 0 < y < H between fixed planes (dim >= 2): phi = sin(n pi y/H) e_x, w = cs n pi/H. On x = const
/// only the normal displacement is free of traction: prescribe the displacement, or u_y = u_z = 0, there.
template <int dim>
class ShearMode : public HarmonicMode<dim>
{
public:
  using HarmonicMode<dim>::HarmonicMode;

  double                        angular_frequency() const override;
  dealii::Tensor<1, dim>        mode(const dealii::Point<dim> &x) const override;
  dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<dim> &x) const override;
};

/// Standing Rayleigh wave (dim >= 2) below the free surface x_v = 0 of a half-space, v the last coordinate, between smooth walls at x_1 = 0
/// and L, k = n pi/L, w = k cR:
///
///   phi_1 = -[e^{k q x_v} - 2 q s/(1 + s^2) e^{k s x_v}] sin(k x_1),    phi_v = q [e^{k q x_v} - 2/(1 + s^2) e^{k s x_v}] cos(k x_1)
///   q^2 = 1 - cR^2/cp^2,   s^2 = 1 - cR^2/cs^2,   (1 + s^2)^2 = 4 q s
///
/// Down to 6 wavelengths below the surface it decays to 4e-7 (nu = 1/4); prescribe the displacement there. Source: Rayleigh (1885).
template <int dim>
class RayleighMode : public HarmonicMode<dim>
{
public:
  RayleighMode(const LinearElastic &material, double length, unsigned int number = 1);

  double                        angular_frequency() const override;
  dealii::Tensor<1, dim>        mode(const dealii::Point<dim> &x) const override;
  dealii::SymmetricTensor<2, 3> mode_stress(const dealii::Point<dim> &x) const override;

private:
  double q, s; ///< decay with depth over k
};

/// cR [m/s]: (2 - x)^2 = 4 sqrt(1 - x cs^2/cp^2) sqrt(1 - x), x = cR^2/cs^2.
double rayleigh_speed(const LinearElastic &);
} // namespace Arenite
