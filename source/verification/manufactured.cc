#include <arenite/verification/manufactured.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <string>

namespace Arenite
{
template <int dim>
ManufacturedPlane<dim>::ManufacturedPlane(const LinearElastic &material, const std::vector<Wave> &waves)
  : material(material)
  , waves(waves)
{}

template <int dim>
void ManufacturedPlane<dim>::declare_parameters(Parameters &parameters)
{
  for (std::size_t i = 0; i < waves.size(); ++i)
    {
      const auto section = parameters.section("Wave " + std::to_string(i + 1));
      parameters.add_vector<dim>("Amplitude", waves[i].amplitude, "m", "Displacement vector of the wave.");
      parameters.add_vector<dim>(
        "Wave vector", waves[i].wave_vector, "1/m",
        "Direction of travel times 2 pi over the wavelength; longer vectors need finer meshes.");
      parameters.add_quantity("Angular frequency", waves[i].angular_frequency, "1/s", any_value,
                              "Speed of the wave times the length of the wave vector; need not fit the material.");
      parameters.add_quantity("Phase", waves[i].phase, "1", any_value, "Phase at the origin and t = 0.");
    }
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedPlane<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  dealii::Tensor<1, dim> u;
  for (const Wave &wave : waves)
    u += std::sin(wave.wave_vector * x - wave.angular_frequency * t + wave.phase) * wave.amplitude;
  return u;
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedPlane<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  dealii::Tensor<1, dim> v;
  for (const Wave &wave : waves)
    v -= wave.angular_frequency * std::cos(wave.wave_vector * x - wave.angular_frequency * t + wave.phase) *
         wave.amplitude;
  return v;
}

template <int dim>
dealii::SymmetricTensor<2, 3> ManufacturedPlane<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  dealii::Tensor<2, dim> gradient;
  for (const Wave &wave : waves)
    gradient += std::cos(wave.wave_vector * x - wave.angular_frequency * t + wave.phase) *
                outer_product(wave.amplitude, wave.wave_vector);
  return material.stress(gradient);
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedPlane<dim>::body_force(const dealii::Point<dim> &x, const double t) const
{
  const double           G = material.shear_modulus, lambda = material.lame_lambda();
  dealii::Tensor<1, dim> f;
  for (const Wave &wave : waves)
    {
      const auto  &d = wave.amplitude, &k = wave.wave_vector;
      const double w = wave.angular_frequency;
      f += std::sin(k * x - w * t + wave.phase) *
           ((G * k.norm_square() - material.density * w * w) * d + (lambda + G) * (k * d) * k);
    }
  return f;
}

template <int dim>
ManufacturedCube<dim>::ManufacturedCube(const LinearElastic &material, const dealii::Tensor<1, dim> &amplitude,
                                        const dealii::Tensor<1, dim> &wave_numbers, const double angular_frequency,
                                        const double phase)
  : material(material)
  , amplitude(amplitude)
  , wave_numbers(wave_numbers)
  , angular_frequency(angular_frequency)
  , phase(phase)
{}

template <int dim>
void ManufacturedCube<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_vector<dim>("Amplitude", amplitude, "m", "Displacement vector of the standing wave.");
  parameters.add_vector<dim>("Wave numbers", wave_numbers, "1/m",
                             "k_i of sin(k_i x_i); multiples of pi over the side vanish on the faces of the cube.");
  parameters.add_quantity("Angular frequency", angular_frequency, "1/s", any_value, "Of the oscillation in time.");
  parameters.add_quantity("Phase", phase, "1", any_value, "Phase at t = 0; zero starts from rest position.");
}

template <int dim>
double ManufacturedCube<dim>::product(const dealii::Point<dim> &x) const
{
  double result = 1.;
  for (unsigned int i = 0; i < dim; ++i)
    result *= std::sin(wave_numbers[i] * x[i]);
  return result;
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedCube<dim>::product_gradient(const dealii::Point<dim> &x) const
{
  dealii::Tensor<1, dim> gradient;
  for (unsigned int i = 0; i < dim; ++i)
    {
      gradient[i] = 1.;
      for (unsigned int m = 0; m < dim; ++m)
        gradient[i] *= m == i ? wave_numbers[m] * std::cos(wave_numbers[m] * x[m]) : std::sin(wave_numbers[m] * x[m]);
    }
  return gradient;
}

template <int dim>
dealii::Tensor<2, dim> ManufacturedCube<dim>::product_hessian(const dealii::Point<dim> &x) const
{
  dealii::Tensor<2, dim> hessian;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        if (i == j)
          {
            hessian[i][i] = -wave_numbers[i] * wave_numbers[i] * product(x);
            continue;
          }
        hessian[i][j] = 1.;
        for (unsigned int m = 0; m < dim; ++m)
          hessian[i][j] *=
            m == i || m == j ? wave_numbers[m] * std::cos(wave_numbers[m] * x[m]) : std::sin(wave_numbers[m] * x[m]);
      }
  return hessian;
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedCube<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  return std::sin(angular_frequency * t + phase) * product(x) * amplitude;
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedCube<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  return angular_frequency * std::cos(angular_frequency * t + phase) * product(x) * amplitude;
}

template <int dim>
dealii::SymmetricTensor<2, 3> ManufacturedCube<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  return material.stress(std::sin(angular_frequency * t + phase) * outer_product(amplitude, product_gradient(x)));
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedCube<dim>::body_force(const dealii::Point<dim> &x, const double t) const
{
  const double G = material.shear_modulus, lambda = material.lame_lambda(), w = angular_frequency;
  const double inertia_and_shear = G * wave_numbers.norm_square() - material.density * w * w;
  return std::sin(w * t + phase) *
         (inertia_and_shear * product(x) * amplitude - (lambda + G) * (product_hessian(x) * amplitude));
}

template <int dim>
ManufacturedShell<dim>::ManufacturedShell(const LinearElastic &material, const double inner_radius,
                                          const Motion &motion)
  : material(material)
  , inner_radius(inner_radius)
  , motion(motion)
{}

template <int dim>
void ManufacturedShell<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_quantity("Breathing", motion.breathing, "m", any_value, "Amplitude U of the radial motion.");
  parameters.add_quantity("Twist", motion.twist, "1", any_value, "Amplitude V of the rotation about the z axis.");
  parameters.add_quantity("Breathing number", motion.breathing_number, "1/m", any_value,
                          "Wave number kr of the radial motion; larger values need finer meshes.");
  parameters.add_quantity("Twist number", motion.twist_number, "1/m", any_value,
                          "Wave number kc of the rotation; larger values need finer meshes.");
  parameters.add_quantity("Breathing frequency", motion.breathing_frequency, "1/s", any_value,
                          "Angular frequency of the radial motion.");
  parameters.add_quantity("Twist frequency", motion.twist_frequency, "1/s", any_value,
                          "Angular frequency of the rotation.");
}

namespace
{
/// e_z x x; in fewer dimensions none
template <int dim>
dealii::Tensor<1, dim> rotation_about_z(const dealii::Point<dim> &x)
{
  dealii::Tensor<1, dim> result;
  if constexpr (dim == 3)
    {
      result[0] = -x[1];
      result[1] = x[0];
    }
  else
    (void)x;
  return result;
}
} // namespace

template <int dim>
dealii::Tensor<1, dim> ManufacturedShell<dim>::displacement(const dealii::Point<dim> &x, const double t) const
{
  const double r = x.norm();
  const double B = std::sin(motion.breathing_number * (r - inner_radius)) + 0.5;
  const double C = std::cos(motion.twist_number * r);
  return motion.breathing * B * std::sin(motion.breathing_frequency * t) / r * x +
         motion.twist * C * std::sin(motion.twist_frequency * t) * rotation_about_z(x);
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedShell<dim>::velocity(const dealii::Point<dim> &x, const double t) const
{
  const double r  = x.norm();
  const double B  = std::sin(motion.breathing_number * (r - inner_radius)) + 0.5;
  const double C  = std::cos(motion.twist_number * r);
  const double w1 = motion.breathing_frequency, w2 = motion.twist_frequency;
  return motion.breathing * B * w1 * std::cos(w1 * t) / r * x +
         motion.twist * C * w2 * std::cos(w2 * t) * rotation_about_z(x);
}

template <int dim>
dealii::SymmetricTensor<2, 3> ManufacturedShell<dim>::stress(const dealii::Point<dim> &x, const double t) const
{
  const double G = material.shear_modulus, lambda = material.lame_lambda();
  const double r  = x.norm();
  const double kr = motion.breathing_number, kc = motion.twist_number;

  const double U      = motion.breathing * std::sin(motion.breathing_frequency * t);
  const double radial = U * kr * std::cos(kr * (r - inner_radius));
  const double hoop   = U * (std::sin(kr * (r - inner_radius)) + 0.5) / r;
  auto         stress = spherical_stress<dim>((lambda + 2. * G) * radial + 2. * lambda * hoop,
                                      lambda * radial + 2. * (lambda + G) * hoop, x / r);
  if constexpr (dim == 3)
    {
      // C(r) times a rotation: only the gradient of C strains
      const double slope = -motion.twist * std::sin(motion.twist_frequency * t) * kc * std::sin(kc * r);
      stress += 2. * G * slope / r * symmetrize(outer_product(rotation_about_z(x), dealii::Tensor<1, 3>(x)));
    }
  return stress;
}

template <int dim>
dealii::Tensor<1, dim> ManufacturedShell<dim>::body_force(const dealii::Point<dim> &x, const double t) const
{
  const double G = material.shear_modulus, M = material.lame_lambda() + 2. * G, rho = material.density;
  const double r  = x.norm();
  const double kr = motion.breathing_number, kc = motion.twist_number;
  const double w1 = motion.breathing_frequency, w2 = motion.twist_frequency;

  const double sine = std::sin(kr * (r - inner_radius));
  const double B = sine + 0.5, B1 = kr * std::cos(kr * (r - inner_radius)), B2 = -kr * kr * sine;
  const double C = std::cos(kc * r), C1 = -kc * std::sin(kc * r), C2 = -kc * kc * C;

  return motion.breathing * std::sin(w1 * t) * (-rho * w1 * w1 * B - M * (B2 + 2. * B1 / r - 2. * B / (r * r))) / r *
           x +
         motion.twist * std::sin(w2 * t) * (-rho * w2 * w2 * C - G * (C2 + 4. * C1 / r)) * rotation_about_z(x);
}

template class ManufacturedPlane<1>;
template class ManufacturedPlane<2>;
template class ManufacturedPlane<3>;
template class ManufacturedCube<1>;
template class ManufacturedCube<2>;
template class ManufacturedCube<3>;
template class ManufacturedShell<1>;
template class ManufacturedShell<2>;
template class ManufacturedShell<3>;
} // namespace Arenite
