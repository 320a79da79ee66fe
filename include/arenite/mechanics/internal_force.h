#pragma once

#include <arenite/base/number.h>
#include <arenite/base/parameters.h>
#include <arenite/base/tensor_tools.h>
#include <arenite/materials/linear_elastic.h>
#include <arenite/mechanics/state.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <limits>
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
  std::string  volumetric_strain     = "pointwise";

  double      linear_viscosity = 0.06, quadratic_viscosity = 1.2; ///< of blocks with a law of their own
  bool        viscosity_in_expansion = false;
  std::string viscosity_form         = "volumetric";

  bool directional_viscosity() const { return viscosity_form == "directional"; }

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);
};

/// Largest change of volume of a point in one step, where laws are updated; the next step is shortened when the present rate would
/// exceed it.
constexpr double largest_volume_change = 0.02;

/// Cells are visited in three parts, so that messages travel while cells without ghost nodes are computed.
enum class CellPart : unsigned int
{
  boundary     = 0, ///< cells with ghost nodes
  inner_first  = 1, ///< while ghost displacements arrive
  inner_second = 2  ///< while ghost forces arrive
};

/// How the numbers lie that a block keeps for one cell and that move with the cell to another process, mesh or file: [point][value], then
/// those of the cell itself. Points are a tensor product in the unit cell, the first direction fastest.
struct CellRecord
{
  /// What becomes of a number of a cell when the cell is halved, and how that of the whole follows from its parts.
  struct OfCell
  {
    double to_child;
    bool   sums; ///< the parts; otherwise the largest
    double to_parent;
  };

  std::vector<double> points, weights; ///< along each direction of [0,1]; empty if the block keeps nothing
  unsigned int        n_values = 0;    ///< of a point: six of the stress first, the reference volume last [m^3]
  std::vector<OfCell> of_cell;

  unsigned int n_points(const int dim) const
  {
    unsigned int n = points.empty() ? 0 : 1;
    for (int d = 0; d < dim; ++d)
      n *= static_cast<unsigned int>(points.size());
    return n;
  }
  unsigned int size(const int dim) const
  {
    return n_points(dim) * n_values + static_cast<unsigned int>(of_cell.size());
  }
};

/// What indicators ask of cells.
enum class CellQuantity
{
  bulk_viscosity, ///< largest |q| of its points [Pa]
  dissipation     ///< by the law [W/m^3]
};

/// Energies of one material block on this process [J]. A law with energies per reference volume closes the balance
///
///   work = d(strain) + d(dissipated) + d(bulk viscosity) + d(hourglass)
///
/// to the order of the step. One whose moduli belong to the Cauchy stress per present volume (linear elastic, cap with constant moduli)
/// is hypoelastic at finite strain: work that a volume change does on stored energy, the integral of stored dJ, is lost to it or given
/// by it. volume_change counts that, also of a law of which one part is so (undrained cap).
struct BlockEnergy
{
  double strain         = 0.; ///< sum over points: sigma:epsilon/2, or what the law stores
  double hourglass      = 0.; ///< stored by the stiffness form; with a law of its own, all work on the patterns
  double dissipated     = 0.; ///< by the law, since the start
  double bulk_viscosity = 0.; ///< dissipated by it, since the start
  double volume_change  = 0.; ///< minus the integral of the energy stored per present volume over dJ, since the start

  double       largest_hourglass = 0.;                                       ///< of one cell
  unsigned int hourglass_cell    = std::numeric_limits<unsigned int>::max(); ///< which one, on this process

  void note_hourglass(const double energy, const unsigned int cell)
  {
    if (energy > largest_hourglass)
      {
        largest_hourglass = energy;
        hourglass_cell    = cell;
      }
  }
  double       total() const { return strain + hourglass + dissipated + bulk_viscosity + volume_change; }
  BlockEnergy &operator+=(const BlockEnergy &other);
};

/// Internal forces of one material block: gather -> kinematics -> stress -> scatter, once per batch of cells.
template <int dim>
class InternalForce
{
public:
  virtual ~InternalForce() = default;

  /// Rebuild the batches after a change of the mesh.
  virtual void reinit(const Discretization<dim> &) = 0;

  /// True if stress and history of every point are stored.
  virtual bool stores_points() const { return false; }

  /// Room for what the block keeps in a state, at rest; without @p at_rest it waits for unpack().
  virtual void reinit_state(BlockState &, bool /*at_rest*/ = true) const {}

  /// Whether a cell of Discretization::cells() is one of this block.
  virtual bool contains(unsigned int cell) const = 0;

  /// What moves with cells, and its way from and to the state; @p values as the record says. The sums of BlockState stay behind.
  virtual CellRecord cell_record() const { return {}; }
  virtual void       pack(const BlockState &, unsigned int /*cell*/, double       */*values*/) const {}
  virtual void       unpack(BlockState &, unsigned int /*cell*/, const double       */*values*/) const {}

  /// After all cells were unpacked on a new mesh: the law brings points of the @p changed ones, new or moved, back to admissible states; viscous hourglass
  /// forces of these cells, stored energy and stable step are taken anew from displacement, velocity and stress. No time passes.
  virtual void restore(const State<dim> &, BlockState &, const std::vector<unsigned int> & /*changed*/) const {}

  /// A quantity of each cell of the block; the others are left alone.
  virtual void cell_values(const BlockState &, CellQuantity, dealii::Vector<float> & /*per_cell*/) const {}

  /// Set an entry of the history at all points of each cell. @return false if the points have no such entry.
  virtual bool set_history(BlockState &, const std::string & /*name*/,
                           const std::function<double(unsigned int cell)> & /*value*/) const
  {
    return false;
  }

  /// BatchLaw::begin_under() of the block's law.
  virtual std::string begin_under(const SymTensor<double> & /*stress*/, double /*overconsolidation*/,
                                  double * /*history*/) const
  {
    return "its stress follows from the displacement, it cannot begin under one. With 'Kinematics = finite strain' it "
           "is stored.";
  }

  /// force += -integral of P : Grad N over the cells of @p part. Hanging entries receive forces like all others. What the block keeps is
  /// brought to state.step first if record.points.advances; viscous hourglass forces replace those of the last evaluation and add their
  /// power.
  virtual void add(VectorType &force, const State<dim> &, CellPart part, BlockState &record) const = 0;

  /// Energies from the points, by a path that does not use the nodal forces.
  virtual BlockEnergy energy(const State<dim> &, const BlockState &) const = 0;

  /// True if the forces depend on state.half_velocity, which then needs valid ghosts and hanging nodes.
  virtual bool uses_velocity() const { return false; }

  /// Values at the nodes of @p cell (lexicographic) of what its points store: the polynomial through the points.
  /// @p values: [node][quantity], the six of the Cauchy stress (order of SymTensor), then names_of_point_values(). False if the cell is of another
  /// block, or the block stores nothing because its stress follows from the displacement.
  virtual bool point_values(const State<dim> &, const BlockState &, unsigned int, std::vector<double> &) const
  {
    return false;
  }

  /// Whether point_values() knows more than the displacement says.
  virtual bool gives_point_values() const { return stores_points(); }

  /// Of what point_values() gives after the stress, "name [unit]".
  virtual std::vector<std::string> names_of_point_values() const { return {}; }

  /// mass += integral of rho N_i, one entry per node.
  virtual void add_mass(VectorType &mass) const = 0;

  /// The same of one cell: [node].
  virtual void cell_mass(unsigned int cell, std::vector<double> &mass) const = 0;

  /// Stiffness of a cell of the block with its elasticity at rest [N/m], hourglass stiffness included: - d force / d displacement, both
  /// [node][component]. Where the block is linear elastic at small strain this is its tangent, to the last bit but round-off.
  virtual void cell_stiffness(unsigned int cell, dealii::FullMatrix<double> &stiffness) const = 0;

  /// Squared Frobenius norm of the inverse Jacobian of each cell of the block, at its smallest point [1/m^2].
  virtual void inverse_size_squared(dealii::Vector<double> &per_cell) const = 0;

  /// Largest eigenvalue of each element's own M^-1 K [1/s^2] by power iteration (from below). With viscous forces -C v the fixed point
  /// lambda of M^-1 (K + sqrt(lambda) C): the element alone is stable up to dt = 2/sqrt(lambda) in both cases.
  virtual void largest_eigenvalue(dealii::Vector<double> &per_cell) const = 0;

  /// Of a small overstress at rest [s]; 0: not known.
  virtual double relaxation_time() const { return 0.; }

  /// Its elasticity at rest.
  virtual const LinearElastic &material() const = 0;

  /// One line for the start of the log: law, kinematics, lanes, bytes per point.
  virtual std::string description() const = 0;
};

class BatchLaw;
struct KinematicsChoice;

/// A block with the law @p law (on native_lanes), which stores stress and history of every point.
template <int dim>
std::unique_ptr<InternalForce<dim>> make_law_force(
  const ElementChoice &, const KinematicsChoice &, std::unique_ptr<const BatchLaw> law,
  dealii::types::material_id block = dealii::numbers::invalid_material_id, Symmetry = cartesian<dim>());

/// Fused small-strain linear elasticity: no stress and no history is stored. @p block: material id of its cells; by default all cells.
template <int dim, int W = native_lanes>
std::unique_ptr<InternalForce<dim>> make_elastic_force(
  const ElementChoice &, const LinearElastic &, dealii::types::material_id block = dealii::numbers::invalid_material_id,
  Symmetry = cartesian<dim>());
} // namespace Arenite
