#include <arenite/base/stopwatch.h>
#include <arenite/time/dynamics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Arenite
{
using namespace dealii;

namespace
{
/// The points of a block have to go on to @p step. @return whether they do
bool begin_step(PointData &points, const unsigned int step)
{
  points.advances = points.stores_points && points.step != step;
  if (points.advances)
    {
      points.step              = step;
      points.stored_energy     = 0.;
      points.stable_step       = std::numeric_limits<double>::infinity();
      points.largest_frequency = 0.;
    }
  return points.advances;
}
} // namespace

template <int dim>
Dynamics<dim>::Dynamics(Discretization<dim> &discretization, std::vector<std::unique_ptr<InternalForce<dim>>> blocks,
                        std::vector<std::unique_ptr<Load<dim>>> loads, Constraints<dim> &constraints,
                        const MaterialOfBlock &material_of_block)
  : discretization(discretization)
  , blocks(std::move(blocks))
  , loads(std::move(loads))
  , constraints(constraints)
  , material_of_block(material_of_block)
{
  if (!this->material_of_block)
    this->material_of_block = [this](types::material_id) { return this->blocks.front()->material(); };
  std::vector<std::string> names;
  for (const auto &load : this->loads)
    names.push_back(load->name);
  names.push_back("constraints");
  momentum_balance.set_names(names);
  names.back() = "prescribed motion";
  names.push_back("hourglass viscosity");
  balance.set_names(names);
}

template <int dim>
void Dynamics<dim>::reinit(State<dim> &state, const bool at_rest)
{
  state.reinit(discretization);
  NodalMass nodal{discretization.new_scalar(), VectorType()};
  for (auto &block : blocks)
    {
      block->reinit(discretization);
      block->add_mass(nodal.partial);
      state.blocks.emplace_back();
      block->reinit_state(state.blocks.back(), at_rest);
      state.blocks.back().points.is_timed = cost.has_value();
      if (state.blocks.back().points.stores_points)
        state.last_displacement.reinit(discretization.vector_partitioner);
    }
  copy_with_ghosts(nodal.partial, nodal.condensed);
  VectorType &mass = nodal.condensed;
  discretization.hanging.template condense<1>(mass.begin());
  mass.compress(VectorOperation::add);
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double m                                   = mass.local_element(node);
        state.inverse_mass.local_element(dim * node + c) = m > 0. ? 1. / m : 0.;
      }
  for (auto &load : loads)
    load->reinit(discretization, nodal, material_of_block);
  constraints.reinit(discretization);
  damping.reinit(loads, constraints);
  this->mass.swap(nodal.condensed);
}

template <int dim>
void Dynamics<dim>::compute_force(State<dim> &state, const bool overlap)
{
  compute_internal_force(state, overlap);
  const Stopwatch watch(cost ? &cost->loads : nullptr);
  for (const auto &load : loads)
    load->add(state.force, state);
}

template <int dim>
void Dynamics<dim>::compute_internal_force(State<dim> &state, const bool overlap)
{
  const HangingNodes &hanging = discretization.hanging;
  VectorType         &u = state.displacement, &f = state.force;
  const auto          add = [&](const CellPart part) {
    const Stopwatch watch(cost ? &cost->cells : nullptr);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      blocks[b]->add(f, state, part, state.blocks[b]);
  };

  state.blocks.resize(blocks.size()); // without room if the state was not sized by reinit(): no record
  bool advances = false;
  for (BlockState &record : state.blocks)
    {
      record.power = 0.;
      advances |= begin_step(record.points, state.step);
    }
  double *const exchange = cost ? &cost->exchange : nullptr;
  {
    const Stopwatch watch(exchange);
    for (const auto &block : blocks)
      if (block->uses_velocity())
        {
          make_consistent(discretization, state.half_velocity);
          break;
        }
    hanging.interpolate<dim>(u.begin(), 0, hanging.n_local);
    u.update_ghost_values_start();
  }
  if (overlap)
    add(CellPart::inner_first);
  {
    const Stopwatch watch(exchange);
    u.update_ghost_values_finish();
    hanging.interpolate<dim>(u.begin(), hanging.n_local, hanging.size());
  }
  add(CellPart::boundary);
  if (!overlap)
    {
      add(CellPart::inner_first);
      add(CellPart::inner_second);
    }
  {
    const Stopwatch watch(exchange);
    hanging.condense<dim>(f.begin());
    f.compress_start(0, VectorOperation::add);
  }
  if (overlap)
    add(CellPart::inner_second);
  const Stopwatch watch(exchange);
  f.compress_finish(VectorOperation::add);
  hanging.condense<dim>(f.begin()); // what inner_second left at hanging nodes; the others are zero by now
  if (advances)
    {
      for (BlockState &record : state.blocks)
        record.points.advances = false;
      copy_with_ghosts(u, state.last_displacement);
    }
}

template <int dim>
void Dynamics<dim>::book_work(const State<dim> &state, const double half_step)
{
  const VectorType &v = state.half_velocity;
  for (unsigned int l = 0; l < loads.size(); ++l)
    balance.add_work(l, half_step * (loads[l]->power(v) + damping.power(l, v)));
  balance.add_work(loads.size(), half_step * constraints.power(v));
}

// The leapfrog kinetic energy changes by (dt_mean f_n . v) on both sides of t_n, the forces do work over dt_{n-1} and dt_n: the
// difference, zero for equal steps, is booked as a step change.
template <int dim>
void Dynamics<dim>::close_force(State<dim> &state, const double dt, const bool book_first_half)
{
  const Stopwatch watch(cost ? &cost->update : nullptr);
  const double    mean = 0.5 * (state.dt_last + dt);
  damping.apply(state, mean);
  constraints.apply(state, dt, mean);
  for (unsigned int l = 0; l < loads.size(); ++l)
    {
      for (auto &[id, resultant] : of_load)
        resultant = {};
      loads[l]->add_resultants(of_load);
      damping.add_resultants(l, of_load);
      momentum_balance.set_force(l, total(of_load).force);
    }
  momentum_balance.set_force(loads.size(), constraints.reaction());
  if (!book_first_half)
    return;
  book_work(state, 0.5 * state.dt_last);
  // both halves of the step behind at once, with the forces at its ends: the second needs the forces of t_n, which depend on v_{n-1/2}
  for (const BlockState &record : state.blocks)
    balance.add_work(loads.size() + 1, -state.dt_last * record.power);
  if (mean != state.dt_last)
    balance.add_step_change(0.5 * (mean - state.dt_last) * power(state));
}

template <int dim>
EnergyReport Dynamics<dim>::report(const State<dim> &state, const double dt)
{
  const BlockEnergy stored = stored_energy(state);
  EnergyReport      result =
    balance.report(state.time, kinetic_energy(state, 0.5 * (state.dt_last + dt)), stored, discretization.communicator);
  result.stores_points = stores_points();
  result.momentum      = momentum_balance.report(state, mass, discretization.symmetry, discretization.communicator);
  for (const auto &load : loads)
    for (LoadValue &value : load->values())
      {
        value.name = load->name + ": " + value.name;
        result.values.push_back(value);
      }
  return result;
}

template <int dim>
Resultants<dim> Dynamics<dim>::external_forces()
{
  Resultants<dim> sums;
  for (unsigned int l = 0; l < loads.size(); ++l)
    {
      loads[l]->add_resultants(sums);
      damping.add_resultants(l, sums);
    }
  constraints.add_resultants(discretization, sums);
  return sums;
}

template <int dim>
double Dynamics<dim>::total_energy(const State<dim> &state, const double dt) const
{
  const BlockEnergy stored = stored_energy(state);
  return Utilities::MPI::sum(kinetic_energy(state, 0.5 * (state.dt_last + dt)) + stored.total(),
                             discretization.communicator);
}

template <int dim>
double Dynamics<dim>::advance(State<dim> &state, const double dt)
{
  const Stopwatch watch(cost ? &cost->update : nullptr);
  const double    mean        = 0.5 * (state.dt_last + dt);
  const double    power_after = central_difference(state, dt, mean);
  momentum_balance.advance(mean);
  book_work(state, 0.5 * dt);
  balance.add_step_change(0.5 * (mean - dt) * power_after);
  for (const auto &load : loads)
    load->finish_step(state.half_velocity, dt);
  return power_after;
}

template <int dim>
BlockEnergy Dynamics<dim>::stored_energy(const State<dim> &state) const
{
  BlockEnergy total;
  for (unsigned int b = 0; b < blocks.size(); ++b)
    total += blocks[b]->energy(state, state.blocks[b]);
  return total;
}

template <int dim>
bool Dynamics<dim>::stores_points() const
{
  return std::any_of(blocks.begin(), blocks.end(), [](const auto &block) { return block->stores_points(); });
}

template <int dim>
PointLimits<dim> Dynamics<dim>::point_limits(const State<dim> &state)
{
  // the smallest of (step, rank with a failure, -frequency^2) in one message
  const Stopwatch     watch(cost ? &cost->exchange : nullptr);
  const int           rank = Utilities::MPI::this_mpi_process(discretization.communicator);
  std::vector<double> least(3, std::numeric_limits<double>::infinity());
  for (const BlockState &record : state.blocks)
    {
      const PointData &points = record.points;
      // a step that is not a number comes with a failure
      least[0] = std::min(least[0], std::isnan(points.stable_step) ? 0. : points.stable_step);
      least[2] = std::min(least[2], -points.largest_frequency);
      if (points.failed_cell != std::numeric_limits<unsigned int>::max())
        least[1] = rank;
    }
  Utilities::MPI::min(least, discretization.communicator, least);
  PointLimits<dim> limits;
  limits.stable_step = least[0];
  limits.crossing    = 2. * std::sqrt(dim / -least[2]);
  limits.failed      = std::isfinite(least[1]);
  limits.failed_rank = limits.failed ? static_cast<int>(least[1]) : -1;
  return limits;
}

template <int dim>
bool Dynamics<dim>::gives_point_values() const
{
  return std::any_of(blocks.begin(), blocks.end(), [](const auto &block) { return block->gives_point_values(); });
}

template <int dim>
std::vector<std::string> Dynamics<dim>::names_of_point_values() const
{
  std::vector<std::string> names;
  for (const auto &block : blocks)
    for (const std::string &name : block->names_of_point_values())
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  return names;
}

template <int dim>
bool Dynamics<dim>::point_values(const State<dim> &state, const unsigned int cell, std::vector<double> &values) const
{
  for (unsigned int b = 0; b < blocks.size(); ++b)
    if (blocks[b]->point_values(state, state.blocks[b], cell, values))
      {
        if (blocks.size() == 1) // in order already: receivers ask in every step
          return true;
        const auto all = names_of_point_values(), own = blocks[b]->names_of_point_values();
        if (own == all)
          return true;
        const std::size_t   n_nodes = values.size() / (6 + own.size());
        std::vector<double> sorted(n_nodes * (6 + all.size()), 0.);
        for (std::size_t node = 0; node < n_nodes; ++node)
          for (std::size_t k = 0; k < 6 + own.size(); ++k)
            {
              const std::size_t to = k < 6 ? k : 6 + (std::find(all.begin(), all.end(), own[k - 6]) - all.begin());
              sorted[node * (6 + all.size()) + to] = values[node * (6 + own.size()) + k];
            }
        values.swap(sorted);
        return true;
      }
  return false;
}

template <int dim>
double Dynamics<dim>::total_mass() const
{
  return Utilities::MPI::sum(std::accumulate(mass.begin(), mass.begin() + mass.locally_owned_size(), 0.),
                             discretization.communicator);
}

template <int dim>
Conserved<dim> Dynamics<dim>::conserved(const State<dim> &state, const double dt) const
{
  Conserved<dim> result;
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double mv = mass.local_element(node) * state.half_velocity.local_element(dim * node + c);
        result.momentum[c] += mv;
        result.momentum_scale += std::abs(mv);
      }
  result.mass           = total_mass();
  result.energy         = total_energy(state, dt);
  result.momentum       = Utilities::MPI::sum(result.momentum, discretization.communicator);
  result.momentum_scale = Utilities::MPI::sum(result.momentum_scale, discretization.communicator);
  return result;
}

template <int dim>
VectorType Dynamics<dim>::velocity(const State<dim> &state) const
{
  VectorType result = discretization.new_vector();
  for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
    result.local_element(i) = state.half_velocity.local_element(i) +
                              0.5 * state.dt_last * state.inverse_mass.local_element(i) * state.force.local_element(i);
  make_consistent(discretization, result);
  return result;
}

template class Dynamics<1>;
template class Dynamics<2>;
template class Dynamics<3>;
} // namespace Arenite
