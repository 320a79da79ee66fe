#pragma once

#include <arenite/base/parameters.h>
#include <arenite/base/tensor_tools.h>
#include <arenite/materials/iterations.h>

#include <string>
#include <type_traits>

namespace Arenite
{
/// What changes in a point over one step, in a frame that has taken part in the rotation. Small strain: densities that follow from
/// the strain are still those of J, never of a sum of strain traces.
template <typename Number>
struct PointIncrement
{
  SymTensor<Number> strain;                   ///< logarithmic strain increment [-], tension positive
  Number            density_old = Number(1.); ///< at t_n [kg/m^3]
  Number            density     = Number(1.); ///< at t_{n+1} [kg/m^3]
  Number            heat        = Number(0.); ///< work of artificial viscosity in this step [J/kg]
  double            dt          = 0.;         ///< [s]
};

/// What a law answers, at t_{n+1}.
template <typename Number>
struct Response
{
  SymTensor<Number> stress;                  ///< Cauchy stress [Pa], tension positive
  Number            wave_speed = Number(0.); ///< no disturbance of the present state is faster [m/s]
  Number            stored     = Number(0.); ///< recoverable energy [J/m^3], per present volume
  Number dissipated = Number(0.); ///< what the step turned into heat and closed pores, PointIncrement::heat not counted
                                  ///< again [J/m^3], per present volume
  Number stored_by_volume =
    Number(0.); ///< what the volume change of the step added to `stored` without work [J/m^3], per present volume;
                ///< of laws of which a part has moduli of the Cauchy stress, see PointState
  double     substeps = 1.; ///< parts into which the law divided the step
  Iterations iterations;    ///< of the equations that the law solved
};

/// No memory but the stress.
template <typename Number>
struct NoHistory
{
  template <typename F>
  void for_each(F &&)
  {}
};

// A law is a struct without a base class. It knows no mesh, no process and no file:
//
//   struct MyLaw
//   {
//     static constexpr const char *name        = "my law";         // `set Law = my law`
//     static constexpr const char *description = "One sentence for the manual.";
//
//     template <typename Number>
//     struct History                                               // or: using History = NoHistory<Number>
//     {
//       Number hardening = Number(0.);
//       template <typename F> void for_each(F &&f) { f("hardening", hardening); }
//     };
//
//     void declare_parameters(Parameters &);                       // entries of the block's section
//     void finalize(const Parameters &);                           // derived constants; refuse() with the reason
//
//     double density() const;                                      // at rest [kg/m^3]
//     History<double> initial_history() const;
//
//     template <typename Number>
//     Response<Number> update(const SymTensor<Number> &stress_n,   // Cauchy stress at t_n, rotation done [Pa]
//                             const PointIncrement<Number> &, History<Number> &) const;
//
//     double wave_speed_bound() const;                             // [m/s], over all states up to the law's valid range
//     template <typename Number>
//     void after_transfer(SymTensor<Number> &stress, History<Number> &) const;   // back to an admissible state
//
//     template <typename F>
//     void for_each_constant(F &&f) const;                         // may be left out: f(name, value, unit) of what the log shows
//     std::vector<std::string> warnings() const;                   // may be left out: what is admissible and doubtful, for the log
//     static constexpr bool energy_per_present_volume = true;      // may be left out: all moduli are of the Cauchy stress, see PointState
//     static constexpr int  tensor_history            = 0;         // may be left out: first of six entries that turn with the point
//     double viscosity_time() const;                               // may be left out: stiffness-proportional viscosity [s]
//     double relaxation_time_at_rest() const;                      // may be left out: of a small overstress [s]
//     std::string begin_under(const SymTensor<double> &stress, double overconsolidation, History<double> &) const;
//                                                                  // may be left out: whether the law can begin under a stress without
//                                                                  // strain, with the history that goes with it; else the reason
//   };
//
// A new law is complete with its line in law_types.h.
//
// Rules. `Number` is double, lanes or a differentiable number: no `if` on a Number, select() instead. Pressure is positive in
// compression, stress and strain in tension. Branches that are the same for all points (a parameter, dt) are plain `if`s.

/// True if @p Law offers all of the above for @p Number.
template <typename Law, typename Number = double, typename = void>
struct IsMaterialLaw : std::false_type
{};
template <typename Law, typename Number>
struct IsMaterialLaw<
  Law, Number,
  std::void_t<decltype(Law::name), decltype(Law::description),
              decltype(std::declval<Law &>().declare_parameters(std::declval<Parameters &>())),
              decltype(std::declval<Law &>().finalize(std::declval<const Parameters &>())),
              std::enable_if_t<std::is_same_v<decltype(std::declval<const Law &>().density()), double>>,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const Law &>().initial_history()),
                                              typename Law::template History<double>>>,
              std::enable_if_t<std::is_same_v<
                decltype(std::declval<const Law &>().update(std::declval<const SymTensor<Number> &>(),
                                                            std::declval<const PointIncrement<Number> &>(),
                                                            std::declval<typename Law::template History<Number> &>())),
                Response<Number>>>,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const Law &>().wave_speed_bound()), double>>,
              decltype(std::declval<const Law &>().after_transfer(
                std::declval<SymTensor<Number> &>(), std::declval<typename Law::template History<Number> &>()))>>
  : std::true_type
{};
} // namespace Arenite
