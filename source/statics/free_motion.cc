#include <arenite/statics/free_motion.h>

namespace Arenite
{
using namespace dealii;

template <int dim>
void FreeMotion<dim>::reinit(const Discretization<dim> &discretization, const Constraints<dim> &constraints)
{
  this->discretization = &discretization;
  projectors           = constraints.freedom();
}

template <int dim>
void FreeMotion<dim>::project(VectorType &vector) const
{
  for (const auto &[node, P] : projectors)
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = vector.local_element(dim * node + c);
      value = P * value;
      for (unsigned int c = 0; c < dim; ++c)
        vector.local_element(dim * node + c) = value[c];
    }
  zero_at_hanging_nodes(*discretization, vector);
}

template <int dim>
std::vector<Tensor<2, dim>> FreeMotion<dim>::of_local_nodes() const
{
  std::vector<Tensor<2, dim>> result(discretization->n_local_nodes());
  for (unsigned int column = 0; column < dim; ++column)
    {
      VectorType values = discretization->new_vector();
      for (unsigned int node = 0; node < discretization->n_owned_nodes(); ++node)
        values.local_element(dim * node + column) = 1.;
      for (const auto &[node, P] : projectors)
        for (unsigned int c = 0; c < dim; ++c)
          values.local_element(dim * node + c) = P[c][column];
      values.update_ghost_values();
      for (unsigned int node = 0; node < result.size(); ++node)
        for (unsigned int c = 0; c < dim; ++c)
          result[node][c][column] = values.local_element(dim * node + c);
    }
  return result;
}

template class FreeMotion<1>;
template class FreeMotion<2>;
template class FreeMotion<3>;
} // namespace Arenite
