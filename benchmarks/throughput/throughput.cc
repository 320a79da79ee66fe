// Speed of the whole step for every kind of element, beside the limits of processor and memory. Started by study.py:
//
//   [mpirun -n 2] throughput_benchmark throughput.prm --refinement 4 --repetitions 7 --output result.json
//
// One repetition is 50 steps: ghost exchange, hanging nodes, kernels, loads, dashpots, spherical boundary, constraints, work of
// all forces, update, and one report of the energy ledgers. The flops are counted by running each kernel with a number type
// that counts its operations; the bytes are what must cross from memory if every entry is fetched once per sweep.

#include <arenite/base/version.h>
#include <arenite/mechanics/multilinear_element.h>
#include <arenite/mechanics/spectral_element.h>
#include <arenite/simulation/scene.h>
#include <arenite/time/dynamics.h>

#include <deal.II/distributed/tria.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>

namespace Arenite
{
using namespace dealii;

// --- flops ------------------------------------------------------------------------------------------------------------
/// A number that counts what is done to it. Products with a constant one count although the compiler drops them.
struct CountingNumber
{
  double                    value;
  static inline std::size_t operations = 0;

  CountingNumber(const double value = 0.)
    : value(value)
  {}
  CountingNumber &operator+=(const CountingNumber &b) { return *this = *this + b; }
  CountingNumber &operator-=(const CountingNumber &b) { return *this = *this - b; }

  friend CountingNumber operator+(const CountingNumber &a, const CountingNumber &b) { return count(a.value + b.value); }
  friend CountingNumber operator-(const CountingNumber &a, const CountingNumber &b) { return count(a.value - b.value); }
  friend CountingNumber operator*(const CountingNumber &a, const CountingNumber &b) { return count(a.value * b.value); }
  friend CountingNumber operator/(const CountingNumber &a, const CountingNumber &b) { return count(a.value / b.value); }
  friend CountingNumber operator-(const CountingNumber &a) { return -a.value; } // folded into the next operation
  friend CountingNumber square_root(const CountingNumber &a) { return count(std::sqrt(a.value)); }

private:
  static CountingNumber count(const double value)
  {
    ++operations;
    return value;
  }
};

/// Operations of one call of an element's kernel on a unit cell.
template <typename Element, bool viscous = false>
double kernel_flops()
{
  using V            = CountingNumber;
  constexpr int    n = Element::n_nodes, N = n == 8 ? 2 : (n == 27 ? 3 : (n == 64 ? 4 : 5));
  V                x[3][n], u[3][n], v[3][n];
  ElasticModuli    moduli;
  ElementEnergy<V> energy;
  moduli.lambda = moduli.mu = moduli.hourglass_stiffness = moduli.hourglass_viscosity = 1.;
  for (int i = 0, stride = 1; i < 3; ++i, stride *= N)
    for (int k = 0; k < n; ++k)
      x[i][k] = k / stride % N / (N - 1.);
  CountingNumber::operations = 0;
  if constexpr (Element::has_hourglass_control)
    {
      V Q[3][Element::n_patterns];
      Element::template internal_force<false, viscous>(x, u, v, Q, moduli, energy);
    }
  else
    Element::template internal_force<false>(x, u, moduli, energy);
  return CountingNumber::operations;
}

// --- limits of the machine ----------------------------------------------------------------------------------------------
double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Multiply-add peak of one core in full vectors [flop/s], all processes at the same time; mean over processes.
double multiply_add_peak(const unsigned int repetitions)
{
  using V                = Lanes<native_lanes>;
  constexpr int   chains = 12, n = 4000000;
  volatile double factor = 0.999999, term = 1e-7, sink;
  double          best = 0.;
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      const V b = V(factor), c = V(term);
      V       a[chains];
      for (int k = 0; k < chains; ++k)
        a[k] = V(1. + k);
      MPI_Barrier(MPI_COMM_WORLD);
      const double start = seconds();
      for (int i = 0; i < n; ++i)
        for (auto &chain : a)
          chain = chain * b + c;
      const double time = seconds() - start;
      V            sum  = a[0];
      for (int k = 1; k < chains; ++k)
        sum += a[k];
      sink = lane(sum, 0);
      best = std::max(best, 2. * chains * native_lanes * double(n) / time);
    }
  (void)sink;
  return Utilities::MPI::sum(best, MPI_COMM_WORLD) / Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
}

/// Bandwidth of a_i += s b_i [byte/s per core], 24 byte per entry, all processes at the same time; mean over processes.
double triad_bandwidth(const double megabytes, const unsigned int repetitions)
{
  const std::size_t   n = megabytes * 1e6 / 16;
  std::vector<double> a(n, 1.), b(n, 2.);
  volatile double     factor = 1e-9;
  const unsigned int  sweeps = std::max(1., 200. / megabytes);
  double              best   = 0.;
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      MPI_Barrier(MPI_COMM_WORLD);
      const double start = seconds();
      for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
        {
          const double s             = factor;
          double *__restrict x       = a.data();
          const double *__restrict y = b.data();
#pragma omp simd
          for (std::size_t i = 0; i < n; ++i)
            x[i] += s * y[i];
        }
      best = std::max(best, 24. * n * sweeps / (seconds() - start));
    }
  return Utilities::MPI::sum(best, MPI_COMM_WORLD) / Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
}

// --- the step -----------------------------------------------------------------------------------------------------------
struct Case
{
  std::string              name;
  std::vector<std::string> settings;
  unsigned int             degree, layers; ///< layers: about the same number of unknowns for every degree
  int                      coarser;        ///< refinements fewer than trilinear elements
  double                   flops_per_cell;
};

std::vector<Case> cases()
{
  const auto element = [](const std::string &type, const unsigned int degree) {
    return std::vector<std::string>{"Element/Type=" + type, "Element/Degree=" + std::to_string(degree)};
  };
  auto viscous = element("one-point hexahedron", 1);
  viscous.push_back("Element/Hourglass control=viscous");
  return {{"Q1, one point, stiffness", element("one-point hexahedron", 1), 1, 1, 0, kernel_flops<OnePointHexahedron>()},
          {"Q1, one point, viscous", viscous, 1, 1, 0, kernel_flops<OnePointHexahedron, true>()},
          {"Q1, 2x2x2", element("hexahedron", 1), 1, 1, 0, kernel_flops<FullHexahedron>()},
          {"Q2", element("spectral element", 2), 2, 1, 1, kernel_flops<SpectralElement<3, 2>>()},
          {"Q3", element("spectral element", 3), 3, 2, 2, kernel_flops<SpectralElement<3, 3>>()},
          {"Q4", element("spectral element", 4), 4, 1, 2, kernel_flops<SpectralElement<3, 4>>()}};
}

/// One repetition: @p n_steps steps and a report of the ledgers. Returns seconds of the slowest process.
double run_steps(Dynamics<3> &dynamics, State<3> &state, const unsigned int n_steps, const bool overlap)
{
  constexpr double dt = 1e-8; // far below every stable step: the speed does not depend on it
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = seconds();
  for (unsigned int step = 0; step < n_steps; ++step)
    {
      dynamics.compute_force(state, overlap);
      dynamics.close_force(state, dt);
      if (step == 0)
        dynamics.report(state, dt);
      dynamics.advance(state, dt);
    }
  return Utilities::MPI::max(seconds() - start, MPI_COMM_WORLD);
}

nlohmann::json measure(const Case &what, const std::string &scene_file, const int refinement,
                       const unsigned int repetitions)
{
  constexpr unsigned int n_steps  = 50;
  auto                   settings = what.settings;
  settings.push_back("Mesh/Radial layers=" + std::to_string(what.layers));
  settings.push_back("Mesh/Refinement=" + std::to_string(refinement - what.coarser));
  Parameters parameters = Parameters::from_files({scene_file}, settings);
  Scene<3>   scene(parameters);

  // mesh: a ball in the middle of the octant is refined once more, about one cell in a hundred
  parallel::distributed::Triangulation<3> triangulation(MPI_COMM_WORLD);
  scene.mesh.geometry->create(triangulation);
  triangulation.refine_global(scene.mesh.refinement);
  const Point<3> middle(0.12, 0.10, 0.11);
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center().distance(middle) < 0.03)
      cell->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();

  Discretization<3> discretization(triangulation, scene.element.degree);
  discretization.distribute_nodes();
  discretization.positions_from_manifolds();
  std::vector<std::unique_ptr<InternalForce<3>>> blocks;
  blocks.push_back(make_elastic_force<3>(scene.element, scene.blocks.front().material));
  Dynamics<3> dynamics(discretization, std::move(blocks), std::move(scene.loads), scene.constraints);
  State<3>    state;
  dynamics.reinit(state);
  // everything moves a little: no zeros and no denormal numbers, which would not take the usual time
  for (unsigned int i = 0; i < state.displacement.locally_owned_size(); ++i)
    state.displacement.local_element(i) = 1e-6 * std::sin(1.3 * i);

  const double ranks   = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const double dofs    = 3. * discretization.n_nodes();
  const double cells   = triangulation.n_global_active_cells();
  const double n       = discretization.nodes_per_cell();
  const double hanging = Utilities::MPI::sum(discretization.hanging.size(), MPI_COMM_WORLD);

  nlohmann::json result;
  result["element"]       = what.name;
  result["degree"]        = what.degree;
  result["dofs"]          = std::size_t(dofs);
  result["cells"]         = std::size_t(cells);
  result["hanging_lines"] = std::size_t(hanging);
  // kernel and scatter; update: 7 operations per entry
  result["flops_per_dof"] = cells * (what.flops_per_cell + 3. * n) / dofs + 7.;
  // kernel: x, u read, f read and written, table of nodes; update: u, v, f read and written, 1/m read
  const bool   viscous     = what.name.find("viscous") != std::string::npos;
  const double velocity    = viscous ? 8. : 0.;
  const double amplitudes  = viscous ? 8. * 12. * cells / dofs : 0.; // read and written
  result["bytes_per_dof"]  = 32. + velocity + 2. * amplitudes + 4. * n * cells / dofs + 56.;
  result["working_set_mb"] = 1e-6 * dofs / ranks * (40. + amplitudes + 4. * n * cells / dofs);

  // with and without overlap in turn, so that both meet the same disturbances
  std::vector<bool>   variants = ranks > 1 ? std::vector<bool>{true, false} : std::vector<bool>{true};
  std::vector<double> times[2];
  run_steps(dynamics, state, 5, true);
  for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    for (const bool overlap : variants)
      times[overlap].push_back(run_steps(dynamics, state, n_steps, overlap));
  for (const bool overlap : variants)
    {
      std::vector<double> &t = times[overlap];
      std::sort(t.begin(), t.end());
      result[overlap ? "overlap" : "no_overlap"] = {{"best", 1e-6 * dofs * n_steps / (t.front() * ranks)},
                                                    {"median", 1e-6 * dofs * n_steps / (t[t.size() / 2] * ranks)},
                                                    {"ms_per_step", 1e3 * t.front() / n_steps}};
    }
  return result;
}

int run(const int argc, char **argv)
{
  std::string  scene, output;
  unsigned int refinement = 5, repetitions = 7;
  for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      if (word == "--refinement" && i + 1 < argc)
        refinement = std::stoul(argv[++i]);
      else if (word == "--repetitions" && i + 1 < argc)
        repetitions = std::stoul(argv[++i]);
      else if (word == "--output" && i + 1 < argc)
        output = argv[++i];
      else if (word.rfind("--", 0) != 0 && scene.empty())
        scene = word;
      else
        throw InputError("throughput_benchmark: unknown argument '" + word + "'");
    }
  if (scene.empty() || refinement < 2 || repetitions < 1)
    throw InputError(
      "usage: throughput_benchmark SCENE.prm [--refinement N >= 2] [--repetitions N >= 1] [--output FILE.json]");

  const bool     root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  nlohmann::json record;
  record["version"]     = version();
  record["commit"]      = commit();
  record["compiler"]    = compiler();
  record["deal_ii"]     = dealii_version();
  record["ranks"]       = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  record["lanes"]       = native_lanes;
  record["repetitions"] = repetitions;
  record["peak_gflops"] = 1e-9 * multiply_add_peak(repetitions);
  for (const double megabytes : {1., 12., 24., 100., 400.})
    record["bandwidth"].push_back(
      {{"megabytes", megabytes}, {"gb_per_s", 1e-9 * triad_bandwidth(megabytes, repetitions)}});
  for (const Case &what : cases())
    {
      record["cases"].push_back(measure(what, scene, refinement, repetitions));
      if (root)
        std::cerr << record["cases"].back().dump() << std::endl;
    }
  if (root && output.empty())
    std::cout << record.dump(2) << std::endl;
  else if (root)
    std::ofstream(output) << record.dump(2) << '\n';
  return 0;
}
} // namespace Arenite

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      return Arenite::run(argc, argv);
    }
  catch (const std::exception &exception)
    {
      std::cerr << exception.what() << std::endl;
      MPI_Abort(MPI_COMM_WORLD, 2);
      return 2;
    }
}
