#include <arenite/verification/buried_cavity.h>
#include <arenite/verification/gauss_rule.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace Arenite
{
BuriedCavity::BuriedCavity(const LinearElastic &material, const double radius, const double depth,
                           std::shared_ptr<const TimeHistory> pressure)
  : material(material)
  , radius(radius)
  , depth(depth)
  , panel(0.5 * radius / material.p_wave_speed())
  , cavity(material, radius, std::move(pressure))
{
  AssertThrow(depth > radius, dealii::ExcMessage("The cavity must lie below the surface."));
}

double BuriedCavity::valid_until(const double r) const
{
  return (2. * (depth - radius) + std::hypot(r, depth) - radius) / material.p_wave_speed();
}

BuriedCavity::SurfaceVector BuriedCavity::response(const double r, const double s) const
{
  using Complex   = std::complex<double>;
  const double a2 = std::pow(material.p_wave_speed(), -2), b2 = std::pow(material.s_wave_speed(), -2); // slowness^2
  const double R2 = r * r + depth * depth, q_m2 = s * s / R2 - a2;
  if (!(q_m2 > 0.))
    return {};
  const double q_m = std::sqrt(q_m2), R = std::sqrt(R2);
  double       radial = 0., upward = 0.;
  for (unsigned int k = 0; k < gauss_rule().size(); ++k)
    {
      const double theta = 0.5 * dealii::numbers::PI * gauss_rule().point(k)[0], q = q_m * std::sin(theta);
      // s^2 - R^2 (a2 + q^2) = (R q_m cos theta)^2
      const double  root  = R * q_m * std::cos(theta);
      const Complex zeta  = Complex(s * r, depth * root) / R2;
      const Complex dzeta = Complex(r, depth * s / root) / R2; // d zeta/d s
      const Complex p2    = q * q - zeta * zeta;
      const Complex eta_a = std::sqrt(p2 + a2), eta_b = std::sqrt(p2 + b2);
      const Complex Om       = 2. * p2 + b2;
      const Complex per_Ray  = b2 / (Om * Om - 4. * p2 * eta_a * eta_b) * dzeta;
      const double  measured = gauss_rule().weight(k) * 0.5 * dealii::numbers::PI * q_m * std::cos(theta);
      upward -= measured * (2. * Om * per_Ray).imag();
      radial += measured * (-4. * zeta * eta_b * per_Ray).imag();
    }
  return {2. / dealii::numbers::PI * radial, 2. / dealii::numbers::PI * upward};
}

const BuriedCavity::Samples &BuriedCavity::sampled(const double r, const double start, const double end) const
{
  const auto &rule = gauss_rule();
  Samples    &own  = samples[r];
  for (std::size_t k = own.times.size() / rule.size(); start + (k + 1) * panel <= end; ++k)
    for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double        s = start + (k + rule.point(i)[0]) * panel;
        const SurfaceVector I = response(r, s);
        own.times.push_back(s);
        own.response.push_back({I.radial * rule.weight(i) * panel, I.upward * rule.weight(i) * panel});
      }
  return own;
}

BuriedCavity::SurfaceVector BuriedCavity::displacement(const double r, const double t) const
{
  const double start = std::hypot(r, depth) / material.p_wave_speed(), end = t + radius / material.p_wave_speed();
  if (!(end > start))
    return {};
  const auto   &rule     = gauss_rule();
  const auto    complete = static_cast<std::size_t>((end - start) / panel);
  SurfaceVector u;
  const auto    add = [&](const double s, const SurfaceVector &weighted) {
    const double source = cavity.potential(end - s).second;
    u.radial += source * weighted.radial;
    u.upward += source * weighted.upward;
  };
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const Samples                    &own = sampled(r, start, end);
    for (std::size_t i = 0; i < std::min(complete * rule.size(), own.times.size()); ++i)
      add(own.times[i], own.response[i]);
  }
  const double last = start + complete * panel, rest = end - last;
  for (unsigned int i = 0; i < rule.size(); ++i)
    {
      const double        s = last + rule.point(i)[0] * rest, w = rule.weight(i) * rest;
      const SurfaceVector I = response(r, s);
      add(s, {I.radial * w, I.upward * w});
    }
  return u;
}
} // namespace Arenite
