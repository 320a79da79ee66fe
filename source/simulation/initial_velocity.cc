#include <arenite/base/names.h>
#include <arenite/simulation/initial_velocity.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Arenite
{
using namespace dealii;

template <int dim>
void InitialVelocity<dim>::declare_parameters(Parameters &parameters)
{
  path  = parameters.current_path();
  names = parameters.peek_list(path + "/Moving regions");
  parameters.add_list("Moving regions", names,
                      "Names of velocities at t = 0; each has a subsection. Needs 'State = rest'.");
  for (const std::string &name : names)
    {
      const auto subsection = parameters.section(name);
      regions.push_back(std::make_unique<Region>());
      Region &region = *regions.back();
      region.name    = name;
      parameters.add_text("Block", region.block,
                          "Material block that moves; empty: all. A node shared by blocks takes the mean of their "
                          "velocities weighted by mass, so that no momentum is lost.");
      parameters.add_text("Velocity", region.text,
                          "Velocity [m/s]: " + place_formula_rules<dim>() + ". Example: " +
                            (dim == 1   ? "-545*(0.08/x)^2"
                             : dim == 2 ? "-545*(0.08/x)^2; 0"
                                        : "-545*(0.08/x)^2; 0; 0"));
      parameters.require("Velocity");
    }
}

template <int dim>
void InitialVelocity<dim>::finalize(const Parameters &parameters, const std::vector<std::string> &block_names)
{
  if (!at_rest() && parameters.peek(path + "/State", "rest") != "rest")
    parameters.refuse(path + "/Moving regions", "needs 'State = rest': the exact solution brings its own velocity");
  std::map<unsigned int, std::string> region_of;
  for (const auto &region : regions)
    {
      const std::string section = path + "/" + region->name;
      if (!region->block.empty())
        {
          const auto position = std::find(block_names.begin(), block_names.end(), region->block);
          if (position == block_names.end())
            parameters.refuse(section + "/Block", "there is no such block." + suggestion(region->block, block_names));
          region->block_index = position - block_names.begin();
        }
      const auto [other, is_new] = region_of.emplace(region->block_index, region->name);
      if (!is_new)
        parameters.refuse(section, "moves the block of '" + other->second + "' again");
      if (const std::string complaint = region->velocity.read(region->text); !complaint.empty())
        parameters.refuse(section + "/Velocity", complaint);
    }
  if (region_of.size() > 1 && region_of.count(all_blocks) > 0)
    parameters.refuse(path + "/" + region_of[all_blocks],
                      "without 'Block' it takes all cells, and no other region may move them");
}

template <int dim>
void InitialVelocity<dim>::apply(const Dynamics<dim> &dynamics, State<dim> &state) const
{
  const Discretization<dim> &discretization = dynamics.discretization;
  state.half_velocity                       = 0.;
  for (const auto &region : regions)
    {
      unsigned int bad_values = 0;
      VectorType   mass       = discretization.new_scalar();
      for (unsigned int b = 0; b < dynamics.blocks.size(); ++b)
        if (region->block_index == all_blocks || region->block_index == b)
          dynamics.blocks[b]->add_mass(mass);
      discretization.hanging.template condense<1>(mass.begin());
      mass.compress(VectorOperation::add);
      for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
        if (mass.local_element(node) > 0.)
          {
            // on the axis nothing moves radially; formulas may be singular there
            const Tensor<1, dim> v    = region->velocity.value(discretization.position(node));
            const double         part = mass.local_element(node) / dynamics.mass.local_element(node);
            for (unsigned int c = discretization.on_axis(node) ? 1 : 0; c < dim; ++c)
              {
                bad_values += std::isfinite(v[c]) ? 0 : 1;
                state.half_velocity.local_element(dim * node + c) += part * v[c];
              }
          }
      if (Utilities::MPI::sum(bad_values, discretization.communicator) > 0)
        throw InputError("[" + path + " / " + region->name + "] Velocity = " + region->text +
                         ": is not a number at some nodes of the block.");
    }
}

template <int dim>
std::string InitialVelocity<dim>::description() const
{
  std::string text;
  for (const auto &region : regions)
    text += "Moving     " + region->name + ": " + (region->block.empty() ? "all blocks" : "block " + region->block) +
            " with " + region->text + " m/s\n";
  return text;
}

template class InitialVelocity<1>;
template class InitialVelocity<2>;
template class InitialVelocity<3>;
} // namespace Arenite
