#pragma once

#include <arenite/loads/nodal_force.h>
#include <arenite/loads/node_faces.h>

namespace Arenite
{
/// Dashpots carry no static load: what held the absorbing boundaries when the equilibrium of the start was found goes on as a traction
/// that is constant in time, and the dashpots act on the motion that comes.
///
/// Per boundary and node t_i = R_i / A_i with the reaction R_i and the nodal area A_i, f_i = A_i t_i. On another mesh the traction is
/// interpolated, each boundary's on its own so that it may jump at edges, and shifted by a constant so that the force on the boundary stays.
template <int dim>
class SupportAtRest : public Load<dim>
{
public:
  SupportAtRest(const std::vector<dealii::types::boundary_id> &ids, const std::vector<std::string> &names)
    : ids(ids)
    , boundary_names(names)
    , force_on(ids.size())
  {
    this->name = "support at rest";
  }

  void        declare_parameters(Parameters &) override {}
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void        add(VectorType &force, const State<dim> &) override;
  double      power(const VectorType &half_velocity) const override;
  void        add_resultants(Resultants<dim> &) const override;
  void        exchange(StateArchive &) override;
  bool        admits(Reduction &, const Parameters &) const override { return true; } ///< the dashpots there decide
  std::string description() const override;
  std::vector<const VectorType *>                nodal_states() const override;
  void                                           set_nodal_states(const std::vector<VectorType> &) override;
  const std::vector<dealii::types::boundary_id> &boundaries() const { return ids; }

  /// Reactions of the nodes, zero where nothing was held. Boundaries share that of a node like springs side by side, whose stiffness
  /// along their normals is their area. @p along_normals: they were held in these directions only. Collective.
  void take_up(const VectorType &reactions, bool along_normals);

private:
  void find_forces();

  const std::vector<dealii::types::boundary_id> ids;
  const std::vector<std::string>                boundary_names;
  const Discretization<dim>                    *discretization = nullptr;
  std::vector<dealii::Tensor<1, dim>>           force_on; ///< each boundary, of all processes [N]
  bool                                          has_forces = false;
  std::vector<std::vector<NodeFaces<dim>>>      faces;    ///< of each boundary
  std::vector<VectorType>                       traction; ///< of each boundary and component, per node [Pa]
  std::vector<Resultant<dim>>                   whole;    ///< of this process, per boundary
  NodalForces<dim>                              forces;
};
} // namespace Arenite
