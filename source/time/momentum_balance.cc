#include <arenite/base/state_archive.h>
#include <arenite/time/momentum_balance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void MomentumBalance<dim>::set_names(const std::vector<std::string> &new_names)
{
  names = new_names;
  forces.assign(names.size(), {});
  impulses.assign(names.size(), {});
}

namespace
{
/// Of the nodes of this process at t_n: sum of m v, then that of m |v_c| over the components with a balance.
template <int dim>
std::vector<double> momentum_of_nodes(const State<dim> &state, const VectorType &mass, const unsigned int first)
{
  std::vector<double> sums(dim + 1, 0.);
  const double        half_step = 0.5 * state.dt_last;
  for (unsigned int node = 0; node < mass.locally_owned_size(); ++node)
    for (unsigned int c = first; c < dim; ++c)
      {
        const unsigned int i = dim * node + c;
        const double       p =
          mass.local_element(node) * state.half_velocity.local_element(i) + half_step * state.force.local_element(i);
        sums[c] += p;
        sums[dim] += std::abs(p);
      }
  return sums;
}
} // namespace

template <int dim>
void MomentumBalance<dim>::set_initial(const State<dim> &state, const VectorType &mass, const MPI_Comm communicator)
{
  std::vector<double> sums = momentum_of_nodes(state, mass, 0);
  Utilities::MPI::sum(sums, communicator, sums);
  for (unsigned int c = 0; c < dim; ++c)
    initial[c] = sums[c];
}

template <int dim>
MomentumLedger MomentumBalance<dim>::report(const State<dim> &state, const VectorType &mass, const Symmetry symmetry,
                                            const MPI_Comm communicator)
{
  MomentumLedger     ledger;
  const unsigned int first = n_hoop_directions(symmetry) > 0 ? 1 : 0;
  if (first == dim)
    return ledger;
  std::vector<double> sums = momentum_of_nodes(state, mass, first);
  for (std::size_t i = 0; i < names.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      sums.push_back(impulses[i][c] + 0.5 * state.dt_last * forces[i][c]);
  Utilities::MPI::sum(sums, communicator, sums);
  ledger.scale  = sums[dim];
  double square = 0.;
  for (unsigned int c = first; c < dim; ++c)
    {
      const std::string along = std::string("_") + direction_letters(symmetry)[c];
      double            rest  = sums[c] - initial[c] - adaptation[c];
      ledger.columns.emplace_back("momentum" + along, sums[c]);
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          const double impulse = sums[dim + 1 + i * dim + c];
          ledger.columns.emplace_back("impulse" + along + " of " + names[i], impulse);
          ledger.scale = std::max(ledger.scale, std::abs(impulse));
          rest -= impulse;
        }
      ledger.columns.emplace_back("momentum" + along + " of adaptation", adaptation[c]);
      square += rest * rest;
    }
  ledger.imbalance  = std::sqrt(square);
  largest_imbalance = std::max(largest_imbalance, ledger.imbalance);
  largest_scale     = std::max(largest_scale, ledger.scale);
  return ledger;
}

template <int dim>
void MomentumBalance<dim>::exchange(StateArchive &archive)
{
  for (Tensor<1, dim> &impulse : impulses)
    for (unsigned int c = 0; c < dim; ++c)
      archive.sum(impulse[c]);
  for (unsigned int c = 0; c < dim; ++c)
    {
      archive.common(adaptation[c]);
      archive.common(initial[c]);
    }
  archive.common(largest_imbalance);
  archive.common(largest_scale);
}

template class MomentumBalance<1>;
template class MomentumBalance<2>;
template class MomentumBalance<3>;
} // namespace Arenite
