#include <arenite/base/state_archive.h>
#include <arenite/loads/gas_pressure.h>

#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
void GasPressure<dim>::declare_parameters(Parameters &parameters)
{
  UniformPressure<dim>::declare_parameters(parameters);
  const std::vector<std::string> kinds = {"ideal gas", "detonation products"};
  kind                                 = parameters.peek_choice(this->path + "/Gas", kind, kinds);
  parameters.add_choice(
    "Gas", kind, kinds,
    "Ideal gas without exchange of heat, p V^gamma constant, or detonation products on their isentrope (Jones, "
    "Wilkins and Lee); their entries follow.");
  is_explosive = kind == "detonation products";
  if (is_explosive)
    {
      parameters.add_quantity("Charge density", products.charge_density, "kg/m^3", positive, "rho_0 of the explosive.");
      parameters.add_quantity(
        "Charge mass", charge_mass, "kg", non_negative,
        "Of the full body; what the charge does not fill is empty at first. 0: the charge fills the cavity.");
      parameters.add_quantity("A", products.A, "Pa", non_negative,
                              "Of p = A exp(-R1 v) + B exp(-R2 v) + C v^-(1 + omega).");
      parameters.add_quantity("B", products.B, "Pa", any_value, "Of the same.");
      parameters.add_quantity("R1", products.R1, "-", positive, "Of the same, above R2.");
      parameters.add_quantity("R2", products.R2, "-", positive, "Of the same.");
      parameters.add_quantity("Omega", products.omega, "-", positive,
                              "Of the same: ratio of specific heats at large volume, less 1.");
      parameters.add_quantity("Energy", products.specific_energy, "J/m^3", positive, "E_0 of the charge per volume.");
      parameters.add_quantity(
        "Detonation speed", products.detonation_speed, "m/s", non_negative,
        "D. With the detonation pressure the constants are checked against each other; 0: they are not.");
      parameters.add_quantity("Detonation pressure", products.detonation_pressure, "Pa", non_negative,
                              "p_CJ, for the same.");
      for (const char *entry : {"Charge density", "A", "B", "R1", "R2", "Omega", "Energy"})
        parameters.require(entry);
    }
  else
    {
      parameters.add_quantity("Initial pressure", gas.initial_pressure, "Pa", positive,
                              "Absolute, at the volume of the start.");
      parameters.require("Initial pressure");
      parameters.add_quantity("Ratio of specific heats", gas.gamma, "-", {1., 10., true, false},
                              "gamma. Air 1.4, detonation products at low density 1.2 to 1.3.");
    }
  parameters.add_quantity("Outside pressure", outside, "Pa", any_value,
                          "Absolute pressure at which the body is without stress, taken off the gas's.");
  parameters.add_vector("Centre", centre, "m",
                        "A point of all symmetry planes that cut the gas. For a closed wall any point will do.");
}

template <int dim>
void GasPressure<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  UniformPressure<dim>::finalize(parameters, geometry);
  symmetry_factor = geometry.symmetry_factor();
}

template <int dim>
void GasPressure<dim>::reinit(const Discretization<dim> &new_discretization, const NodalMass &mass,
                              const MaterialOfBlock &material)
{
  discretization = &new_discretization;
  UniformPressure<dim>::reinit(new_discretization, mass, material);
}

template <int dim>
double GasPressure<dim>::volume_of(const State<dim> &state) const
{
  const double n       = n_hoop_directions(discretization->symmetry) + dim;
  double       at_rest = 0., swept = 0.;
  for (const auto &[node, dA] : this->area)
    for (unsigned int c = 0; c < dim; ++c)
      {
        at_rest += (discretization->positions.local_element(dim * node + c) - centre[c]) * dA[c];
        swept += state.displacement.local_element(dim * node + c) * dA[c];
      }
  // the areas follow the surface, or the volume is linear in the displacement
  return -Utilities::MPI::sum(at_rest / n + swept / (this->follows_surface ? n : 1.), discretization->communicator);
}

/// Fix the state of the gas at the start.
template <int dim>
void GasPressure<dim>::fill(const double at_start)
{
  initial_volume         = at_start;
  gas.initial_volume     = at_start;
  products.charge_volume = charge_mass > 0. ? charge_mass / products.charge_density / symmetry_factor : at_start;
  std::ostringstream problem;
  if (!(at_start > 0.))
    problem << "the wall encloses a volume of " << at_start
            << " m^3. 'Boundary' must be the wall of a cavity, and 'Centre' lie on the planes that cut it.";
  else if (is_explosive && products.charge_volume > at_start * (1. + 1e-6))
    problem << "the charge of " << charge_mass << " kg does not fit into the cavity of " << at_start * symmetry_factor
            << " m^3.";
  else
    problem << (is_explosive ? products.complaint() : gas.complaint());
  if (!problem.str().empty())
    throw InputError("[Loads / " + this->name + "]: " + problem.str());
}

template <int dim>
void GasPressure<dim>::add(VectorType &force, const State<dim> &state)
{
  this->find_areas(state);
  volume = volume_of(state);
  if (initial_volume == 0.)
    fill(volume);
  this->push(force, gas_pressure() - outside);
}

template <int dim>
void GasPressure<dim>::exchange(StateArchive &archive)
{
  double at_start = initial_volume;
  archive.common(at_start);
  if (archive.loads())
    fill(at_start);
}

template <int dim>
std::vector<LoadValue> GasPressure<dim>::values() const
{
  return {{"gas pressure", "Pa", gas_pressure(), false},
          {"gas volume", "m^3", volume, true},
          {"gas energy", "J", gas_energy(), true}};
}

template <int dim>
bool GasPressure<dim>::admits(Reduction &form, const Parameters &parameters) const
{
  form.shorten(parameters, this->path + "/Centre", centre);
  return UniformPressure<dim>::admits(form, parameters);
}

template <int dim>
std::string GasPressure<dim>::description() const
{
  std::ostringstream text;
  if (is_explosive)
    text << "detonation products of "
         << (charge_mass > 0. ? std::to_string(charge_mass) + " kg" : "a charge that fills the cavity");
  else
    text << "ideal gas of " << gas.initial_pressure << " Pa at the start";
  text << ' ' << UniformPressure<dim>::description();
  if (is_explosive && products.detonation_speed > 0. && products.detonation_pressure > 0. &&
      !products.warning().empty())
    text << "\nWarning    " << products.warning();
  return text.str();
}

template class GasPressure<1>;
template class GasPressure<2>;
template class GasPressure<3>;
} // namespace Arenite
