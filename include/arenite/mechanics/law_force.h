#pragma once

#include <arenite/base/stopwatch.h>
#include <arenite/materials/batch_law.h>
#include <arenite/mechanics/bulk_viscosity.h>
#include <arenite/mechanics/cell_batches.h>
#include <arenite/mechanics/internal_force.h>
#include <arenite/mechanics/point_motion.h>
#include <arenite/mechanics/point_operators.h>
#include <arenite/mechanics/point_packing.h>
#include <arenite/mechanics/present_shape.h>

#include <algorithm>
#include <cmath>

namespace Arenite
{
/// Forces of a block whose law has memory, or whose strains are finite. The stress of a step comes from the increment of the displacement
/// since the last one:
///
///   gather -> gradients (PointOperators) -> strain increment and rotation (PointMotion) -> law, once per batch -> q -> P -> scatter
///
/// sigma = law + sigma_q of the bulk viscosity (BulkViscosity), of which sigma_q = - q I in the volumetric form; P = J sigma F^-T at finite
/// strain, sigma at small strain. The work (J_n sigma_q,n + J sigma_q) : d eps/2 per reference volume, sigma_q,n turned like the stress, is what
/// the nodal forces take out of the motion; the law receives it as heat.
///
/// Step: an element alone is stable up to dt with g (c^2 dt^2/4 + nu dt/2) = 1 for a viscosity nu (StableTimeStep has the reason): g =
/// r |A|^2 with the ratio r between the largest eigenvalue of the element's M^-1 K and c^2 |A|^2, from power iterations on the first
/// mesh with the elasticity at rest and as a fluid. Per cell c^2 |A|^2 is predicted to grow as it did in the last step, at most fourfold.
template <typename Element, int W>
class LawForce : public InternalForce<Element::dim>
{
public:
  static constexpr int dim = Element::dim, n_nodes = Element::n_nodes, n_hoop = Element::n_hoop;
  using Number                  = Lanes<W>;
  using Operators               = PointOperators<Element, Number>;
  using Motion                  = PointMotion<dim, n_hoop, Number>;
  using Shape                   = PresentShape<dim, Number>;
  static constexpr int n_points = Operators::n_points;

  LawForce(const ElementChoice &element, const KinematicsChoice &kinematics, std::unique_ptr<const BatchLaw> law,
           const LinearElastic &at_rest, const dealii::types::material_id block, const Symmetry symmetry)
    : element(element)
    , kinematics(kinematics)
    , law(std::move(law))
    , block(block)
    , finite(kinematics.finite_strain())
    , polar(kinematics.polar())
    , viscous_hourglass(element.hourglass_control == "viscous")
    , n_viscous(element.directional_viscosity() ? 6 : 1)
    , n_history(static_cast<unsigned int>(this->law->history_names().size()))
    , elastic(make_elastic_force<dim, W>(element, at_rest, block, symmetry))
  {
    LinearElastic fluid = at_rest;
    fluid.bulk_modulus += 4. / 3. * fluid.shear_modulus;
    fluid.shear_modulus = 0.;
    as_fluid            = make_elastic_force<dim, W>(element, fluid, block, symmetry);
  }

  void reinit(const Discretization<dim> &discretization) override
  {
    positions = &discretization.positions;
    batches.reinit(discretization, block);
    elastic->reinit(discretization);
    as_fluid->reinit(discretization);
  }

  bool stores_points() const override { return true; }

  void reinit_state(BlockState &record, const bool at_rest) const override
  {
    PointData        &points = record.points;
    const std::size_t n      = std::size_t(batches.size()) * n_points * W;
    points                   = PointData();
    points.stores_points     = true;
    points.stress.resize(6 * n, 0.);
    points.history.resize(n_history * n, 0.);
    points.bulk_viscosity.resize(n_viscous * n, 0.);
    points.wave_speed.resize(n, 0.);
    points.stored.resize(n, 0.);
    points.frequency.resize(batches.size() * W, 0.);
    points.inverse_step.resize(batches.size() * W, 0.);
    points.ratio.resize(batches.size() * W, 0.);
    points.dissipation.resize(batches.size() * W, 0.);
    if (at_rest)
      find_ratios(points);
    const std::vector<double> start = law->initial_history();
    for (std::size_t point = 0; point < n / W; ++point)
      for (unsigned int h = 0; h < n_history; ++h)
        for (int l = 0; l < W; ++l)
          points.history[(point * n_history + h) * W + l] = start[h];
    if constexpr (Element::has_hourglass_control)
      {
        record.amplitude.resize(std::size_t(batches.size()) * n_amplitudes * W, 0.);
        points.hourglass.resize(batches.size() * W, 0.);
      }
  }

  CellRecord cell_record() const override
  {
    CellRecord record;
    Operators::lines(record.points, record.weights);
    record.n_values = packing.n_values() + 1;
    record.of_cell  = packing.of_cell(dim);
    return record;
  }

  void pack(const BlockState &record, const unsigned int cell, double *values) const override
  {
    const unsigned int place = batches.place(cell), batch = place / W;
    Number             x[dim][n_nodes];
    gather<dim, W, n_nodes>(positions->begin(), entries(batch), x);
    const Operators operators(x);
    for (int q = 0; q < n_points; ++q)
      values[(q + 1) * (packing.n_values() + 1) - 1] = lane(operators.weight[q], place % W);
    packing.exchange<true>(record, place, values);
  }

  void unpack(BlockState &record, const unsigned int cell, const double *values) const override
  {
    packing.exchange<false>(record, batches.place(cell), values);
  }

  std::string begin_under(const SymTensor<double> &stress, const double overconsolidation,
                          double *history) const override
  {
    return law->begin_under(stress, overconsolidation, history);
  }

  void restore(const State<dim> &state, BlockState &record, const std::vector<unsigned int> &changed) const override
  {
    PointData &points        = record.points;
    points.step              = state.step;
    points.stored_energy     = 0.;
    points.stable_step       = std::numeric_limits<double>::infinity();
    points.largest_frequency = 0.;
    std::vector<bool> renewed(std::size_t(batches.size()) * W, false);
    for (const unsigned int cell : changed)
      if (batches.place(cell) != dealii::numbers::invalid_unsigned_int)
        renewed[batches.place(cell)] = true;
    for (unsigned int batch = 0; batch < batches.size(); ++batch)
      {
        Number    x[dim][n_nodes], u[dim][n_nodes], H[n_points][dim][dim], h[n_points];
        Motion    motion[n_points];
        Increment step;
        gather<dim, W, n_nodes>(positions->begin(), entries(batch), x);
        gather<dim, W, n_nodes>(state.displacement.begin(), entries(batch), u);
        gather<dim, W, n_nodes>(state.half_velocity.begin(), entries(batch), step.u);
        for (int c = 0; c < dim; ++c)
          for (int n = 0; n < n_nodes; ++n)
            step.u[c][n] *= Number(state.dt_last);
        const Operators operators(x);
        operators.gradients(step.u, step.H, step.h);
        operators.gradients(u, H, h);
        for (int q = 0; q < n_points; ++q)
          {
            const Number zero[dim][dim] = {};
            move(H[q], zero, h[q], Number(0.), motion[q]);
          }
        if constexpr (Element::mean_dilatation)
          take_mean_volumes(operators, motion);
        const auto first = renewed.begin() + std::ptrdiff_t(batch) * W;
        if (std::find(first, first + W, true) != first + W)
          {
            const BatchCopy kept(packing, record, batch);
            const Number    loss = settle(batch, operators, motion, record);
            if constexpr (Element::has_hourglass_control)
              if (viscous_hourglass)
                {
                  Amplitudes force, dq;
                  operators.patterns(step.u, step.H, dq);
                  viscous_hourglass_forces(batch, operators, H, h, dq, Number(law->density()) / motion[0].J,
                                           state.dt_last, points, force);
                  for (int i = 0; i < dim; ++i)
                    for (int a = 0; a < Element::n_patterns; ++a)
                      store<Number>(force[i][a], amplitude(record, batch, i, a));
                }
            for (int l = 0; l < W; ++l)
              if (!first[l])
                kept.give_back(record, batch * W + l);
              else if (l < batches.active[batch])
                points.dissipated += lane(loss, l);
          }
        for (int l = 0; l < batches.active[batch]; ++l)
          {
            for (int q = 0; q < n_points; ++q)
              points.stored_energy += lane(operators.weight[q], l) *
                                      (finite || !law->energy_per_present_volume() ? lane(motion[q].J, l) : 1.) *
                                      points.stored[(std::size_t(batch) * n_points + q) * W + l];
            note_step(points, batch, l);
          }
      }
  }

  void cell_values(const BlockState &record, const CellQuantity quantity,
                   dealii::Vector<float> &per_cell) const override
  {
    const PointData &points = record.points;
    for (unsigned int place = 0; place < batches.cells.size(); ++place)
      if (batches.cells[place] != dealii::numbers::invalid_unsigned_int)
        {
          double value = 0.;
          if (quantity == CellQuantity::dissipation)
            value = std::abs(points.dissipation[place]);
          else
            for (int q = 0; q < n_points; ++q)
              value =
                std::max(value, std::abs(shown_viscosity(points, n_viscous, place / W * n_points + q, W, place % W)));
          per_cell[batches.cells[place]] = static_cast<float>(value);
        }
  }

  bool set_history(BlockState &record, const std::string &name,
                   const std::function<double(unsigned int cell)> &value) const override
  {
    const auto names    = law->history_names();
    const auto position = std::find(names.begin(), names.end(), name);
    if (position == names.end())
      return false;
    const std::size_t entry = position - names.begin();
    for (unsigned int place = 0; place < batches.cells.size(); ++place)
      if (batches.cells[place] != dealii::numbers::invalid_unsigned_int)
        {
          const double of_cell = value(batches.cells[place]);
          for (int q = 0; q < n_points; ++q)
            record.points.history[((place / W * n_points + q) * n_history + entry) * W + place % W] = of_cell;
        }
    return true;
  }

  void add(VectorType &force, const State<dim> &state, const CellPart part, BlockState &record) const override
  {
    if (!record.points.stores_points)
      {
        elastic->add(force, state, part, record);
        return;
      }
    const auto    p       = static_cast<unsigned int>(part);
    double *const scatter = record.points.is_timed ? &record.points.scatter_seconds : nullptr;
    for (unsigned int batch = batches.part_begin[p]; batch < batches.part_begin[p + 1]; ++batch)
      {
        Number    x[dim][n_nodes], u[dim][n_nodes], H[n_points][dim][dim], h[n_points];
        Increment step;
        {
          const Stopwatch watch(scatter);
          gather<dim, W, n_nodes>(positions->begin(), entries(batch), x);
          gather<dim, W, n_nodes>(state.displacement.begin(), entries(batch), u);
          if (record.points.advances)
            gather<dim, W, n_nodes>(state.last_displacement.begin(), entries(batch), step.u);
        }
        const Operators operators(x);
        if (record.points.advances)
          {
            for (int c = 0; c < dim; ++c)
              for (int n = 0; n < n_nodes; ++n)
                step.u[c][n] = u[c][n] - step.u[c][n];
            operators.gradients(step.u, step.H, step.h);
          }
        operators.gradients(u, H, h);
        if (record.points.advances)
          advance(batch, operators, u, H, h, step, state.dt_last, record);
        integrate(batch, operators, H, h, record, u);
        const Stopwatch watch(scatter);
        scatter_add<dim, W, n_nodes>(force.begin(), entries(batch), u, batches.active[batch]);
      }
  }

  BlockEnergy energy(const State<dim> &, const BlockState &record) const override
  {
    const PointData &points = record.points;
    BlockEnergy      total;
    total.strain         = points.stored_energy;
    total.hourglass      = points.hourglass_work;
    total.dissipated     = points.dissipated;
    total.bulk_viscosity = points.viscous_work;
    total.volume_change  = points.volume_change;
    for (std::size_t place = 0; place < points.hourglass.size(); ++place)
      total.note_hourglass(points.hourglass[place], batches.cells[place]);
    return total;
  }

  bool contains(const unsigned int cell) const override
  {
    return batches.place(cell) != dealii::numbers::invalid_unsigned_int;
  }

  void add_mass(VectorType &mass) const override { elastic->add_mass(mass); }
  void cell_mass(const unsigned int cell, std::vector<double> &mass) const override { elastic->cell_mass(cell, mass); }
  void cell_stiffness(const unsigned int cell, dealii::FullMatrix<double> &stiffness) const override
  {
    elastic->cell_stiffness(cell, stiffness);
  }
  void inverse_size_squared(dealii::Vector<double> &per_cell) const override
  {
    elastic->inverse_size_squared(per_cell);
  }
  void largest_eigenvalue(dealii::Vector<double> &per_cell) const override { elastic->largest_eigenvalue(per_cell); }

  const LinearElastic &material() const override { return elastic->material(); }
  double               relaxation_time() const override { return law->relaxation_time_at_rest(); }

  std::string description() const override
  {
    const unsigned int n = packing.n_values();
    return this->kinematics.kinematics + (finite ? ", " + this->kinematics.rate + " rate" : "") + ", " +
           std::to_string(8 * n) + " B/point, " + std::to_string(n_points) + (n_points == 1 ? " point" : " points") +
           " per cell, " + std::to_string(W) + (W == 1 ? " lane" : " lanes");
  }

  std::vector<std::string> names_of_point_values() const override
  {
    std::vector<std::string> names{"density [kg/m^3]", "bulk viscosity [Pa]", "wave speed [m/s]"};
    for (const std::string &name : law->history_names())
      names.push_back(name);
    return names;
  }

  bool point_values(const State<dim> &state, const BlockState &record, const unsigned int cell,
                    std::vector<double> &values) const override
  {
    const unsigned int place = batches.place(cell);
    if (place == dealii::numbers::invalid_unsigned_int)
      return false;
    const unsigned int batch = place / W, lane_of_cell = place % W;
    const unsigned int n_values = 9 + n_history;
    const PointData   &points   = record.points;
    Number             x[dim][n_nodes], u[dim][n_nodes], H[n_points][dim][dim], h[n_points];
    gather<dim, W, n_nodes>(positions->begin(), entries(batch), x);
    gather<dim, W, n_nodes>(state.displacement.begin(), entries(batch), u);
    const Operators operators(x);
    operators.gradients(u, H, h);
    std::vector<double> at_points(n_points * n_values);
    for (int q = 0; q < n_points; ++q)
      {
        double           *v     = &at_points[q * n_values];
        const std::size_t point = std::size_t(batch) * n_points + q;
        const auto at = [&](const dealii::AlignedVector<double> &array, const unsigned int k, const unsigned int n) {
          return array[(point * n + k) * W + lane_of_cell];
        };
        Number zero[dim][dim] = {};
        Motion motion;
        move(H[q], zero, h[q], Number(0.), motion);
        const auto viscosity = viscous_stress<Number>(points, n_viscous, point * W);
        for (int k = 0; k < 6; ++k)
          v[k] = at(points.stress, k, 6) - lane(viscosity[k], lane_of_cell);
        v[6] = law->density() / lane(motion.J, lane_of_cell);
        v[7] = shown_viscosity(points, n_viscous, point, W, lane_of_cell);
        v[8] = at(points.wave_speed, 0, 1);
        for (unsigned int k = 0; k < n_history; ++k)
          v[9 + k] = at(points.history, k, n_history);
      }
    points_to_nodes<Element>(at_points, n_values, values);
    return true;
  }

private:
  static constexpr int n_amplitudes = Element::n_patterns * dim; ///< per cell
  using Amplitudes                  = Number[dim][Element::n_patterns];

  /// Of the displacement over a step.
  struct Increment
  {
    Number u[dim][n_nodes], H[n_points][dim][dim], h[n_points];
  };

  const unsigned int *entries(const unsigned int batch) const { return &batches.entries[batch * n_nodes * W]; }

  void move(const Number (&H)[dim][dim], const Number (&dH)[dim][dim], const Number &h, const Number &dh,
            Motion &motion) const
  {
    if (finite)
      motion.finite_strain(H, dH, h, dh, polar);
    else
      motion.small_strain(H, dH, h, dh);
  }

  /// Ratios between the largest eigenvalue of each element and c^2 |A|^2.
  void find_ratios(PointData &points) const
  {
    dealii::Vector<double> solid(batches.n_cells()), fluid = solid;
    elastic->largest_eigenvalue(solid);
    as_fluid->largest_eigenvalue(fluid);
    const double c2 = std::pow(material().p_wave_speed(), 2);
    for (unsigned int batch = 0; batch < batches.size(); ++batch)
      {
        Number x[dim][n_nodes], largest = Number(0.);
        gather<dim, W, n_nodes>(positions->begin(), entries(batch), x);
        const Operators operators(x);
        for (int q = 0; q < n_points; ++q)
          largest = Arenite::max<Number>(largest, Shape::square_norm(operators.metric[q]));
        for (int l = 0; l < batches.active[batch]; ++l)
          {
            const unsigned int cell = batches.cells[batch * W + l];
            // power iterations end up to 1 % below, and cells change their shape
            points.ratio[batch * W + l] = 1.03 * std::max(solid[cell], fluid[cell]) / (c2 * lane(largest, l));
          }
      }
  }

  /// The points of a batch go to the end of the step: stress, history, q, and the sums over the block.
  void advance(unsigned int batch, const Operators &operators, const Number (&u)[dim][n_nodes],
               const Number (&H)[n_points][dim][dim], const Number (&h)[n_points], const Increment &step,
               double dt_last, BlockState &record) const;

  void note_step(PointData &points, const unsigned int batch, const int lane) const
  {
    const double stable = 1. / points.inverse_step[batch * W + lane];
    if (stable < points.stable_step)
      {
        points.stable_step   = stable;
        points.limiting_cell = batches.cells[batch * W + lane];
      }
    points.largest_frequency = std::max(points.largest_frequency, points.frequency[batch * W + lane]);
  }

  /// What the law sees of a batch: the stored arrays, and those of the kernel.
  PointBatch batch_of_points(PointData &points, const unsigned int batch, const double dt,
                             const Number (&strain)[n_points][6], const Number (&density_old)[n_points],
                             const Number (&density)[n_points], Number (&dissipated)[n_points],
                             Number *stored_by_volume = nullptr) const
  {
    const std::size_t first = std::size_t(batch) * n_points;
    PointBatch        result;
    result.n_points    = n_points;
    result.dt          = dt;
    result.strain      = reinterpret_cast<const double *>(strain);
    result.density_old = reinterpret_cast<const double *>(density_old);
    result.density     = reinterpret_cast<const double *>(density);
    result.stress      = &points.stress[6 * first * W];
    result.history     = n_history > 0 ? &points.history[n_history * first * W] : nullptr;
    result.wave_speed  = &points.wave_speed[first * W];
    result.stored      = &points.stored[first * W];
    result.dissipated  = reinterpret_cast<double *>(dissipated);

    result.stored_by_volume = reinterpret_cast<double *>(stored_by_volume);
    return result;
  }

  /// The law takes the points of a batch to admissible states, with their stored energy and wave speed; no time passes. @return what it
  /// dissipated of the cells' energies
  Number settle(const unsigned int batch, const Operators &operators, const Motion (&motion)[n_points],
                BlockState &record) const
  {
    Number strain[n_points][6], density[n_points], dissipated[n_points];
    for (int q = 0; q < n_points; ++q)
      {
        for (int k = 0; k < 6; ++k)
          strain[q][k] = Number(0.);
        density[q] = Number(law->density()) / Arenite::max<Number>(motion[q].J, Number(1e-9));
      }
    PointBatch law_batch =
      batch_of_points(record.points, batch, std::numeric_limits<double>::min(), strain, density, density, dissipated);
    law->after_transfer(law_batch);
    law->update(law_batch);
    Number loss = Number(0.);
    for (int q = 0; q < n_points; ++q)
      loss +=
        operators.weight[q] * dissipated[q] * (finite || !law->energy_per_present_volume() ? motion[q].J : Number(1.));
    return loss;
  }

  static ARENITE_INLINE Number law_sum(const double *stress)
  {
    Number sum = Number(0.);
    for (int k = 0; k < 6; ++k)
      sum += load<Number>(stress + k * W);
    return sum;
  }

  /// Mean dilatation: every point has the change of volume of the cell.
  void take_mean_volumes(const Operators &operators, Motion (&motion)[n_points]) const
  {
    Number volume = Number(0.), J = Number(0.), J_old = Number(0.);
    for (int q = 0; q < n_points; ++q)
      {
        volume += operators.weight[q];
        J += operators.weight[q] * motion[q].J;
        J_old += operators.weight[q] * motion[q].J_old;
      }
    for (int q = 0; q < n_points; ++q)
      motion[q].set_volume(J_old / volume, J / volume, finite);
  }

  /// Viscous forces on the patterns, for their increments @p dq over the step.
  void viscous_hourglass_forces(unsigned int batch, const Operators &operators, const Number (&H)[n_points][dim][dim],
                                const Number (&h)[n_points], const Amplitudes &dq, const Number &density,
                                double dt_last, const PointData &points, Amplitudes &force) const;

  /// Stiffness of the patterns: k = coefficient rho c^2 s, with s the part of the elastic deviatoric stress that the point carries,
  /// |s|/(2 G |e|), so that soil that flows is not held by its hourglass control; at least a hundredth.
  Number hourglass_stiffness(unsigned int batch, const Operators &operators, const Number (&H)[n_points][dim][dim],
                             const Number (&h)[n_points], const Number &density, const PointData &points) const;

  /// Elastic forces on the patterns. The stiffness of soil follows its state, so they come from increments,
  ///
  ///   Q = min(1, k/k_n) R Q_n + k (q - R q_n),
  ///
  /// with the rotation R of the step: stiffness that grows leaves the force as it is, stiffness that goes takes force with it. Neither gives
  /// energy away, which k q and the sum of k dq do; both are k q as long as k does not grow.
  void elastic_hourglass_forces(unsigned int batch, const Operators &operators, const Number (&u)[dim][n_nodes],
                                const Number (&H)[n_points][dim][dim], const Motion &motion, const Amplitudes &dq,
                                const Number &old_stiffness, const Number &stiffness, const BlockState &record,
                                Amplitudes &force) const;

  /// Hourglass forces of the end of the step take the place of those of its beginning. @return the work of both on @p dq
  Number advance_hourglass(unsigned int batch, const Amplitudes &dq, const Amplitudes &force, BlockState &record) const;

  template <typename Record>
  auto *amplitude(Record &record, const unsigned int batch, const int i, const int a) const
  {
    return &record.amplitude[(std::size_t(batch) * n_amplitudes + i * Element::n_patterns + a) * W];
  }

  ARENITE_INLINE Number secant_ratio(const unsigned int batch, const Number (&H)[n_points][dim][dim],
                                     const Number (&h)[n_points], const PointData &points) const
  {
    const double G = material().shear_modulus;
    if (G == 0.)
      return Number(0.01);
    SymTensor<Number> e, stress; // at finite strain Green's, which a rotation leaves alone
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        {
          Number sum = H[0][i][j] + H[0][j][i];
          for (int k = 0; finite && k < dim; ++k)
            sum += H[0][k][i] * H[0][k][j];
          e[Motion::index(i, j)] = Number(0.5) * sum;
        }
    for (int i = dim; i < dim + n_hoop; ++i)
      e[i] = h[0] + Number(finite ? 0.5 : 0.) * h[0] * h[0];
    for (int k = 0; k < 6; ++k)
      stress[k] = load<Number>(&points.stress[(std::size_t(batch) * 6 + k) * W]);
    const auto   s        = deviator(stress);
    const Number strained = Number(4. * G * G) * second_invariant(deviator(e)), carried = second_invariant(s);
    return Arenite::select<Number>(
      strained > Number(1e-20 * G * G),
      Arenite::min<Number>(Number(1.), Arenite::max<Number>(Number(0.01), square_root(Number(carried / strained)))),
      Number(1.));
  }

  /// Nodal forces of the stored stress.
  void integrate(unsigned int batch, const Operators           &operators, const Number (&H)[n_points][dim][dim],
                 const Number (&h)[n_points], const BlockState &record, Number (&f)[dim][n_nodes]) const;

  /// Mean of p + q and of J over the cell, with the weights of the reference volume: what works on the change of its volume.
  void find_means(const unsigned int batch, const Operators    &operators, const Number (&H)[n_points][dim][dim],
                  const Number (&h)[n_points], const PointData &points, Number &mean_pressure, Number &mean_J) const
  {
    Number volume = Number(0.);
    mean_J        = Number(0.);
    for (int q = 0; q < n_points; ++q)
      {
        const std::size_t at = (std::size_t(batch) * n_points + q) * W;
        SymTensor<Number> s;
        for (int k = 0; k < 3; ++k)
          s[k] = load<Number>(&points.stress[6 * at + k * W]);
        s -= viscous_stress<Number>(points, n_viscous, at);
        Number F[dim][dim], C[dim][dim];
        Shape::deformation(H[q], F);
        Number J = cofactors(F, C);
        for (int i = 0; i < n_hoop; ++i)
          J *= Number(1.) + h[q];
        volume += operators.weight[q];
        mean_J += operators.weight[q] * J;
        mean_pressure += operators.weight[q] * pressure(s);
      }
    mean_pressure *= Number(1.) / volume;
    mean_J *= Number(1.) / volume;
    (void)h;
  }

  const ElementChoice                 element;
  const KinematicsChoice              kinematics;
  std::unique_ptr<const BatchLaw>     law;
  const dealii::types::material_id    block;
  const bool                          finite, polar, viscous_hourglass;
  const unsigned int                  n_viscous, n_history; ///< numbers of a point: bulk viscosity, history of the law
  std::unique_ptr<InternalForce<dim>> elastic, as_fluid;    ///< for mass, eigenvalues and forces without points
  const VectorType                   *positions = nullptr;
  CellBatches<dim, W>                 batches;
  const PointPacking                  packing{
    n_points, W, n_history, n_viscous, Element::has_hourglass_control ? n_amplitudes : 0, !viscous_hourglass};
};
} // namespace Arenite

#include <arenite/mechanics/law_force_advance.h>
