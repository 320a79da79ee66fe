#pragma once

#include <deal.II/base/function_parser.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// Formulas that a user writes, read by muParser: one number each, of variables that share a point; pi is known.
template <int n_variables>
class Formulas
{
public:
  /// Reads @p texts in the variables "x,y,z". What is wrong with them, or nothing.
  std::string read(const std::vector<std::string> &texts, const std::string &variables);

  /// NaN or infinite where a formula is.
  double value(const dealii::Point<n_variables> &at, const unsigned int component = 0) const
  {
    return function->value(at, component);
  }

private:
  std::unique_ptr<dealii::FunctionParser<n_variables>> function;
};

/// A vector or place as formulas of the place in the mesh, "-545*(0.08/x)^2; 0". The coordinates are called x, y, z in all symmetries.
template <int dim>
class PlaceFormulas
{
public:
  /// One formula for each of dim components, separated by semicolons. What is wrong with them, or nothing.
  std::string read(const std::string &text);

  dealii::Tensor<1, dim> value(const dealii::Point<dim> &x) const;

private:
  Formulas<3> formulas;
};

/// How to write PlaceFormulas in dim dimensions, for the manual.
template <int dim>
std::string place_formula_rules();
} // namespace Arenite
