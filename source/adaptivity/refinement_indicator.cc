#include <arenite/adaptivity/refinement_indicator.h>
#include <arenite/mechanics/nodal_stress.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Arenite
{
using namespace dealii;

namespace
{
/// max |f - mean f| of a field over the nodes of a cell.
template <int dim>
double variation(const Discretization<dim> &discretization, const VectorType &field, const unsigned int cell)
{
  const unsigned int         *nodes = discretization.cell_nodes(cell);
  const unsigned int          n     = discretization.nodes_per_cell();
  std::vector<Tensor<1, dim>> f(n);
  Tensor<1, dim>              mean;
  for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int c = 0; c < dim; ++c)
        f[i][c] = field.local_element(dim * nodes[i] + c);
      mean += f[i] / n;
    }
  double largest = 0.;
  for (const auto &value : f)
    largest = std::max(largest, (value - mean).norm());
  return largest;
}

/// Variation of velocity and of strain times cp inside a cell: both are of the same size in a wave, and the second alone is left
/// where the solid is at rest under load.
///
///   eta = max |v - mean v| + cp max |E - mean E|,   E the gradient along the edges of the reference cell over its length.
template <int dim>
class WaveFront : public RefinementIndicator<dim>
{
public:
  void evaluate(const Dynamics<dim> &dynamics, const State<dim> &state, const VectorType &velocity,
                Vector<float> &per_cell) const override
  {
    const Discretization<dim>  &discretization = dynamics.discretization;
    const unsigned int          N = discretization.degree() + 1, n = discretization.nodes_per_cell();
    std::vector<Tensor<1, dim>> u(n);
    std::vector<Point<dim>>     x;
    for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
      {
        const unsigned int *nodes = discretization.cell_nodes(cell);
        discretization.cell_positions(cell, x);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int c = 0; c < dim; ++c)
            u[i][c] = state.displacement.local_element(dim * nodes[i] + c);
        // differences of neighbouring nodes along each direction, compared with their mean over the cell
        double strain = 0.;
        for (unsigned int d = 0, stride = 1; d < dim; ++d, stride *= N)
          {
            Tensor<1, dim> mean;
            unsigned int   count = 0;
            for (int pass = 0; pass < 2; ++pass)
              for (unsigned int i = 0; i < n; ++i)
                if (i / stride % N + 1 < N)
                  {
                    const Tensor<1, dim> slope = (u[i + stride] - u[i]) / x[i + stride].distance(x[i]);
                    if (pass == 0)
                      {
                        mean += slope;
                        ++count;
                      }
                    else
                      strain = std::max(strain, (slope - mean / count).norm());
                  }
          }
        const double cp = dynamics.material_of_block(discretization.cells()[cell]->material_id()).p_wave_speed();
        per_cell[cell]  = static_cast<float>(variation(discretization, velocity, cell) + cp * strain);
      }
  }
};

/// max |v - mean v|: what jumps inside of the cell, whatever the solid is strained.
template <int dim>
class VelocityJump : public RefinementIndicator<dim>
{
public:
  void evaluate(const Dynamics<dim> &dynamics, const State<dim> &, const VectorType &velocity,
                Vector<float> &per_cell) const override
  {
    for (unsigned int cell = 0; cell < dynamics.discretization.cells().size(); ++cell)
      per_cell[cell] = static_cast<float>(variation(dynamics.discretization, velocity, cell));
  }
};

/// Variation of the stress inside of a cell after averaging over the cells that touch a node: its gradient times the size of the cell
/// (recovery in the manner of Zienkiewicz & Zhu, 1987).
template <int dim>
class StressGradient : public RefinementIndicator<dim>
{
public:
  void evaluate(const Dynamics<dim> &dynamics, const State<dim> &state, const VectorType &,
                Vector<float> &per_cell) const override
  {
    const Discretization<dim> &discretization = dynamics.discretization;
    std::vector<LinearElastic> materials;
    for (const auto &cell : discretization.cells())
      {
        const types::material_id id = cell->material_id();
        while (materials.size() <= id)
          materials.push_back(dynamics.material_of_block(static_cast<types::material_id>(materials.size())));
      }
    StoredFields<dim> stored;
    if (dynamics.gives_point_values())
      stored.values = [&](const unsigned int cell, std::vector<double> &values) {
        return dynamics.point_values(state, cell, values);
      };
    const NodalStress<dim> stress = nodal_stress(discretization, state.displacement, materials, stored);
    const unsigned int     n      = discretization.nodes_per_cell();
    for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
      {
        const unsigned int *nodes = discretization.cell_nodes(cell);
        double              sum   = 0.;
        for (unsigned int k = 0; k < stress.size(); ++k)
          {
            double low = stress[k].local_element(nodes[0]), high = low;
            for (unsigned int i = 1; i < n; ++i)
              {
                low  = std::min(low, stress[k].local_element(nodes[i]));
                high = std::max(high, stress[k].local_element(nodes[i]));
              }
            sum += (k < 3 ? 1. : 2.) * (high - low) * (high - low);
          }
        per_cell[cell] = static_cast<float>(std::sqrt(sum));
      }
  }
};

/// What the points of blocks with a law of their own know.
template <int dim, CellQuantity quantity>
class OfPoints : public RefinementIndicator<dim>
{
public:
  void evaluate(const Dynamics<dim> &dynamics, const State<dim> &state, const VectorType &,
                Vector<float> &per_cell) const override
  {
    for (unsigned int b = 0; b < dynamics.blocks.size(); ++b)
      dynamics.blocks[b]->cell_values(state.blocks[b], quantity, per_cell);
  }
};

/// 1 where a front is expected, 0 elsewhere: distances from an origin within half a width of R + U t.
template <int dim>
class PredictedFront : public RefinementIndicator<dim>
{
public:
  void declare_parameters(Parameters &parameters) override
  {
    parameters.add_vector("Front origin", origin, "m", "Centre of the predicted front.");
    parameters.add_quantity("Front radius", radius, "m", non_negative, "Of the predicted front at the start.");
    parameters.add_quantity("Front speed", speed, "m/s", positive, "At which the predicted front goes outwards.");
    parameters.add_quantity("Front width", width, "m", positive,
                            "Cells closer than half of it to the predicted front are refined.");
  }
  void evaluate(const Dynamics<dim> &dynamics, const State<dim> &state, const VectorType &,
                Vector<float> &per_cell) const override
  {
    std::vector<Point<dim>> x;
    for (unsigned int cell = 0; cell < dynamics.discretization.cells().size(); ++cell)
      {
        dynamics.discretization.cell_positions(cell, x);
        double nearest = std::numeric_limits<double>::max(), farthest = 0.;
        for (const Point<dim> &node : x)
          {
            const double distance = (node - Point<dim>(origin)).norm();
            nearest               = std::min(nearest, distance);
            farthest              = std::max(farthest, distance);
          }
        const double front = radius + speed * state.time;
        per_cell[cell]     = front + 0.5 * width > nearest && front - 0.5 * width < farthest ? 1.f : 0.f;
      }
  }

private:
  Tensor<1, dim> origin;
  double         radius = 0., speed = std::numeric_limits<double>::quiet_NaN(),
         width = std::numeric_limits<double>::quiet_NaN();
};

template <int dim>
Registry<RefinementIndicator<dim>> make_indicators()
{
  Registry<RefinementIndicator<dim>> registry("refinement indicator");
  registry.template add<WaveFront<dim>>("wave front",
                                        "Variation of velocity and strain inside of a cell: elastic waves.");
  registry.template add<OfPoints<dim, CellQuantity::bulk_viscosity>>(
    "shock front", "Pressure of the bulk viscosity: shocks in soil that stays compacted behind them.");
  registry.template add<VelocityJump<dim>>("velocity jump", "Variation of velocity inside of a cell.");
  registry.template add<StressGradient<dim>>("stress gradient",
                                             "Variation inside of a cell of the stress averaged at nodes.");
  registry.template add<OfPoints<dim, CellQuantity::dissipation>>(
    "dissipation", "What the law of a cell dissipates per volume and time: where soil flows or is crushed.");
  registry.template add<PredictedFront<dim>>("predicted front", "A sphere that grows with a given speed.");
  return registry;
}
} // namespace

template <int dim>
const Registry<RefinementIndicator<dim>> &refinement_indicators()
{
  static const Registry<RefinementIndicator<dim>> registry = make_indicators<dim>();
  return registry;
}

template const Registry<RefinementIndicator<1>> &refinement_indicators<1>();
template const Registry<RefinementIndicator<2>> &refinement_indicators<2>();
template const Registry<RefinementIndicator<3>> &refinement_indicators<3>();
} // namespace Arenite
