#include <arenite/materials/cavity_gas.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
double AdiabaticGas::pressure(const double volume) const
{
  return initial_pressure * std::pow(initial_volume / volume, gamma);
}

double AdiabaticGas::energy(const double volume) const { return pressure(volume) * volume / (gamma - 1.); }

std::string AdiabaticGas::complaint() const
{
  std::ostringstream reason;
  if (!(gamma > 1.))
    reason << "the ratio of specific heats is " << gamma << "; it must exceed 1.";
  else if (!(initial_pressure > 0. && initial_volume > 0.))
    reason << "the gas needs a positive initial pressure and volume, not " << initial_pressure << " Pa and "
           << initial_volume << " m^3.";
  return reason.str();
}

double DetonationProducts::pressure_of_energy(const double v, const double E) const
{
  return A * (1. - omega / (R1 * v)) * std::exp(-R1 * v) + B * (1. - omega / (R2 * v)) * std::exp(-R2 * v) +
         omega * E / v;
}

double DetonationProducts::isentrope_constant(const double v, const double E) const
{
  return omega * std::pow(v, omega) * (E - A / R1 * std::exp(-R1 * v) - B / R2 * std::exp(-R2 * v));
}

double DetonationProducts::isentrope_pressure(const double v, const double C) const
{
  return A * std::exp(-R1 * v) + B * std::exp(-R2 * v) + C * std::pow(v, -1. - omega);
}

double DetonationProducts::isentrope_slope(const double v, const double C) const
{
  return A * R1 * std::exp(-R1 * v) + B * R2 * std::exp(-R2 * v) + C * (1. + omega) * std::pow(v, -2. - omega);
}

double DetonationProducts::isentrope_energy(const double v, const double C) const
{
  return A / R1 * std::exp(-R1 * v) + B / R2 * std::exp(-R2 * v) + C / omega * std::pow(v, -omega);
}

double DetonationProducts::pressure(const double volume) const
{
  return isentrope_pressure(volume / charge_volume, fill_constant());
}

double DetonationProducts::energy(const double volume) const
{
  return charge_volume * isentrope_energy(volume / charge_volume, fill_constant());
}

double DetonationProducts::detonation_volume() const
{
  return 1. - detonation_pressure / (charge_density * detonation_speed * detonation_speed);
}

double DetonationProducts::detonation_energy() const
{
  return specific_energy + .5 * detonation_pressure * (1. - detonation_volume());
}

double DetonationProducts::inconsistency() const
{
  const double v = detonation_volume(), E = detonation_energy(),
               stiffness = charge_density * detonation_speed * detonation_speed;
  if (!(v > 0.))
    return 1.;
  return std::max(std::abs(pressure_of_energy(v, E) / detonation_pressure - 1.),
                  std::abs(isentrope_slope(v, isentrope_constant(v, E)) / stiffness - 1.));
}

std::string DetonationProducts::warning() const
{
  if (inconsistency() <= .02)
    return "";
  const double       v = detonation_volume(), E = detonation_energy();
  std::ostringstream text;
  text << "the constants of the detonation products do not fit their detonation: at v_CJ = " << v
       << " they give p = " << pressure_of_energy(v, E) << " Pa instead of p_CJ = " << detonation_pressure
       << " Pa, and the isentrope falls with " << isentrope_slope(v, isentrope_constant(v, E))
       << " Pa instead of rho_0 D^2 = " << charge_density * detonation_speed * detonation_speed
       << " Pa. Are A, B, R1, R2, omega and E_0 of one set, and in Pa?";
  return text.str();
}

std::string DetonationProducts::complaint(const double largest_relative_volume) const
{
  std::ostringstream reason;
  if (!(R2 > 0. && R1 > R2))
    reason << "needs 0 < R2 < R1; they are R2 = " << R2 << " and R1 = " << R1 << ".";
  else if (!(omega > 0.))
    reason << "omega is " << omega << "; it must be positive: it is the expansion of the products to a gas.";
  else if (!(charge_density > 0. && specific_energy > 0. && charge_volume > 0.))
    reason << "the density of the charge, " << charge_density << " kg/m^3, its energy, " << specific_energy
           << " J/m^3, and its volume, " << charge_volume << " m^3, must be positive.";
  else
    for (double v = 1., C = fill_constant(); v <= largest_relative_volume; v *= 1.01)
      if (!(isentrope_pressure(v, C) > 0. && isentrope_slope(v, C) > 0.))
        {
          reason << "the isentrope is not that of a gas at v = " << v << ": p = " << isentrope_pressure(v, C)
                 << " Pa with -dp/dv = " << isentrope_slope(v, C)
                 << " Pa; both must be positive. Is E_0 = " << specific_energy << " J/m^3 too small for A and B?";
          break;
        }
  return reason.str();
}
} // namespace Arenite
