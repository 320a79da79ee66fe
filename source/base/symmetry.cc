#include <arenite/base/symmetry.h>

#include <cmath>

namespace Arenite
{
const std::vector<std::string> &symmetry_names()
{
  static const std::vector<std::string> names{"none", "plane strain", "axisymmetric", "plane wave", "spherical"};
  return names;
}

std::string name(const Symmetry symmetry) { return symmetry_names()[static_cast<unsigned int>(symmetry)]; }

DimensionChoice::DimensionChoice(const Parameters &parameters)
{
  dimension              = parameters.peek_choice("Dimension", "3", {"1", "2", "3"})[0] - '0';
  const std::string word = parameters.peek_choice("Symmetry", "none", symmetry_names());
  for (unsigned int i = 0; i < symmetry_names().size(); ++i)
    if (symmetry_names()[i] == word)
      symmetry = static_cast<Symmetry>(i);
  const bool plane = symmetry == Symmetry::plane_strain || symmetry == Symmetry::axisymmetric;
  if (dimension != (symmetry == Symmetry::none ? 3 : (plane ? 2 : 1)))
    parameters.refuse(parameters.is_set("Symmetry") ? "Symmetry" : "Dimension",
                      std::string("three dimensions have no symmetry, two need 'plane strain' or 'axisymmetric', one "
                                  "needs 'plane wave' or 'spherical'; Dimension is ") +
                        std::to_string(dimension) + " and Symmetry '" + word + "'.");
}

const char *direction_letters(const Symmetry symmetry)
{
  return symmetry == Symmetry::axisymmetric ? "rzt" : (symmetry == Symmetry::spherical ? "rtp" : "xyz");
}

std::string per_extent(const Symmetry symmetry)
{
  return symmetry == Symmetry::plane_strain ? "/m" : (symmetry == Symmetry::plane_wave ? "/m^2" : "");
}

template <int dim>
dealii::Point<dim> reduce(const Symmetry symmetry, const dealii::Point<3> &x)
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = x[d];
  if (symmetry == Symmetry::spherical)
    result[0] = x.norm();
  else if (symmetry == Symmetry::axisymmetric)
    {
      result[0]       = std::hypot(x[0], x[1]);
      result[dim - 1] = x[2];
    }
  return result;
}

template dealii::Point<1> reduce(Symmetry, const dealii::Point<3> &);
template dealii::Point<2> reduce(Symmetry, const dealii::Point<3> &);
template dealii::Point<3> reduce(Symmetry, const dealii::Point<3> &);
} // namespace Arenite
