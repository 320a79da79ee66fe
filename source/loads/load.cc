#include <arenite/loads/absorbing.h>
#include <arenite/loads/gas_pressure.h>
#include <arenite/loads/load.h>
#include <arenite/loads/nodal_force.h>

namespace Arenite
{
namespace
{
template <int dim>
Registry<Load<dim>> make_loads()
{
  Registry<Load<dim>> registry("load");
  registry.template add<Pressure<dim>>("pressure", "Pressure history on named boundaries.");
  registry.template add<GasPressure<dim>>("gas pressure",
                                          "Gas that fills a cavity, by the volume that the wall leaves it.");
  registry.template add<Gravity<dim>>("gravity", "Acceleration of the whole body.");
  registry.template add<AbsorbingBoundary<dim>>("absorbing boundary",
                                                "Dashpots, or the exact condition for spherical waves.");
  registry.template add<Sponge<dim>>("sponge", "Layer in which waves die out.");
  return registry;
}
} // namespace

template <int dim>
const Registry<Load<dim>> &loads()
{
  static const Registry<Load<dim>> registry = make_loads<dim>();
  return registry;
}

void HistoryChoice::declare_parameters(Parameters &parameters, const std::string &unit)
{
  kind = parameters.peek_choice(parameters.current_path() + "/History", kind, time_history_names());
  parameters.add_choice("History", kind, time_history_names(),
                        "Function of time by name; its entries follow. Amplitudes in " + unit + ".");
  history = make_time_history(kind);
  history->declare_parameters(parameters);
}

void HistoryChoice::finalize() { history->finalize(); }

template const Registry<Load<1>> &loads<1>();
template const Registry<Load<2>> &loads<2>();
template const Registry<Load<3>> &loads<3>();
} // namespace Arenite
