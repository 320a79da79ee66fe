#pragma once

#include <arenite/mechanics/law_force.h>

namespace Arenite
{
// How the points of a block go through a step; LawForce says what is computed.

template <typename Element, int W>
void LawForce<Element, W>::advance(const unsigned int batch, const Operators &operators,
                                   const Number (&u)[dim][n_nodes], const Number (&H)[n_points][dim][dim],
                                   const Number (&h)[n_points], const Increment &step, const double dt_last,
                                   BlockState &record) const
{
  PointData   &points = record.points;
  const double dt = dt_last > 0. ? dt_last : std::numeric_limits<double>::min(); // at rest: energy and wave speed only
  const std::size_t first = std::size_t(batch) * n_points;
  Motion            motion[n_points];
  for (int q = 0; q < n_points; ++q)
    move(H[q], step.H[q], h[q], step.h[q], motion[q]);
  if constexpr (Element::mean_dilatation)
    take_mean_volumes(operators, motion);

  // viscous hourglass forces heat like the bulk viscosity: with their work lost a blast of gas would fall behind
  Number     hourglass = Number(0.), hourglass_heat = Number(0.), old_stiffness = Number(0.); // J, J/kg, N/m
  Amplitudes dq, Q;
  if constexpr (Element::has_hourglass_control)
    {
      operators.patterns(step.u, step.H, dq);
      if (viscous_hourglass)
        {
          viscous_hourglass_forces(batch, operators, H, h, dq, Number(law->density()) / motion[0].J, dt_last, points,
                                   Q);
          hourglass      = advance_hourglass(batch, dq, Q, record);
          hourglass_heat = hourglass / (Number(law->density()) * operators.weight[0]);
        }
      else
        {
          Number H_old[n_points][dim][dim];
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              H_old[0][i][j] = H[0][i][j] - step.H[0][i][j];
          const Number h_old[n_points] = {h[0] - step.h[0]};
          old_stiffness =
            hourglass_stiffness(batch, operators, H_old, h_old, Number(law->density()) / motion[0].J_old, points);
        }
    }

  // kinematics, viscosity
  Number strain[n_points][6], density_old[n_points], density[n_points], heat[n_points], stored_old[n_points],
    dissipated[n_points], by_volume[n_points], viscous_work[n_points], size[n_points]; // |A|^2
  const double rho_0 = law->density();
  const bool   viscous =
    dt_last > 0. && !points.quasi_static && (element.linear_viscosity > 0. || element.quadratic_viscosity > 0.);
  Number largest_rate = Number(0.), viscosity[n_points];
  for (int q = 0; q < n_points; ++q)
    {
      const std::size_t at = (first + q) * W;
      const Motion     &m  = motion[q];
      const Number      J  = Arenite::max<Number>(m.J, Number(1e-9)), // inverted points are reported below
        J_old = Arenite::max<Number>(m.J_old, Number(1e-9)), volume_strain = trace(m.strain),
                   D = volume_strain * Number(1. / dt);
      for (int k = 0; k < 6; ++k)
        strain[q][k] = m.strain[k];
      density[q]     = Number(rho_0) / J;
      density_old[q] = Number(rho_0) / J_old;
      largest_rate   = Arenite::max<Number>(largest_rate, Arenite::absolute<Number>(D));

      Number A[dim][dim];
      Shape::metric(operators.metric[q], H[q], finite, A);
      size[q] = Shape::square_norm(A);
      BulkViscosity<dim, Number> bulk{element, density[q], load<Number>(&points.wave_speed[at]),
                                      Operators::length_of_unit};
      if (n_viscous == 1)
        {
          const Number q_old = load<Number>(&points.bulk_viscosity[at]),
                       q_new = viscous ? bulk.volumetric(m.strain, D, A) : Number(0.);
          store<Number>(q_new, &points.bulk_viscosity[at]);
          viscous_work[q] =
            Number(-0.5) * volume_strain * (finite ? Number(q_old * J_old + q_new * J) : Number(q_old + q_new));
        }
      else
        {
          if (finite)
            m.turn(&points.bulk_viscosity[6 * at]);
          const SymTensor<Number> old = viscous_stress<Number>(points, n_viscous, at);
          const SymTensor<Number> now = viscous ? bulk.directional(m.strain, dt, A) : SymTensor<Number>();
          for (int k = 0; k < 6; ++k)
            store<Number>(now[k], &points.bulk_viscosity[6 * at + k * W]);
          viscous_work[q] =
            Number(-0.5) * (finite ? Number(J_old * contract(old, m.strain) + J * contract(now, m.strain))
                                   : Number(contract(old, m.strain) + contract(now, m.strain)));
        }
      viscosity[q]  = bulk.largest;
      heat[q]       = viscous_work[q] * Number(1. / rho_0) + hourglass_heat;
      stored_old[q] = load<Number>(&points.stored[at]);
      if (finite)
        {
          m.turn(&points.stress[6 * at]);
          if (law->tensor_history() >= 0)
            m.turn(&points.history[n_history * at + law->tensor_history() * W]);
        }
    }

  PointBatch law_batch = batch_of_points(points, batch, dt, strain, density_old, density, dissipated, by_volume);
  law_batch.heat       = reinterpret_cast<const double *>(heat);
  Number volume_limit[n_points];
  if (law->limits_volume_change())
    law_batch.volume_limit = reinterpret_cast<double *>(volume_limit);
  {
    const Stopwatch watch(points.is_timed ? &points.law_seconds : nullptr);
    law->update(law_batch);
  }
  points.substeps = std::max(points.substeps, law_batch.substeps);

  // energies, the step
  const bool per_present_volume = law->energy_per_present_volume();
  Number     energy = Number(0.), loss = Number(0.), by_viscosity = Number(0.), volume_change = Number(0.),
         volume          = Number(0.);
  Number       frequency = Number(0.), inverse_step = Number(0.);
  const Number shape = load<Number>(&points.ratio[batch * W]);
  for (int q = 0; q < n_points; ++q)
    {
      const std::size_t at = (first + q) * W;
      const Number      w = operators.weight[q], J = motion[q].J, J_old = motion[q].J_old,
                   stored = load<Number>(&points.stored[at]), c = load<Number>(&points.wave_speed[at]);
      const bool with_volume = finite || !per_present_volume;
      energy += w * (with_volume ? Number(J * stored) : stored);
      loss += w * (with_volume ? Number(Number(0.5) * (J + J_old) * dissipated[q]) : dissipated[q]);
      by_viscosity += w * viscous_work[q];
      volume += w;
      if (!per_present_volume)
        volume_change -= w * Number(0.5) * (J + J_old) * by_volume[q];
      else if (finite)
        volume_change -= w * Number(0.5) * (stored_old[q] + stored) * (J - J_old);

      const Number g = shape * size[q], nu = viscosity[q] + Number(law->viscosity_time()) * c * c, f = g * c * c;
      frequency = Arenite::max<Number>(frequency, f);
      // 1/dt = g (nu + sqrt(nu^2 + 4 c^2/g))/4
      inverse_step =
        Arenite::max<Number>(inverse_step,
                             Number(Number(0.25) * (g * nu + square_root(Number(g * nu * g * nu + Number(4.) * f)))));
      const Number sum  = law_sum(&points.stress[6 * at]) + c + stored;
      const auto   good = J > Number(0.) && sum - sum == Number(0.);
      if (any_of(!good))
        for (int l = 0; l < batches.active[batch]; ++l)
          if (!mask_lane(good, l) && batches.cells[batch * W + l] < points.failed_cell)
            points.failed_cell = batches.cells[batch * W + l];
    }
  const Number last = load<Number>(&points.frequency[batch * W]);
  const Number growth =
    Arenite::select<Number>(last > Number(0.), Arenite::min<Number>(frequency / last, Number(4.)), Number(1.));
  inverse_step *= square_root(Arenite::max<Number>(growth, Number(1.)));
  store<Number>(frequency, &points.frequency[batch * W]);
  inverse_step = Arenite::max<Number>(inverse_step, Number(largest_rate * Number(1. / largest_volume_change)));
  if (law_batch.volume_limit)
    for (int q = 0; q < n_points; ++q)
      inverse_step = Arenite::max<Number>(inverse_step, Number(Arenite::absolute<Number>(trace(motion[q].strain)) /
                                                               (Number(dt) * volume_limit[q])));
  store<Number>(inverse_step, &points.inverse_step[batch * W]);
  store<Number>(loss / volume * Number(dt_last > 0. ? 1. / dt_last : 0.), &points.dissipation[batch * W]);
  if constexpr (Element::has_hourglass_control)
    if (!viscous_hourglass) // the stiffness form follows the state that the law gives
      {
        elastic_hourglass_forces(batch, operators, u, H, motion[0], dq, old_stiffness,
                                 hourglass_stiffness(batch, operators, H, h, density[0], points), record, Q);
        hourglass = advance_hourglass(batch, dq, Q, record);
      }
  (void)u, (void)old_stiffness, (void)dq, (void)Q;
  for (int l = 0; l < batches.active[batch]; ++l)
    {
      points.stored_energy += lane(energy, l);
      points.dissipated += lane(loss, l);
      points.viscous_work += lane(by_viscosity, l);
      points.volume_change += lane(volume_change, l);
      points.hourglass_work += lane(hourglass, l);
      note_step(points, batch, l);
    }
}

template <typename Element, int W>
void LawForce<Element, W>::viscous_hourglass_forces(const unsigned int batch, const Operators &operators,
                                                    const Number (&H)[n_points][dim][dim], const Number (&h)[n_points],
                                                    const Amplitudes &dq, const Number &density, const double dt_last,
                                                    const PointData &points, Amplitudes &force) const
{
  Number N[dim][dim]; // of the present cell: an expanded one has larger faces
  Shape::turned_areas(H[0], h[0], n_hoop, finite, N);
  const Number viscosity = Number(element.hourglass_coefficient) * density *
                           load<Number>(&points.wave_speed[batch * W]) * operators.pattern_viscosity(N) *
                           Number(dt_last > 0. ? 1. / dt_last : 0.);
  for (int i = 0; i < dim; ++i)
    for (int a = 0; a < Element::n_patterns; ++a)
      force[i][a] = viscosity * dq[i][a];
}

template <typename Element, int W>
typename LawForce<Element, W>::Number LawForce<Element, W>::hourglass_stiffness(
  const unsigned int batch, const Operators &operators, const Number (&H)[n_points][dim][dim],
  const Number (&h)[n_points], const Number &density, const PointData &points) const
{
  const Number c = load<Number>(&points.wave_speed[batch * W]);
  return Number(element.hourglass_coefficient) * density * c * c * operators.pattern_stiffness() *
         secant_ratio(batch, H, h, points);
}

template <typename Element, int W>
void LawForce<Element, W>::elastic_hourglass_forces(const unsigned int batch, const Operators &operators,
                                                    const Number (&u)[dim][n_nodes],
                                                    const Number (&H)[n_points][dim][dim], const Motion &motion,
                                                    const Amplitudes &dq, const Number &old_stiffness,
                                                    const Number &stiffness, const BlockState &record,
                                                    Amplitudes &force) const
{
  // forces and amplitudes at the beginning of the step, which take part in its rotation
  Amplitudes q, start;
  operators.patterns(u, H, q);
  const Number kept = Arenite::min<Number>(
    Number(1.), Number(stiffness / Arenite::max<Number>(old_stiffness, Number(std::numeric_limits<double>::min()))));
  for (int i = 0; i < dim; ++i)
    for (int a = 0; a < Element::n_patterns; ++a)
      {
        start[i][a] = q[i][a] - dq[i][a];
        force[i][a] = kept * load<Number>(amplitude(record, batch, i, a));
      }
  if (finite)
    {
      motion.turn_vectors(start);
      motion.turn_vectors(force);
    }
  for (int i = 0; i < dim; ++i)
    for (int a = 0; a < Element::n_patterns; ++a)
      force[i][a] += stiffness * (q[i][a] - start[i][a]);
}

template <typename Element, int W>
typename LawForce<Element, W>::Number LawForce<Element, W>::advance_hourglass(const unsigned int batch,
                                                                              const Amplitudes  &dq,
                                                                              const Amplitudes  &force,
                                                                              BlockState        &record) const
{
  PointData &points = record.points;
  Number     work   = Number(0.);
  for (int i = 0; i < dim; ++i)
    for (int a = 0; a < Element::n_patterns; ++a)
      {
        double *stored = amplitude(record, batch, i, a);
        work += Number(0.5) * (load<Number>(stored) + force[i][a]) * dq[i][a];
        store<Number>(force[i][a], stored);
      }
  store<Number>(load<Number>(&points.hourglass[batch * W]) + work, &points.hourglass[batch * W]);
  return work;
}

template <typename Element, int W>
void LawForce<Element, W>::integrate(const unsigned int batch, const Operators &operators,
                                     const Number (&H)[n_points][dim][dim], const Number (&h)[n_points],
                                     const BlockState &record, Number (&f)[dim][n_nodes]) const
{
  const PointData  &points = record.points;
  const std::size_t first  = std::size_t(batch) * n_points;
  Number            P[n_points][dim][dim], hoop[n_points];
  Number            mean_pressure = Number(0.), mean_J = Number(1.);
  if constexpr (Element::mean_dilatation)
    find_means(batch, operators, H, h, points, mean_pressure, mean_J);
  for (int q = 0; q < n_points; ++q)
    {
      const std::size_t at = (first + q) * W;
      SymTensor<Number> s;
      for (int k = 0; k < 6; ++k)
        s[k] = load<Number>(&points.stress[6 * at + k * W]);
      if (n_viscous == 6 || !Element::mean_dilatation)
        s -= viscous_stress<Number>(points, n_viscous, at);
      if (!finite)
        {
          if constexpr (Element::mean_dilatation)
            s = deviator(s) - spherical(mean_pressure);
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              P[q][i][j] = s[Motion::index(i, j)];
          hoop[q] = s[dim < 3 ? dim : 2];
          continue;
        }
      Number F[dim][dim], C[dim][dim], stretch = Number(1.) + h[q], others = Number(1.); // in the hoop directions
      Shape::deformation(H[q], F);
      const Number det = cofactors(F, C);
      for (int i = 0; i < n_hoop; ++i)
        others *= stretch;
      if constexpr (Element::mean_dilatation)
        s = deviator(s) * Number(mean_J / (det * others)) - spherical(mean_pressure);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          {
            Number sum = s[Motion::index(i, 0)] * C[0][j];
            for (int k = 1; k < dim; ++k)
              sum += s[Motion::index(i, k)] * C[k][j];
            P[q][i][j] = sum * others;
          }
      if constexpr (n_hoop > 0)
        hoop[q] = s[dim < 3 ? dim : 2] * det * (n_hoop == 1 ? Number(1.) : stretch);
    }
  if constexpr (Element::has_hourglass_control)
    {
      Amplitudes Q;
      for (int k = 0; k < n_amplitudes; ++k)
        Q[k / Element::n_patterns][k % Element::n_patterns] =
          load<Number>(&record.amplitude[(std::size_t(batch) * n_amplitudes + k) * W]);
      operators.forces(P, hoop, Q, f);
    }
  else if constexpr (n_points == 1)
    {
      const Amplitudes none = {};
      operators.forces(P, hoop, none, f);
    }
  else
    operators.forces(P, hoop, f);
  (void)h, (void)mean_pressure, (void)mean_J;
}
} // namespace Arenite
