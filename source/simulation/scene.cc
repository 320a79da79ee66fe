#include <arenite/loads/absorbing.h>
#include <arenite/loads/body_force.h>
#include <arenite/loads/nodal_force.h>
#include <arenite/loads/support_at_rest.h>
#include <arenite/materials/elasticity_at_rest.h>
#include <arenite/materials/law_list.h>
#include <arenite/simulation/material_bench.h>
#include <arenite/simulation/scene.h>

#include <map>

namespace Arenite
{
template <int dim>
Scene<dim>::Scene(Parameters &parameters)
  : symmetry(DimensionChoice(parameters).symmetry)
  , mesh(parameters)
{
  declare_parameters(parameters);
  parameters.parse();
  finalize(parameters);
}

template <int dim>
void Scene<dim>::declare_parameters(Parameters &parameters)
{
  parameters.add_text("Title", title, "One line for the log and run.json.");
  parameters.add_choice("Dimension", dimension, {"1", "2", "3"}, "Space dimension of the mesh.");
  parameters.add_choice("Symmetry", symmetry_name, symmetry_names(),
                        "What a mesh of fewer dimensions stands for: in two 'plane strain' or 'axisymmetric' (first "
                        "coordinate r, second z), in one 'plane wave' (uniaxial strain) or 'spherical' (r).");
  kinematics.declare_parameters(parameters);
  parameters.add_quantity("End time", end_time, "s", positive, "The run starts at 0 and ends here.");
  parameters.add_choice(
    "Analysis", analysis, {"dynamic", "static"},
    "'static' goes through equilibria, in the steps of 'Statics' instead of 'Time stepping': nothing "
    "is accelerated, the histories of loads and prescribed velocities are followed as slowly as "
    "one likes. The mesh stays that of the start.");

  block_names = parameters.peek_list("Blocks");
  load_names  = parameters.peek_list("Loads");
  if (block_names.empty())
    block_names = {"solid"};
  parameters.add_list("Blocks", block_names, "Names of the material blocks; each has a subsection of 'Materials'.");
  parameters.add_list("Loads", load_names, "Names of the loads; each has a subsection of 'Loads'.");

  mesh.declare_parameters(parameters);
  element.declare_parameters(parameters);
  {
    const auto section = parameters.section("Materials");
    blocks.reserve(block_names.size());
    for (const std::string &name : block_names)
      {
        blocks.emplace_back();
        Block &block          = blocks.back();
        block.name            = name;
        block.material_id     = blocks.size() - 1;
        const auto subsection = parameters.section(name);
        declare_law(parameters, block.law_name);
        parameters.add_integer("Material id", block.material_id, 0, 254,
                               "Id of the block's cells in the mesh; a single block takes all cells.");
        if (block.law_name == "linear elastic" && !kinematics.finite_strain())
          {
            block.constants.declare_parameters(parameters);
            continue;
          }
        block.law = material_laws(native_lanes).make(block.law_name);
        block.law->declare_parameters(parameters);
      }
  }
  {
    const auto section = parameters.section("Loads");
    for (const std::string &name : load_names)
      {
        const auto  subsection = parameters.section(name);
        std::string type = parameters.peek_choice("Loads/" + name + "/Type", "pressure", Arenite::loads<dim>().names());
        loads.push_back(Arenite::loads<dim>().make(type));
        loads.back()->name = name;
        load_types.push_back(type);
        parameters.add_choice("Type", load_types.back(), Arenite::loads<dim>().names(), "Kind of load.");
        loads.back()->declare_parameters(parameters);
      }
  }
  constraints.declare_parameters(parameters);
  {
    const auto section = parameters.section("Initial conditions");
    parameters.add_choice(
      "State", initial_state, {"rest", "exact solution", "equilibrium"},
      "Displacement and velocity at t = 0. 'equilibrium': at rest under the loads of t = 0, found by Newton's "
      "method from 'Stress'; needs 'Statics' and hourglass control by stiffness.");
    parameters.add_choice(
      "Support at rest", support_at_rest, {"rollers", "fixed"},
      "How absorbing boundaries hold the body while 'State = equilibrium' is found: along their normals, or in all "
      "directions. Their reaction goes on as a constant traction, with the dashpots on the motion that comes.");
    initial_velocity.declare_parameters(parameters);
    initial_energy.declare_parameters(parameters);
    stress_at_rest.declare_parameters(parameters);
  }
  for (Block &block : blocks)
    {
      const auto section = parameters.section("Materials"), subsection = parameters.section(block.name);
      stress_at_rest.declare_block(parameters, block.past);
    }
  time_step.declare_parameters(parameters);
  statics.declare_parameters(parameters);
  adaptor.declare_parameters(parameters);
  receivers.declare_parameters(parameters);
  pictures.declare_parameters(parameters);
  statistics.declare_parameters(parameters);
  {
    const auto section = parameters.section("Output");
    parameters.add_flag(
      "Cost of parts", timed,
      "Measure and print where the time goes: laws, other work in the cells, loads, the step, exchange "
      "between processes. Costs some percent of it.");
  }
  checkpoints.declare_parameters(parameters);
  solution_choice.declare_parameters(parameters);
}

template <int dim>
void Scene<dim>::finalize(Parameters &parameters)
{
  mesh.finalize(parameters);
  element.finalize(parameters);
  std::map<unsigned int, std::string> ids;
  for (Block &block : blocks)
    {
      if (block.law)
        {
          block.law->finalize(parameters);
          block.material = elasticity_at_rest(*block.law);
        }
      else
        block.material = block.constants.finalize(parameters);
      const auto [position, is_new] = ids.emplace(block.material_id, block.name);
      if (!is_new)
        parameters.refuse("Materials/" + block.name + "/Material id",
                          "is the id of block '" + position->second + "' too");
    }
  for (auto &load : loads)
    {
      load->finalize(parameters, *mesh.geometry);
      if (kinematics.finite_strain())
        load->use_finite_strain();
    }
  std::map<unsigned int, GeostaticPast> past;
  for (const Block &block : blocks)
    past[block.material_id] = block.past;
  stress_at_rest.finalize(parameters, *mesh.geometry, loads, past);
  if (stress_at_rest.is_wanted())
    loads.push_back(std::make_unique<HeldStress<dim>>(stress_at_rest, element.type == "one-point hexahedron"));
  if (initial_state == "equilibrium")
    support_absorbing_boundaries(parameters);
  constraints.finalize(parameters, *mesh.geometry);
  initial_velocity.finalize(parameters, block_names);
  initial_energy.finalize(parameters);
  time_step.finalize(parameters);
  adaptor.finalize(parameters, mesh, *mesh.geometry);
  receivers.finalize(parameters, *mesh.geometry);
  pictures.finalize(parameters);
  statistics.finalize(parameters);

  if (is_static() || initial_state == "equilibrium")
    refuse_motion(parameters);

  std::shared_ptr<const TimeHistory> pressure;
  for (const auto &load : loads)
    if (const auto *candidate = dynamic_cast<const Pressure<dim> *>(load.get()); candidate && !pressure)
      pressure = candidate->pressure_history().get();
  exact_solution = solution_choice.make(parameters, blocks.front().material, pressure, symmetry);
  for (const Block &block : blocks)
    if (exact_solution && !(block.material == blocks.front().material && block.law_name == blocks.front().law_name))
      parameters.refuse("Verification/Exact solution", "holds for one material, but the blocks '" +
                                                         blocks.front().name + "' and '" + block.name + "' differ");
  constraints.exact_solution = exact_solution.get();
  if (!(exact_solution && exact_solution->is_field()) &&
      (initial_state == "exact solution" || parameters.is_set("Constraints/Exact boundaries")))
    parameters.refuse("Verification/Exact solution",
                      "must be a solution inside of the body for 'Initial conditions / State' or 'Constraints / Exact "
                      "boundaries'");
  if (exact_solution && exact_solution->has_body_force())
    loads.push_back(std::make_unique<BodyForce<dim>>(exact_solution));
}

template <int dim>
void Scene<dim>::support_absorbing_boundaries(const Parameters &parameters)
{
  if (const auto names = absorbing_boundaries(loads); !names.empty())
    loads.push_back(
      std::make_unique<SupportAtRest<dim>>(mesh.geometry->boundary_ids(parameters, "Initial conditions/State", names),
                                           names));
}

/// What has no meaning where nothing moves, in the whole run or at its start.
template <int dim>
void Scene<dim>::refuse_motion(const Parameters &parameters) const
{
  const std::string reason =
    is_static() ? "has no meaning with 'Analysis = static'" : "has no meaning with 'State = equilibrium'";
  if (element.type == "one-point hexahedron" && element.hourglass_control == "viscous")
    parameters.refuse("Element/Hourglass control", reason + ": take 'stiffness'");
  if (!initial_velocity.at_rest())
    parameters.refuse("Initial conditions/Moving regions", reason);
  if (is_static() && receivers.has_balances())
    parameters.refuse("Receivers",
                      "surfaces and boxes follow the steps of a motion, and have no meaning with 'Analysis = static'");
  if (is_static() && initial_state != "rest")
    parameters.refuse("Initial conditions/State", reason);
}

template struct Scene<1>;
template struct Scene<2>;
template struct Scene<3>;
} // namespace Arenite
