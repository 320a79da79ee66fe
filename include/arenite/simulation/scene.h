#pragma once

#include <arenite/adaptivity/mesh_adaptor.h>
#include <arenite/base/parameters.h>
#include <arenite/io/receivers.h>
#include <arenite/io/statistics.h>
#include <arenite/io/vtu_output.h>
#include <arenite/loads/constraints.h>
#include <arenite/loads/geostatic_stress.h>
#include <arenite/materials/batch_law.h>
#include <arenite/materials/elastic_constants.h>
#include <arenite/mechanics/internal_force.h>
#include <arenite/mechanics/point_motion.h>
#include <arenite/mesh/geometry.h>
#include <arenite/simulation/checkpoint_schedule.h>
#include <arenite/simulation/initial_energy.h>
#include <arenite/simulation/initial_velocity.h>
#include <arenite/statics/static_equilibrium.h>
#include <arenite/time/stable_time_step.h>
#include <arenite/verification/solution_choice.h>

#include <list>
#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// A material block: a name, the cells' material id, and its law. Linear elasticity at small strain is fused into the kernels and needs its
/// constants only.
struct Block
{
  std::string               name, law_name = "linear elastic";
  unsigned int              material_id = 0;
  ElasticConstants          constants;
  std::unique_ptr<BatchLaw> law;      ///< null where the kernel does without
  LinearElastic             material; ///< elasticity at rest
  GeostaticPast             past;     ///< where the soil begins under a stress
};

/// Everything that a .prm says, read and checked. Members in the order of the file's sections.
template <int dim>
struct Scene
{
  /// Declare the entries of the models that this scene chose, parse strictly, derive and cross-check. `Dimension` is dim.
  explicit Scene(Parameters &);

  std::string      title;
  KinematicsChoice kinematics;
  const Symmetry   symmetry;
  double           end_time = std::numeric_limits<double>::quiet_NaN();
  std::string      analysis = "dynamic";
  bool             is_static() const { return analysis == "static"; }

  MeshChoice<dim>                           mesh;
  ElementChoice                             element;
  std::vector<Block>                        blocks;
  std::vector<std::unique_ptr<Load<dim>>>   loads;
  Constraints<dim>                          constraints;
  std::string                               initial_state = "rest", support_at_rest = "rollers";
  InitialVelocity<dim>                      initial_velocity;
  InitialEnergy<dim>                        initial_energy;
  GeostaticStress<dim>                      stress_at_rest;
  StableTimeStep<dim>                       time_step;
  StaticsChoice                             statics;
  MeshAdaptor<dim>                          adaptor;
  ReceiverSets<dim>                         receivers;
  VTUOutput<dim>                            pictures;
  Statistics                                statistics;
  bool                                      timed = false; ///< print what the parts of a step cost
  CheckpointSchedule                        checkpoints;
  SolutionChoice<dim>                       solution_choice;
  std::shared_ptr<const ExactSolution<dim>> exact_solution;

private:
  void declare_parameters(Parameters &);
  void finalize(Parameters &);
  void support_absorbing_boundaries(const Parameters &);
  void refuse_motion(const Parameters &) const;

  std::string              dimension = "3", symmetry_name = "none"; ///< what DimensionChoice has read already
  std::vector<std::string> block_names, load_names;
  std::list<std::string>   load_types; ///< what `set Type` of each load binds to
};

/// Call @p f(std::integral_constant<int, dim>()) with the dimension that the parameters ask for.
template <typename Function>
auto with_dimension(const Parameters &parameters, const Function &f)
{
  switch (DimensionChoice(parameters).dimension)
    {
    case 1:
      return f(std::integral_constant<int, 1>());
    case 2:
      return f(std::integral_constant<int, 2>());
    default:
      return f(std::integral_constant<int, 3>());
    }
}
} // namespace Arenite
