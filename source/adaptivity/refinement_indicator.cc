#include <arenite/adaptivity/refinement_indicator.h>

#include <cmath>

namespace Arenite
{
using namespace dealii;

namespace
{
/// Variation of velocity and of strain times cp inside a cell: both are of the same size in a wave, and the second alone is left
/// where the solid is at rest under load.
///
///   eta = max |v - mean v| + cp max |E - mean E|,   E the gradient along the edges of the reference cell over its length.
template <int dim>
class WaveFront : public RefinementIndicator<dim>
{
public:
  void evaluate(const Discretization<dim> &discretization, const State<dim> &state, const VectorType &velocity,
                const MaterialOfBlock &material, Vector<float> &per_cell) const override
  {
    const unsigned int          N = discretization.degree() + 1, n = discretization.nodes_per_cell();
    std::vector<Tensor<1, dim>> v(n), u(n);
    std::vector<Point<dim>>     x;
    for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
      {
        const unsigned int *nodes = discretization.cell_nodes(cell);
        discretization.cell_positions(cell, x);
        Tensor<1, dim> mean_v;
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int c = 0; c < dim; ++c)
              {
                v[i][c] = velocity.local_element(dim * nodes[i] + c);
                u[i][c] = state.displacement.local_element(dim * nodes[i] + c);
              }
            mean_v += v[i] / n;
          }
        double variation = 0.;
        for (unsigned int i = 0; i < n; ++i)
          variation = std::max(variation, (v[i] - mean_v).norm());
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
        const double cp = material(discretization.cells()[cell]->material_id()).p_wave_speed();
        // rounded, so that the same wave on another number of processes gives the same mesh
        per_cell[cell] = static_cast<float>(variation + cp * strain);
      }
  }
};

template <int dim>
Registry<RefinementIndicator<dim>> make_indicators()
{
  Registry<RefinementIndicator<dim>> registry("refinement indicator");
  registry.template add<WaveFront<dim>>("wave front", "Variation of velocity and strain inside of a cell.");
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
