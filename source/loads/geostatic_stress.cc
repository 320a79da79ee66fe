#include <arenite/base/errors.h>
#include <arenite/loads/absorbing.h>
#include <arenite/loads/geostatic_stress.h>

#include <limits>
#include <sstream>

namespace Arenite
{
using namespace dealii;

template <int dim>
void GeostaticStress<dim>::declare_parameters(Parameters &parameters)
{
  path                                 = parameters.current_path();
  const std::vector<std::string> kinds = {"none", "geostatic"};
  kind                                 = parameters.peek_choice(path + "/Stress", kind, kinds);
  parameters.add_choice(
    "Stress", kind, kinds,
    "Stress at t = 0, without deformation. 'geostatic': of horizontal layers, the material blocks, under the "
    "gravity load; needs laws whose stress is a state of its own (cap models, linear elastic at finite strain).");
  if (!is_wanted())
    return;
  parameters.add_quantity("Surcharge", surcharge, "Pa", non_negative,
                          "Vertical stress at the highest point of the body, of what lies above it.");
  parameters.add_list(
    "Held boundaries", held_boundaries,
    "Boundaries on which this stress acts from outside for the whole run, because something holds the body there. "
    "'auto': the absorbing ones. Add the surface below a surcharge, and a cavity whose wall is supported.");
}

template <int dim>
void GeostaticStress<dim>::declare_block(Parameters &parameters, GeostaticPast &block) const
{
  if (!is_wanted())
    return;
  parameters.add_quantity(
    "Earth pressure coefficient", block.K0, "-", positive,
    "K0: horizontal over vertical stress at rest. Sands 0.4 to 0.5, clays 0.5 to 0.7, overconsolidated ones more.");
  parameters.add_quantity(
    "Overconsolidation ratio", block.overconsolidation, "-", {1., 100.},
    "Largest past stress over that at t = 0. The cap begins where the past stress would touch it, but never below "
    "its initial position.");
}

template <int dim>
void GeostaticStress<dim>::finalize(const Parameters &parameters, const Geometry<dim> &geometry,
                                    const std::vector<std::unique_ptr<Load<dim>>> &loads,
                                    const std::map<unsigned int, GeostaticPast>   &new_past)
{
  if (!is_wanted())
    return;
  past       = new_past;
  bool found = false;
  for (const auto &load : loads)
    if (const auto *weight = dynamic_cast<const Gravity<dim> *>(load.get()))
      {
        gravity += weight->at_rest();
        found = true;
      }
  if (!found || gravity.norm() == 0.)
    parameters.refuse(path + "/Stress", "needs a load of 'Type = gravity' that acts at t = 0");
  down = gravity / gravity.norm();
  if (held_boundaries == std::vector<std::string>{"auto"})
    held_boundaries = absorbing_boundaries(loads);
  held_ids = geometry.boundary_ids(parameters, path + "/Held boundaries", held_boundaries);
}

template <int dim>
void GeostaticStress<dim>::reinit(const Discretization<dim> &discretization, const MaterialOfBlock &material)
{
  // lowest and highest level of the cells of each block
  std::map<unsigned int, std::pair<double, double>> range;
  for (const auto &[id, unused] : past)
    range[id] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  std::vector<Point<dim>> x;
  for (unsigned int cell = 0; cell < discretization.cells().size(); ++cell)
    {
      auto &levels = past.size() == 1 ? range.begin()->second : range.at(discretization.cells()[cell]->material_id());
      discretization.cell_positions(cell, x);
      for (const Point<dim> &node : x)
        {
          levels.first  = std::min(levels.first, -(down * node));
          levels.second = std::max(levels.second, -(down * node));
        }
    }
  layers.clear();
  top_level   = std::numeric_limits<double>::lowest();
  double foot = std::numeric_limits<double>::max();
  for (auto &[id, levels] : range)
    {
      levels.first  = Utilities::MPI::min(levels.first, discretization.communicator);
      levels.second = Utilities::MPI::max(levels.second, discretization.communicator);
      top_level     = std::max(top_level, levels.second);
      foot          = std::min(foot, levels.first);
    }
  for (const auto &[id, levels] : range)
    layers.push_back({top_level - levels.second, top_level - levels.first, material(id).density, id});
  std::sort(layers.begin(), layers.end(), [](const Layer &a, const Layer &b) { return a.top < b.top; });
  for (unsigned int k = 1; k < layers.size(); ++k)
    if (std::abs(layers[k].top - layers[k - 1].bottom) > 1e-6 * (top_level - foot))
      throw InputError("[" + path + "] Stress = geostatic: the blocks are no horizontal layers, one ends " +
                       std::to_string(layers[k - 1].bottom) + " m below the highest point and the next begins at " +
                       std::to_string(layers[k].top) + " m.");
}

template <int dim>
double GeostaticStress<dim>::vertical(const Point<dim> &x) const
{
  const double depth = top_level + down * x;
  double       sum   = surcharge;
  for (const Layer &layer : layers)
    sum += layer.density * gravity.norm() * std::max(0., std::min(depth, layer.bottom) - layer.top);
  return sum;
}

template <int dim>
SymTensor<double> GeostaticStress<dim>::at(const Point<dim> &x, const types::material_id id) const
{
  const double      s = vertical(x), K0 = past_of(id).K0;
  SymTensor<double> stress;
  for (int i = 0; i < 3; ++i)
    stress[i] = -s * K0;
  for (int i = 0; i < dim; ++i)
    for (int j = i; j < dim; ++j)
      stress[i == j ? i : 2 + i + j] -= s * (1. - K0) * down[i] * down[j];
  return stress;
}

template <int dim>
const GeostaticPast &GeostaticStress<dim>::past_of(const types::material_id id) const
{
  return past.size() == 1 ? past.begin()->second : past.at(id);
}

template <int dim>
std::string GeostaticStress<dim>::description() const
{
  std::ostringstream text;
  text << "vertical stress " << surcharge << " Pa at the top";
  double at_foot = surcharge;
  for (const Layer &layer : layers)
    {
      at_foot += layer.density * gravity.norm() * (layer.bottom - layer.top);
      text << ", " << at_foot << " Pa at " << layer.bottom << " m (K0 = " << past_of(layer.id).K0 << ")";
    }
  return text.str();
}

template <int dim>
void HeldStress<dim>::reinit(const Discretization<dim> &discretization, const NodalMass &,
                             const MaterialOfBlock     &material)
{
  stress.reinit(discretization, material);
  VectorType         sum = discretization.new_vector();
  const unsigned int n   = discretization.nodes_per_cell();
  whole.clear();
  for (const types::boundary_id boundary : stress.held())
    for_each_face_point(discretization, {boundary},
                        [&](const unsigned int *nodes, const double *N, const Point<dim> &x, const Tensor<1, dim> &dA,
                            const types::material_id id) {
                          Point<dim> place = x;
                          if (one_point)
                            {
                              place                       = Point<dim>();
                              const unsigned int per_face = n / 2;
                              for (unsigned int i = 0; i < n; ++i)
                                if (N[i] > 1e-12)
                                  place += discretization.position(nodes[i]) / per_face;
                            }
                          const SymTensor<double> s = stress.at(place, id);
                          Tensor<1, dim>          t;
                          for (unsigned int c = 0; c < dim; ++c)
                            {
                              for (unsigned int d = 0; d < dim; ++d)
                                t[c] += s[c == d ? c : 2 + c + d] * dA[d];
                              for (unsigned int i = 0; i < n; ++i)
                                sum.local_element(dim * nodes[i] + c) += N[i] * t[c];
                            }
                          if (const double dS = dA.norm(); dS > 0.)
                            whole[boundary] += {t, t * dA / dS};
                        });
  traction = assemble(discretization, sum);
}

template <int dim>
void HeldStress<dim>::add(VectorType &force, const State<dim> &)
{
  add_forces(traction, 1., force);
}

template <int dim>
double HeldStress<dim>::power(const VectorType &half_velocity) const
{
  return power_of(traction, 1., half_velocity);
}

template <int dim>
void HeldStress<dim>::add_resultants(Resultants<dim> &sums) const
{
  for (const auto &[boundary, resultant] : whole)
    sums[boundary] += resultant;
}

template <int dim>
std::string HeldStress<dim>::description() const
{
  return stress.description() + (stress.held_names().empty() ? "" : "; held on " + join(stress.held_names()));
}

template class GeostaticStress<1>;
template class GeostaticStress<2>;
template class GeostaticStress<3>;
template class HeldStress<1>;
template class HeldStress<2>;
template class HeldStress<3>;
} // namespace Arenite
