#pragma once

#include <arenite/materials/elastic_constants.h>
#include <arenite/materials/material_law.h>

#include <string>

namespace Arenite
{
/// Linear viscoelastic solid: an isotropic spring C (the block's elastic constants) and a branch with the same Poisson ratio.
///
///   Maxwell                 sigma + tau sigma_dot = tau C : eps_dot              C is the instantaneous stiffness
///   Kelvin-Voigt            sigma = C : (eps + tau eps_dot)                      C is the relaxed stiffness
///   standard linear solid   sigma = C : eps + h,  h + tau h_dot = tau m C : eps_dot     C relaxed, m = branch ratio
///
/// The branch is integrated exactly for a strain rate that is constant over the step, so that the step is bounded by accuracy in
/// the load alone: h_{n+1} = h_n e^{-dt/tau} + m C : Delta eps (tau/dt) (1 - e^{-dt/tau}). Fung (1977); Roger (2015), section 2.1.
///
/// The branch stress is a tensor of the frame of the strain increments: who turns the stress turns it, too.
struct Viscoelastic
{
  static constexpr const char *name        = "viscoelastic";
  static constexpr const char *description = "Maxwell, Kelvin-Voigt or standard linear solid, exact in the branch.";

  static constexpr bool energy_per_present_volume = true;
  static constexpr int  tensor_history            = 0; ///< the branch stress

  enum class Model
  {
    maxwell,
    kelvin_voigt,
    standard
  };

  template <typename Number>
  struct History
  {
    SymTensor<Number> branch; ///< h [Pa]; Kelvin-Voigt: the viscous stress

    template <typename F>
    void for_each(F &&f)
    {
      constexpr const char *names[] = {"branch stress xx", "branch stress yy", "branch stress zz",
                                       "branch stress xy", "branch stress xz", "branch stress yz"};
      for (int k = 0; k < 6; ++k)
        f(names[k], branch[k]);
    }
  };

  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  double          density() const { return spring.density; }
  History<double> initial_history() const { return {}; }

  /// Of the fastest waves: the branch is stiff for them. Kelvin-Voigt has no fastest wave, see stable_step().
  double wave_speed_bound() const { return spring.p_wave_speed() * std::sqrt(instantaneous()); }

  /// tau of the viscous stress tau C : eps_dot of a Kelvin-Voigt solid [s]
  double viscosity_time() const { return model == Model::kelvin_voigt ? relaxation_time : 0.; }

  /// Largest stable step of central differences for waves of length 2 h [s]: (2/omega) (sqrt(1 + xi^2) - xi), omega = 2 c/h. A
  /// Kelvin-Voigt solid has xi = tau omega/2, so that the step falls with h^2 on fine meshes.
  double stable_step(const double h) const
  {
    const double omega = 2. * wave_speed_bound() / h,
                 xi    = model == Model::kelvin_voigt ? 0.5 * relaxation_time * omega : 0.;
    return 2. / omega * (std::sqrt(1. + xi * xi) - xi);
  }

  template <typename Number>
  Response<Number> update(const SymTensor<Number> &stress_n, const PointIncrement<Number> &increment,
                          History<Number> &history) const
  {
    const double            x = increment.dt / relaxation_time, E = std::exp(-x);
    const SymTensor<Number> force = stiffness_times(increment.strain); // C : Delta eps
    const SymTensor<Number> h_n   = model == Model::maxwell ? stress_n : history.branch;
    SymTensor<Number>       h;
    Number                  dissipated;
    if (model == Model::kelvin_voigt)
      {
        h          = increment.dt > 0. ? force * Number(1. / x) : h_n;
        dissipated = contract(h, increment.strain);
      }
    else
      {
        const double m    = model == Model::maxwell ? 1. : branch_ratio;
        const double rise = x > 1e-8 ? -std::expm1(-x) / x : 1. - 0.5 * x; // (1 - e^-x)/x
        h                 = h_n * Number(E) + force * Number(m * rise);
        // integral of h : (m C)^-1 : h / tau over the step, h = h_n e^-s + m C : Delta eps (1 - e^-s)/x, 0 < s < x
        const StepIntegrals i = integrals(x);
        dissipated            = Number(i.old_old / m) * compliance_product(h_n, h_n) +
                     Number(2. * i.old_new) * compliance_product(h_n, force) +
                     Number(m * i.new_new) * compliance_product(force, force);
      }

    const SymTensor<Number> relaxed_n = model == Model::maxwell ? SymTensor<Number>() : stress_n - h_n;
    const SymTensor<Number> relaxed   = model == Model::maxwell ? relaxed_n : relaxed_n + force;
    Response<Number>        response;
    response.stress = relaxed + h;
    response.stored = Number(0.5) * compliance_product(relaxed, relaxed);
    if (model != Model::kelvin_voigt)
      response.stored += Number(0.5 / (model == Model::maxwell ? 1. : branch_ratio)) * compliance_product(h, h);
    response.dissipated = dissipated;
    response.wave_speed = square_root(
      Number(Number(instantaneous() * (spring.bulk_modulus + 4. / 3. * spring.shear_modulus)) / increment.density));
    history.branch = h;
    return response;
  }

  template <typename Number>
  void after_transfer(SymTensor<Number> &, History<Number> &) const
  {}

  /// f(name, value, unit) for the log.
  template <typename F>
  void for_each_constant(F &&f) const
  {
    spring.for_each_constant(f);
    constants.for_each_constant(f);
  }

  ElasticConstants constants;
  LinearElastic    spring;
  std::string      model_name      = "standard linear solid";
  Model            model           = Model::standard;
  double           relaxation_time = 1.; ///< tau [s]
  double           branch_ratio    = 1.; ///< m [-]

private:
  /// Integrals over 0 < s < x of e^-2s, of e^-s (1 - e^-s)/x and of (1 - e^-s)^2/x^2. The last is (x - u - u^2/2)/x^2 with u = 1 - e^-x,
  /// which cancels in small steps; with x = -ln(1 - u) it is a series of positive terms, (u^3/3 + u^4/4 + ...)/x^2.
  struct StepIntegrals
  {
    double old_old = 0., old_new = 0., new_new = 0.;
  };
  static StepIntegrals integrals(const double x)
  {
    if (!(x > 0.))
      return {};
    const double u = -std::expm1(-x), r = u / x;
    double       sum = 0.;
    if (u < 0.05)
      for (int k = 13; k >= 3; --k) // the next term is below 1e-14 of the first
        sum = 1. / k + u * sum;
    return {u - 0.5 * u * u, 0.5 * u * r, u < 0.05 ? u * r * r * sum : (x - u - 0.5 * u * u) / (x * x)};
  }

  /// Stiffness for infinitely fast loading over C.
  double instantaneous() const { return model == Model::standard ? 1. + branch_ratio : 1.; }

  template <typename Number>
  SymTensor<Number> stiffness_times(const SymTensor<Number> &strain) const
  {
    return deviator(strain) * Number(2. * spring.shear_modulus) +
           spherical(Number(Number(spring.bulk_modulus) * trace(strain)));
  }

  /// a : C^-1 : b
  template <typename Number>
  Number compliance_product(const SymTensor<Number> &a, const SymTensor<Number> &b) const
  {
    return contract(deviator(a), deviator(b)) * Number(0.5 / spring.shear_modulus) +
           trace(a) * trace(b) * Number(1. / (9. * spring.bulk_modulus));
  }
};
} // namespace Arenite
