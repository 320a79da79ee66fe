#include <arenite/adaptivity/cell_transport.h>
#include <arenite/base/errors.h>
#include <arenite/simulation/initial_stress.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Points of a cell in the unit cell, in the order of a block's records; its centre for a block that keeps nothing.
template <int dim>
std::vector<Point<dim>> points_of(const CellRecord &record)
{
  const std::vector<double> line     = record.points.empty() ? std::vector<double>{0.5} : record.points;
  const unsigned int        per_line = line.size();
  std::vector<Point<dim>>   result(Utilities::pow(per_line, dim));
  for (unsigned int q = 0; q < result.size(); ++q)
    for (unsigned int d = 0, i = q; d < dim; ++d, i /= per_line)
      result[q][d] = line[i % per_line];
  return result;
}

/// Stress and history of the points of a cell of @p block. @return why one of them cannot begin so, with its place, or nothing
template <int dim>
std::string set_stress(const GeostaticStress<dim> &wanted, const Discretization<dim> &discretization,
                       const InternalForce<dim> &block, const unsigned int cell, BlockState &state)
{
  const CellRecord        record = block.cell_record();
  const auto              points = points_of<dim>(record);
  const auto              id     = discretization.cells()[cell]->material_id();
  std::vector<Point<dim>> nodes;
  std::vector<double>     values(std::max(record.size(dim), 6u));
  discretization.cell_positions(cell, nodes);
  block.pack(state, cell, values.data());
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      Point<dim> x;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        x += discretization.fe.shape_value(discretization.lexicographic[i], points[q]) * nodes[i];
      const SymTensor<double> stress = wanted.at(x, id);
      double                 *at     = &values[q * record.n_values];
      if (const std::string reason = block.begin_under(stress, wanted.past_of(id).overconsolidation, at + 6);
          !reason.empty())
        {
          std::ostringstream text;
          text << " at (" << x << "): " << reason;
          return text.str();
        }
      std::copy_n(&stress[0], 6, at);
    }
  block.unpack(state, cell, values.data());
  return "";
}

/// The same of all cells; InputError on all processes if one cannot.
template <int dim>
void set_stress(const GeostaticStress<dim> &wanted, const Dynamics<dim> &dynamics, State<dim> &state,
                const std::vector<std::string> &block_names)
{
  const Discretization<dim> &discretization = dynamics.discretization;
  std::string                problem;
  for (unsigned int cell = 0; cell < discretization.cells().size() && problem.empty(); ++cell)
    {
      const unsigned int b      = block_of(dynamics, cell);
      const std::string  reason = set_stress(wanted, discretization, *dynamics.blocks[b], cell, state.blocks[b]);
      if (!reason.empty())
        problem = "[Initial conditions] Stress = geostatic: block '" + block_names[b] + "'" + reason;
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
