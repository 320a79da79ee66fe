#include <arenite/base/errors.h>
#include <arenite/base/names.h>
#include <arenite/base/state_archive.h>
#include <arenite/base/stopwatch.h>
#include <arenite/base/values.h>
#include <arenite/io/receivers.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr unsigned int most_rows  = 1024; // in the buffer
constexpr std::size_t  most_bytes = std::size_t(1) << 24;

// Steps that meet a multiple of the interval up to round-off count as there.
constexpr double time_tolerance = 1e-9;
} // namespace

template <int dim>
Receivers<dim>::Receivers(const std::string &name)
  : name(name)
{}

template <int dim>
void Receivers<dim>::declare_parameters(Parameters &parameters)
{
  path = parameters.current_path();
  points.declare_parameters(parameters);
  parameters.add_list(
    "Quantities", quantity_names,
    "What is written: displacement [m], velocity [m/s], stress [Pa], tension positive, density [kg/m^3]; 'history' "
    "stands for everything that points with a law of their own keep, density among it.");
  parameters.add_quantity("Interval", interval, "s", points.in_table() ? non_negative : positive,
                          "Time between two rows; a longer one gives smaller files and misses what happens between. "
                          "Zero writes every step, for Type = points only.");
  if (!points.in_table())
    parameters.require("Interval");
}

template <int dim>
void Receivers<dim>::finalize(const Parameters &parameters)
{
  points.finalize(parameters);
  const std::vector<std::string> known{"displacement", "velocity", "stress", "density", "history"};
  for (const std::string &quantity : quantity_names)
    if (std::find(known.begin(), known.end(), quantity) == known.end())
      parameters.refuse(path + "/Quantities", "'" + quantity + "' cannot be recorded." + suggestion(quantity, known));
  if (quantity_names.empty())
    parameters.refuse(path + "/Quantities", "Nothing would be recorded. Known: " + join(known) + ".");
  const auto wanted = [&](const std::string &quantity) {
    return std::find(quantity_names.begin(), quantity_names.end(), quantity) != quantity_names.end();
  };
  quantities   = {wanted("displacement"), wanted("velocity"), wanted("stress"), {}};
  with_density = wanted("density");
  with_history = wanted("history");
}

template <int dim>
void Receivers<dim>::reinit(const Discretization<dim> &new_discretization, const MaterialOfBlock &material,
                            const StoredPointValues<dim> &new_stored_values)
{
  stored_values = new_stored_values;
  quantities.scalars.clear();
  if (with_history)
    quantities.scalars = stored_values.names;
  else if (with_density)
    quantities.scalars = {stored_values.names.front()};
  n_values       = dim + (quantities.stress ? n_stress_components(dim) : 0) + quantities.scalars.size();
  discretization = &new_discretization;
  fields         = std::make_unique<CellFields<dim>>(new_discretization);
  location.reinit(*fields, points.positions, points.names, "[Receivers / " + name + "]");
  materials.clear();
  if (quantities.stress || !quantities.scalars.empty())
    for (const auto &contact : location.contacts)
      materials.push_back(material(new_discretization.cells()[contact.cell]->material_id()));
  velocity.reinit(0);
  chained = false;

  const std::size_t row_size = points.names.size() * n_values;
  capacity                   = std::clamp<std::size_t>(most_bytes / (row_size * sizeof(double)), 4, most_rows);
  headers.reserve(capacity);
  buffer.reserve(capacity * row_size);
}

template <int dim>
void Receivers<dim>::open(const std::string &directory_, const double start_time, const double end_time_,
                          const ExactSolution<dim> *exact, std::shared_ptr<ReceiverStore> &store, const FileStart start)
{
  const MPI_Comm communicator = discretization->communicator;
  directory                   = directory_;
  end_time                    = end_time_;
  next_output                 = 0;
  with_errors                 = exact != nullptr;

  const std::string stem = directory + "/receivers-" + name;
  if (points.in_table())
    {
      file = make_receiver_table<dim>(stem + ".csv", points.names, quantities, discretization->symmetry, communicator,
                                      start);
      std::string text = "name";
      for (unsigned int d = 0; d < dim; ++d)
        text += std::string(",") + direction_letters(discretization->symmetry)[d];
      text += "\n";
      for (unsigned int i = 0; i < points.names.size(); ++i)
        {
          text += points.names[i];
          for (unsigned int d = 0; d < dim; ++d)
            text += "," + to_text(location.positions[i][d]);
          text += "\n";
        }
      write_text_file(stem + "-points.csv", text, communicator);
    }
  else
    {
      if (!store)
        store = std::make_shared<ReceiverStore>(directory + "/receivers.h5", communicator);
      // rows at the first step and at every multiple of the interval that follows
      const double n_rows =
        std::floor(end_time / interval + time_tolerance) - std::floor(start_time / interval + time_tolerance) + 1.;
      if (n_rows > 1e7)
        throw InputError("[Receivers / " + name + "] Interval = " + to_text(interval) +
                         " s gives more than 1e7 rows until the end time. Is it shorter than the step?");
      file = make_receiver_group<dim>(store, name, location.positions, quantities, discretization->symmetry,
                                      std::size_t(n_rows));
    }

  const unsigned int rank        = Utilities::MPI::this_mpi_process(communicator);
  const unsigned int first_point = file->first_points[rank];
  n_own_points                   = file->first_points[rank + 1] - first_point;
  if (exact)
    error_integrals.reinit(*exact, {&points.positions[first_point], &points.positions[first_point] + n_own_points},
                           quantities);
}

template <int dim>
bool Receivers<dim>::due(const State<dim> &state)
{
  if (state.step == last_step) // again on a new mesh
    return false;
  if (interval == 0.)
    return true;
  if (state.time < (next_output - time_tolerance) * interval ||
      next_output * interval > end_time + time_tolerance * interval) // the last step may pass the end time
    return false;
  next_output = static_cast<unsigned int>(std::floor(state.time / interval + time_tolerance)) + 1;
  return true;
}

// Between two outputs of an interval nothing is evaluated. A row that does not continue a chain brings v_{n-1/2} along, the step
// after it completes the row. The last steps of a run are chained so that the last row has an acceleration.
template <int dim>
void Receivers<dim>::record(const State<dim> &state)
{
  const bool is_due = due(state), is_near_end = state.time + 2.5 * state.dt_last >= end_time;
  const bool same_step = state.step == last_step, consecutive = state.step == last_step + 1;
  if (!is_due && !row_is_open && !is_near_end)
    {
      chained = false;
      return;
    }
  if (!chained || !(consecutive || same_step))
    {
      if (velocity.size() == 0)
        velocity.reinit(discretization->vector_partitioner);
      velocity.zero_out_ghost_values();
      velocity.copy_locally_owned_data_from(state.half_velocity);
      make_consistent(*discretization, velocity);
      push(Kind::half_velocity, velocity, state);
      if (interval == 0.) // not needed again on this mesh
        velocity.reinit(0);
    }
  push(is_due ? Kind::row : Kind::auxiliary, state.displacement, state);
  row_is_open = is_due || (same_step && row_is_open);
  chained     = true;
  last_step   = state.step;
}

template <int dim>
void Receivers<dim>::push(const Kind kind, const VectorType &field, const State<dim> &state)
{
  if (headers.size() == capacity)
    flush();
  headers.push_back({kind, state.step, state.time, state.dt_last});
  const std::size_t start = buffer.size();
  buffer.resize(start + points.names.size() * n_values, 0.);
  for (unsigned int i = 0; i < location.contacts.size(); ++i)
    {
      const auto          &contact = location.contacts[i];
      double              *values  = &buffer[start + contact.point * n_values];
      const Tensor<1, dim> u       = fields->value(field, contact.cell, contact.factors);
      for (unsigned int c = 0; c < dim; ++c)
        values[c] += contact.weight * u[c];
      if (kind == Kind::row && n_values > dim)
        add_stored(i, u, state, values + dim);
    }
}

/// From what the points of the cell store, or from the gradient of the displacement.
template <int dim>
void Receivers<dim>::add_stored(const unsigned int i, const Tensor<1, dim> &u, const State<dim> &state, double *values)
{
  const auto            &contact   = location.contacts[i];
  constexpr unsigned int n_stress  = n_stress_components(dim);
  const std::size_t      n_scalars = quantities.scalars.size();
  if (stored_values.values && stored_values.values(state, contact.cell, values_of_cell))
    {
      const std::size_t n     = values_of_cell.size() / discretization->nodes_per_cell();
      const auto        value = [&](const std::size_t k) {
        return contact.weight * fields->interpolate(&values_of_cell[k], n, contact.factors);
      };
      for (unsigned int k = 0; k < n_stress && quantities.stress; ++k)
        *values++ += value(k);
      for (std::size_t k = 0; k < n_scalars; ++k)
        *values++ += value(6 + k);
    }
  else
    {
      const Tensor<2, dim> gradient =
        fields->reference_gradient(state.displacement, contact.cell, contact.factors) * contact.inverse_jacobian;
      const Tensor<2, 3> full = full_gradient(discretization->symmetry, gradient, u, location.positions[contact.point]);
      const SymmetricTensor<2, 3> stress = materials[i].stress(full);
      for (unsigned int k = 0; k < n_stress && quantities.stress; ++k)
        *values++ += contact.weight * stress.access_raw_entry(k);
      if (n_scalars > 0)
        *values += contact.weight * materials[i].density / (1. + trace(full)); // nothing else is stored
    }
}

template <int dim>
void Receivers<dim>::flush()
{
  const Stopwatch watch(&seconds);
  process(sums_of_own_points());
  headers.clear();
  buffer.clear();
  file->flush();
}

/// [header][own point][u, stress]
template <int dim>
std::vector<double> Receivers<dim>::sums_of_own_points() const
{
  const std::size_t                row_size = points.names.size() * n_values;
  const std::vector<unsigned int> &first    = file->first_points;
  std::vector<double>              by_owner;
  std::vector<int>                 counts;
  by_owner.reserve(buffer.size());
  for (unsigned int owner = 0; owner + 1 < first.size(); ++owner)
    {
      for (std::size_t row = 0; row < headers.size(); ++row)
        by_owner.insert(by_owner.end(), buffer.begin() + row * row_size + first[owner] * n_values,
                        buffer.begin() + row * row_size + first[owner + 1] * n_values);
      counts.push_back(int(headers.size() * (first[owner + 1] - first[owner]) * n_values));
    }
  std::vector<double> result(headers.size() * n_own_points * n_values);
  const int           ierr = MPI_Reduce_scatter(by_owner.data(), result.data(), counts.data(), MPI_DOUBLE, MPI_SUM,
                                                discretization->communicator);
  AssertThrowMPI(ierr);
  return result;
}

template <int dim>
void Receivers<dim>::emit(const ReceiverRow<dim> &row)
{
  file->add(row);
  signal_norms.add(row);
  if (with_errors)
    error_integrals.add(row);
}

template <int dim>
void Receivers<dim>::process(const std::vector<double> &sums)
{
  const auto                  emit_row = [this](const ReceiverRow<dim> &row) { emit(row); };
  std::vector<Tensor<1, dim>> vectors(n_own_points);
  ReceiverRow<dim>            row;
  const double               *values = sums.data();
  for (const Header &header : headers)
    {
      row.stress.resize(quantities.stress ? n_own_points : 0);
      row.scalars.clear();
      for (unsigned int point = 0; point < n_own_points; ++point, values += n_values)
        {
          for (unsigned int c = 0; c < dim; ++c)
            vectors[point][c] = values[c];
          for (unsigned int k = 0; k < n_stress_components(dim) && quantities.stress; ++k)
            row.stress[point].access_raw_entry(k) = values[dim + k];
          row.scalars.insert(row.scalars.end(), values + n_values - quantities.scalars.size(), values + n_values);
        }
      if (header.kind == Kind::half_velocity)
        {
          history.begin(header.step, header.dt, vectors, emit_row);
          continue;
        }
      row.time         = header.time;
      row.displacement = vectors;
      history.add(header.step, header.dt, vectors, header.kind == Kind::row ? &row : nullptr, emit_row);
    }
}

template <int dim>
void Receivers<dim>::exchange(StateArchive &archive)
{
  if (!archive.loads())
    flush();
  archive.common(next_output);
  archive.common(last_step);
  archive.common(chained);
  archive.common(row_is_open);
  const unsigned int first_point = file->first_points[Utilities::MPI::this_mpi_process(discretization->communicator)];
  history.exchange(archive, first_point, n_own_points);
  if (with_errors)
    error_integrals.exchange(archive, first_point);
  signal_norms.exchange(archive);
  file->exchange(archive);
}

template <int dim>
void Receivers<dim>::finish()
{
  flush();
  history.finish([this](const ReceiverRow<dim> &row) { emit(row); });
  file->flush();
  file.reset();
  norm_map = signal_norms.of_set(discretization->communicator);
  if (with_errors)
    write_errors();
}

template <int dim>
void Receivers<dim>::write_errors()
{
  const MPI_Comm communicator = discretization->communicator;
  const auto     of_set       = error_integrals.of_set(communicator);
  error_map.clear();
  for (const auto &[quantity, error] : of_set)
    error_map[name + "." + quantity] = error;

  const auto line = [](std::string text, const std::map<std::string, double> &errors) {
    for (const auto &[quantity, error] : errors)
      text += "," + table_number(error);
    return text + "\n";
  };
  std::vector<std::map<std::string, double>> of_own_points;
  for (unsigned int point = 0; point < n_own_points; ++point)
    of_own_points.push_back(error_integrals.of_point(point));
  std::string text = "name";
  for (const auto &[quantity, error] : of_set)
    text += "," + quantity;
  text += line("\nall points", of_set);
  auto point_name = points.names.begin();
  for (const auto &of_points : Utilities::MPI::gather(communicator, of_own_points)) // on process 0
    for (const auto &of_point : of_points)
      text += line(*point_name++, of_point);
  write_text_file(directory + "/receivers-" + name + "-errors.csv", text, communicator);
}

template <int dim>
void ReceiverSets<dim>::declare_parameters(Parameters &parameters)
{
  names = parameters.peek_list("Receivers");
  parameters.add_list("Receivers", names,
                      "Sets of points where the motion is recorded, surfaces and boxes; each has its section below.");
  auto all = parameters.section("Receivers");
  for (const std::string &name : names)
    {
      auto              section = parameters.section(name);
      const std::string type    = parameters.peek_choice("Receivers/" + name + "/Type", "points", receiver_types());
      if (type == "surface" || type == "box")
        {
          types.push_back(type);
          parameters.add_choice("Type", types.back(), receiver_types(), receiver_type_sentence);
          balances.push_back(std::make_unique<BalanceReceiver<dim>>(name));
          balances.back()->declare_parameters(parameters, type);
          continue;
        }
      sets.push_back(std::make_unique<Receivers<dim>>(name));
      sets.back()->declare_parameters(parameters);
    }
}

template <int dim>
void ReceiverSets<dim>::finalize(const Parameters &parameters)
{
  for (auto &set : sets)
    set->finalize(parameters);
}

template <int dim>
void ReceiverSets<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  finalize(parameters);
  for (auto &balance : balances)
    balance->finalize(parameters, geometry);
}

template <int dim>
void ReceiverSets<dim>::reinit(const Discretization<dim> &discretization, const MaterialOfBlock &material,
                               const StoredPointValues<dim> &stored_values)
{
  for (auto &set : sets)
    set->reinit(discretization, material, stored_values);
}

template <int dim>
void ReceiverSets<dim>::reinit(Dynamics<dim> &dynamics, const StoredPointValues<dim> &stored_values)
{
  reinit(dynamics.discretization, dynamics.material_of_block, stored_values);
  for (auto &balance : balances)
    balance->reinit(dynamics);
}

template <int dim>
void ReceiverSets<dim>::open(const std::string &directory, const double start_time, const double end_time,
                             const ExactSolution<dim> *exact, const FileStart start)
{
  for (auto &set : sets)
    set->open(directory, start_time, end_time, exact, store, start);
  for (auto &balance : balances)
    balance->open(directory, end_time, start);
  if (store && start == FileStart::fresh)
    store->create();
  else if (store)
    store->open();
}

template <int dim>
void ReceiverSets<dim>::exchange(StateArchive &archive)
{
  for (auto &set : sets)
    set->exchange(archive);
  for (auto &balance : balances)
    balance->exchange(archive);
}

template <int dim>
void ReceiverSets<dim>::record(const State<dim> &state)
{
  for (auto &set : sets)
    set->record(state);
  for (auto &balance : balances)
    balance->record(state);
}

template <int dim>
void ReceiverSets<dim>::finish()
{
  for (auto &set : sets)
    set->finish();
  for (auto &balance : balances)
    balance->finish();
  if (store)
    store->close();
  store.reset();
}

template <int dim>
std::map<std::string, double> ReceiverSets<dim>::norms() const
{
  std::map<std::string, double> result;
  for (const auto &set : sets)
    for (const auto &[quantity, norm] : set->norms())
      result[set->set_name() + "." + quantity] = norm;
  for (const auto &balance : balances)
    for (const auto &[quantity, norm] : balance->norms())
      result[balance->set_name() + "." + quantity] = norm;
  return result;
}

template <int dim>
std::map<std::string, double> ReceiverSets<dim>::errors() const
{
  std::map<std::string, double> result;
  for (const auto &set : sets)
    result.insert(set->errors().begin(), set->errors().end());
  return result;
}

template <int dim>
double ReceiverSets<dim>::output_seconds() const
{
  double sum = 0.;
  for (const auto &set : sets)
    sum += set->output_seconds();
  return sum;
}

template class Receivers<1>;
template class Receivers<2>;
template class Receivers<3>;
template class ReceiverSets<1>;
template class ReceiverSets<2>;
template class ReceiverSets<3>;
} // namespace Arenite
