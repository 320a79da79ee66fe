#pragma once

#include <arenite/base/registry.h>
#include <arenite/base/time_history.h>
#include <arenite/loads/boundary_faces.h>
#include <arenite/loads/resultant.h>
#include <arenite/mechanics/cell_fields.h>
#include <arenite/mechanics/state.h>
#include <arenite/mesh/geometry.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
class StateArchive;

/// Dashpots of a node [N s/m], on the faces of one boundary or inside of the body.
template <int dim>
struct DampingBlock
{
  unsigned int                    node;
  dealii::SymmetricTensor<2, dim> value;
  dealii::types::boundary_id      boundary = inside;
  dealii::Tensor<1, dim>          normal   = {}; ///< unit, out of the body; zero inside
};

template <int dim>
using DampingBlocks = std::vector<DampingBlock<dim>>; ///< a node may come more than once

/// Lumped mass of a mesh, one entry per node [kg].
struct NodalMass
{
  VectorType partial;   ///< from the cells of this process, hanging nodes with their own share
  VectorType condensed; ///< what the update uses: hanging nodes gave to their masters, ghosts to their owners
};

/// What a load says about itself in the table of energies.
struct LoadValue
{
  std::string name, unit; ///< "volume", "m^3"
  double      value;
  bool        of_sector; ///< a sum over the modelled sector, not a number of its own like a pressure
};

/// Forces from outside, on owned nodes. A load knows its nodes after reinit() and touches nothing else in the step.
template <int dim>
class Load
{
public:
  virtual ~Load() = default;

  virtual void declare_parameters(Parameters &) = 0;
  virtual void finalize(const Parameters &, const Geometry<dim> &) {}

  /// From now on the body deforms for good, 'Kinematics = finite strain': a load on the surface goes with it. Before reinit().
  virtual void use_finite_strain() {}

  /// Rebuild nodal lists after a change of the mesh. @p material: law of the cells with a material id.
  virtual void reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &material) = 0;

  /// force += f(t_n); also remembers f for power(). Displacement with valid ghosts and hanging nodes. Collective.
  virtual void add(VectorType &force, const State<dim> &) = 0;

  /// Dashpots [N s/m]: the update treats - D (v_{n-1/2} + v_{n+1/2})/2 implicitly, node by node.
  virtual const DampingBlocks<dim> *damping() const { return nullptr; }

  /// Advance own state over dt with the velocity v_{n+1/2}.
  virtual void finish_step(const VectorType & /*half_velocity*/, double /*dt*/) {}

  /// Sum over nodes of f_n . v [W], the force of the last add().
  virtual double power(const VectorType &half_velocity) const = 0;

  /// What the last add() put on the nodes of this process, without dashpots, by boundary. Called in every step.
  virtual void add_resultants(Resultants<dim> &) const = 0;

  /// Own state that must survive a change of the mesh: as many scalars per node (zero elsewhere), on any mesh. The setter is collective.
  virtual std::vector<const VectorType *> nodal_states() const { return {}; }
  virtual void                            set_nodal_states(const std::vector<VectorType> &) {}

  /// Own state besides, for a checkpoint.
  virtual void exchange(StateArchive &) {}

  /// Values at the last add(), the same on all processes.
  virtual std::vector<LoadValue> values() const { return {}; }

  /// Boundaries that this load pushes on; adaptive meshes start refined there.
  virtual std::vector<dealii::types::boundary_id> loaded_boundaries() const { return {}; }

  /// Whether a body that admits the form keeps to it under this load. Not known is no.
  virtual bool admits(Reduction &, const Parameters &) const { return false; }

  /// One line for the log.
  virtual std::string description() const = 0;

  std::string name; ///< of the subsection
};

template <int dim>
const Registry<Load<dim>> &loads();

/// The history of `subsection <load>`: reads `set History`, and declares the entries of the chosen kind.
class HistoryChoice
{
public:
  /// The name under "<path>/History".
  void                                declare_parameters(Parameters &, const std::string &unit);
  void                                finalize();
  double                              value(double t) const { return history->value(t); }
  const std::shared_ptr<TimeHistory> &get() const { return history; }
  const std::string                  &name() const { return kind; }

private:
  std::string                  kind = "constant";
  std::shared_ptr<TimeHistory> history;
};
} // namespace Arenite
