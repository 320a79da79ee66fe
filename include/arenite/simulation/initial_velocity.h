#pragma once

#include <arenite/base/formula.h>
#include <arenite/time/dynamics.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// Velocities at t = 0 by material block: `set Moving regions` of `subsection Initial conditions`.
///
/// A node that several blocks share moves with the mean velocity weighted by their masses at the node,
///
///   v_i = sum_b m_ib v_b(x_i) / sum_b m_ib,
///
/// so that the lumped momentum is the sum over the blocks of theirs, to round-off; blocks that are not named are at rest.
/// Constrained nodes lose what their constraints forbid, afterwards.
template <int dim>
class InitialVelocity
{
public:
  /// In the open section.
  void declare_parameters(Parameters &);

  /// @p block_names in the order of Dynamics::blocks.
  void finalize(const Parameters &, const std::vector<std::string> &block_names);

  bool at_rest() const { return regions.empty(); }

  /// state.half_velocity of the owned nodes, without regard to constraints. Collective.
  void apply(const Dynamics<dim> &, State<dim> &) const;

  /// Lines for the log.
  std::string description() const;

private:
  struct Region
  {
    std::string        name, block, text;
    unsigned int       block_index = all_blocks;
    PlaceFormulas<dim> velocity;
  };
  static constexpr unsigned int all_blocks = dealii::numbers::invalid_unsigned_int;

  std::vector<std::string>             names;
  std::vector<std::unique_ptr<Region>> regions; ///< the entries bind to their members
  std::string                          path;
};
} // namespace Arenite
