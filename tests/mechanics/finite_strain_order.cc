// Order of the elements at finite strain: a manufactured motion of a neo-Hookean solid.

#include <arenite/loads/body_force.h>
#include <arenite/materials/elasticity_at_rest.h>

#include <deal.II/base/quadrature_lib.h>

#include "law_body.h"

using namespace Arenite;
using namespace Arenite::Test;

namespace
{
/// u_i = A_i sin(w t) prod_d cos(k X_d + i + d), strains up to some 20 %. The body force per reference volume is rho_0 u'' - Div P with
/// P = mu (F - F^-T) + lambda ln J F^-T; the divergence by central differences of P over 2e-4, with an error of 1e-8 of it.
template <int dim>
class LargeMotion : public ExactSolution<dim>
{
public:
  explicit LargeMotion(const LinearElastic &law)
    : law(law)
  {}

  Tensor<1, dim> displacement(const Point<dim> &X, const double t) const override
  {
    return std::sin(frequency * t) * shape(X);
  }
  Tensor<1, dim> velocity(const Point<dim> &X, const double t) const override
  {
    return frequency * std::cos(frequency * t) * shape(X);
  }
  SymmetricTensor<2, 3> stress(const Point<dim> &, double) const override { return {}; }

  Tensor<1, dim> body_force(const Point<dim> &X, const double t) const override
  {
    constexpr double d = 1e-4;
    Tensor<1, dim>   f = -law.density * frequency * frequency * displacement(X, t);
    for (unsigned int j = 0; j < dim; ++j)
      {
        Point<dim> plus = X, minus = X;
        plus[j] += d;
        minus[j] -= d;
        const Tensor<2, dim> slope = (piola(plus, t) - piola(minus, t)) / (2. * d);
        for (unsigned int i = 0; i < dim; ++i)
          f[i] -= slope[i][j];
      }
    return f;
  }
  bool has_body_force() const override { return true; }

private:
  Tensor<1, dim> shape(const Point<dim> &X) const
  {
    Tensor<1, dim> u;
    for (unsigned int i = 0; i < dim; ++i)
      {
        u[i] = 0.08 - 0.02 * i;
        for (unsigned int d = 0; d < dim; ++d)
          u[i] *= std::cos(k * X[d] + i + d);
      }
    return u;
  }

  Tensor<2, dim> piola(const Point<dim> &X, const double t) const
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          double value = (0.08 - 0.02 * i) * std::sin(frequency * t);
          for (unsigned int d = 0; d < dim; ++d)
            value *= d == j ? -k * std::sin(k * X[d] + i + d) : std::cos(k * X[d] + i + d);
          F[i][j] = value + (i == j ? 1. : 0.);
        }
    const Tensor<2, dim> inverse_transposed = transpose(invert(F));
    return law.shear_modulus * (F - inverse_transposed) +
           law.lame_lambda() * std::log(determinant(F)) * inverse_transposed;
  }

  static constexpr double k = 2., frequency = 600.;
  const LinearElastic     law;
};

/// Relative L2 error of the displacement at the end of a tenth of the period, on n^dim cells with prescribed boundaries.
template <int dim>
double error(const ElementChoice &choice, const unsigned int n)
{
  auto                                             law     = example_law(native_lanes, "neo hookean", "soil");
  const auto                                       elastic = elasticity_at_rest(*law);
  const auto                                       exact   = std::make_shared<LargeMotion<dim>>(elastic);
  LawBody<dim>                                     body(choice, "finite strain", std::move(law),
                                                        [n](auto &triangulation) { GridGenerator::subdivided_hyper_cube(triangulation, n); });
  std::vector<std::unique_ptr<InternalForce<dim>>> blocks = std::move(body.dynamics->blocks);
  std::vector<std::unique_ptr<Load<dim>>>          loads;
  loads.push_back(std::make_unique<BodyForce<dim>>(exact));
  body.constraints.set_exact({0}, exact.get());
  body.dynamics = std::make_unique<Dynamics<dim>>(body.discretization, std::move(blocks), std::move(loads),
                                                  body.constraints, [elastic](types::material_id) { return elastic; });
  body.dynamics->reinit(body.state);
  body.set(body.state.half_velocity, [&](const Point<dim> &X) { return exact->velocity(X, 0.); });
  StableTimeStep<dim> limit;
  limit.calibrate(*body.dynamics);
  const double       end   = 0.1 * 2. * numbers::PI / 600.;
  const unsigned int steps = std::ceil(end / std::min(0.3 * limit.limit(), end / 400.));
  const double       step  = end / steps;
  for (unsigned int s = 0; s < steps; ++s)
    {
      body.dynamics->compute_force(body.state);
      body.dynamics->close_force(body.state, step);
      body.dynamics->advance(body.state, step);
    }
  make_consistent(body.discretization, body.state.displacement);
  CellFields<dim>   fields(body.discretization);
  const QGauss<dim> rule(choice.degree + 3);
  double            wrong = 0., all = 0.;
  for (unsigned int cell = 0; cell < body.discretization.cells().size(); ++cell)
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const auto           factors = fields.shape(rule.point(q));
        const Tensor<1, dim> u       = exact->displacement(fields.position(cell, factors), end);
        wrong += rule.weight(q) * (fields.value(body.state.displacement, cell, factors) - u).norm_square();
        all += rule.weight(q) * u.norm_square();
      }
  return std::sqrt(wrong / all);
}
} // namespace

BOOST_AUTO_TEST_SUITE(finite_strain_order)

// p + 0.8 between the two finer of three meshes; errors in time are below 1e-6.
BOOST_AUTO_TEST_CASE(neo_hookean)
{
  for (const ElementChoice &choice : elements_for_laws())
    {
      const unsigned int n    = choice.degree == 1 ? 8 : (choice.degree == 2 ? 4 : 2);
      const double       fine = error<2>(choice, 2 * n), coarse = error<2>(choice, n);
      const double       order = std::log2(coarse / fine);
      BOOST_TEST_MESSAGE(choice.type << " of degree " << choice.degree << ' ' << choice.volumetric_strain << ": "
                                     << coarse << ", " << fine << ", order " << order);
      BOOST_TEST(order > choice.degree + 0.8, choice.type << " of degree " << choice.degree << ": " << order);
    }
  BOOST_TEST(std::log2(error<1>(elements_for_laws()[2], 4) / error<1>(elements_for_laws()[2], 8)) > 2.8);
  BOOST_TEST(std::log2(error<3>(elements_for_laws()[2], 2) / error<3>(elements_for_laws()[2], 4)) > 2.8);
}

BOOST_AUTO_TEST_SUITE_END()
