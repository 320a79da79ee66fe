#include <arenite/verification/spherical_cavity.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace Arenite
{
namespace
{
/// Damped oscillator F'' + 2 alpha F' + w0^2 F = -(a/rho) p of the cavity.
HistoryResponse<2> oscillator(const LinearElastic &material, const double radius,
                              const std::shared_ptr<const TimeHistory> &pressure)
{
  AssertThrow(radius > 0. && material.density > 0. && material.bulk_modulus > 0. && material.shear_modulus > 0.,
              dealii::ExcMessage("The cavity needs a positive radius, density, bulk and shear modulus."));
  const double cp = material.p_wave_speed(), cs = material.s_wave_speed();
  const double alpha = 2. * cs * cs / (radius * cp);
  const double w0    = 2. * cs / radius;
  const double wd    = w0 * std::sqrt(1. - cs * cs / (cp * cp)); // cs < cp for K > 0: always underdamped

  const auto propagator = [=](const std::array<double, 2> &y, const double s) {
    const double damping = std::exp(-alpha * s);
    const double cosine  = damping * std::cos(wd * s);
    const double sine    = damping * std::sin(wd * s) / wd;
    return std::array<double, 2>{
      {(cosine + alpha * sine) * y[0] + sine * y[1], -w0 * w0 * sine * y[0] + (cosine - alpha * sine) * y[1]}};
  };
  // panels of one radian: the 24-point rule integrates the exponential to rounding
  return {pressure, propagator, {{0., -radius / material.density}}, {{w0, 1.}}, 1. / w0};
}
} // namespace

template <int dim>
SphericalCavity<dim>::SphericalCavity(const LinearElastic &material, const double radius,
                                      std::shared_ptr<const TimeHistory> pressure)
  : material(material)
  , radius(radius)
  , pressure(std::move(pressure))
  , response(oscillator(material, radius, this->pressure))
{}

template <int dim>
void SphericalCavity<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_vector<dim>("Centre", centre, "m", "Centre of the cavity.");
}

template <int dim>
typename SphericalCavity<dim>::Potential SphericalCavity<dim>::potential(const double tau) const
{
  if (tau < 0.)
    return {0., 0., 0.};
  const double cs    = material.s_wave_speed();
  const double alpha = 2. * cs * cs / (radius * material.p_wave_speed());
  const double w0    = 2. * cs / radius;
  const auto   F     = response(tau);
  return {F[0], F[1], -radius / material.density * pressure->value(tau) - 2. * alpha * F[1] - w0 * w0 * F[0]};
}

template <int dim>
typename SphericalCavity<dim>::RadialState SphericalCavity<dim>::radial_state(const double r, const double t) const
{
  Assert(r > 0., dealii::ExcMessage("The fields of the cavity are singular at its centre."));
  const double    cp     = material.p_wave_speed();
  const Potential F      = potential(t - (r - radius) / cp);
  const double    strain = F.value / (r * r * r) + F.first / (cp * r * r); // -u/r, the hoop strain
  return {-strain * r, -F.first / (r * r) - F.second / (cp * r),
          material.density * F.second / r + 4. * material.shear_modulus * strain,
          material.lame_lambda() * F.second / (cp * cp * r) - 2. * material.shear_modulus * strain};
}

template <int dim>
dealii::Tensor<1, dim> SphericalCavity<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  const dealii::Tensor<1, dim> from_centre = x - centre;
  const double                 r           = from_centre.norm();
  return radial_state(r, t).displacement / r * from_centre;
}

template <int dim>
dealii::Tensor<1, dim> SphericalCavity<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  const dealii::Tensor<1, dim> from_centre = x - centre;
  const double                 r           = from_centre.norm();
  return radial_state(r, t).velocity / r * from_centre;
}

template <int dim>
dealii::SymmetricTensor<2, 3> SphericalCavity<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  const dealii::Tensor<1, dim> from_centre = x - centre;
  const double                 r           = from_centre.norm();
  const RadialState            state       = radial_state(r, t);
  return spherical_stress<dim>(state.radial_stress, state.hoop_stress, from_centre / r);
}

template class SphericalCavity<1>;
template class SphericalCavity<2>;
template class SphericalCavity<3>;
} // namespace Arenite
