#include <arenite/io/error_norms.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Arenite
{
using namespace dealii;

namespace
{
double relative(const double error, const double exact)
{
  if (exact > 0.)
    return error / exact;
  return error > 0. ? std::numeric_limits<double>::infinity() : 0.;
}
} // namespace

template <int dim>
std::map<std::string, double> volume_errors(const Discretization<dim> &discretization, const MaterialOfBlock &material,
                                            const VectorType &displacement, const VectorType &velocity,
                                            const ExactSolution<dim> &exact, const double time)
{
  const CellFields<dim>          fields(discretization);
  const QGauss<dim>              rule(discretization.degree() + 2);
  std::vector<ShapeFactors<dim>> factors;
  for (const Point<dim> &xi : rule.get_points())
    factors.push_back(fields.shape(xi));

  std::vector<double> error(3, 0.), norm(3, 0.), error_sum(3), norm_sum(3);
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      const LinearElastic law = material(discretization.cells()[cell]->material_id());
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Tensor<2, dim> J      = fields.jacobian(cell, factors[q]);
          const Point<dim>     x      = fields.position(cell, factors[q]);
          const double         volume = rule.weight(q) * determinant(J) * measure(discretization.symmetry, x);
          const auto           add    = [&](const unsigned int k, const auto &computed, const auto &known) {
            error[k] += volume * ((computed - known) * (computed - known));
            norm[k] += volume * (known * known);
          };
          add(0, fields.value(displacement, cell, factors[q]), exact.displacement(x, time));
          add(1, fields.value(velocity, cell, factors[q]), exact.velocity(x, time));
          add(2, fields.stress(law, displacement, cell, factors[q]), exact.stress(x, time));
        }
    }
  Utilities::MPI::sum(error, discretization.communicator, error_sum);
  Utilities::MPI::sum(norm, discretization.communicator, norm_sum);
  std::map<std::string, double> result;
  for (unsigned int k = 0; k < 3; ++k)
    result[std::string("volume.") +
           (k == 0   ? "displacement"
            : k == 1 ? "velocity"
                     : "stress") +
           ".E_x"] = std::sqrt(relative(error_sum[k], norm_sum[k]));
  return result;
}

template <int dim>
std::map<std::string, double> traction_error(const Discretization<dim> &discretization, const MaterialOfBlock &material,
                                             const VectorType &displacement, const std::vector<types::boundary_id> &ids,
                                             const ExactSolution<dim> &exact, const double time)
{
  const CellFields<dim> fields(discretization);
  const QGauss<dim - 1> rule(discretization.degree() + 2);
  double                error = 0., largest = 0.;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    for (const unsigned int f : discretization.cells()[cell]->face_indices())
      {
        const auto &face = discretization.cells()[cell]->face(f);
        if (!face->at_boundary() || std::find(ids.begin(), ids.end(), face->boundary_id()) == ids.end())
          continue;
        const LinearElastic law = material(discretization.cells()[cell]->material_id());
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point<dim> xi;
            for (unsigned int d = 0, k = 0; d < dim; ++d)
              xi[d] = d == f / 2 ? f % 2 : rule.point(q)[k++];
            const auto     factors = fields.shape(xi);
            Tensor<1, dim> unit_normal;
            unit_normal[f / 2] = f % 2 ? 1. : -1.;
            Tensor<1, dim> n   = transpose(invert(fields.jacobian(cell, factors))) * unit_normal;
            n /= n.norm();
            const auto     known = exact.stress(fields.position(cell, factors), time);
            const auto     wrong = fields.stress(law, displacement, cell, factors) - known;
            Tensor<1, dim> traction;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                traction[i] += wrong[i][j] * n[j];
            error   = std::max(error, traction.norm());
            largest = std::max(largest, known.norm());
          }
      }
  return {{"boundary.traction.E_inf", relative(Utilities::MPI::max(error, discretization.communicator),
                                               Utilities::MPI::max(largest, discretization.communicator))}};
}

#define ARENITE_INSTANTIATE(dim)                                                                                     \
  template std::map<std::string, double> volume_errors(const Discretization<dim> &, const MaterialOfBlock &,         \
                                                       const VectorType &, const VectorType &,                       \
                                                       const ExactSolution<dim> &, double);                          \
  template std::map<std::string, double> traction_error(const Discretization<dim> &, const MaterialOfBlock &,        \
                                                        const VectorType &, const std::vector<types::boundary_id> &, \
                                                        const ExactSolution<dim> &, double);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
