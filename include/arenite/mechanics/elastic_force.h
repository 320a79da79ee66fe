#pragma once

#include <arenite/mechanics/cell_batches.h>
#include <arenite/mechanics/internal_force.h>
#include <arenite/mechanics/point_operators.h>
#include <arenite/mechanics/spectral_element.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace Arenite
{
/// Small-strain linear elasticity fused into the kernel of one kind of element.
template <typename Element, int W>
class ElasticForce : public InternalForce<Element::dim>
{
public:
  static constexpr int dim = Element::dim, n_nodes = Element::n_nodes, n_hoop = Element::n_hoop;
  using Number = Lanes<W>;

  ElasticForce(const ElementChoice &element, const LinearElastic &law, const dealii::types::material_id block)
    : law(law)
    , block(block)
  {
    moduli.lambda = law.lame_lambda();
    moduli.mu     = law.shear_modulus;
    viscous       = Element::has_hourglass_control && element.hourglass_control == "viscous";
    (viscous ? moduli.hourglass_viscosity : moduli.hourglass_stiffness) =
      element.hourglass_coefficient * (viscous ? law.density * law.p_wave_speed() : 1.);
  }

  void reinit(const Discretization<dim> &discretization) override
  {
    positions = &discretization.positions;
    batches.reinit(discretization, block);
  }

  void add(VectorType &force, const State<dim> &state, const CellPart part, BlockState &record) const override
  {
    const auto p = static_cast<unsigned int>(part);
    if (viscous)
      add_forces<Element::has_hourglass_control>(force, state, batches.part_begin[p], batches.part_begin[p + 1],
                                                 record);
    else
      add_forces<false>(force, state, batches.part_begin[p], batches.part_begin[p + 1], record);
  }

  BlockEnergy energy(const State<dim> &state, const BlockState &) const override
  {
    BlockEnergy total;
    for (unsigned int b = 0; b < batches.size(); ++b)
      {
        Number x[dim][n_nodes], u[dim][n_nodes], v[dim][n_nodes] = {};
        load(b, positions->begin(), x);
        load(b, state.displacement.begin(), u);
        Amplitudes            Q = {};
        ElementEnergy<Number> energy;
        if (viscous)
          element_force<true, Element::has_hourglass_control>(x, u, v, Q, energy);
        else
          element_force<true, false>(x, u, v, Q, energy);
        for (int l = 0; l < batches.active[b]; ++l)
          {
            total.strain += lane(energy.strain, l);
            total.hourglass += lane(energy.hourglass, l);
            total.note_hourglass(lane(energy.hourglass, l), batches.cells[b * W + l]);
          }
      }
    return total;
  }

  bool contains(const unsigned int cell) const override
  {
    return batches.place(cell) != dealii::numbers::invalid_unsigned_int;
  }

  void add_mass(VectorType &mass) const override
  {
    for (unsigned int b = 0; b < batches.size(); ++b)
      {
        Number x[dim][n_nodes], volume[n_nodes];
        load(b, positions->begin(), x);
        Element::nodal_volume(x, volume);
        for (int n = 0; n < n_nodes; ++n)
          for (int l = 0; l < batches.active[b]; ++l)
            mass.local_element(entries(b)[n * W + l] / dim) += law.density * lane(volume[n], l);
      }
  }

  void cell_mass(const unsigned int cell, std::vector<double> &mass) const override
  {
    const unsigned int place = batches.place(cell);
    Number             x[dim][n_nodes], volume[n_nodes];
    load(place / W, positions->begin(), x);
    Element::nodal_volume(x, volume);
    mass.resize(n_nodes);
    for (int n = 0; n < n_nodes; ++n)
      mass[n] = law.density * lane(volume[n], place % W);
  }

  /// Column by column from the kernel, so that no second one has to agree with it. Without viscous forces.
  void cell_stiffness(const unsigned int cell, dealii::FullMatrix<double> &stiffness) const override
  {
    const unsigned int place = batches.place(cell);
    Number             x[dim][n_nodes];
    load(place / W, positions->begin(), x);
    stiffness.reinit(dim * n_nodes, dim * n_nodes, true);
    for (unsigned int column = 0; column < dim * n_nodes; ++column)
      {
        Number                u[dim][n_nodes] = {}, v[dim][n_nodes] = {};
        Amplitudes            Q = {};
        ElementEnergy<Number> unused;
        u[column % dim][column / dim] = Number(1.);
        element_force<false, false>(x, u, v, Q, unused);
        for (int n = 0; n < n_nodes; ++n)
          for (int c = 0; c < dim; ++c)
            stiffness(dim * n + c, column) = -lane(u[c][n], place % W);
      }
  }

  void inverse_size_squared(dealii::Vector<double> &per_cell) const override
  {
    for (unsigned int b = 0; b < batches.size(); ++b)
      {
        Number x[dim][n_nodes];
        load(b, positions->begin(), x);
        const Number size = Element::inverse_size_squared(x);
        for (int l = 0; l < batches.active[b]; ++l)
          per_cell[batches.cells[b * W + l]] = lane(size, l);
      }
  }

  void largest_eigenvalue(dealii::Vector<double> &per_cell) const override
  {
    for (unsigned int b = 0; b < batches.size(); ++b)
      {
        Number x[dim][n_nodes];
        load(b, positions->begin(), x);
        const Number lambda = power_iteration(x);
        for (int l = 0; l < batches.active[b]; ++l)
          per_cell[batches.cells[b * W + l]] = lane(lambda, l);
      }
  }

  bool uses_velocity() const override { return viscous; }

  void reinit_state(BlockState &record, bool) const override
  {
    record.amplitude.resize(viscous ? batches.size() * n_amplitudes * W : 0, 0.);
  }

  /// Viscous hourglass forces of the cell; new cells begin without.
  CellRecord cell_record() const override
  {
    CellRecord record;
    record.of_cell.resize(viscous ? n_amplitudes : 0, {0., false, 0.});
    return record;
  }

  void pack(const BlockState &record, const unsigned int cell, double *values) const override
  {
    for (int k = 0; viscous && k < n_amplitudes; ++k)
      values[k] = record.amplitude[amplitude(cell, k)];
  }

  void unpack(BlockState &record, const unsigned int cell, const double *values) const override
  {
    for (int k = 0; viscous && k < n_amplitudes; ++k)
      record.amplitude[amplitude(cell, k)] = values[k];
  }

  bool gives_point_values() const override { return Element::mean_dilatation; }

  std::vector<std::string> names_of_point_values() const override
  {
    return Element::mean_dilatation ? std::vector<std::string>{"density [kg/m^3]"} : std::vector<std::string>();
  }

  /// With the mean volume strain, which the displacement of a point alone does not tell.
  bool point_values(const State<dim> &state, const BlockState &, const unsigned int cell,
                    std::vector<double> &values) const override
  {
    if constexpr (Element::mean_dilatation)
      return stress_of_mean_dilatation(state, cell, values);
    else
      return (void)state, (void)cell, (void)values, false;
  }

  const LinearElastic &material() const override { return law; }

  std::string description() const override
  {
    return "small strain, 0 B/point, " + std::to_string(W) + (W == 1 ? " lane" : " lanes");
  }

private:
  static constexpr int n_patterns = Element::n_patterns, n_amplitudes = n_patterns * dim; ///< per cell
  using Amplitudes = Number[dim][n_patterns];

  /// Where number @p k of a cell lies among the amplitudes.
  std::size_t amplitude(const unsigned int cell, const int k) const
  {
    const unsigned int place = batches.place(cell);
    return (std::size_t(place / W) * n_amplitudes + k) * W + place % W;
  }

  const unsigned int *entries(const unsigned int batch) const { return &batches.entries[batch * n_nodes * W]; }

  void load(const unsigned int batch, const double *vector, Number (&values)[dim][n_nodes]) const
  {
    gather<dim, W, n_nodes>(vector, entries(batch), values);
  }

  template <bool with_energy, bool with_viscosity>
  ARENITE_INLINE void element_force(const Number (&x)[dim][n_nodes], Number (&u)[dim][n_nodes],
                                    Number (&v)[dim][n_nodes], Amplitudes &Q, ElementEnergy<Number> &energy) const
  {
    if constexpr (Element::has_hourglass_control)
      Element::template internal_force<with_energy, with_viscosity>(x, u, v, Q, moduli, energy);
    else
      {
        (void)v;
        (void)Q;
        Element::template internal_force<with_energy>(x, u, moduli, energy);
      }
  }

  template <bool with_viscosity>
  void add_forces(VectorType &force, const State<dim> &state, const unsigned int begin, const unsigned int end,
                  BlockState &record) const
  {
    const double *X = positions->begin(), *U = state.displacement.begin(), *V = state.half_velocity.begin();
    double       *F = force.begin(), *amplitudes = record.amplitude.empty() ? nullptr : record.amplitude.begin();
    double        power = 0.;
    for (unsigned int b = begin; b < end; ++b)
      {
        Number                x[dim][n_nodes], u[dim][n_nodes], v[dim][n_nodes];
        Amplitudes            Q;
        ElementEnergy<Number> energy;
        gather<dim, W, n_nodes>(X, entries(b), x);
        gather<dim, W, n_nodes>(U, entries(b), u);
        if constexpr (with_viscosity)
          {
            gather<dim, W, n_nodes>(V, entries(b), v);
            for (int k = 0; k < n_amplitudes; ++k)
              if (amplitudes)
                Q[k / n_patterns][k % n_patterns] = Arenite::load<Number>(amplitudes + (b * n_amplitudes + k) * W);
              else
                Q[k / n_patterns][k % n_patterns] = Number(0.);
          }
        element_force<false, with_viscosity>(x, u, v, Q, energy);
        if constexpr (with_viscosity)
          if (amplitudes)
            {
              for (int k = 0; k < n_amplitudes; ++k)
                Arenite::store<Number>(Q[k / n_patterns][k % n_patterns], amplitudes + (b * n_amplitudes + k) * W);
              for (int l = 0; l < batches.active[b]; ++l)
                power += lane(energy.viscous, l);
            }
        scatter_add<dim, W, n_nodes>(F, entries(b), u, batches.active[b]);
      }
    record.power += power;
  }

  /// Largest eigenvalue of M^-1 K of the element itself, with viscous forces lambda = largest of M^-1 (K + sqrt(lambda) C): the
  /// force at v = sqrt(lambda) y, with the lambda reached so far. The start vector has a part in every mode and does not depend on
  /// ranks; 60 iterations leave the Rayleigh quotient at most 1 % below the eigenvalue (tests/mechanics/stable_step.cc).
  Number power_iteration(const Number (&x)[dim][n_nodes]) const
  {
    Number volume[n_nodes], y[dim][n_nodes], v[dim][n_nodes], lambda = Number(0.);
    Element::nodal_volume(x, volume);
    const std::vector<AxisNode> on_axis = axis_nodes(x);
    for (int n = 0; n < n_nodes; ++n)
      for (int c = 0; c < dim; ++c)
        y[c][n] = Number(std::sin(1. + 2.3 * n * n + 1.7 * c * (n + 1)));
    interpolate(on_axis, y);
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        Number       z[dim][n_nodes], yy = Number(0.), yz = Number(0.);
        const Number rate = square_root(lambda);
        for (int c = 0; c < dim; ++c)
          for (int n = 0; n < n_nodes; ++n)
            {
              z[c][n] = y[c][n];
              v[c][n] = rate * y[c][n];
            }
        ElementEnergy<Number> unused;
        Amplitudes            Q = {};
        if (viscous)
          element_force<false, Element::has_hourglass_control>(x, z, v, Q, unused);
        else
          element_force<false, false>(x, z, v, Q, unused);
        condense(on_axis, z);
        for (int c = 0; c < dim; ++c)
          for (int n = 0; n < n_nodes; ++n)
            {
              yz += y[c][n] * z[c][n];
              yy += y[c][n] * y[c][n] * volume[n];
              z[c][n] = z[c][n] / volume[n];
            }
        interpolate(on_axis, z);
        lambda = -yz / yy * (1. / law.density);
        if (viscous && iteration == 0)
          continue; // the rate was zero: K alone would take the hourglass patterns out of y for good
        const Number scale = Number(1. / law.density) / lambda;
        for (int c = 0; c < dim; ++c)
          for (int n = 0; n < n_nodes; ++n)
            y[c][n] = z[c][n] * scale;
      }
    return lambda;
  }

  /// A node on the axis or in the centre, in one lane: it has no radial motion and, without a mass of its own, follows the nodes of
  /// its line, node + m stride.
  struct AxisNode
  {
    int  lane, node, stride;
    bool follows;
  };

  /// Empty for cells of the interior and in Cartesian coordinates.
  static std::vector<AxisNode> axis_nodes(const Number (&x)[dim][n_nodes])
  {
    std::vector<AxisNode> result;
    if constexpr (Element::n_hoop > 0)
      for (int l = 0; l < W; ++l)
        for (int n = 0; n < n_nodes; ++n)
          if (lane(x[0][n], l) == 0.)
            {
              constexpr int N      = Element::degree + 1;
              int           stride = 0; // of the direction in which the radius grows
              for (int d = 0, step = 1; d < dim; ++d, step *= N)
                for (const int side : {0, N - 1})
                  if (n / step % N == side && lane(x[0][side == 0 ? n + step : n - step], l) > 0.)
                    stride = side == 0 ? step : -step;
              result.push_back({l, n, stride, dim == 2 && Element::degree > 1});
            }
    (void)x;
    return result;
  }

  /// Values of axis nodes from those of their lines, and forces the other way.
  static void interpolate(const std::vector<AxisNode> &nodes, Number (&u)[dim][n_nodes])
  {
    for (const auto &[l, n, stride, follows] : nodes)
      {
        set_lane(u[0][n], l, 0.);
        if (!follows)
          continue;
        const std::vector<double> weights = even_line_weights(Element::degree);
        double                    sum     = 0.;
        for (int m = 1; m <= Element::degree; ++m)
          sum += weights[m] * lane(u[dim - 1][n + m * stride], l);
        set_lane(u[dim - 1][n], l, sum);
      }
  }
  static void condense(const std::vector<AxisNode> &nodes, Number (&f)[dim][n_nodes])
  {
    for (const auto &[l, n, stride, follows] : nodes)
      {
        set_lane(f[0][n], l, 0.);
        if (!follows)
          continue;
        const std::vector<double> weights = even_line_weights(Element::degree);
        for (int m = 1; m <= Element::degree; ++m)
          set_lane(f[dim - 1][n + m * stride], l,
                   lane(f[dim - 1][n + m * stride], l) + weights[m] * lane(f[dim - 1][n], l));
        set_lane(f[dim - 1][n], l, 0.);
      }
  }

  bool stress_of_mean_dilatation(const State<dim> &state, const unsigned int cell, std::vector<double> &values) const
  {
    const unsigned int place = batches.place(cell);
    if (place == dealii::numbers::invalid_unsigned_int)
      return false;
    const unsigned int batch = place / W, l = place % W;
    Number             x[dim][n_nodes], u[dim][n_nodes], H[n_nodes][dim][dim], h[n_nodes];
    load(batch, positions->begin(), x);
    load(batch, state.displacement.begin(), u);
    const PointOperators<Element, Number> operators(x);
    operators.gradients(u, H, h);
    const auto volume_strain = [&](const int q) {
      double sum = n_hoop > 0 ? n_hoop * lane(h[q], l) : 0.;
      for (int i = 0; i < dim; ++i)
        sum += lane(H[q][i][i], l);
      return sum;
    };
    double mean = 0., volume = 0.;
    for (int q = 0; q < n_nodes; ++q)
      {
        mean += lane(operators.weight[q], l) * volume_strain(q);
        volume += lane(operators.weight[q], l);
      }
    mean /= volume;
    std::vector<double> at_points(n_nodes * 7, 0.);
    for (int q = 0; q < n_nodes; ++q)
      {
        double      *s     = &at_points[7 * q];
        const double third = volume_strain(q) / 3.;
        for (int k = 0; k < 3; ++k)
          {
            const double strain = k < dim ? lane(H[q][k][k], l) : (k < dim + n_hoop ? lane(h[q], l) : 0.);
            s[k]                = law.bulk_modulus * mean + 2. * law.shear_modulus * (strain - third);
          }
        for (int i = 0; i < dim; ++i)
          for (int j = i + 1; j < dim; ++j)
            s[2 + i + j] = law.shear_modulus * (lane(H[q][i][j], l) + lane(H[q][j][i], l));
        s[6] = law.density / (1. + mean);
      }
    points_to_nodes<Element>(at_points, 7, values);
    return true;
  }

  const LinearElastic              law;
  const dealii::types::material_id block;
  ElasticModuli                    moduli;
  bool                             viscous   = false;
  const VectorType                *positions = nullptr;
  CellBatches<dim, W>              batches;
};

/// The kernel of an element with H hoop directions.
template <int dim, int n_hoop, int W>
std::unique_ptr<InternalForce<dim>> make_elastic_kernel(const ElementChoice &element, const LinearElastic &law,
                                                        const dealii::types::material_id block)
{
  if (element.type == "spectral element")
    switch (element.degree)
      {
      case 1:
        if constexpr (dim < 3)
          return std::make_unique<ElasticForce<SpectralElement<dim, 1, n_hoop>, W>>(element, law, block);
        break;
      case 2:
        return std::make_unique<ElasticForce<SpectralElement<dim, 2, n_hoop>, W>>(element, law, block);
      case 3:
        return std::make_unique<ElasticForce<SpectralElement<dim, 3, n_hoop>, W>>(element, law, block);
      case 4:
        return std::make_unique<ElasticForce<SpectralElement<dim, 4, n_hoop>, W>>(element, law, block);
      }
  else if (element.type == "hexahedron" && element.volumetric_strain == "mean dilatation")
    return std::make_unique<ElasticForce<MeanDilatationElement<dim, n_hoop>, W>>(element, law, block);
  else if (element.type == "hexahedron")
    return std::make_unique<ElasticForce<FullElement<dim, n_hoop>, W>>(element, law, block);
  else if (element.type == "one-point hexahedron")
    return std::make_unique<ElasticForce<OnePointElement<dim, n_hoop>, W>>(element, law, block);
  AssertThrow(false, dealii::ExcMessage("no kernel for element '" + element.type + "' of this degree"));
  return nullptr;
}

template <int dim, int W>
std::unique_ptr<InternalForce<dim>> make_elastic_force(const ElementChoice &element, const LinearElastic &law,
                                                       const dealii::types::material_id block, const Symmetry symmetry)
{
  if constexpr (dim < 3)
    if (n_hoop_directions(symmetry) > 0)
      return make_elastic_kernel<dim, 3 - dim, W>(element, law, block);
  (void)symmetry;
  return make_elastic_kernel<dim, 0, W>(element, law, block);
}

// Compiled once, in internal_force.cc.
#define ARENITE_EXTERN(dim)                                                                  \
  extern template std::unique_ptr<InternalForce<dim>> make_elastic_force<dim, native_lanes>( \
    const ElementChoice &, const LinearElastic &, dealii::types::material_id, Symmetry);
ARENITE_EXTERN(1)
ARENITE_EXTERN(2)
ARENITE_EXTERN(3)
#undef ARENITE_EXTERN
} // namespace Arenite
