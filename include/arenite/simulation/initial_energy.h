#pragma once

#include <arenite/base/formula.h>
#include <arenite/time/dynamics.h>

#include <string>

namespace Arenite
{
/// Internal energy at t = 0 as a formula of the place, `set Internal energy` of `subsection Initial conditions`: for laws whose history
/// has an `internal energy`, taken at the centre of each cell. A blast is a hot cell.
template <int dim>
class InitialEnergy
{
public:
  /// In the open section.
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// InputError if no block has an internal energy. Collective.
  void apply(const Dynamics<dim> &, State<dim> &) const;

private:
  std::string text, path;
  Formulas<3> formula;
};
} // namespace Arenite
