#pragma once

#include <arenite/io/balance_receiver.h>
#include <arenite/io/receiver_history.h>
#include <arenite/io/receiver_points.h>
#include <arenite/io/receiver_store.h>
#include <arenite/mechanics/state.h>

#include <list>

namespace Arenite
{
/// InternalForce::point_values() of an owned cell of any block, and their names; without it all stresses follow from displacements.
template <int dim>
struct StoredPointValues
{
  std::function<bool(const State<dim> &, unsigned int cell, std::vector<double> &values)> values;
  std::vector<std::string>                                                                names{"density [kg/m^3]"};
};

/// One set of receivers: displacement, velocity, stress and what points store at fixed material points over the time of a run.
///
/// Values are means over all cells that touch a point, so they do not depend on the partition; displacements are continuous
/// anyway. Each process adds up what its cells contribute; the sum over processes is only formed when the buffer is full, and so
/// is everything that follows from it: velocities, exact solutions, text. Of a table process 0 gets the sums of all points; of a
/// line or plane each process gets those of its share of the points. The buffer is allocated once.
template <int dim>
class Receivers
{
public:
  explicit Receivers(const std::string &name);

  /// Entries of the current section.
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// Locate the points, at the start and after every change of the mesh. Differences of displacements do not cross the change:
  /// the next record() starts anew from the half-step velocity of the state. Rows in the buffer stay. Collective.
  void reinit(const Discretization<dim> &, const MaterialOfBlock &, const StoredPointValues<dim> & = {});

  /// Create the files in @p directory; after the first reinit(). @p exact may be null. Collective. Lines and planes share the
  /// store, whose file is created when all of them are known.
  void open(const std::string &directory, double start_time, double end_time, const ExactSolution<dim> *exact,
            std::shared_ptr<ReceiverStore> &store, FileStart);

  /// At every t_n after the forces were computed (displacement with valid ghosts, half_velocity = v_{n-1/2}), also at the end
  /// time; once more at the same t_n after a change of the mesh if the forces are computed again. Collective when it flushes.
  void record(const State<dim> &);

  /// Write what the buffer holds, then everything that a resumed run needs to go on as if nothing had happened. Between two calls of
  /// record(), or after open() before the first. Collective.
  void exchange(StateArchive &);

  /// Complete the last row, write everything that is left and close the file; also before the program ends with an alarm.
  /// Collective.
  void finish();

  /// "<set>.<quantity>.E_t", on all processes after finish(); empty without exact solution.
  const std::map<std::string, double> &errors() const { return error_map; }

  const std::string &set_name() const { return name; }

  /// "<quantity>.rms|peak", on all processes after finish().
  const std::map<std::string, double> &norms() const { return norm_map; }

  const std::vector<dealii::Point<dim>> &positions() const { return location.positions; }

  /// Wall time of what is done when the buffer is full [s].
  double output_seconds() const { return seconds; }

private:
  enum class Kind : unsigned char
  {
    half_velocity, ///< v_{n-1/2}: a chain of differences begins
    auxiliary,     ///< u_n, to complete the velocity of a row
    row
  };
  struct Header
  {
    Kind         kind;
    unsigned int step;
    double       time, dt;
  };

  bool due(const State<dim> &);
  void push(Kind, const VectorType &, const State<dim> &);
  void add_stored(unsigned int contact, const dealii::Tensor<1, dim> &u, const State<dim> &, double *values);
  void flush();
  std::vector<double> sums_of_own_points() const;
  void                process(const std::vector<double> &sums);
  void                emit(const ReceiverRow<dim> &);
  void                write_errors();

  const std::string        name;
  std::string              path, directory;
  ReceiverPoints<dim>      points;
  std::vector<std::string> quantity_names{"displacement", "velocity", "stress"};
  ReceiverQuantities       quantities;
  double                   interval = 0., end_time = 0.;

  const Discretization<dim>       *discretization = nullptr;
  std::unique_ptr<CellFields<dim>> fields;
  PointLocation<dim>               location;
  std::vector<LinearElastic>       materials; ///< per contact
  StoredPointValues<dim>           stored_values;
  std::vector<double>              values_of_cell;
  bool                             with_density = false, with_history = false;
  VectorType                       velocity; ///< consistent copy of v_{n-1/2}

  // buffer of partial sums: [header][point][u, stress, scalars]
  std::vector<Header> headers;
  std::vector<double> buffer;
  unsigned int        n_values = 0, capacity = 0;

  unsigned int next_output = 0; ///< the next row is due at next_output * interval
  unsigned int last_step   = dealii::numbers::invalid_unsigned_int;
  bool         chained     = false; ///< the last record() put u of the step before into the buffer
  bool         row_is_open = false; ///< the last row still needs u of the next step
  double       seconds     = 0.;    ///< in flush()

  // of the points of this process
  unsigned int                       n_own_points = 0;
  VelocityHistory<dim>               history;
  ReceiverErrors<dim>                error_integrals;
  bool                               with_errors = false;
  std::unique_ptr<ReceiverFile<dim>> file;
  ReceiverNorms<dim>                 signal_norms;
  std::map<std::string, double>      error_map, norm_map;
};

/// All sets of a scene: the list `Receivers` at the top level and a section `Receivers / <name>` for each.
template <int dim>
class ReceiverSets
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);
  void finalize(const Parameters &, const Geometry<dim> &);
  /// Of points alone, of a motion that comes from anywhere.
  void reinit(const Discretization<dim> &, const MaterialOfBlock &, const StoredPointValues<dim> & = {});
  void reinit(Dynamics<dim> &, const StoredPointValues<dim> & = {});
  /// @p start: whether files are created, or there already; exchange() must follow then.
  void open(const std::string &directory, double start_time, double end_time, const ExactSolution<dim> *exact,
            FileStart start = FileStart::fresh);
  void exchange(StateArchive &);
  void record(const State<dim> &);
  void finish();

  std::map<std::string, double> errors() const;
  std::map<std::string, double> norms() const;
  double                        output_seconds() const; ///< of all sets

  /// Whether some sets are balances of steps.
  bool has_balances() const { return !balances.empty(); }

private:
  std::vector<std::string>                     names;
  std::shared_ptr<ReceiverStore>               store; // before the sets, which close their groups first
  std::vector<std::unique_ptr<Receivers<dim>>> sets;

  std::list<std::string>                             types; ///< what `set Type` of a balance binds to
  std::vector<std::unique_ptr<BalanceReceiver<dim>>> balances;
};
} // namespace Arenite
