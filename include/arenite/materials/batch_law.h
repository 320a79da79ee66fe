#pragma once

#include <arenite/base/parameters.h>
#include <arenite/materials/material_law.h>

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Arenite
{
/// The points of W cells, one step: arrays of a kernel's buffer and of the block's stored state, structure of arrays with the
/// lane as last index. The law reads the first group, replaces the second and writes the third.
struct PointBatch
{
  unsigned int n_points = 0;
  double       dt       = 0.; ///< [s]

  const double *strain      = nullptr; ///< [point][6][lane], logarithmic increment, tension positive
  const double *density_old = nullptr; ///< [point][lane], at t_n [kg/m^3]
  const double *density     = nullptr; ///< [point][lane], at t_{n+1} [kg/m^3]
  const double *heat        = nullptr; ///< [point][lane], work of artificial viscosity [J/kg]; none if null

  double *stress  = nullptr; ///< [point][6][lane], Cauchy stress [Pa]
  double *history = nullptr; ///< [point][n_history][lane]

  double *wave_speed       = nullptr; ///< [point][lane] [m/s]
  double *stored           = nullptr; ///< [point][lane], per present volume [J/m^3]
  double *dissipated       = nullptr; ///< [point][lane], of this step, per present volume [J/m^3]
  double *stored_by_volume = nullptr; ///< [point][lane], Response::stored_by_volume; not wanted if null
  double *volume_limit     = nullptr; ///< [point][lane], see BatchLaw::limits_volume_change(); not wanted if null
  double  substeps         = 1.;      ///< most parts into which the law divided the step of a point
};

/// A number that follows from the parameters, for the log.
struct DerivedConstant
{
  std::string name;
  double      value;
  std::string unit;
};

/// A law as kernels, scenes and the bench see it: one virtual call for all points of a batch of cells.
class BatchLaw
{
public:
  virtual ~BatchLaw() = default;

  virtual void   declare_parameters(Parameters &)   = 0;
  virtual void   finalize(const Parameters &)       = 0;
  virtual int    n_lanes() const                    = 0;
  virtual void   update(PointBatch &) const         = 0;
  virtual void   after_transfer(PointBatch &) const = 0; ///< stress and history, back to an admissible state
  virtual double density() const                    = 0; ///< at rest [kg/m^3]
  virtual double wave_speed_bound() const           = 0; ///< [m/s]

  virtual bool   energy_per_present_volume() const = 0; ///< see PointState
  virtual int    tensor_history() const = 0; ///< first of six entries of the history that turn with the point; -1: none
  virtual double viscosity_time() const = 0; ///< of a viscous stress in proportion to the stiffness [s]; 0: none
  virtual double relaxation_time_at_rest() const = 0; ///< of an overstress at rest [s]; 0: not known

  /// Whether states may stiffen much over one step; update() then says how large the next volume strain should be at most.
  virtual bool limits_volume_change() const = 0;

  /// Set the history of a point, in the order of history_names(), to one that goes with @p stress [Pa] without any strain; the largest past
  /// stress was @p overconsolidation times as large. @return why the law cannot begin so, or nothing
  virtual std::string begin_under(const SymTensor<double> &stress, double overconsolidation, double *history) const = 0;

  virtual std::vector<std::string>     history_names() const     = 0;
  virtual std::vector<double>          initial_history() const   = 0;
  virtual std::vector<DerivedConstant> derived_constants() const = 0;
  virtual std::vector<std::string>     warnings() const          = 0; ///< sentences for the log
};

/// The history of W points to and from an array [n_history][lane], by for_each.
template <typename History, typename Number>
ARENITE_INLINE void load_history(History &history, const double *from)
{
  history.for_each([&](const char *, Number &value) {
    value = load<Number>(from);
    from += n_lanes<Number>();
  });
}
template <typename History, typename Number>
ARENITE_INLINE void store_history(History &history, double *to)
{
  history.for_each([&](const char *, const Number &value) {
    store<Number>(value, to);
    to += n_lanes<Number>();
  });
}

/// Laws may offer `template <typename F> void for_each_constant(F &&f) const`, with f(name, value, unit).
template <typename Law, typename = void>
struct HasDerivedConstants : std::false_type
{};
template <typename Law>
struct HasDerivedConstants<Law, std::void_t<decltype(std::declval<const Law &>().for_each_constant(
                                  std::declval<void (*)(const char *, double, const char *)>()))>> : std::true_type
{};

/// Laws may offer `std::vector<std::string> warnings() const`: parameters that are admissible and doubtful.
template <typename Law, typename = void>
struct HasWarnings : std::false_type
{};
template <typename Law>
struct HasWarnings<Law, std::void_t<decltype(std::declval<const Law &>().warnings())>> : std::true_type
{};

/// Laws may say that their energies are those of the present volume, see PointState.
template <typename Law, typename = void>
struct EnergyPerPresentVolume : std::false_type
{};
template <typename Law>
struct EnergyPerPresentVolume<Law, std::enable_if_t<Law::energy_per_present_volume>> : std::true_type
{};

/// Laws may have a tensor in their history: six entries from Law::tensor_history on, in the order of SymTensor.
template <typename Law, typename = void>
struct TensorHistory : std::integral_constant<int, -1>
{};
template <typename Law>
struct TensorHistory<Law, std::enable_if_t<(Law::tensor_history >= 0)>>
  : std::integral_constant<int, Law::tensor_history>
{};

/// Laws may have times of their own.
template <typename Law, typename = void>
struct HasViscosityTime : std::false_type
{};
template <typename Law>
struct HasViscosityTime<Law, std::void_t<decltype(std::declval<const Law &>().viscosity_time())>> : std::true_type
{};
template <typename Law, typename = void>
struct HasRelaxationTime : std::false_type
{};
template <typename Law>
struct HasRelaxationTime<Law, std::void_t<decltype(std::declval<const Law &>().relaxation_time_at_rest())>>
  : std::true_type
{};

/// Laws may say how large a volume strain of one step may be: `Number volume_limit(const History<Number> &) const`.
template <typename Law, typename = void>
struct HasVolumeLimit : std::false_type
{};
template <typename Law>
struct HasVolumeLimit<Law, std::void_t<decltype(std::declval<const Law &>().limits_volume_change())>> : std::true_type
{};

/// Laws may begin under a stress.
template <typename Law, typename = void>
struct BeginsUnderStress : std::false_type
{};
template <typename Law>
struct BeginsUnderStress<
  Law, std::void_t<decltype(std::declval<const Law &>().begin_under(
         std::declval<const SymTensor<double> &>(), 1., std::declval<typename Law::template History<double> &>()))>>
  : std::true_type
{};

/// @p Law on W lanes: loops over the points, everything inside is inlined.
template <typename Law, int W>
class BatchLawFor final : public BatchLaw
{
public:
  using Number  = Lanes<W>;
  using History = typename Law::template History<Number>;
  static_assert(IsMaterialLaw<Law, Number>::value, "material_law.h says what a law must offer");

  void   declare_parameters(Parameters &parameters) override { law.declare_parameters(parameters); }
  void   finalize(const Parameters &parameters) override { law.finalize(parameters); }
  int    n_lanes() const override { return W; }
  double density() const override { return law.density(); }
  double wave_speed_bound() const override { return law.wave_speed_bound(); }

  void update(PointBatch &batch) const override
  {
    batch.substeps = 1.;
    for (unsigned int point = 0; point < batch.n_points; ++point)
      {
        const unsigned int     at = point * W;
        PointIncrement<Number> increment;
        SymTensor<Number>      stress;
        for (int k = 0; k < 6; ++k)
          {
            increment.strain[k] = load<Number>(batch.strain + 6 * at + k * W);
            stress[k]           = load<Number>(batch.stress + 6 * at + k * W);
          }
        increment.density_old = load<Number>(batch.density_old + at);
        increment.density     = load<Number>(batch.density + at);
        if (batch.heat)
          increment.heat = load<Number>(batch.heat + at);
        increment.dt = batch.dt;
        History history;
        load_history<History, Number>(history, batch.history + n_history * at);

        const Response<Number> response = law.update(stress, increment, history);

        for (int k = 0; k < 6; ++k)
          store<Number>(response.stress[k], batch.stress + 6 * at + k * W);
        store_history<History, Number>(history, batch.history + n_history * at);
        store<Number>(response.wave_speed, batch.wave_speed + at);
        store<Number>(response.stored, batch.stored + at);
        store<Number>(response.dissipated, batch.dissipated + at);
        if (batch.stored_by_volume)
          store<Number>(response.stored_by_volume, batch.stored_by_volume + at);
        if constexpr (HasVolumeLimit<Law>::value)
          if (batch.volume_limit)
            store<Number>(law.volume_limit(history), batch.volume_limit + at);
        batch.substeps = std::max(batch.substeps, response.substeps);
      }
  }

  void after_transfer(PointBatch &batch) const override
  {
    for (unsigned int point = 0; point < batch.n_points; ++point)
      {
        const unsigned int at = point * W;
        SymTensor<Number>  stress;
        History            history;
        for (int k = 0; k < 6; ++k)
          stress[k] = load<Number>(batch.stress + 6 * at + k * W);
        load_history<History, Number>(history, batch.history + n_history * at);
        law.after_transfer(stress, history);
        for (int k = 0; k < 6; ++k)
          store<Number>(stress[k], batch.stress + 6 * at + k * W);
        store_history<History, Number>(history, batch.history + n_history * at);
      }
  }

  bool energy_per_present_volume() const override { return EnergyPerPresentVolume<Law>::value; }
  int  tensor_history() const override { return TensorHistory<Law>::value; }

  double viscosity_time() const override
  {
    if constexpr (HasViscosityTime<Law>::value)
      return law.viscosity_time();
    else
      return 0.;
  }
  double relaxation_time_at_rest() const override
  {
    if constexpr (HasRelaxationTime<Law>::value)
      return law.relaxation_time_at_rest();
    else
      return 0.;
  }

  bool limits_volume_change() const override
  {
    if constexpr (HasVolumeLimit<Law>::value)
      return law.limits_volume_change();
    else
      return false;
  }

  std::string begin_under(const SymTensor<double> &stress, const double overconsolidation,
                          double *values) const override
  {
    if constexpr (BeginsUnderStress<Law>::value)
      {
        typename Law::template History<double> history;
        load_history<typename Law::template History<double>, double>(history, values);
        const std::string reason = law.begin_under(stress, overconsolidation, history);
        store_history<typename Law::template History<double>, double>(history, values);
        return reason;
      }
    else
      return (void)stress, (void)overconsolidation, (void)values,
             std::string("the stress of the law '") + Law::name +
               "' follows from its strain, it cannot begin under one.";
  }

  std::vector<std::string> history_names() const override
  {
    std::vector<std::string> names;
    History().for_each([&](const char *name, const Number &) { names.emplace_back(name); });
    return names;
  }

  std::vector<double> initial_history() const override
  {
    std::vector<double> values;
    auto                history = law.initial_history();
    history.for_each([&](const char *, const double &value) { values.push_back(value); });
    return values;
  }

  std::vector<DerivedConstant> derived_constants() const override
  {
    std::vector<DerivedConstant> constants;
    if constexpr (HasDerivedConstants<Law>::value)
      law.for_each_constant([&](const char *name, const double value, const char *unit) {
        constants.push_back({name, value, unit});
      });
    return constants;
  }

  std::vector<std::string> warnings() const override
  {
    if constexpr (HasWarnings<Law>::value)
      return law.warnings();
    else
      return {};
  }

  Law law;

private:
  static unsigned int count()
  {
    unsigned int n = 0;
    History().for_each([&](const char *, const Number &) { ++n; });
    return n;
  }
  const unsigned int n_history = count();
};
} // namespace Arenite
