#pragma once

#include <arenite/materials/elastic_constants.h>
#include <arenite/materials/material_law.h>

namespace Arenite
{
/// Linear elasticity as a law of the list: sigma_{n+1} = sigma_n + K tr(d eps) I + 2 G dev(d eps). Small-strain scenes use the
/// kernel with the fused LinearElastic instead, which stores nothing.
struct LinearElasticLaw
{
  static constexpr const char *name        = "linear elastic";
  static constexpr const char *description = "Isotropic linear elasticity.";

  static constexpr bool energy_per_present_volume = true;

  template <typename Number>
  using History = NoHistory<Number>;

  void declare_parameters(Parameters &parameters) { constants.declare_parameters(parameters); }
  void finalize(const Parameters &parameters) { elastic = constants.finalize(parameters); }

  double          density() const { return elastic.density; }
  History<double> initial_history() const { return {}; }
  double          wave_speed_bound() const { return elastic.p_wave_speed(); }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &) const
  {
    const Number     K = Number(elastic.bulk_modulus), G = Number(elastic.shear_modulus);
    Response<Number> response;
    response.stress =
      stress_n + deviator(increment.strain) * Number(Number(2.) * G) + spherical(Number(K * trace(increment.strain)));
    const Number p      = pressure(response.stress);
    response.stored     = elastic.stored_energy(p, second_invariant(deviator(response.stress)));
    response.wave_speed = square_root(Number((K + Number(4. / 3.) * G) / increment.density));
    return response;
  }

  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &) const
  {}

  std::string begin_under(const SymTensor<double> &, double, History<double> &) const { return ""; }

  template <typename F>
  void for_each_constant(F &&f) const
  {
    elastic.for_each_constant(f);
    constants.for_each_constant(f);
  }

  ElasticConstants constants;
  LinearElastic    elastic;
};
} // namespace Arenite
