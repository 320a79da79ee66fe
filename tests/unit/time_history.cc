#include <arenite/base/main_frequency.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <vector>

#include "history_from_text.h"

using namespace Arenite;

namespace
{
constexpr double pi = 3.14159265358979323846;

/// A file that is removed at the end of the test.
struct TemporaryFile
{
  TemporaryFile(const std::string &name, const std::string &content)
    : name(name)
  {
    std::ofstream file(name, std::ios::binary);
    file << content;
  }
  ~TemporaryFile() { std::remove(name.c_str()); }
  std::string name;
};

/// Largest difference from @p closed_form on a grid over [-1, 4] ms that meets none of the break points below.
double deviation(const TimeHistory &history, const std::function<double(double)> &closed_form)
{
  double largest = 0.;
  for (int i = -100; i < 400; ++i)
    {
      const double t = (i + 0.3731) * 1e-5;
      largest        = std::max(largest, std::abs(history.value(t) - closed_form(t)));
    }
  return largest;
}

/// Exponent q of |Delta^m p| ~ h^q across the time @p t: k + 1 for a jump in the derivative k + 1, if m = k + 2.
double order_across(const TimeHistory &history, const double t, const unsigned int m, const double h)
{
  const auto difference = [&](const double step) {
    double sum = 0., binomial = 1.;
    for (unsigned int i = 0; i <= m; ++i)
      {
        // the break lies at 0.4 of an interval near the middle
        sum += (i % 2 ? -1. : 1.) * binomial * history.value(t + (double(i) - m / 2 - 0.4) * step);
        binomial *= double(m - i) / (i + 1);
      }
    return std::abs(sum);
  };
  return std::log2(difference(h) / difference(0.5 * h));
}

bool mentions(const InputError &error, const std::vector<std::string> &words)
{
  bool all = true;
  for (const std::string &word : words)
    if (std::string(error.what()).find(word) == std::string::npos)
      {
        BOOST_TEST_MESSAGE("missing '" << word << "' in: " << error.what());
        all = false;
      }
  return all;
}
} // namespace

BOOST_AUTO_TEST_SUITE(time_history)

// Every history equals its closed form. Tolerance 1e-14 A: rounding of the argument; for the polynomial steps the
// powers written here cancel with the sum of their coefficients, 209 eps and 1.1e4 eps near the end of the rise.
BOOST_AUTO_TEST_CASE(closed_forms)
{
  const double      A         = 1e6;
  const std::string amplitude = "set Amplitude = 1e6\n";
  const auto        S3        = [](const double x) {
    return x > 1. ? 1. : 35. * std::pow(x, 4) - 84. * std::pow(x, 5) + 70. * std::pow(x, 6) - 20. * std::pow(x, 7);
  };
  // S5 as the normalised integral of x^5 (1 - x)^5
  const auto S5 = [](const double x) {
    return x > 1. ? 1.
                  : 2772. * (std::pow(x, 6) / 6. - 5. * std::pow(x, 7) / 7. + 10. * std::pow(x, 8) / 8. -
                             10. * std::pow(x, 9) / 9. + 5. * std::pow(x, 10) / 10. - std::pow(x, 11) / 11.);
  };
  const auto check = [&](const std::string &name, const std::string &entries,
                         const std::function<double(double)> &shape, const double tolerance = 1e-14) {
    const auto history = history_from_text(name, amplitude + entries);
    BOOST_TEST(deviation(*history, [&](const double t) { return t < 0. ? 0. : A * shape(t); }) < tolerance * A, name);
    // the same, later
    const auto late = history_from_text(name, amplitude + entries + "set Start time = 7e-4\n");
    BOOST_TEST(deviation(*late, [&](const double t) { return t < 7e-4 ? 0. : A * shape(t - 7e-4); }) < tolerance * A,
               name);
    BOOST_TEST(late->break_points().front() == 7e-4);
  };

  check("constant", "", [](double) { return 1.; });
  check("step", "", [](double) { return 1.; });
  check(
    "C3 step", "set Rise time = 1e-3\n", [&](const double t) { return S3(t / 1e-3); }, 5e-14);
  check(
    "C5 step", "set Rise time = 1e-3\n", [&](const double t) { return S5(t / 1e-3); }, 2.5e-12);
  check("exponential", "set Decay rate = 4000\n", [](const double t) { return std::exp(-4000. * t); });
  check(
    "rise exponential", "set Rise time = 5e-4\nset Decay rate = 4000\n",
    [&](const double t) { return S3(t / 5e-4) * std::exp(-4000. * t); }, 5e-14);
  check("sin^n pulse", "set Duration = 1.2e-3\nset Exponent = 6\n",
        [](const double t) { return t > 1.2e-3 ? 0. : std::pow(std::sin(pi * t / 1.2e-3), 6); });
  check("Gaussian", "set Centre time = 1e-3\nset Standard deviation = 1e-4\n",
        [](const double t) { return std::exp(-std::pow((t - 1e-3) / 1e-4, 2) / 2.); });
  check("Ricker", "set Centre time = 1e-3\nset Frequency = 2000\n", [](const double t) {
    const double x = pi * 2000. * (t - 1e-3);
    return (1. - 2. * x * x) * std::exp(-x * x);
  });
  check("expression", "set Expression = exp(-4000*t)*sin(2*pi*500*t)\n",
        [](const double t) { return std::exp(-4000. * t) * std::sin(2. * pi * 500. * t); });
}

// The declared number of continuous derivatives is the real one at every break point. The exponent k + 1 is met up to
// terms of the next order, O(h) of the local scale with h = 0.3 % of the rise: 0.1 (measured 0.07, C5).
BOOST_AUTO_TEST_CASE(regularity_at_break_points)
{
  struct Case
  {
    std::string name, entries;
    int         regularity;
  };
  std::vector<Case> cases = {{"step", "", -1},
                             {"C3 step", "set Rise time = 1e-3", 3},
                             {"C5 step", "set Rise time = 1e-3", 5},
                             {"exponential", "set Decay rate = 4000", -1},
                             {"rise exponential", "set Rise time = 1e-3\nset Decay rate = 500", 3}};
  for (int n = 1; n <= 6; ++n)
    cases.push_back({"sin^n pulse", "set Duration = 1e-3\nset Exponent = " + std::to_string(n), n - 1});

  for (const Case &c : cases)
    {
      const auto history = history_from_text(c.name, c.entries + "\nset Start time = 1e-3");
      BOOST_TEST(history->regularity() == c.regularity, c.name);
      for (const double t : history->break_points())
        BOOST_TEST(std::abs(order_across(*history, t, c.regularity + 2, 3e-6) - (c.regularity + 1)) < 0.1,
                   c.name << " at " << t << ": order " << order_across(*history, t, c.regularity + 2, 3e-6)
                          << ", expected " << c.regularity + 1);
    }
}

// sin^6(pi t/T) has p' of 30 sin 2x - 24 sin 4x + 6 sin 6x, x = pi t/T, so that the mean square of p'' over that of p' is 28/3 (pi/T)^2;
// the spectrum of Ricker's p' is f^3 exp(-(f/f_p)^2), whose mean square frequency is 7/4 f_p^2. Tolerance: differences, (pulse/5000)^2.
BOOST_AUTO_TEST_CASE(main_frequency_of_pulses)
{
  const auto pulse = history_from_text("sin^n pulse", "set Amplitude = 3e6\nset Duration = 2e-3\nset Exponent = 6\n");
  BOOST_TEST(main_frequency(*pulse, 7e-3) == std::sqrt(28. / 3.) / (2. * 2e-3), boost::test_tools::tolerance(1e-5));
  const auto ricker = history_from_text("Ricker", "set Frequency = 500\nset Centre time = 5e-3\n");
  BOOST_TEST(main_frequency(*ricker, 1e-2) == std::sqrt(7.) / 2. * 500., boost::test_tools::tolerance(1e-5));
  BOOST_TEST(!std::isfinite(main_frequency(*history_from_text("step", "set Amplitude = 1\n"), 1.)));
}

// A pulse with tails counts as smooth only if its cut at the start is below rounding.
BOOST_AUTO_TEST_CASE(tails)
{
  BOOST_TEST(history_from_text("Gaussian", "set Centre time = 8.5e-4\nset Standard deviation = 1e-4")->regularity() >
             20);
  const auto cut = history_from_text("Gaussian", "set Centre time = 6e-4\nset Standard deviation = 1e-4");
  BOOST_TEST(cut->regularity() == -1);
  BOOST_TEST(cut->value(0.) == std::exp(-18.), boost::test_tools::tolerance(1e-13)); // the documented 1.5e-8
  BOOST_TEST(history_from_text("Ricker", "set Centre time = 2e-3\nset Frequency = 1000")->regularity() > 20);
  BOOST_TEST(history_from_text("Ricker", "set Centre time = 1e-3\nset Frequency = 1000")->regularity() == -1);
}

// A table is linear between its rows, zero before and constant after; its rows are break points.
BOOST_AUTO_TEST_CASE(table)
{
  const TemporaryFile file("time_history_table.csv",
                           "\xEF\xBB\xBFtime [s], pressure [Pa]\r\n# measured\r\n0,0\r\n1e-3, 2\r\n\r\n"
                           "4e-3,-1\r\n");
  const auto          history =
    history_from_text("table", "set File = time_history_table.csv\nset Amplitude = 10\nset Start time = 1");
  for (const auto &[t, value] : std::vector<std::pair<double, double>>{
         {0.5, 0.}, {1.0005, 10.}, {1.001, 20.}, {1.002, 10.}, {1.004, -10.}, {2., -10.}})
    BOOST_TEST(std::abs(history->value(t) - value) < 1e-10, t); // rounding of t = 1 s against 1 ms: 2e-13 of 20
  BOOST_TEST(history->regularity() == 0);
  BOOST_TEST(history->break_points() == (std::vector<double>{1., 1.001, 1.004}), boost::test_tools::per_element());

  // a first row that is not zero is a jump, wherever it stands
  const TemporaryFile jump("time_history_jump.csv", "t,p\n1e-3,5\n2e-3,0\n");
  const auto          late = history_from_text("table", "set File = time_history_jump.csv");
  BOOST_TEST(late->regularity() == -1);
  BOOST_TEST(late->value(0.5e-3) == 0.);
  BOOST_TEST(late->value(1e-3) == 5.);
}

// Mistakes in a table name the file and the line.
BOOST_AUTO_TEST_CASE(table_errors)
{
  const auto expect = [](const std::string &content, const std::vector<std::string> &words) {
    const TemporaryFile file("time_history_bad.csv", content);
    BOOST_CHECK_EXCEPTION(history_from_text("table", "set File = time_history_bad.csv"), InputError,
                          [&](const InputError &error) { return mentions(error, words); });
  };
  expect("0,0\n1,1\n", {"time_history_bad.csv:1:", "header"});
  expect("t,p\n0,0\n2,1\n1,1\n", {"time_history_bad.csv:4:", "ascend"});
  expect("t,p\n0,0\n0,1\n", {"time_history_bad.csv:3:", "ascend"});
  expect("t,p\n0,0\n1,one\n", {"time_history_bad.csv:3:", "1,one"});
  expect("t,p\n0,0\n1,nan\n", {"time_history_bad.csv:3:", "finite"});
  expect("t,p\n0,0,0\n", {"time_history_bad.csv:2:", "3"});
  expect("t,p\n", {"scene.prm:1:", "no rows"});
  expect("t,p\n-2,1\n-1,1\n", {"scene.prm:1:", "negative"});
  BOOST_CHECK_EXCEPTION(history_from_text("table", "set File = absent.csv"), InputError, [](const InputError &error) {
    return mentions(error, {"scene.prm:1:", "absent.csv"});
  });
}

// Wrong names, missing entries and formulas that are none raise InputError with the place.
BOOST_AUTO_TEST_CASE(errors)
{
  BOOST_CHECK_EXCEPTION(make_time_history("gausian"), InputError, [](const InputError &error) {
    return mentions(error, {"gausian", "'Gaussian'"});
  });
  BOOST_CHECK_EXCEPTION(history_from_text("C3 step", ""), InputError,
                        [](const InputError &error) { return mentions(error, {"Rise time"}); });
  BOOST_CHECK_EXCEPTION(history_from_text("C3 step", "set Rise time = 0"), InputError, [](const InputError &error) {
    return mentions(error, {"scene.prm:1", "Rise time"});
  });
  BOOST_CHECK_EXCEPTION(history_from_text("expression", "set Expression = sin(t"), InputError,
                        [](const InputError &error) {
                          return mentions(error, {"scene.prm:1", "Expression", "arenthes"});
                        });
  BOOST_CHECK_EXCEPTION(history_from_text("expression", "set Expression = sin(x)"), InputError,
                        [](const InputError &error) {
                          return mentions(error, {"scene.prm:1", "Expression", "x"});
                        });
  const auto square_root = history_from_text("expression", "set Expression = sqrt(1-t)");
  BOOST_CHECK_EXCEPTION(square_root->value(2.), InputError, [](const InputError &error) {
    return mentions(error, {"scene.prm:1", "nan", "t = 2"});
  });
}

// Every listed name can be made, and refuses or accepts its defaults without crashing.
BOOST_AUTO_TEST_CASE(names)
{
  BOOST_TEST(time_history_names().size() == 11);
  for (const std::string &name : time_history_names())
    {
      Parameters parameters = Parameters::from_text("");
      const auto history    = make_time_history(name);
      history->declare_parameters(parameters);
      BOOST_TEST(parameters.manual().find("Amplitude") != std::string::npos);
    }
}

BOOST_AUTO_TEST_SUITE_END()
