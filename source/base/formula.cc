#include <arenite/base/formula.h>
#include <arenite/base/values.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <iostream>

namespace Arenite
{
namespace
{
/// The sentence of muParser in the long message of deal.II.
std::string reason_of(const std::string &message, const std::string &variables)
{
  const std::string introduction = "The parser said: ";
  const std::size_t begin        = message.find(introduction);
  if (begin == std::string::npos)
    return "not a formula in " + variables + ".";
  const std::string sentence = message.substr(begin + introduction.size());
  return dealii::Utilities::trim(sentence.substr(0, sentence.find('\n')));
}

/// deal.II prints what it also throws.
struct MutedErrorStream
{
  MutedErrorStream()
    : buffer(std::cerr.rdbuf(nullptr))
  {}
  ~MutedErrorStream() { std::cerr.rdbuf(buffer); }
  std::streambuf *buffer;
};
} // namespace

template <int n_variables>
std::string Formulas<n_variables>::read(const std::vector<std::string> &texts, const std::string &variables)
{
  const MutedErrorStream muted;
  try
    {
      function = std::make_unique<dealii::FunctionParser<n_variables>>(texts.size());
      function->initialize(variables, texts, {{"pi", dealii::numbers::PI}}, false);
      for (unsigned int i = 0; i < texts.size(); ++i) // muParser reads a formula at its first use
        function->value(dealii::Point<n_variables>(), i);
    }
  catch (const dealii::ExceptionBase &exception)
    {
      return reason_of(exception.what(), variables);
    }
  return "";
}

template <int dim>
std::string PlaceFormulas<dim>::read(const std::string &text)
{
  const std::vector<std::string> texts = split_list(text, ';');
  if (texts.size() != dim)
    return "needs " + std::to_string(dim) + (dim == 1 ? " formula" : " formulas separated by semicolons") +
           " in x, y, z.";
  for (const std::string &formula : texts)
    if (formula.empty())
      return "has an empty formula; write 0 for a component that vanishes.";
  return formulas.read(texts, "x,y,z");
}

template <int dim>
dealii::Tensor<1, dim> PlaceFormulas<dim>::value(const dealii::Point<dim> &x) const
{
  dealii::Point<3> place;
  for (unsigned int d = 0; d < dim; ++d)
    place[d] = x[d];
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = formulas.value(place, d);
  return result;
}

template <int dim>
std::string place_formula_rules()
{
  return std::string(dim == 1 ? "one formula" : "one formula per component, separated by semicolons,") +
         " of the coordinates x, y, z, which keep these names in all symmetries (x is the radius of axisymmetric and "
         "spherical meshes, y the height of axisymmetric ones); pi is known";
}

#define ARENITE_INSTANTIATE(dim)     \
  template class Formulas<dim>;      \
  template class PlaceFormulas<dim>; \
  template std::string place_formula_rules<dim>();
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
