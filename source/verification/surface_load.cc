#include <arenite/verification/free_vibration.h>
#include <arenite/verification/gauss_rule.h>
#include <arenite/verification/surface_load.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace Arenite
{
namespace
{
using Complex = std::complex<double>;

constexpr double pi = dealii::numbers::PI;

/// Integral of f from @p low to @p high with square roots at both ends.
template <typename Function>
double integrate_roots(const double low, const double high, const Function &f)
{
  double                 sum    = 0.;
  constexpr unsigned int panels = 4;
  for (unsigned int panel = 0; panel < panels; ++panel)
    sum += gauss_integral(0.5 * pi * panel / panels, 0.5 * pi * (panel + 1) / panels, [&](const double theta) {
      const double sine = std::sin(theta);
      return (high - low) * 2. * sine * std::cos(theta) * f(low + (high - low) * sine * sine);
    });
  return sum;
}

/// (b^2 - 2 z^2)^2 + 4 z^2 eta_a eta_b
Complex rayleigh_function(const double z, const Complex &eta_a, const Complex &eta_b, const double b)
{
  const double first = b * b - 2. * z * z;
  return first * first + 4. * z * z * eta_a * eta_b;
}
} // namespace

SurfaceLoad::SurfaceLoad(const LinearElastic &material, const double disc_radius,
                         std::shared_ptr<const TimeHistory> pressure)
  : material(material)
  , radius(disc_radius)
  , a(1. / material.p_wave_speed())
  , b(1. / material.s_wave_speed())
  , pressure(std::move(pressure))
  , breaks(this->pressure->break_points())
{
  AssertThrow(breaks.size() >= 2, dealii::ExcMessage("The surface load needs a pulse with break points."));
  step = 1e-3 * (breaks.back() - breaks.front());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    step = std::min(step, 1e-3 * (breaks[i + 1] - breaks[i]));
  rayleigh_slowness = 1. / Arenite::rayleigh_speed(material);
}

double SurfaceLoad::pressure_rate(const double t) const
{
  const auto p = [&](const double shift) { return pressure->value(t + shift); };
  return (8. * (p(step) - p(-step)) - (p(2. * step) - p(-2. * step))) / (12. * step);
}

double SurfaceLoad::source(const unsigned int n, const double z, const double r, const double t) const
{
  // panels end where the retarded time t - r z cosh w is one of the break points; the pressure is at rest before the first
  const double arrival  = r * z;
  const auto   integral = [&](const double low, const double high) {
    return gauss_integral(low, high, [&](const double w) {
      const double c = std::cosh(w);
      return pressure_rate(t - arrival * c) * (n == 1 ? c : 1.);
    });
  };
  double sum = 0., high = std::acosh(std::max(1., (t - breaks.front()) / arrival));
  for (std::size_t i = 1; i < breaks.size(); ++i)
    {
      const double low = std::acosh(std::max(1., (t - breaks[i]) / arrival));
      if (high > low)
        sum += integral(low, high);
      high = low;
    }
  if (high > 0.) // after the last break point
    sum += integral(0., high);
  return sum;
}

SurfaceLoad::SurfaceVector SurfaceLoad::point_force(const double r, const double t) const
{
  const double end = t / r, c = rayleigh_slowness; // largest slowness that has arrived
  if (!(end > a))
    return {};
  const auto etas = [&](const double z) {
    return std::make_pair(std::sqrt(Complex(a * a - z * z)), std::sqrt(Complex(b * b - z * z)));
  };
  const auto down = [&](const double z) { // -Im[..] z
    const auto [eta_a, eta_b] = etas(z);
    return -(b * b * eta_a / rayleigh_function(z, eta_a, eta_b, b)).imag() * z;
  };
  const auto radial = [&](const double z) { // [..] z^2
    const auto [eta_a, eta_b] = etas(z);
    return (b * b - 2. * z * z - 2. * eta_a * eta_b) / rayleigh_function(z, eta_a, eta_b, b) * z * z;
  };
  // residue of both at c: from the two sides, extrapolated
  const auto residue = [&](const auto &f) {
    const auto odd = [&](const double h) { return 0.5 * h * (f(c + h) - f(c - h)); };
    return (4. * odd(1e-4 * c) - odd(2e-4 * c)) / 3.;
  };

  double u_down = integrate_roots(a, std::min(b, end), [&](const double z) { return down(z) * source(0, z, r, t); });
  double u_radial =
    integrate_roots(a, std::min(b, end), [&](const double z) { return -radial(z).imag() * source(1, z, r, t); });
  if (end > b)
    {
      const double at_pole      = residue(down) * source(0, c, r, t);
      const auto   without_pole = [&](const double z) { return down(z) * source(0, z, r, t) - at_pole / (z - c); };
      // [b, 2 c - b] is symmetric, so that errors of the residue cancel; beyond, the source changes where its break points arrive
      std::vector<double> ends = {b, std::min(end, 2. * c - b), end};
      for (const double time : breaks)
        if ((t - time) / r > ends[1] && (t - time) / r < end)
          ends.push_back((t - time) / r);
      std::sort(ends.begin(), ends.end());
      for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        u_down += integrate_roots(ends[i], ends[i + 1], without_pole);
      u_down += at_pole * std::log(std::abs((end - c) / (b - c)));
    }
  if (end > c)
    u_radial -= pi * residue([&](const double z) { return radial(z).real(); }) * source(1, c, r, t);
  const double factor = 1. / (pi * pi * material.shear_modulus);
  return {factor * u_radial, -factor * u_down};
}

SurfaceLoad::SurfaceVector SurfaceLoad::displacement(const double r, const double t) const
{
  // Gauss' rule along the radius of the disc, the mean over its angle; half of it by symmetry
  static const dealii::QGauss<1> rule(6);
  constexpr unsigned int         angles = 8;
  SurfaceVector                  u;
  for (unsigned int i = 0; i < rule.size(); ++i)
    for (unsigned int k = 0; k < angles; ++k)
      {
        const double s = rule.point(i)[0] * radius, theta = pi * (k + 0.5) / angles;
        const double area = rule.weight(i) * radius * s * 2. * pi / angles;
        const double dx = r - s * std::cos(theta), dy = s * std::sin(theta), distance = std::hypot(dx, dy);
        const auto   part = point_force(distance, t);
        u.upward += area * part.upward;
        u.radial += area * part.radial * dx / distance;
      }
  return u;
}
} // namespace Arenite
