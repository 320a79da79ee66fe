#pragma once

#include <arenite/loads/nodal_force.h>
#include <arenite/materials/cavity_gas.h>

namespace Arenite
{
/// Gas in a cavity whose wall are named boundaries of the body. Its pressure follows the volume V that the wall leaves it,
///
///   p = p_gas(V) - p_outside,     V = -1/n integral of (x - c) . n dA,
///
/// with the surface integral over the wall of all processes; n points out of the body, n = 3, in plane strain 2, for plane waves 1. The
/// other sides of the gas, if there are any, are planes through the centre c, which (x - c) . n = 0 leaves out: the symmetry planes of a
/// sector. At small strain V = V_0 - integral of u . n dA on the undeformed wall. Both are made of the nodal areas that the forces are made of: what the
/// gas loses the body gains, but for the error of the steps in time and, on deformed faces of a higher degree than 1, of the rule.
template <int dim>
class GasPressure : public UniformPressure<dim>
{
public:
  void                   declare_parameters(Parameters &) override;
  void                   finalize(const Parameters &, const Geometry<dim> &) override;
  void                   reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void                   add(VectorType &force, const State<dim> &) override;
  void                   exchange(StateArchive &) override;
  std::vector<LoadValue> values() const override;
  bool                   admits(Reduction &, const Parameters &) const override;
  std::string            description() const override;

private:
  double volume_of(const State<dim> &) const;
  void   fill(double volume);
  double gas_pressure() const { return is_explosive ? products.pressure(volume) : gas.pressure(volume); }
  double gas_energy() const { return is_explosive ? products.energy(volume) : gas.energy(volume); }

  std::string                kind         = "ideal gas";
  bool                       is_explosive = false;
  AdiabaticGas               gas;
  DetonationProducts         products;
  double                     charge_mass = 0., outside = 0., symmetry_factor = 1.;
  dealii::Tensor<1, dim>     centre;
  const Discretization<dim> *discretization = nullptr;
  double                     volume = 0., initial_volume = 0.; ///< of the modelled sector [m^3]; at the start
};
} // namespace Arenite
