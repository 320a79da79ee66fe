#pragma once

#include <arenite/base/parameters.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace Arenite
{
// Texts of the user and the values they stand for. A complaint is what prevents a text from being a value, written so
// that it continues "Entry = text: ..."; it is empty for a good text, and only good texts may be converted.

/// Shortest text that reads back to exactly @p value.
std::string to_text(double value);

/// "0, 0, -9.81".
template <int dim>
std::string to_text(const dealii::Tensor<1, dim> &vector);

/// The reverse of to_text().
template <int dim>
dealii::Tensor<1, dim> to_vector(const std::string &text);

/// Words between @p separator, trimmed; no word for an empty text.
std::vector<std::string> split_list(const std::string &text, char separator);

/// False for "", "-" and "1", which stand for a number without dimension.
bool has_unit(const std::string &unit);

/// " [kg/m^3]", or nothing without a unit.
std::string unit_label(const std::string &unit);

/// False also for NaN and infinity.
bool contains(const Range &range, double value);

/// "> 0", "in [0, 0.5)", "any number".
std::string describe(const Range &range);

/// A finite number in plain SI notation; @p unit stands in the advice.
std::string complaint_about_number(const std::string &text, const std::string &unit);

/// @p dim finite numbers separated by commas.
std::string complaint_about_vector(const std::string &text, int dim, const std::string &unit);

/// Words separated by single commas.
std::string complaint_about_list(const std::string &text);

/// A list of different words, each fit to be the name of a section.
std::string complaint_about_names(const std::string &text);

/// One of @p allowed.
std::string complaint_about_choice(const std::string &text, const std::vector<std::string> &allowed);
} // namespace Arenite
