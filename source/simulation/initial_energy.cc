#include <arenite/simulation/initial_energy.h>

#include <cmath>

namespace Arenite
{
using namespace dealii;

template <int dim>
void InitialEnergy<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path() + "/Internal energy";
  parameters.add_text("Internal energy", text,
                      "Formula of x, y, z [J/kg] for laws with an internal energy (ideal gas, mie grueneisen), taken "
                      "at the centre of each "
                      "cell; empty: zero. Example of a blast: if(x < 0.01, 1e6, 0)");
}

template <int dim>
void InitialEnergy<dim>::finalize(const Parameters &parameters)
{
  if (text.empty())
    return;
  if (const std::string complaint = formula.read({text}, "x,y,z"); !complaint.empty())
    parameters.refuse(path, complaint);
}

template <int dim>
void InitialEnergy<dim>::apply(const Dynamics<dim> &dynamics, State<dim> &state) const
{
  if (text.empty())
    return;
  const Discretization<dim> &discretization = dynamics.discretization;
  bool                       found = false, finite = true, zero = true;
  const auto                 value = [&](const unsigned int cell) {
    std::vector<Point<dim>> x;
    discretization.cell_positions(cell, x);
    Point<3> centre;
    for (const Point<dim> &node : x)
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] += node[d] / x.size();
    const double energy = formula.value(centre);
    finite              = finite && std::isfinite(energy);
    zero                = zero && energy == 0.;
    return energy;
  };
  for (unsigned int b = 0; b < dynamics.blocks.size(); ++b)
    found = dynamics.blocks[b]->set_history(state.blocks[b], "internal energy", value) || found;
  if (!found)
    throw InputError("[Initial conditions] Internal energy = " + text +
                     ": no block has a law with an internal energy.");
  if (Utilities::MPI::min(finite ? 1 : 0, discretization.communicator) == 0)
    throw InputError("[Initial conditions] Internal energy = " + text + ": is not a number in some cells.");
  if (Utilities::MPI::min(zero ? 1 : 0, discretization.communicator) == 1)
    throw InputError("[Initial conditions] Internal energy = " + text +
                     ": is zero at the centres of all cells. Refine the mesh there, or heat a larger region.");
}

template class InitialEnergy<1>;
template class InitialEnergy<2>;
template class InitialEnergy<3>;
} // namespace Arenite
