#include <arenite/base/names.h>
#include <arenite/base/parameters.h>
#include <arenite/base/values.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <climits>
#include <map>
#include <set>

namespace Arenite
{
namespace
{
namespace Patterns = dealii::Patterns;

/// "A/B/Entry" -> {"A/B", "Entry"}; {"", "Entry"} at the top level.
std::pair<std::string, std::string> split_entry(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos)
    return {"", path};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

/// "[A / B]"; "the top level" for the empty path.
std::string section_label(const std::string &section)
{
  return section.empty() ? "the top level" : "[" + join(split_path(section), " / ") + "]";
}

/// "[A / B] Entry" or "Entry".
std::string entry_label(const std::string &path, const std::string &quote = "")
{
  const auto [section, name] = split_entry(path);
  return (section.empty() ? "" : section_label(section) + " ") + quote + excerpt(name) + quote;
}

std::string markdown_cell(const std::string &text)
{
  std::string result;
  for (const char c : normalise_blanks(text))
    result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}
} // namespace

// ---- reading ----

void Parameters::adopt(const Prescan &scanned)
{
  refuse_all(scanned.problems);
  settings = scanned.settings;
}

Parameters Parameters::from_files(const std::vector<std::string> &files, const std::vector<std::string> &overrides)
{
  Prescan    scanned;
  const bool parallel = dealii::Utilities::MPI::job_supports_mpi();
  if (!parallel || dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      for (const std::string &file : files)
        scanned.scan_file(file);
      for (const std::string &assignment : overrides)
        scanned.scan_override(assignment);
    }
  if (parallel)
    {
      scanned.problems = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, scanned.problems);
      scanned.settings = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, scanned.settings);
    }

  Parameters parameters;
  if (!files.empty())
    parameters.input_name = files.front();
  parameters.adopt(scanned);
  return parameters;
}

Parameters Parameters::from_text(const std::string &text, const std::string &name,
                                 const std::vector<std::string> &overrides)
{
  Prescan scanned;
  scanned.scan_text(text, name);
  for (const std::string &assignment : overrides)
    scanned.scan_override(assignment);

  Parameters parameters;
  parameters.input_name = name;
  parameters.adopt(scanned);
  return parameters;
}

// ---- the first pass ----

const Setting *Parameters::last_setting(const std::string &path, const bool opens_section) const
{
  const auto found = std::find_if(settings.rbegin(), settings.rend(), [&](const Setting &setting) {
    return setting.opens_section == opens_section && setting.path == path;
  });
  return found == settings.rend() ? nullptr : &*found;
}

std::string Parameters::peek(const std::string &path, const std::string &fallback) const
{
  const Setting *setting = last_setting(normalise_path(path));
  return setting ? setting->value : fallback;
}

std::string Parameters::peek_choice(const std::string &path, const std::string &fallback,
                                    const std::vector<std::string> &allowed) const
{
  const std::string value     = peek(path, fallback);
  const std::string complaint = complaint_about_choice(value, allowed);
  if (!complaint.empty())
    refuse(path, is_set(path) ? complaint : "must be set. " + complaint);
  return value;
}

std::vector<std::string> Parameters::peek_list(const std::string &path) const
{
  const std::string text      = peek(path, "");
  const std::string complaint = complaint_about_names(text);
  if (!complaint.empty())
    refuse(path, complaint);
  return split_list(text, ',');
}

bool Parameters::is_set(const std::string &path) const { return last_setting(normalise_path(path)) != nullptr; }

// ---- declarations ----

Parameters::Section::Section(Parameters &parameters, const std::string &name)
  : parameters(parameters)
{
  if (name.find('/') != std::string::npos || normalise_blanks(name) != name || name.empty())
    throw std::logic_error("'" + name + "' cannot be the name of a section.");
  parameters.path.push_back(name);
  const std::string current = parameters.current_path();
  if (std::find(parameters.sections.begin(), parameters.sections.end(), current) == parameters.sections.end())
    parameters.sections.push_back(current);
}

Parameters::Section::~Section() { parameters.path.pop_back(); }

std::string Parameters::current_path() const { return join(path, "/"); }

void Parameters::add(Entry entry)
{
  if (entry.path.find('/') != std::string::npos || normalise_blanks(entry.path) != entry.path || entry.path.empty())
    throw std::logic_error("'" + entry.path + "' cannot be the name of an entry.");
  if (!path.empty())
    entry.path = current_path() + "/" + entry.path;
  for (const Entry &other : entries)
    if (other.path == entry.path)
      throw std::logic_error("The entry '" + entry.path + "' is declared twice.");

  if (!entry.complaint(entry.default_value).empty())
    {
      entry.required = true;
      entry.default_value.clear();
    }
  entry.value = entry.default_value;
  entries.push_back(std::move(entry));
}

void Parameters::add_quantity(const std::string &name, double &value, const std::string &unit, const Range &range,
                              const std::string &sentence)
{
  Entry entry{name, to_text(value), "", unit, describe(range), sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Double>();
  entry.complaint = [unit, range](const std::string &text) -> std::string {
    const std::string complaint = complaint_about_number(text, unit);
    if (!complaint.empty() || contains(range, dealii::Utilities::string_to_double(text)))
      return complaint;
    return "must be " + describe(range) + unit_label(unit) + ".";
  };
  entry.store = [&value](const std::string &text) {
    value = dealii::Utilities::string_to_double(text);
    return to_text(value);
  };
  add(std::move(entry));
}

template <int dim>
void Parameters::add_vector(const std::string &name, dealii::Tensor<1, dim> &value, const std::string &unit,
                            const std::string &sentence)
{
  Entry entry{name, to_text(value), "", unit, "", sentence, false, false, nullptr, {}, {}};
  entry.admissible = dim == 1 ? "any number" : std::to_string(dim) + " numbers separated by commas";
  entry.pattern    = std::make_shared<Patterns::List>(Patterns::Double(), dim, dim);
  entry.complaint  = [unit](const std::string &text) { return complaint_about_vector(text, dim, unit); };
  entry.store      = [&value](const std::string &text) {
    value = to_vector<dim>(text);
    return to_text(value);
  };
  add(std::move(entry));
}

template <int dim>
void Parameters::add_points(const std::string &name, std::vector<dealii::Point<dim>> &value, const std::string &unit,
                            const std::string                                                 &sentence,
                            const std::function<dealii::Point<dim>(const dealii::Point<3> &)> &reduce)
{
  const auto all_to_text = [](const std::vector<dealii::Point<dim>> &points) {
    std::vector<std::string> texts;
    for (const dealii::Point<dim> &point : points)
      texts.push_back(to_text<dim>(point));
    return join(texts, "; ");
  };

  const std::string form = dim == 1 ? "x; x" : dim == 2 ? "x, y; x, y" : "x, y, z; x, y, z";
  Entry entry{name, all_to_text(value), "", unit, "points '" + form + "'", sentence, false, false, nullptr, {}, {}};
  const auto in_three = [reduce](const std::string &point) { return reduce && split_list(point, ',').size() == 3; };
  entry.pattern       = std::make_shared<Patterns::List>(Patterns::List(Patterns::Double(), dim, reduce ? 3 : dim), 0,
                                                   Patterns::List::max_int_value, ";");
  entry.complaint     = [unit, form, in_three](const std::string &text) -> std::string {
    for (const std::string &point : split_list(text, ';'))
      {
        const std::string complaint = complaint_about_vector(point, in_three(point) ? 3 : dim, unit);
        if (!complaint.empty())
          return "in point '" + excerpt(point) + "': " + complaint + " Write '" + form + "'.";
      }
    return "";
  };
  entry.store = [&value, all_to_text, in_three, reduce](const std::string &text) {
    value.clear();
    for (const std::string &point : split_list(text, ';'))
      value.push_back(in_three(point) ? reduce(dealii::Point<3>(to_vector<3>(point)))
                                      : dealii::Point<dim>(to_vector<dim>(point)));
    return all_to_text(value);
  };
  add(std::move(entry));
}

void Parameters::add_integer(const std::string &name, unsigned int &value, const unsigned int lower,
                             const unsigned int upper, const std::string &sentence)
{
  // ParameterHandler reads int
  const unsigned int last = std::min<unsigned int>(upper, INT_MAX);
  const std::string  rule = upper >= INT_MAX
                              ? "integer >= " + std::to_string(lower)
                              : "integer in [" + std::to_string(lower) + ", " + std::to_string(upper) + "]";
  Entry              entry{name, std::to_string(value), "", "", rule, sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Integer>(lower, last);
  entry.complaint = [pattern = entry.pattern, rule](const std::string &text) {
    return pattern->match(text) ? "" : "must be an " + rule + ".";
  };
  entry.store = [&value](const std::string &text) {
    value = dealii::Utilities::string_to_int(text);
    return std::to_string(value);
  };
  add(std::move(entry));
}

void Parameters::add_flag(const std::string &name, bool &value, const std::string &sentence)
{
  Entry entry{name, value ? "true" : "false", "", "", "true or false", sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Bool>();
  entry.complaint = [pattern = entry.pattern](const std::string &text) {
    return pattern->match(text) ? "" : "must be true or false.";
  };
  entry.store = [&value](const std::string &text) -> std::string {
    value = text == "true" || text == "yes";
    return value ? "true" : "false";
  };
  add(std::move(entry));
}

void Parameters::add_text(const std::string &name, std::string &value, const std::string &sentence)
{
  Entry entry{name, value, "", "", "text", sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Anything>();
  entry.complaint = [](const std::string &) { return ""; };
  entry.store     = [&value](const std::string &text) { return value = text; };
  add(std::move(entry));
}

void Parameters::add_list(const std::string &name, std::vector<std::string> &value, const std::string &sentence)
{
  Entry entry{name, join(value), "", "", "words separated by commas", sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Anything>();
  entry.complaint = complaint_about_list;
  entry.store     = [&value](const std::string &text) {
    value = split_list(text, ',');
    return join(value);
  };
  add(std::move(entry));
}

void Parameters::add_choice(const std::string &name, std::string &value, const std::vector<std::string> &allowed,
                            const std::string &sentence)
{
  Entry entry{name, value, "", "", join(allowed), sentence, false, false, nullptr, {}, {}};
  entry.pattern   = std::make_shared<Patterns::Selection>(join(allowed, "|"));
  entry.complaint = [allowed](const std::string &text) { return complaint_about_choice(text, allowed); };
  entry.store     = [&value](const std::string &text) { return value = text; };
  add(std::move(entry));
}

void Parameters::require(const std::string &name)
{
  const std::string full = path.empty() ? name : current_path() + "/" + name;
  for (Entry &entry : entries)
    if (entry.path == full)
      {
        entry.required = true;
        return;
      }
  throw std::logic_error("The entry '" + full + "' is required but not declared.");
}

void Parameters::leave_out_if_unset(const std::string &name)
{
  const std::string full = path.empty() ? name : current_path() + "/" + name;
  for (Entry &entry : entries)
    if (entry.path == full)
      {
        entry.only_if_set = true;
        return;
      }
  throw std::logic_error("The entry '" + full + "' is required but not declared.");
}

// ---- the strict pass ----

std::string Parameters::unknown_section(const Setting &setting, const std::string &section) const
{
  const auto [parent, name] = split_entry(section);
  std::vector<std::string> siblings;
  for (const std::string &other : sections)
    if (split_entry(other).first == parent)
      siblings.push_back(split_entry(other).second);

  std::string       message = setting.place() + ": " + section_label(excerpt(section)) + " is not a section here.";
  const std::string nearest = nearest_name(name, siblings);
  std::string       elsewhere;
  for (const std::string &other : sections)
    if (split_entry(other).second == name)
      elsewhere = other;
  if (!elsewhere.empty())
    message += " Did you mean " + section_label(elsewhere) + "? Is an 'end' missing above?";
  else if (!nearest.empty())
    message += " Did you mean " + section_label(parent.empty() ? nearest : parent + "/" + nearest) + "?";
  else if (!siblings.empty() && siblings.size() <= 12)
    message += " Known: " + join(siblings) + ".";
  return message;
}

std::string Parameters::unknown_entry(const Setting &setting) const
{
  const auto [section, name] = split_entry(setting.path);
  std::string message        = setting.place() + ": " + entry_label(setting.path, "'") + " is not a parameter here.";

  std::vector<std::string> here, homes;
  for (const Entry &entry : entries)
    {
      const auto [other_section, other_name] = split_entry(entry.path);
      if (other_section == section)
        here.push_back(other_name);
      else if (same_ignoring_case(other_name, name))
        homes.push_back(section_label(other_section));
    }

  const std::string nearest = nearest_name(name, here);
  if (!nearest.empty() && (homes.empty() || same_ignoring_case(nearest, name)))
    {
      for (const Entry &entry : entries)
        if (entry.path == (section.empty() ? nearest : section + "/" + nearest))
          message += " Did you mean '" + nearest + "'" + unit_label(entry.unit) + "?";
    }
  else if (!homes.empty())
    {
      if (homes.size() > 3)
        homes.resize(3);
      message += " It belongs to " + join(homes, " or ") + ".";
    }
  else if (std::find(sections.begin(), sections.end(), setting.path) != sections.end())
    message += " It is a section: write 'subsection " + name + "'.";
  else if (!here.empty() && here.size() <= 12)
    message += " Known: " + join(here) + ".";
  return message;
}

void Parameters::parse()
{
  std::vector<std::string>             problems;
  std::map<std::string, const Entry *> entry_of;
  for (const Entry &entry : entries)
    entry_of[entry.path] = &entry;

  // a value that a later file or --set replaces may be one of another dimension
  const auto wins = [&](const Setting &setting) { return &setting == last_setting(setting.path); };

  // (i) every setting must be declared and admissible; an unknown section is reported once, without what it contains
  std::set<std::string> known(sections.begin(), sections.end()), reported;
  known.insert("");
  for (const Setting &setting : settings)
    {
      std::string section = setting.opens_section ? setting.path : split_entry(setting.path).first;
      if (known.count(section) == 0)
        {
          while (known.count(split_entry(section).first) == 0)
            section = split_entry(section).first;
          if (reported.insert(setting.file + ":" + section).second)
            problems.push_back(unknown_section(setting, section));
          continue;
        }
      if (setting.opens_section)
        continue;
      const auto found = entry_of.find(setting.path);
      if (found == entry_of.end())
        {
          problems.push_back(unknown_entry(setting));
          continue;
        }
      const std::string complaint = found->second->complaint(setting.value);
      if (!complaint.empty() && wins(setting))
        problems.push_back(setting.place() + ": " + entry_label(setting.path) + " = " + excerpt(setting.value) + ": " +
                           complaint);
    }

  // (ii) nothing may be missing
  for (const Entry &entry : entries)
    if (entry.required && !is_set(entry.path))
      {
        const Setting *opening = last_setting(split_entry(entry.path).first, true);
        problems.push_back((opening ? opening->place() : input_name) + ": " + entry_label(entry.path, "'") +
                           unit_label(entry.unit) + " is missing; it has no default. " + entry.sentence);
      }
  refuse_all(problems);

  // (iii) deal.II reads the settings, now without surprises, and the members take their values from it
  dealii::ParameterHandler handler;
  const auto               inside = [&handler](const std::string &path, const auto &action) {
    const std::vector<std::string> names = split_path(path);
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
      handler.enter_subsection(names[i]);
    action(names.back());
    for (std::size_t i = 0; i + 1 < names.size(); ++i)
      handler.leave_subsection();
  };
  for (const Entry &entry : entries)
    inside(entry.path, [&](const std::string &name) {
      if (entry.pattern->match(entry.default_value))
        handler.declare_entry(name, entry.default_value, *entry.pattern);
      else // required, without default: the user's value has passed the pattern in (i)
        handler.declare_entry(name, entry.default_value);
    });

  std::string text;
  for (const Setting &setting : settings)
    if (!setting.opens_section && wins(setting))
      {
        const std::vector<std::string> names = split_path(setting.path);
        for (std::size_t i = 0; i + 1 < names.size(); ++i)
          text += "subsection " + names[i] + "\n";
        text += "set " + names.back() + " = " + setting.value + "\n";
        for (std::size_t i = 0; i + 1 < names.size(); ++i)
          text += "end\n";
      }
  handler.parse_input_from_string(text);

  for (Entry &entry : entries)
    if (is_set(entry.path))
      inside(entry.path, [&](const std::string &name) { entry.value = entry.store(handler.get(name)); });
}

void Parameters::refuse(const std::string &path, const std::string &reason) const
{
  std::string full = normalise_path(path);
  if (const Setting *setting = last_setting(full))
    throw InputError(setting->place() + ": " + entry_label(full) + " = " + excerpt(setting->value) + ": " + reason);
  for (const Entry &entry : entries)
    if (entry.path == full)
      throw InputError(input_name + ": " + entry_label(full) +
                       (entry.value.empty() ? "" : " = " + excerpt(entry.value) + " (default)") + ": " + reason);

  if (!full.empty() && full.back() == '/')
    full.pop_back();
  const Setting *opening    = last_setting(full, true);
  const bool     is_section = opening || std::find(sections.begin(), sections.end(), full) != sections.end();
  throw InputError((opening ? opening->place() : input_name) + ": " +
                   (full.empty() ? "" : (is_section ? section_label(full) : entry_label(full)) + ": ") + reason);
}

// ---- printing ----

std::map<std::string, std::string> Parameters::values() const
{
  std::map<std::string, std::string> result;
  for (const Entry &entry : entries)
    if (!entry.only_if_set || is_set(entry.path))
      result[entry.path] = entry.value;
  return result;
}

std::string Parameters::echo() const
{
  std::string result;
  const auto  print = [&](const auto &self, const std::string &section, const std::string &indent) -> void {
    for (const Entry &entry : entries)
      {
        const auto [parent, name] = split_entry(entry.path);
        if (parent != section)
          continue;
        result += indent + "# " + normalise_blanks(entry.sentence) + unit_label(entry.unit) +
                  (entry.admissible.empty() ? "" : " (" + entry.admissible + ")") + "\n";
        const bool missing = (entry.required && entry.value.empty()) || (entry.only_if_set && !is_set(entry.path));
        result +=
          indent + (missing ? "# set " : "set ") + name + " =" + (entry.value.empty() ? "" : " " + entry.value) + "\n";
      }
    for (const std::string &child : sections)
      {
        const auto [parent, name] = split_entry(child);
        if (parent != section)
          continue;
        result += (indent.empty() && !result.empty() ? "\n" : "") + indent + "subsection " + name + "\n";
        self(self, child, indent + "  ");
        result += indent + "end\n";
      }
  };
  print(print, "", "");
  return result;
}

std::string Parameters::manual() const
{
  std::string result;
  const auto  print = [&](const std::string &section) {
    std::string rows;
    for (const Entry &entry : entries)
      {
        const auto [parent, name] = split_entry(entry.path);
        if (parent != section)
          continue;
        rows += "| " + markdown_cell(name) + " | " +
                (entry.required ? "*required*" : markdown_cell(entry.default_value)) + " | " +
                (has_unit(entry.unit) ? markdown_cell(entry.unit) : "") + " | " + markdown_cell(entry.admissible) +
                " | " + markdown_cell(entry.sentence) + " |\n";
      }
    if (!rows.empty())
      result += (result.empty() ? "## " : "\n## ") +
                (section.empty() ? "Top level" : join(split_path(section), " / ")) +
                "\n\n| Entry | Default | Unit | Admissible | Meaning |\n|---|---|---|---|---|\n" + rows;
  };
  print("");
  for (const std::string &section : sections)
    print(section);
  return result;
}

std::string Parameters::source_text() const
{
  std::map<std::string, std::string> last;
  for (const Setting &setting : settings)
    if (!setting.opens_section)
      last[setting.path] = setting.value;
  std::string result;
  for (const auto &[path, value] : last)
    result += path + " = " + value + "\n";
  return result;
}

#define ARENITE_INSTANTIATE(dim)                                                                                \
  template void Parameters::add_vector<dim>(const std::string &, dealii::Tensor<1, dim> &, const std::string &, \
                                            const std::string &);                                               \
  template void Parameters::add_points<dim>(const std::string &, std::vector<dealii::Point<dim>> &,             \
                                            const std::string &, const std::string &,                           \
                                            const std::function<dealii::Point<dim>(const dealii::Point<3> &)> &);
ARENITE_INSTANTIATE(1)
ARENITE_INSTANTIATE(2)
ARENITE_INSTANTIATE(3)
#undef ARENITE_INSTANTIATE
} // namespace Arenite
