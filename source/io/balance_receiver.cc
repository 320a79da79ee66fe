#include <arenite/base/state_archive.h>
#include <arenite/base/values.h>
#include <arenite/io/balance_receiver.h>
#include <arenite/loads/node_faces.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
constexpr std::size_t most_rows      = 256;  // in the buffer
constexpr double      time_tolerance = 1e-9; // of the interval

bool is_root(const MPI_Comm communicator) { return Utilities::MPI::this_mpi_process(communicator) == 0; }
} // namespace

template <int dim>
void BalanceReceiver<dim>::declare_parameters(Parameters &parameters, const std::string &new_type)
{
  type = new_type;
  path = parameters.current_path();
  if (on_surface())
    {
      parameters.add_list("Boundary", boundary_names, "Names of the boundaries that are taken together.");
      parameters.require("Boundary");
    }
  else
    {
      parameters.add_vector(
        "Corner", corner, "m",
        "Of a box whose faces follow the coordinates of the mesh; cells with their centre in it count.");
      parameters.require("Corner");
      parameters.add_vector("Opposite corner", opposite, "m", "Of the same box.");
      parameters.require("Opposite corner");
    }
  parameters.add_quantity("Interval", interval, "s", non_negative,
                          "Time between two rows; impulses are those of all steps in between. Zero writes every step.");
}

template <int dim>
void BalanceReceiver<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry)
{
  if (on_surface())
    ids = geometry.boundary_ids(parameters, path + "/Boundary", boundary_names);
  for (unsigned int c = 0; c < dim && !on_surface(); ++c)
    {
      if (corner[c] == opposite[c])
        parameters.refuse(path + "/Opposite corner", "must differ from 'Corner' in all coordinates");
      if (corner[c] > opposite[c])
        std::swap(corner[c], opposite[c]);
    }
}

template <int dim>
void BalanceReceiver<dim>::reinit(Dynamics<dim> &new_dynamics)
{
  dynamics = &new_dynamics;
  faces.clear();
  share.clear();
  if (!on_surface())
    return find_share();
  for (const NodeFaces<dim> &of_node : faces_of_nodes(dynamics->discretization, ids, true))
    faces.push_back({of_node.node, of_node.size, of_node.area});
}

/// A node between cells inside and outside gives the part of its mass that the cells inside have of all around it.
template <int dim>
void BalanceReceiver<dim>::find_share()
{
  const Discretization<dim> &discretization = dynamics->discretization;
  const unsigned int         n              = discretization.nodes_per_cell();
  std::vector<Point<dim>>    x;
  VectorType                 all = discretization.new_scalar(), in_box = all;
  Point<dim>                 middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      discretization.cell_positions(cell, x);
      Point<dim>     centre;
      Tensor<2, dim> J;
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int shape = discretization.lexicographic[i];
          centre += discretization.fe.shape_value(shape, middle) * x[i];
          J += outer_product(x[i], discretization.fe.shape_grad(shape, middle));
        }
      bool is_inside = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_inside = is_inside && centre[d] >= corner[d] && centre[d] < opposite[d];
      const double mass = dynamics->material_of_block(discretization.cells()[cell]->material_id()).density *
                          determinant(J) * measure(discretization.symmetry, centre);
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int node = discretization.cell_nodes(cell)[i];
          all.local_element(node) += mass;
          in_box.local_element(node) += is_inside ? mass : 0.;
        }
    }
  for (VectorType *vector : {&all, &in_box})
    {
      discretization.hanging.template condense<1>(vector->begin());
      vector->compress(VectorOperation::add);
    }
  for (unsigned int node = 0; node < discretization.n_owned_nodes(); ++node)
    if (in_box.local_element(node) > 0. && dynamics->mass.local_element(node) > 0.)
      share.emplace_back(node, in_box.local_element(node) / all.local_element(node));
}

template <int dim>
std::vector<std::string> BalanceReceiver<dim>::columns() const
{
  const Symmetry           symmetry = dynamics->discretization.symmetry;
  const std::string        extent = per_extent(symmetry), part = " (modelled part)";
  std::vector<std::string> result;
  const auto               add = [&](const std::string &what, const std::string &tail) {
    for (unsigned int c = 0; c < dim; ++c)
      result.push_back(what + "_" + direction_letters(symmetry)[c] + tail);
  };
  if (on_surface())
    {
      add("force", part + " [N" + extent + "]");
      add("impulse", part + " [N s" + extent + "]");
      result.insert(result.end(), {"pressure [Pa]", "impulse per area [Pa s]"});
      add("mean velocity", " [m/s]");
      result.push_back("mean normal velocity [m/s]");
    }
  else
    {
      result.push_back("mass" + part + " [kg" + extent + "]");
      add("momentum", part + " [N s" + extent + "]");
    }
  return result;
}

template <int dim>
void BalanceReceiver<dim>::open(const std::string &directory, const double new_end_time, const FileStart start)
{
  const MPI_Comm communicator = dynamics->discretization.communicator;
  end_time                    = new_end_time;
  file_name                   = directory + "/receivers-" + name + ".csv";
  std::string problem;
  if (is_root(communicator))
    {
      errno = 0;
      file.open(file_name, std::ios::binary | (start == FileStart::resumed ? std::ios::app : std::ios::out));
      if (start == FileStart::fresh)
        {
          file << "t [s]";
          for (const std::string &column : columns())
            file << ',' << column;
          file << '\n';
        }
      if (!file)
        problem = write_problem(file_name);
    }
  agree_on_output(problem, communicator);
  const double there = Utilities::MPI::sum(double(faces.size() + share.size()), communicator);
  if (there == 0.)
    throw InputError("[Receivers / " + name + "]: no cell of the mesh is there.");
}

template <int dim>
bool BalanceReceiver<dim>::due(const double time)
{
  if (interval == 0.)
    return true;
  if (time < (next_output - time_tolerance) * interval)
    return time >= end_time * (1. - 1e-12); // the whole impulse
  next_output = static_cast<unsigned int>(std::floor(time / interval + time_tolerance)) + 1;
  return true;
}

template <int dim>
void BalanceReceiver<dim>::record(const State<dim> &state)
{
  if (state.step == last_step)
    return;
  last_step = state.step;
  if (on_surface())
    {
      Resultant<dim>        now;
      const Resultants<dim> all = dynamics->external_forces();
      for (const types::boundary_id id : ids)
        if (const auto at = all.find(id); at != all.end())
          now += at->second;
      impulse += 0.5 * state.dt_last * last;
      impulse += 0.5 * state.dt_last * now;
      last = now;
    }
  if (!due(state.time))
    return;
  add_row(state);
  if (times.size() == most_rows)
    flush();
}

/// The part of this process: sums, whose quotients flush() forms.
template <int dim>
void BalanceReceiver<dim>::add_row(const State<dim> &state)
{
  const auto velocity = [&](const unsigned int node) { // of t_n
    Tensor<1, dim> v;
    for (unsigned int c = 0; c < dim; ++c)
      {
        const unsigned int i = dim * node + c;
        v[c]                 = state.half_velocity.local_element(i) +
               0.5 * state.dt_last * state.inverse_mass.local_element(i) * state.force.local_element(i);
      }
    return v;
  };
  times.push_back(state.time);
  const auto add = [&](const Tensor<1, dim> &vector) {
    for (unsigned int c = 0; c < dim; ++c)
      buffer.push_back(vector[c]);
  };
  Tensor<1, dim> sum;
  if (on_surface())
    {
      double size = 0., flow = 0.;
      for (const Face &face : faces)
        {
          const Tensor<1, dim> v = velocity(face.node);
          sum += face.size * v;
          flow += v * face.area;
          size += face.size;
        }
      add(last.force);
      add(impulse.force);
      buffer.insert(buffer.end(), {-last.pull, -impulse.pull});
      add(sum);
      buffer.insert(buffer.end(), {flow, size});
    }
  else
    {
      double mass = 0.;
      for (const auto &[node, part] : share)
        {
          const double m = part * dynamics->mass.local_element(node);
          sum += m * velocity(node);
          mass += m;
        }
      buffer.push_back(mass);
      add(sum);
    }
}

template <int dim>
void BalanceReceiver<dim>::flush()
{
  const MPI_Comm communicator = dynamics->discretization.communicator;
  if (!buffer.empty())
    Utilities::MPI::sum(buffer, communicator, buffer);
  const std::size_t n_values = times.empty() ? 0 : buffer.size() / times.size();
  std::string       problem;
  for (std::size_t row = 0; row < times.size(); ++row)
    {
      double     *values    = &buffer[row * n_values];
      std::size_t n_columns = n_values;
      if (on_surface()) // the last value is the area
        {
          --n_columns;
          for (std::size_t k = 2 * dim; k < n_columns; ++k)
            values[k] /= values[n_columns];
          peak   = std::max(peak, std::abs(values[2 * dim]));
          at_end = values[2 * dim + 1];
        }
      if (!is_root(communicator))
        continue;
      file << to_text(times[row]);
      for (std::size_t k = 0; k < n_columns; ++k)
        file << ',' << to_text(values[k]);
      file << '\n';
    }
  times.clear();
  buffer.clear();
  if (is_root(communicator))
    {
      errno = 0;
      file.flush();
      if (!file)
        problem = write_problem(file_name);
    }
  agree_on_output(problem, communicator);
}

template <int dim>
void BalanceReceiver<dim>::exchange(StateArchive &archive)
{
  if (!archive.loads())
    flush();
  archive.common(last_step);
  archive.common(next_output);
  archive.common(peak);
  archive.common(at_end);
  for (Resultant<dim> *resultant : {&last, &impulse})
    {
      for (unsigned int c = 0; c < dim; ++c)
        archive.sum(resultant->force[c]);
      archive.sum(resultant->pull);
    }
  exchange_length(archive, file_name, file);
}

template <int dim>
void BalanceReceiver<dim>::finish()
{
  flush();
  file.close();
}

template <int dim>
std::map<std::string, double> BalanceReceiver<dim>::norms() const
{
  if (!on_surface())
    return {};
  return {{"pressure.peak", peak}, {"impulse per area.last", at_end}};
}

template class BalanceReceiver<1>;
template class BalanceReceiver<2>;
template class BalanceReceiver<3>;
} // namespace Arenite
