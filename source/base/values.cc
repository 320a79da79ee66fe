#include <arenite/base/names.h>
#include <arenite/base/values.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

namespace Arenite
{
std::string to_text(const double value)
{
  char       buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value).ptr;
  return std::string(buffer, end);
}

bool contains(const Range &range, const double value)
{
  return std::isfinite(value) && (range.lower_open ? value > range.lower : value >= range.lower) &&
         (range.upper_open ? value < range.upper : value <= range.upper);
}

std::string describe(const Range &range)
{
  const bool has_lower = range.lower > -std::numeric_limits<double>::max();
  const bool has_upper = range.upper < std::numeric_limits<double>::max();
  if (has_lower && has_upper)
    return std::string("in ") + (range.lower_open ? "(" : "[") + to_text(range.lower) + ", " + to_text(range.upper) +
           (range.upper_open ? ")" : "]");
  if (has_lower)
    return (range.lower_open ? "> " : ">= ") + to_text(range.lower);
  if (has_upper)
    return (range.upper_open ? "< " : "<= ") + to_text(range.upper);
  return "any number";
}

bool has_unit(const std::string &unit) { return !unit.empty() && unit != "-" && unit != "1"; }

std::string unit_label(const std::string &unit) { return has_unit(unit) ? " [" + unit + "]" : ""; }

std::string complaint_about_number(const std::string &text, const std::string &unit)
{
  if (dealii::Patterns::Double().match(text))
    try
      {
        if (std::isfinite(dealii::Utilities::string_to_double(text)))
          return "";
      }
    catch (const std::exception &)
      {
        // the pattern accepts 1e-400, the conversion does not
        return "is too small for a floating-point number.";
      }
  try
    {
      std::size_t  n_read = 0;
      const double value  = std::stod(text, &n_read); // NaN and infinity: numbers here, but not for the pattern
      if (n_read == text.size() && !std::isfinite(value))
        return "must be a finite number.";
    }
  catch (const std::out_of_range &)
    {
      return "is too large for a floating-point number.";
    }
  catch (const std::invalid_argument &)
    {}
  return "is not a number. Write plain SI numbers, without a unit" + (has_unit(unit) ? " (here " + unit + ")" : "") +
         " and with a decimal point.";
}

std::vector<std::string> split_list(const std::string &text, const char separator)
{
  std::vector<std::string> words;
  if (normalise_blanks(text).empty())
    return words;
  words.emplace_back();
  for (const char c : text)
    if (c == separator)
      words.emplace_back();
    else
      words.back() += c;
  for (std::string &word : words)
    word = normalise_blanks(word);
  return words;
}

std::string complaint_about_vector(const std::string &text, const int dim, const std::string &unit)
{
  const std::vector<std::string> components = split_list(text, ',');
  if (components.size() != static_cast<unsigned int>(dim))
    return (dim == 1 ? "must be one number" : "must be " + std::to_string(dim) + " numbers separated by commas") +
           (has_unit(unit) ? ", in " + unit : "") + ".";
  for (const std::string &component : components)
    {
      const std::string complaint = complaint_about_number(component, unit);
      if (!complaint.empty())
        return (dim == 1 ? "" : "'" + excerpt(component) + "' ") + complaint;
    }
  return "";
}

template <int dim>
dealii::Tensor<1, dim> to_vector(const std::string &text)
{
  const std::vector<std::string> components = split_list(text, ',');
  dealii::Tensor<1, dim>         result;
  for (int d = 0; d < dim; ++d)
    result[d] = dealii::Utilities::string_to_double(components[d]);
  return result;
}

template <int dim>
std::string to_text(const dealii::Tensor<1, dim> &vector)
{
  std::vector<std::string> components;
  for (int d = 0; d < dim; ++d)
    components.push_back(to_text(vector[d]));
  return join(components);
}

std::string complaint_about_list(const std::string &text)
{
  for (const std::string &word : split_list(text, ','))
    if (word.empty())
      return "has an empty item: write words separated by single commas.";
  return "";
}

std::string complaint_about_names(const std::string &text)
{
  std::set<std::string> seen;
  for (const std::string &word : split_list(text, ','))
    if (!seen.insert(word).second)
      return "names '" + excerpt(word) + "' twice.";
  if (text.find('/') != std::string::npos)
    return "a name cannot contain '/'.";
  return complaint_about_list(text);
}

std::string complaint_about_choice(const std::string &text, const std::vector<std::string> &allowed)
{
  if (std::find(allowed.begin(), allowed.end(), text) != allowed.end())
    return "";
  const std::string nearest = nearest_name(text, allowed);
  return "must be one of: " + join(allowed) + "." + (nearest.empty() ? "" : " Did you mean '" + nearest + "'?");
}

#define ARENITE_INSTANTIATE(dim)                                           \
  template std::string            to_text(const dealii::Tensor<1, dim> &); \
  template dealii::Tensor<1, dim> to_vector<dim>(const std::string &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
