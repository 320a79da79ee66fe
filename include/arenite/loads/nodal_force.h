#pragma once

#include <arenite/loads/deformed_faces.h>
#include <arenite/loads/load.h>

namespace Arenite
{
template <int dim>
using NodalForces = std::vector<NodeValue<dealii::Tensor<1, dim>>>;

/// Nodal vector -> list of its nonzero owned entries, after hanging nodes gave to their masters and ghosts to their owners.
template <int dim>
NodalForces<dim> assemble(const Discretization<dim> &, VectorType &);

template <int dim>
void add_forces(const NodalForces<dim> &list, const double factor, VectorType &force)
{
  for (const auto &[node, value] : list)
    for (unsigned int c = 0; c < dim; ++c)
      force.local_element(dim * node + c) += factor * value[c];
}

/// factor * sum of f . v
template <int dim>
double power_of(const NodalForces<dim> &list, const double factor, const VectorType &velocity)
{
  double sum = 0.;
  for (const auto &[node, value] : list)
    for (unsigned int c = 0; c < dim; ++c)
      sum += value[c] * velocity.local_element(dim * node + c);
  return factor * sum;
}

/// Sum of the forces.
template <int dim>
Resultant<dim> resultant_of(const NodalForces<dim> &list, const double factor)
{
  Resultant<dim> sum;
  for (const auto &[node, value] : list)
    sum.force += value;
  return factor * sum;
}

/// One pressure on named boundaries: f_i = -p integral of N_i n dA, on the undeformed surface or, with finite strain, on the deformed
/// one of each time. What p is a subclass says in add():
///
///   find_areas(state);
///   push(force, pressure);
template <int dim>
class UniformPressure : public Load<dim>
{
public:
  void        declare_parameters(Parameters &) override;
  void        finalize(const Parameters &, const Geometry<dim> &) override;
  void        use_finite_strain() override { follows_surface = true; }
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  double      power(const VectorType &half_velocity) const override { return power_of(area, factor, half_velocity); }
  void        add_resultants(Resultants<dim> &) const override;
  bool        admits(Reduction &form, const Parameters &) const override { return form.keeps(ids); }
  std::string description() const override;
  std::vector<dealii::types::boundary_id> loaded_boundaries() const override { return ids; }
  const std::vector<std::string>         &boundaries() const { return boundary_names; }

protected:
  void find_areas(const State<dim> &);
  void push(VectorType &force, const double pressure)
  {
    factor = -pressure;
    add_forces(area, factor, force);
  }

  std::string      path;
  bool             follows_surface = false;
  NodalForces<dim> area; ///< integral of N_i n dA [m^2], n out of the body

private:
  std::vector<std::string>                boundary_names;
  std::vector<dealii::types::boundary_id> ids;
  DeformedFaces<dim>                      faces;       ///< if it follows the surface
  double                                  factor = 0.; ///< -p(t_n)
  std::vector<Resultant<dim>>             whole;       ///< of the pressure -1 on each of the boundaries
};

/// Pressure p(t), a history.
template <int dim>
class Pressure : public UniformPressure<dim>
{
public:
  void                 declare_parameters(Parameters &) override;
  void                 finalize(const Parameters &, const Geometry<dim> &) override;
  void                 add(VectorType &force, const State<dim> &) override;
  std::string          description() const override;
  const HistoryChoice &pressure_history() const { return history; }

private:
  HistoryChoice history;
};

/// Acceleration g of the whole body: f_i = m_i g.
template <int dim>
class Gravity : public Load<dim>
{
public:
  void        declare_parameters(Parameters &) override;
  void        finalize(const Parameters &, const Geometry<dim> &) override;
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void        add(VectorType &force, const State<dim> &) override;
  double      power(const VectorType &half_velocity) const override { return power_of(weight, factor, half_velocity); }
  void        add_resultants(Resultants<dim> &sums) const override { sums[inside] += factor * whole; }
  bool        admits(Reduction &, const Parameters &) const override;
  std::string description() const override;

  /// At t = 0 [m/s^2].
  dealii::Tensor<1, dim> at_rest() const { return history.value(0.) * acceleration; }

private:
  std::string            path;
  dealii::Tensor<1, dim> acceleration;
  HistoryChoice          history;
  NodalForces<dim>       weight;
  Resultant<dim>         whole;
  double                 factor = 0.;
};
} // namespace Arenite
