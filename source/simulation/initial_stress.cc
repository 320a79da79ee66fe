#include <arenite/base/errors.h>
#include <arenite/simulation/initial_stress.h>

#include <cmath>
#include <numeric>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Points of a cell in the unit cell, in the order of a block's records.
template <int dim>
std::vector<Point<dim>> points_of(const CellRecord &record)
{
  std::vector<Point<dim>> result;
  const unsigned int      per_line = record.points.size();
  for (unsigned int q = 0; q < Utilities::pow(per_line, dim); ++q)
    {
      Point<dim> xi;
      for (unsigned int d = 0, i = q; d < dim; ++d, i /= per_line)
        xi[d] = record.points[i % per_line];
      result.push_back(xi);
    }
  return result;
}

/// Stress and history of all points.
template <int dim>
void set_stress(const GeostaticStress<dim> &wanted, const Dynamics<dim> &dynamics, State<dim> &state,
                const std::vector<std::string> &block_names)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  std::vector<unsigned int>  all(discretization.cells().size());
  std::iota(all.begin(), all.end(), 0);
  std::string             problem;
  std::vector<Point<dim>> nodes;
  for (unsigned int b = 0; b < dynamics.blocks.size() && problem.empty(); ++b)
    {
      const InternalForce<dim> &block  = *dynamics.blocks[b];
      const CellRecord          record = block.cell_record();
      const auto                points = points_of<dim>(record);
      std::vector<double>       values;
      for (const unsigned int cell : all)
        {
          if (!block.contains(cell))
            continue;
          discretization.cell_positions(cell, nodes);
          values.assign(record.size(dim), 0.);
          if (points.size() > 0)
            block.pack(state.blocks[b], cell, values.data());
          for (unsigned int q = 0; q < std::max<std::size_t>(points.size(), 1) && problem.empty(); ++q)
            {
              Point<dim> x;
              for (unsigned int i = 0; i < nodes.size(); ++i)
                x += (points.size() > 1 ? discretization.fe.shape_value(discretization.lexicographic[i], points[q])
                                        : 1. / nodes.size()) *
                     nodes[i];
              const auto  stress = wanted.at(x, discretization.cells()[cell]->material_id());
              double     *at     = values.data() + q * record.n_values;
              const auto &past   = wanted.past_of(discretization.cells()[cell]->material_id());
              const auto  reason = block.begin_under(stress, past.overconsolidation, at + 6);
              if (!reason.empty())
                {
                  std::ostringstream text;
                  text << "[Initial conditions] Stress = geostatic: block '" << block_names[b] << "' at (" << x
                       << "): " << reason;
                  problem = text.str();
                  break;
                }
              for (unsigned int k = 0; k < 6; ++k)
                at[k] = stress[k];
            }
          if (!problem.empty())
            break;
          block.unpack(state.blocks[b], cell, values.data());
        }
    }
  for (const std::string &text : Utilities::MPI::all_gather(discretization.communicator, problem))
    if (!text.empty())
      throw InputError(text);
}

} // namespace

template <int dim>
void begin_under_stress(const GeostaticStress<dim> &stress, Dynamics<dim> &dynamics, State<dim> &state,
                        const std::vector<std::string> &block_names)
{
  set_stress(stress, dynamics, state, block_names);
  dynamics.compute_internal_force(state); // points see it, without any strain
  state.force = 0.;
  for (BlockState &block : state.blocks)
    block.points.dissipated = 0.; // what is stored was there before
}

template <int dim>
double unbalanced_part(const GeostaticStress<dim> &stress, const bool all_loads, Dynamics<dim> &dynamics,
                       State<dim> &state)
{
  dynamics.compute_internal_force(state);
  for (const auto &load : dynamics.loads)
    if (all_loads || dynamic_cast<const Gravity<dim> *>(load.get()) ||
        dynamic_cast<const HeldStress<dim> *>(load.get()))
      load->add(state.force, state);
  dynamics.constraints.project(state.force);
  double largest = 0.;
  for (unsigned int node = 0; node < dynamics.discretization.n_owned_nodes(); ++node)
    if (const double weight = dynamics.mass.local_element(node) * stress.acceleration(); weight > 0.)
      {
        double square = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          square += std::pow(state.force.local_element(dim * node + c), 2);
        largest = std::max(largest, std::sqrt(square) / weight);
      }
  state.force = 0.;
  return Utilities::MPI::max(largest, dynamics.discretization.communicator);
}

#define ARENITE_INSTANTIATE(dim)                                                                  \
  template void   begin_under_stress(const GeostaticStress<dim> &, Dynamics<dim> &, State<dim> &, \
                                     const std::vector<std::string> &);                           \
  template double unbalanced_part(const GeostaticStress<dim> &, bool, Dynamics<dim> &, State<dim> &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
