#pragma once

#include <arenite/base/parameters.h>
#include <arenite/io/files.h>
#include <arenite/mesh/geometry.h>
#include <arenite/time/dynamics.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace Arenite
{
class StateArchive;

/// One set of receivers of a balance: the forces on boundaries of the body, or the momentum in a box of it, over the time of a run.
///
///   Type = surface   Boundary          force, impulse, pressure, impulse per area, mean velocity
///   Type = box       Corner, Opposite corner   mass, momentum
///
/// The force on a surface is what acts on the body from outside there: nodal forces of loads and dashpots, reactions of planes, fixed
/// boundaries and prescribed motions. A free surface has none. These are the forces that move the nodes, so their sum over all boundaries and
/// what acts inside is the change of momentum to round-off; the traction sigma n of the cells at a boundary tends to the same, but carries the error
/// of the stresses there. The impulse is that of the central differences, the sum of the forces times the mean steps:
///
///   J_n = J_{n-1} + dt_{n-1}/2 (F_{n-1} + F_n).
///
/// All numbers are those of the modelled part, areas those of the undeformed body.
template <int dim>
class BalanceReceiver
{
public:
  explicit BalanceReceiver(const std::string &name)
    : name(name)
  {}

  /// Entries of the current section; @p type is surface or box.
  void declare_parameters(Parameters &, const std::string &type);
  void finalize(const Parameters &, const Geometry<dim> &);

  /// Nodes of the present mesh. @p dynamics must outlive the next reinit(). Collective.
  void reinit(Dynamics<dim> &dynamics);

  /// Collective.
  void open(const std::string &directory, double end_time, FileStart);

  /// In every step, between close_force() and advance(). Collective when it flushes.
  void record(const State<dim> &);

  /// Write what the buffer holds, and what a resumed run needs. Collective.
  void exchange(StateArchive &);

  /// Collective.
  void finish();

  const std::string &set_name() const { return name; }

  /// "pressure.peak", "impulse per area.last": over the rows, after finish().
  std::map<std::string, double> norms() const;

private:
  bool                     on_surface() const { return type == "surface"; }
  bool                     due(double time);
  std::vector<std::string> columns() const;
  void                     add_row(const State<dim> &);
  void                     find_share();
  void                     flush();

  const std::string                       name;
  std::string                             path, type, file_name;
  std::vector<std::string>                boundary_names;
  std::vector<dealii::types::boundary_id> ids;
  dealii::Tensor<1, dim>                  corner, opposite;
  double                                  interval = 0., end_time = 0.;

  Dynamics<dim> *dynamics = nullptr;
  struct Face
  {
    unsigned int           node;
    double                 size; ///< [m^2]
    dealii::Tensor<1, dim> area; ///< n dS
  };
  std::vector<Face>                            faces; ///< owned nodes of a surface
  std::vector<std::pair<unsigned int, double>> share; ///< of the mass of an owned node, in a box

  // of this process
  Resultant<dim> last, impulse;
  unsigned int   last_step   = dealii::numbers::invalid_unsigned_int;
  unsigned int   next_output = 0;
  double         peak = 0., at_end = 0.; ///< of the pressure, of the impulse per area

  std::vector<double> times, buffer;
  std::ofstream       file;
};
} // namespace Arenite
