#pragma once

#include <arenite/base/symmetry.h>
#include <arenite/base/time_history.h>
#include <arenite/verification/exact_solution.h>

#include <memory>
#include <string>

namespace Arenite
{
/// `subsection Verification`: the exact solution that a run is measured against. Made after parsing, because it needs the
/// material and the pressure history of the scene.
template <int dim>
class SolutionChoice
{
public:
  void declare_parameters(Parameters &);

  /// Null for 'none'. @p pressure: the history of the scene's first pressure load, or null. Refuses a solution that the symmetry
  /// does not allow.
  std::shared_ptr<const ExactSolution<dim>> make(const Parameters &, const LinearElastic &,
                                                 std::shared_ptr<const TimeHistory> pressure, Symmetry) const;

private:
  bool fits(Symmetry) const;

  std::string  type         = "none";
  double       inner_radius = 0.1, load_radius = 0.1, depth = 0.5, outer_radius = 1., side = 1.;
  double       frequency = 1000., amplitude = 1e-3;
  unsigned int mode = 1;
};
} // namespace Arenite
