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
template <typename Result, typename Function>
Result integrate_roots(const double low, const double high, const Function &f)
{
  Result                 sum{};
  constexpr unsigned int panels = 4;
  for (unsigned int panel = 0; panel < panels; ++panel)
    sum += gauss_integral<Result>(0.5 * pi * panel / panels, 0.5 * pi * (panel + 1) / panels, [&](const double theta) {
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
  rayleigh_slowness = 1. / Arenite::rayleigh_speed(material);
  // p' by differences of fourth order, once: the integrals ask for it 10^5 times at one place and time
  constexpr unsigned int n = 4000;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    {
      const double        spacing = (breaks[i + 1] - breaks[i]) / n;
      std::vector<double> values(n + 1);
      for (unsigned int k = 0; k <= n; ++k)
        values[k] = difference(breaks[i] + k * spacing, 4. * spacing);
      rates.emplace_back(values.begin(), values.end(), breaks[i], spacing);
    }
}

double SurfaceLoad::difference(const double t, const double step) const
{
  const auto p = [&](const double shift) { return pressure->value(t + shift); };
  return (8. * (p(step) - p(-step)) - (p(2. * step) - p(-2. * step))) / (12. * step);
}

SurfaceLoad::Pair SurfaceLoad::source(const double z, const double r, const double t) const
{
  // panels end where the retarded time t - r z cosh w is one of the break points; the pressure is at rest before the first
  const double arrival = r * z;
  Pair         sum;
  const auto   add = [&](const double low, const double high, const auto &rate) {
    if (high > low)
      sum += gauss_integral<Pair>(low, high, [&](const double w) {
        const double c = std::cosh(w), value = rate(t - arrival * c);
        return Pair({value, value * c});
      });
  };
  double high = std::acosh(std::max(1., (t - breaks.front()) / arrival));
  for (std::size_t i = 1; i < breaks.size(); ++i)
    {
      const double low = std::acosh(std::max(1., (t - breaks[i]) / arrival));
      add(low, high, [&](const double time) { return rates[i - 1](std::clamp(time, breaks[i - 1], breaks[i])); });
      high = low;
    }
  const double step = 1e-3 * (breaks.back() - breaks.front());
  add(0., high, [&](const double time) { return difference(time, step); });
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

  Pair u = integrate_roots<Pair>(a, std::min(b, end), [&](const double z) {
    const Pair g = source(z, r, t);
    return Pair({down(z) * g[0], -radial(z).imag() * g[1]});
  });
  if (end > b)
    {
      const double at_pole      = residue(down) * source(c, r, t)[0];
      const auto   without_pole = [&](const double z) { return down(z) * source(z, r, t)[0] - at_pole / (z - c); };
      // [b, 2 c - b] is symmetric, so that errors of the residue cancel; beyond, the source changes where its break points arrive
      std::vector<double> ends = {b, std::min(end, 2. * c - b), end};
      for (const double time : breaks)
        if ((t - time) / r > ends[1] && (t - time) / r < end)
          ends.push_back((t - time) / r);
      std::sort(ends.begin(), ends.end());
      for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        u[0] += integrate_roots<double>(ends[i], ends[i + 1], without_pole);
      u[0] += at_pole * std::log(std::abs((end - c) / (b - c)));
    }
  if (end > c)
    u[1] -= pi * residue([&](const double z) { return radial(z).real(); }) * source(c, r, t)[1];
  const double factor = 1. / (pi * pi * material.shear_modulus);
  return {factor * u[1], -factor * u[0]};
}

SurfaceLoad::SurfaceVector SurfaceLoad::displacement(const double r, const double t) const
{
  // arcs of the disc at the distance d = r - R cos theta, of half the angle phi: periodic in theta, so that midpoints do as Gauss' rule;
  // the more, the wider the disc is against the Rayleigh wave that the pulse makes
  const double       wave = (breaks.back() - breaks.front()) / rayleigh_slowness;
  const unsigned int arcs = 12 + std::lround(8. * radius / wave);
  SurfaceVector      u;
  for (unsigned int i = 0; i < arcs; ++i)
    {
      const double theta = pi * (i + 0.5) / arcs, d = r - radius * std::cos(theta);
      const double phi    = std::acos(std::clamp((d * d + r * r - radius * radius) / (2. * d * r), -1., 1.));
      const double length = 2. * d * radius * std::sin(theta) * pi / arcs;
      const auto   part   = point_force(d, t);
      u.upward += length * phi * part.upward;
      u.radial += length * std::sin(phi) * part.radial;
    }
  return u;
}
} // namespace Arenite
