#include <arenite/verification/plane_wave.h>

#include <limits>
#include <utility>

namespace Arenite
{
template <int dim>
PlaneWave<dim>::PlaneWave(const LinearElastic &material, std::shared_ptr<const TimeHistory> pressure)
  : material(material)
  , pressure(std::move(pressure))
  , response(
      this->pressure, [](const std::array<double, 1> &y, double) { return y; },
      {{1. / (material.density * material.p_wave_speed())}}, {{1.}}, std::numeric_limits<double>::infinity())
{
  direction[0] = 1.;
}

template <int dim>
void PlaneWave<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_vector<dim>("Origin", origin, "m", "A point of the loaded surface.");
  parameters.add_vector<dim>("Direction", direction, "1", "Direction into the solid; any length but zero.");
}

template <int dim>
void PlaneWave<dim>::finalize()
{
  const double length = direction.norm();
  if (length == 0.)
    throw InputError("plane wave: Direction is the zero vector; give the direction into the solid, e.g. 1, 0, 0.");
  direction /= length;
}

template <int dim>
double PlaneWave<dim>::arrival_age(const dealii::Point<dim> &x, const double t) const
{
  return t - (x - origin) * direction / material.p_wave_speed();
}

template <int dim>
dealii::Tensor<1, dim> PlaneWave<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  return response(arrival_age(x, t))[0] * direction;
}

template <int dim>
dealii::Tensor<1, dim> PlaneWave<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  return pressure->value(arrival_age(x, t)) / (material.density * material.p_wave_speed()) * direction;
}

template <int dim>
dealii::SymmetricTensor<2, 3> PlaneWave<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  // du/dx = -v/cp along the direction
  const double cp     = material.p_wave_speed();
  const double strain = -pressure->value(arrival_age(x, t)) / (material.density * cp * cp);
  return material.stress(strain * outer_product(direction, direction));
}

template class PlaneWave<1>;
template class PlaneWave<2>;
template class PlaneWave<3>;
} // namespace Arenite
