#include <arenite/base/formula.h>
#include <arenite/base/prescan.h>
#include <arenite/base/registry.h>
#include <arenite/base/time_history.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace Arenite
{
namespace
{
/// Regularity of a function without any break: larger than any order of approximation.
constexpr int infinitely_smooth = 99;

/// Default of an entry that the user must give.
constexpr double no_default = std::numeric_limits<double>::quiet_NaN();

/// value(t) = amplitude shape(t - start), zero before the start: the part that all histories share.
///
/// A derived class knows only the local time s = t - start >= 0.
class ShiftedHistory : public TimeHistory
{
public:
  double value(const double t) const final
  {
    const double s = t - start_time;
    return s < 0. ? 0. : amplitude * shape(s);
  }

  std::vector<double> break_points() const final
  {
    std::vector<double> times = shape_breaks();
    for (double &time : times)
      time += start_time;
    return times;
  }

  void declare_parameters(Parameters &parameters) final
  {
    scene   = &parameters;
    section = parameters.current_path();
    parameters.add_quantity("Amplitude", amplitude, "unit of the load", any_value,
                            "Factor of the normalised history; for most names the largest value.");
    parameters.add_quantity("Start time", start_time, "s", non_negative,
                            "The history is zero before, and shifted by it.");
    declare_shape(parameters);
  }

protected:
  /// Normalised value at the local time @p s >= 0 [s].
  virtual double shape(double s) const = 0;

  /// Breaks in local time, ascending, >= 0.
  virtual std::vector<double> shape_breaks() const { return {0.}; }

  virtual void declare_shape(Parameters &) {}

  /// Refuse the value of @p entry in the section where this history was declared.
  [[noreturn]] void refuse(const std::string &entry, const std::string &reason) const
  {
    if (scene)
      scene->refuse(section.empty() ? entry : section + "/" + entry, reason);
    throw InputError(entry + ": " + reason);
  }

private:
  double            amplitude  = 1.;
  double            start_time = 0.;
  const Parameters *scene      = nullptr; ///< for refuse(); lives as long as the scene
  std::string       section;
};

// Polynomial steps S(x) from 0 to 1. The upper half is taken from S(x) = 1 - S(1 - x): the powers lose digits near x =
// 1.

/// S3(x) = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7, three continuous derivatives at 0 and 1.
double smooth_step_3(const double x)
{
  if (x >= 1.)
    return 1.;
  if (x > 0.5)
    return 1. - smooth_step_3(1. - x);
  return x * x * x * x * (35. + x * (-84. + x * (70. - 20. * x)));
}

/// S5(x) = x^6 (462 - 1980 x + 3465 x^2 - 3080 x^3 + 1386 x^4 - 252 x^5), five continuous derivatives.
double smooth_step_5(const double x)
{
  if (x >= 1.)
    return 1.;
  if (x > 0.5)
    return 1. - smooth_step_5(1. - x);
  return std::pow(x, 6) * (462. + x * (-1980. + x * (3465. + x * (-3080. + x * (1386. - 252. * x)))));
}

/// A for s >= 0. Jump at the start: displacements converge with order 1 to 1.33 whatever the degree.
class Constant : public ShiftedHistory
{
public:
  int regularity() const override { return -1; }

protected:
  double shape(const double) const override { return 1.; }
};

/// A S(s / rise time), then A.
template <double (*S)(double), int continuous_derivatives>
class SmoothStep : public ShiftedHistory
{
public:
  int regularity() const override { return continuous_derivatives; }

protected:
  double              shape(const double s) const override { return S(s / rise_time); }
  std::vector<double> shape_breaks() const override { return {0., rise_time}; }
  void                declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity(
      "Rise time", rise_time, "s", positive,
      "Time from zero to the full amplitude; longer rises excite longer waves and need fewer cells.");
  }

private:
  double rise_time = no_default;
};
using C3Step = SmoothStep<smooth_step_3, 3>;
using C5Step = SmoothStep<smooth_step_5, 5>;

/// A exp(-beta s). Jump at the start.
class Exponential : public ShiftedHistory
{
public:
  int regularity() const override { return -1; }

protected:
  double shape(const double s) const override { return std::exp(-decay_rate * s); }
  void   declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity("Decay rate", decay_rate, "1/s", non_negative,
                            "Rate beta of exp(-beta t); larger values shorten the pulse.");
  }

private:
  double decay_rate = no_default;
};

/// A S3(s / rise time) exp(-beta s): an explosion without the jump. Its largest value is below A.
class RiseExponential : public ShiftedHistory
{
public:
  int regularity() const override { return 3; }

protected:
  double shape(const double s) const override { return smooth_step_3(s / rise_time) * std::exp(-decay_rate * s); }
  std::vector<double> shape_breaks() const override { return {0., rise_time}; }
  void                declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity("Rise time", rise_time, "s", positive,
                            "Time in which the C3 polynomial grows from 0 to 1; the decay acts from the start.");
    parameters.add_quantity("Decay rate", decay_rate, "1/s", non_negative,
                            "Rate beta of exp(-beta t); larger values shorten the pulse.");
  }

private:
  double rise_time  = no_default;
  double decay_rate = no_default;
};

/// A sin^n(pi s / T) for 0 < s < T, zero elsewhere: n - 1 continuous derivatives.
class SinePulse : public ShiftedHistory
{
public:
  int regularity() const override { return static_cast<int>(exponent) - 1; }

protected:
  double shape(const double s) const override
  {
    return s < duration ? std::pow(std::sin(dealii::numbers::PI * s / duration), static_cast<int>(exponent)) : 0.;
  }
  std::vector<double> shape_breaks() const override { return {0., duration}; }
  void                declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity("Duration", duration, "s", positive,
                            "Length T of the pulse; longer pulses need fewer cells.");
    parameters.add_integer(
      "Exponent", exponent, 1, 100,
      "Power n of the sine: n - 1 continuous derivatives and a narrower pulse. Elements of degree p "
      "show their full order for n > p.");
  }

private:
  double       duration = no_default;
  unsigned int exponent = 4;
};

/// Shapes with one centre and infinite tails, cut at the start: what Gaussian and Ricker share.
class CentredPulse : public ShiftedHistory
{
public:
  /// Smooth if the cut at the start is below rounding (4 eps), a jump otherwise. The Gaussian passes from a centre time
  /// of 8.4 standard deviations, the Ricker wavelet from 2 / frequency.
  int regularity() const override
  {
    return std::abs(shape(0.)) <= 4. * std::numeric_limits<double>::epsilon() ? infinitely_smooth : -1;
  }

protected:
  double centre_time = no_default;

  /// Half of the interval outside of which the shape is negligible (1e-8) [s].
  virtual double half_width() const = 0;

  /// The start, and the flanks and the middle of the pulse. Nothing jumps at the latter three; they make quadrature
  /// panels look at the pulse even when it is short compared with them.
  std::vector<double> shape_breaks() const override
  {
    std::vector<double> times = {0.};
    for (const double time : {centre_time - half_width(), centre_time, centre_time + half_width()})
      if (time > 0.)
        times.push_back(time);
    return times;
  }
};

/// A exp(-(s - s_c)^2 / (2 sigma^2)), cut at s = 0 with a jump of A exp(-s_c^2 / (2 sigma^2)):
/// 1.5e-8 A at s_c = 6 sigma, 1e-14 A at 8 sigma, below rounding from 8.5 sigma on.
class Gaussian : public CentredPulse
{
protected:
  double shape(const double s) const override
  {
    const double x = (s - centre_time) / standard_deviation;
    return std::exp(-0.5 * x * x);
  }
  double half_width() const override { return 6. * standard_deviation; }
  void   declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity(
      "Centre time", centre_time, "s", non_negative,
      "Time of the peak after the start. At 6 standard deviations the pulse starts with a jump of "
      "1.5e-8, at 8.5 with one below rounding.");
    parameters.add_quantity("Standard deviation", standard_deviation, "s", positive,
                            "Width of the pulse; wider pulses need fewer cells.");
  }

private:
  double standard_deviation = no_default;
};

/// Ricker wavelet A (1 - 2 x^2) exp(-x^2), x = pi f (s - s_c), cut at s = 0. Its time integral is zero (without the
/// cut).
class Ricker : public CentredPulse
{
protected:
  double shape(const double s) const override
  {
    const double x = dealii::numbers::PI * frequency * (s - centre_time);
    return (1. - 2. * x * x) * std::exp(-x * x);
  }
  double half_width() const override { return 1.5 / frequency; }
  void   declare_shape(Parameters &parameters) override
  {
    parameters.add_quantity(
      "Centre time", centre_time, "s", non_negative,
      "Time of the peak after the start. From 2 / frequency on the cut at the start is below rounding.");
    parameters.add_quantity("Frequency", frequency, "1/s", positive,
                            "Frequency of the largest spectral amplitude; higher frequencies need more cells.");
  }

private:
  double frequency = no_default;
};

/// Linear interpolation in a table of (time, value); zero before the first row, the last value after the last row.
class Table : public ShiftedHistory
{
public:
  /// 0 (kinks at the rows), or -1 if the first row does not start from zero.
  int regularity() const override { return shape(std::max(0., times.empty() ? 0. : times.front())) == 0. ? 0 : -1; }

  /// Read the file: one header line, then "time,value" in ascending time; blank lines and lines with # are skipped.
  void finalize() override
  {
    if (file_name.empty())
      refuse("File", "a table needs the name of a file with the columns time,value.");
    std::istringstream file(content());
    times.clear();
    values.clear();
    bool        header_seen = false;
    std::string line;
    for (unsigned int line_number = 1; std::getline(file, line); ++line_number)
      {
        line = dealii::Utilities::trim(line);
        if (line.empty() || line.front() == '#')
          continue;
        const auto refuse_line = [&](const std::string &reason) {
          throw InputError(file_name + ":" + std::to_string(line_number) + ": '" + line + "': " + reason);
        };

        const std::vector<std::string> cells = dealii::Utilities::split_string_list(line, ',');
        if (cells.size() != 2)
          refuse_line("expected two columns time,value, found " + std::to_string(cells.size()) + ".");
        double     row[2];
        const bool numeric = parse(cells[0], row[0]) && parse(cells[1], row[1]);
        if (!header_seen)
          {
            header_seen = true;
            if (numeric)
              refuse_line("the first line must be a header such as 'time,value', not numbers.");
            continue;
          }
        if (!numeric)
          refuse_line("expected two finite numbers time,value.");
        if (!times.empty() && row[0] <= times.back())
          refuse_line("times must ascend; the row before has time " + dealii::Patterns::Tools::to_string(times.back()) +
                      ".");
        times.push_back(row[0]);
        values.push_back(row[1]);
      }
    if (times.empty())
      refuse("File", "the file '" + file_name + "' has no rows time,value after its header line.");
    if (times.back() < 0.)
      refuse("File", "all times in '" + file_name + "' are negative; the history starts at 0.");
  }

protected:
  double shape(const double s) const override
  {
    const std::size_t above = std::upper_bound(times.begin(), times.end(), s) - times.begin();
    if (above == 0)
      return 0.;
    if (above == times.size())
      return values.back();
    const double weight = (s - times[above - 1]) / (times[above] - times[above - 1]);
    return (1. - weight) * values[above - 1] + weight * values[above];
  }

  std::vector<double> shape_breaks() const override
  {
    std::vector<double> breaks = {0.};
    std::copy_if(times.begin(), times.end(), std::back_inserter(breaks), [](const double time) { return time > 0.; });
    return breaks;
  }

  void declare_shape(Parameters &parameters) override
  {
    parameters.add_text(
      "File", file_name,
      "CSV file with one header line and the columns time [s], value; linear between rows, zero before the "
      "first row, the last value after the last row. Times must ascend.");
    parameters.require("File");
  }

private:
  std::string         file_name;
  std::vector<double> times, values;

  std::string content() const
  {
    try
      {
        return read_text_file(file_name);
      }
    catch (const InputError &error)
      {
        refuse("File", std::string(error.what()) + " Names are relative to the working directory.");
      }
  }

  static bool parse(const std::string &text, double &number)
  {
    try
      {
        number = dealii::Utilities::string_to_double(text);
      }
    catch (const dealii::ExceptionBase &)
      {
        return false;
      }
    return std::isfinite(number);
  }
};

/// A formula in t, the time since the start [s].
class Expression : public ShiftedHistory
{
public:
  /// A jump or a kink inside a formula is not seen: -1 if the formula starts with a jump, else 0, the safe answer.
  int regularity() const override { return shape(0.) == 0. ? 0 : -1; }

  void finalize() override
  {
    if (formula.empty())
      refuse("Expression", "expected a formula in t, for example 'exp(-4000*t)*sin(2*pi*500*t)'.");
    const std::string complaint = formulas.read({formula}, "t");
    if (!complaint.empty())
      refuse("Expression", complaint);
  }

protected:
  double shape(const double s) const override
  {
    const double value = formulas.value(dealii::Point<1>(s));
    if (!std::isfinite(value))
      refuse("Expression",
             "the formula gives " + std::to_string(value) + " at t = " + std::to_string(s) + " s after the start.");
    return value;
  }

  void declare_shape(Parameters &parameters) override
  {
    parameters.add_text(
      "Expression", formula,
      "Formula in t, the time since the start [s]; pi is known. Example: exp(-4000*t)*sin(2*pi*500*t).");
    parameters.require("Expression");
  }

private:
  std::string formula;
  Formulas<1> formulas;
};

/// All histories, in the order of the manual.
const Registry<TimeHistory> &registry()
{
  static const Registry<TimeHistory> histories = [] {
    Registry<TimeHistory> list("time history");
    list.add<Constant>("constant", "The amplitude from the start on; the same as step.");
    list.add<Constant>("step", "The amplitude from the start on, with a jump.");
    list.add<C3Step>("C3 step", "Polynomial rise to the amplitude with three continuous derivatives.");
    list.add<C5Step>("C5 step", "Polynomial rise to the amplitude with five continuous derivatives.");
    list.add<Exponential>("exponential", "Jump to the amplitude and exponential decay.");
    list.add<RiseExponential>("rise exponential", "C3 rise times exponential decay: an explosion without the jump.");
    list.add<SinePulse>("sin^n pulse", "One pulse of finite length and chosen smoothness.");
    list.add<Gaussian>("Gaussian", "Bell curve around a centre time, smooth to all orders.");
    list.add<Ricker>("Ricker", "Second derivative of a bell curve: band-limited signal without mean.");
    list.add<Table>("table", "Linear interpolation in a CSV file, for measured histories.");
    list.add<Expression>("expression", "A formula in t.");
    return list;
  }();
  return histories;
}
} // namespace

const std::vector<std::string> &time_history_names()
{
  static const std::vector<std::string> names = registry().names();
  return names;
}

std::unique_ptr<TimeHistory> make_time_history(const std::string &name) { return registry().make(name); }
} // namespace Arenite
