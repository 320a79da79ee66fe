#include <arenite/mechanics/kinematics.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

namespace Arenite
{
using namespace dealii;

std::vector<double> even_line_weights(const unsigned int degree)
{
  const auto          basis = Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
  std::vector<double> slope, value_and_derivative(2);
  for (const auto &polynomial : basis)
    {
      polynomial.value(0., value_and_derivative);
      slope.push_back(value_and_derivative[1]);
    }
  std::vector<double> weights(degree + 1, 0.);
  for (unsigned int m = 1; m <= degree; ++m)
    weights[m] = -slope[m] / slope[0];
  return weights;
}
} // namespace Arenite
