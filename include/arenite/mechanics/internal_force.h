#pragma once

#include <arenite/base/number.h>
#include <arenite/base/parameters.h>
#include <arenite/materials/linear_elastic.h>
#include <arenite/mechanics/state.h>

#include <deal.II/lac/vector.h>

#include <array>
#include <memory>
#include <string>

namespace Arenite
{
/// `subsection Element` of a scene.
struct ElementChoice
{
  std::string  type                  = "hexahedron";
  unsigned int degree                = 1;
  std::string  hourglass_control     = "stiffness";
  double       hourglass_coefficient = 0.05;

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);
};

/// Cells are visited in three parts, so that messages travel while cells without ghost nodes are computed.
enum class CellPart : unsigned int
{
  boundary     = 0, ///< cells with ghost nodes
  inner_first  = 1, ///< while ghost displacements arrive
  inner_second = 2  ///< while ghost forces arrive
};

/// Energies of one material block on this process [J].
struct BlockEnergy
{
  double strain    = 0.; ///< sum over points of sigma:epsilon/2
  double hourglass = 0.; ///< stored by the stiffness form
};

/// Internal forces of one material block: gather -> kinematics -> stress -> scatter, once per batch of cells.
template <int dim>
class InternalForce
{
public:
  virtual ~InternalForce() = default;

  /// Rebuild the batches after a change of the mesh.
  virtual void reinit(const Discretization<dim> &) = 0;

  /// force += -integral of sigma : grad N over the cells of @p part. Hanging entries receive forces like all others. Viscous forces
  /// replace those of the last evaluation in @p viscous and add their power.
  virtual void add(VectorType &force, const State<dim> &, CellPart part, ViscousForces &viscous) const = 0;

  /// Energies from the points, by a path that does not use the nodal forces.
  virtual BlockEnergy energy(const State<dim> &) const = 0;

  /// True if the forces depend on state.half_velocity, which then needs valid ghosts and hanging nodes.
  virtual bool uses_velocity() const { return false; }

  /// Size of ViscousForces::amplitude that add() needs to keep a record; 0 without viscous forces.
  virtual std::size_t n_viscous_amplitudes() const { return 0; }

  /// mass += integral of rho N_i, one entry per node.
  virtual void add_mass(VectorType &mass) const = 0;

  /// Squared Frobenius norm of the inverse Jacobian of each cell of the block, at its smallest point [1/m^2].
  virtual void inverse_size_squared(dealii::Vector<double> &per_cell) const = 0;

  /// Largest eigenvalue of each element's own M^-1 K [1/s^2] by power iteration (from below). With viscous forces -C v the fixed point
  /// lambda of M^-1 (K + sqrt(lambda) C): the element alone is stable up to dt = 2/sqrt(lambda) in both cases.
  virtual void largest_eigenvalue(dealii::Vector<double> &per_cell) const = 0;

  virtual const LinearElastic &material() const = 0;

  /// One line for the start of the log: law, kinematics, lanes, bytes per point.
  virtual std::string description() const = 0;
};

/// Fused small-strain linear elasticity: no stress and no history is stored. @p block: material id of its cells; by default all cells.
template <int dim, int W = native_lanes>
std::unique_ptr<InternalForce<dim>> make_elastic_force(
  const ElementChoice &, const LinearElastic &, dealii::types::material_id block = dealii::numbers::invalid_material_id,
  Symmetry = cartesian<dim>());
} // namespace Arenite
