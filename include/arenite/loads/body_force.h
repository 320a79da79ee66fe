#pragma once

#include <arenite/loads/load.h>
#include <arenite/verification/exact_solution.h>

namespace Arenite
{
/// Body force of a manufactured solution: f_i = V_i b(x_i, t) with the nodal volumes V_i of the mass matrix; verification only.
template <int dim>
class BodyForce : public Load<dim>
{
public:
  explicit BodyForce(std::shared_ptr<const ExactSolution<dim>> solution)
    : solution(std::move(solution))
  {
    this->name = "body force";
  }

  void   declare_parameters(Parameters &) override {}
  void   reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void   add(VectorType &force, const State<dim> &) override;
  double power(const VectorType &half_velocity) const override;
  void   add_resultants(Resultants<dim> &) const override;
  bool   admits(Reduction &form, const Parameters &) const override
  {
    return n_hoop_directions(form.form) > 0 && solution->is_radial();
  }
  std::string description() const override { return "body force of the manufactured solution"; }

private:
  std::shared_ptr<const ExactSolution<dim>> solution;
  const Discretization<dim>                *discretization = nullptr;
  VectorType                                volume, current; ///< volume per node before hanging nodes are condensed
};
} // namespace Arenite
