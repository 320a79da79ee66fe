#include <arenite/verification/free_vibration.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Arenite
{
namespace
{
using dealii::numbers::PI;

double j(const unsigned int order, const double z) { return boost::math::sph_bessel(order, z); }

double y(const unsigned int order, const double z) { return boost::math::sph_neumann(order, z); }

/// j1(z)/z, 1/3 at the centre.
double j1_over_z(const double z) { return z < 1e-4 ? 1. / 3. - z * z / 30. : j(1, z) / z; }

/// The @p number-th positive root of @p f: search for changes of sign in steps of @p step, then bracketing to rounding.
double root(const std::function<double(double)> &f, const unsigned int number, const double step)
{
  AssertThrow(number > 0, dealii::ExcMessage("Modes are counted from 1."));
  double       lower = step, f_lower = f(lower);
  unsigned int found = 0;
  for (unsigned int i = 0; i < 10000000; ++i)
    {
      const double upper = lower + step, f_upper = f(upper);
      if (f_lower * f_upper <= 0. && f_upper != 0. && ++found == number)
        {
          if (f_lower == 0.)
            return lower;
          std::uintmax_t iterations = 200;
          const auto     bracket =
            boost::math::tools::toms748_solve(f, lower, upper, f_lower, f_upper,
                                              boost::math::tools::eps_tolerance<double>(52), iterations);
          return 0.5 * (bracket.first + bracket.second);
        }
      lower   = upper;
      f_lower = f_upper;
    }
  AssertThrow(false, dealii::ExcMessage("The frequency of the mode was not found."));
  return 0.;
}
} // namespace

template <int dim>
FreeVibration<dim>::FreeVibration(const LinearElastic &material)
  : material(material)
{
  AssertThrow(material.density > 0. && material.bulk_modulus > 0. && material.shear_modulus > 0.,
              dealii::ExcMessage("Vibration needs a positive density, bulk and shear modulus."));
}

template <int dim>
dealii::Tensor<1, dim> FreeVibration<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  return amplitude * std::cos(angular_frequency() * t) * mode(x);
}

template <int dim>
dealii::Tensor<1, dim> FreeVibration<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  return -amplitude * angular_frequency() * std::sin(angular_frequency() * t) * mode(x);
}

template <int dim>
dealii::SymmetricTensor<2, 3> FreeVibration<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  return amplitude * std::cos(angular_frequency() * t) * mode_stress(x);
}

template <int dim>
void FreeVibration<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_quantity("Amplitude", amplitude, "m", any_value,
                          "Largest displacement; the frequency does not depend on it.");
  parameters.add_integer("Mode", number, 1, 1000,
                         "Number of the mode in ascending frequency; higher modes need finer meshes.");
}

template <int dim>
BreathingMode<dim>::BreathingMode(const LinearElastic &material, const double inner_radius, const double outer_radius,
                                  const unsigned int number)
  : FreeVibration<dim>(material)
  , inner_radius(inner_radius)
  , outer_radius(outer_radius)
{
  AssertThrow(inner_radius >= 0. && outer_radius > inner_radius,
              dealii::ExcMessage("Radii of a sphere: 0 <= inner < outer."));
  this->number = number;
  BreathingMode::finalize();
}

template <int dim>
void BreathingMode<dim>::finalize()
{
  const double cp = this->material.p_wave_speed(), cs = this->material.s_wave_speed();
  const double g     = 4. * (cs * cs) / (cp * cp); // 4 G/(lambda + 2 G)
  const double ratio = inner_radius / outer_radius;

  const auto T_j         = [g](const double z) { return j(0, z) - g * j(1, z) / z; };
  const auto T_y         = [g](const double z) { return y(0, z) - g * y(1, z) / z; };
  const auto determinant = [&](const double x) {
    return ratio == 0. ? T_j(x) : T_j(ratio * x) * T_y(x) - T_j(x) * T_y(ratio * x);
  };

  // Roots are about pi/(1 - ratio) apart; the first falls with cs/cp in a nearly incompressible hollow sphere.
  const double x = root(determinant, this->number, 0.05 * std::min(1., 2. * cs / cp));
  wave_number    = x / outer_radius;

  // The free inner surface fixes B/A; then scale to one at the outer surface.
  regular = 1., singular = 0.;
  if (ratio > 0.)
    {
      regular  = T_y(ratio * x);
      singular = -T_j(ratio * x);
    }
  const double scale = regular * j(1, x) + (singular == 0. ? 0. : singular * y(1, x));
  regular /= scale;
  singular /= scale;
}

template <int dim>
double BreathingMode<dim>::angular_frequency() const
{
  return wave_number * this->material.p_wave_speed();
}

template <int dim>
dealii::Tensor<1, dim> BreathingMode<dim>::mode(const dealii::Point<dim> &x) const
{
  const double z = wave_number * x.norm();
  return wave_number * (regular * j1_over_z(z) + (singular == 0. ? 0. : singular * y(1, z) / z)) *
         dealii::Tensor<1, dim>(x);
}

template <int dim>
dealii::SymmetricTensor<2, 3> BreathingMode<dim>::mode_stress(const dealii::Point<dim> &x) const
{
  const double lambda = this->material.lame_lambda(), G = this->material.shear_modulus;
  const double r      = x.norm();
  const double z      = wave_number * r;
  const double hoop   = wave_number * (regular * j1_over_z(z) + (singular == 0. ? 0. : singular * y(1, z) / z)); // u/r
  const double volume = wave_number * (regular * j(0, z) + (singular == 0. ? 0. : singular * y(0, z))); // div u
  const double radial = volume - 2. * hoop;                                                             // du/dr
  return spherical_stress<dim>(lambda * volume + 2. * G * radial, lambda * volume + 2. * G * hoop,
                               r > 0. ? x / r : dealii::Tensor<1, dim>());
}

TorsionMode::TorsionMode(const LinearElastic &material, const double radius, const unsigned int number)
  : FreeVibration<3>(material)
  , radius(radius)
{
  AssertThrow(radius > 0., dealii::ExcMessage("The radius of a ball is positive."));
  this->number = number;
  TorsionMode::finalize();
}

void TorsionMode::finalize()
{
  wave_number = root([](const double x) { return j(2, x); }, number, 0.1) / radius;
}

double TorsionMode::angular_frequency() const { return wave_number * material.s_wave_speed(); }

dealii::Tensor<1, 3> TorsionMode::mode(const dealii::Point<3> &x) const
{
  const double         twist = wave_number * j1_over_z(wave_number * x.norm()) / j(1, wave_number * radius);
  dealii::Tensor<1, 3> phi;
  phi[0] = -twist * x[1];
  phi[1] = twist * x[0];
  return phi;
}

dealii::SymmetricTensor<2, 3> TorsionMode::mode_stress(const dealii::Point<3> &x) const
{
  const double r = x.norm();
  if (r == 0.)
    return {};
  // d(j1(z)/z)/dz = -j2(z)/z: only the change of the twist strains
  const double         slope = -wave_number * j(2, wave_number * r) / r / j(1, wave_number * radius);
  dealii::Tensor<1, 3> rotation;
  rotation[0] = -x[1];
  rotation[1] = x[0];
  return 2. * material.shear_modulus * slope / r * symmetrize(outer_product(rotation, dealii::Tensor<1, 3>(x)));
}

template <int dim>
HarmonicMode<dim>::HarmonicMode(const LinearElastic &material, const double length, const unsigned int number)
  : FreeVibration<dim>(material)
  , length(length)
{
  this->number = number;
}

template <int dim>
double HarmonicMode<dim>::wave_number() const
{
  return this->number * PI / length;
}

template <int dim>
double LameMode<dim>::angular_frequency() const
{
  return std::sqrt(2.) * this->material.s_wave_speed() * this->wave_number();
}

template <int dim>
dealii::Tensor<1, dim> LameMode<dim>::mode(const dealii::Point<dim> &x) const
{
  const double           k = this->wave_number();
  dealii::Tensor<1, dim> phi;
  phi[0] = std::cos(k * x[0]) * std::sin(k * x[1]);
  phi[1] = -std::sin(k * x[0]) * std::cos(k * x[1]);
  return phi;
}

template <int dim>
dealii::SymmetricTensor<2, 3> LameMode<dim>::mode_stress(const dealii::Point<dim> &x) const
{
  const double                  k = this->wave_number();
  dealii::SymmetricTensor<2, 3> stress;
  stress[1][1] = 2. * this->material.shear_modulus * k * std::sin(k * x[0]) * std::sin(k * x[1]);
  stress[0][0] = -stress[1][1];
  return stress;
}

template <int dim>
double ShearMode<dim>::angular_frequency() const
{
  return this->material.s_wave_speed() * this->wave_number();
}

template <int dim>
dealii::Tensor<1, dim> ShearMode<dim>::mode(const dealii::Point<dim> &x) const
{
  dealii::Tensor<1, dim> phi;
  phi[0] = std::sin(this->wave_number() * x[1]);
  return phi;
}

template <int dim>
dealii::SymmetricTensor<2, 3> ShearMode<dim>::mode_stress(const dealii::Point<dim> &x) const
{
  dealii::SymmetricTensor<2, 3> stress;
  stress[0][1] = this->material.shear_modulus * this->wave_number() * std::cos(this->wave_number() * x[1]);
  return stress;
}

double rayleigh_speed(const LinearElastic &material)
{
  const double ratio    = std::pow(material.s_wave_speed() / material.p_wave_speed(), 2);
  const auto   function = [ratio](const double x) {
    return std::pow(2. - x, 2) - 4. * std::sqrt((1. - ratio * x) * (1. - x));
  };
  std::uintmax_t iterations = 100;
  // x = 0 is a root, too; the wave has x > 0.76 for every nu > 0 and 0.47 for nu = -1
  const auto bracket =
    boost::math::tools::toms748_solve(function, 0.4, 1., boost::math::tools::eps_tolerance<double>(52), iterations);
  return material.s_wave_speed() * std::sqrt(0.5 * (bracket.first + bracket.second));
}

template <int dim>
RayleighMode<dim>::RayleighMode(const LinearElastic &material, const double length, const unsigned int number)
  : HarmonicMode<dim>(material, length, number)
  , q(std::sqrt(1. - std::pow(rayleigh_speed(material) / material.p_wave_speed(), 2)))
  , s(std::sqrt(1. - std::pow(rayleigh_speed(material) / material.s_wave_speed(), 2)))
{}

template <int dim>
double RayleighMode<dim>::angular_frequency() const
{
  return rayleigh_speed(this->material) * this->wave_number();
}

template <int dim>
dealii::Tensor<1, dim> RayleighMode<dim>::mode(const dealii::Point<dim> &x) const
{
  const double           k = this->wave_number(), P = std::exp(k * q * x[dim - 1]), S = std::exp(k * s * x[dim - 1]);
  dealii::Tensor<1, dim> phi;
  phi[0]       = -(P - 2. * q * s / (1. + s * s) * S) * std::sin(k * x[0]);
  phi[dim - 1] = q * (P - 2. / (1. + s * s) * S) * std::cos(k * x[0]);
  return phi;
}

template <int dim>
dealii::SymmetricTensor<2, 3> RayleighMode<dim>::mode_stress(const dealii::Point<dim> &x) const
{
  constexpr int v = dim - 1;
  const double  k = this->wave_number(), P = std::exp(k * q * x[v]), S = std::exp(k * s * x[v]);
  const double  cosine = std::cos(k * x[0]), sine = std::sin(k * x[0]);

  dealii::Tensor<2, dim> gradient;
  gradient[0][0] = -k * (P - 2. * q * s / (1. + s * s) * S) * cosine;
  gradient[0][v] = -k * (q * P - 2. * q * s * s / (1. + s * s) * S) * sine;
  gradient[v][0] = -k * q * (P - 2. / (1. + s * s) * S) * sine;
  gradient[v][v] = k * q * (q * P - 2. * s / (1. + s * s) * S) * cosine;
  return this->material.stress(gradient);
}

template class FreeVibration<1>;
template class FreeVibration<2>;
template class FreeVibration<3>;
template class BreathingMode<1>;
template class BreathingMode<2>;
template class BreathingMode<3>;
template class HarmonicMode<2>;
template class HarmonicMode<3>;
template class LameMode<2>;
template class LameMode<3>;
template class ShearMode<2>;
template class ShearMode<3>;
template class RayleighMode<2>;
template class RayleighMode<3>;
} // namespace Arenite
