#include <arenite/base/names.h>
#include <arenite/base/reduction.h>
#include <arenite/base/values.h>

#include <algorithm>

namespace Arenite
{
Reduction::Reduction(const Symmetry form)
  : form(form)
{
  changes = {"Dimension=" + std::to_string(dimension()), "Symmetry=" + name(form)};
}

unsigned int Reduction::dimension() const
{
  return form == Symmetry::spherical || form == Symmetry::plane_wave ? 1 : 2;
}

bool have_common(const Reduction::Boundaries &ids, const Reduction::Boundaries &others)
{
  return std::any_of(ids.begin(), ids.end(),
                     [&](const auto id) { return std::find(others.begin(), others.end(), id) != others.end(); });
}

bool Reduction::keeps(const Boundaries &ids) const
{
  return !have_common(ids, cut) && !have_common(ids, far) && !have_common(ids, bare);
}

template <int dim>
bool Reduction::is_symmetric(const dealii::Tensor<1, dim> &vector) const
{
  const auto zero = [&](const int d) { return d >= dim || vector[d] == 0.; };
  switch (form)
    {
    case Symmetry::spherical:
      return zero(0) && zero(1) && zero(2);
    case Symmetry::plane_wave:
      return zero(1) && zero(2);
    case Symmetry::axisymmetric:
      return zero(0) && zero(1);
    case Symmetry::plane_strain:
      return zero(2);
    default:
      return false;
    }
}

std::vector<unsigned int> Reduction::coordinates(const unsigned int dim) const
{
  if (dimension() == 1)
    return {0};
  return {0, form == Symmetry::axisymmetric ? dim - 1 : 1};
}

void Reduction::shorten(const Parameters &parameters, const std::string &path, const std::vector<std::string> &words)
{
  if (!parameters.is_set(path))
    return;
  std::vector<std::string> kept;
  for (const unsigned int d : coordinates(words.size()))
    kept.push_back(words[d]);
  changes.push_back(path + "=" + join(kept));
}

template <int dim>
void Reduction::shorten(const Parameters &parameters, const std::string &path, const dealii::Tensor<1, dim> &vector)
{
  std::vector<std::string> words;
  for (unsigned int d = 0; d < dim; ++d)
    words.push_back(to_text(vector[d]));
  shorten(parameters, path, words);
}

#define ARENITE_INSTANTIATE(dim)                                               \
  template bool Reduction::is_symmetric(const dealii::Tensor<1, dim> &) const; \
  template void Reduction::shorten(const Parameters &, const std::string &, const dealii::Tensor<1, dim> &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
