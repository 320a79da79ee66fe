#pragma once

#include <arenite/base/prescan.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace Arenite
{
/// A mistake of the user: wrong command, parameter or mesh. what() is the whole message, ready to print; exit code 2.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Closed or half-open interval of admissible values, used for checks, messages and the manual.
struct Range
{
  double lower      = -std::numeric_limits<double>::max();
  double upper      = std::numeric_limits<double>::max();
  bool   lower_open = false; ///< lower < value instead of lower <= value
  bool   upper_open = false;
};

constexpr Range any_value{};
constexpr Range positive{0., std::numeric_limits<double>::max(), true, false};
constexpr Range non_negative{0., std::numeric_limits<double>::max(), false, false};

/// The entries of one scene.
///
/// Objects declare their entries next to their members; parse() then fills every member. The choices that decide which
/// objects exist (dimension, laws, loads) are read before with peek(), which ignores everything else:
///
///   Parameters parameters = Parameters::from_files({"scene.prm"}, {"Mesh/Refinement=3"});
///   const std::string type = parameters.peek("Mesh/Type", "box");    // first pass
///   Box box; { auto s = parameters.section("Mesh"); box.declare(parameters); }
///   parameters.parse();                                              // strict second pass
///
/// A path is written "Section/Sub section/Entry name" in --set, in peek() and in refuse(); messages print it as
/// [Section / Sub section] Entry name. Lower and upper case differ, as in deal.II.
class Parameters
{
public:
  Parameters() = default;

  /// Read the files, later ones win, then the overrides "Section/Entry=value". Includes are expanded, relative to the
  /// file that includes. Every problem that can be seen without declarations (missing file, include cycle, unclosed
  /// subsection, entry given twice in one file) raises one InputError with file:line. Collective over all processes:
  /// process 0 reads, all get the same settings or the same error.
  static Parameters from_files(const std::vector<std::string> &files, const std::vector<std::string> &overrides = {});

  /// The same from a string, for tests and generated scenes; @p name stands for the file name in messages. Not
  /// collective.
  static Parameters from_text(const std::string &text, const std::string &name = "<text>",
                              const std::vector<std::string> &overrides = {});

  /// Value of one entry as written by the user, or @p fallback. Needs no declaration; the entry must be declared later.
  std::string peek(const std::string &path, const std::string &fallback) const;

  /// peek() for an entry that is declared by add_choice() or by a Registry: refuses a value that is not in @p allowed.
  std::string peek_choice(const std::string &path, const std::string &fallback,
                          const std::vector<std::string> &allowed) const;

  /// peek() for comma separated lists of names, trimmed; empty text gives an empty list. Refuses an empty name, a name
  /// with '/' and a name given twice, because each name opens a section.
  std::vector<std::string> peek_list(const std::string &path) const;

  /// Declarations made while the returned object lives belong to subsection @p name. Sections nest.
  class Section
  {
  public:
    Section(Parameters &parameters, const std::string &name);
    ~Section();
    Section(const Section &) = delete;

  private:
    Parameters &parameters;
  };
  [[nodiscard]] Section section(const std::string &name) { return Section(*this, name); }

  // Each add_... binds a member: its present value is the default, parse() overwrites it. The sentence tells the user
  // what the entry does (for numbers: what happens when it grows). Units are SI; "", "-" or "1" without dimension.
  // A default that is not admissible (NaN, outside the range, not an allowed word) makes the entry required.
  void add_quantity(const std::string &name, double &value, const std::string &unit, const Range &range,
                    const std::string &sentence);
  template <int dim>
  void add_vector(const std::string &name, dealii::Tensor<1, dim> &value, const std::string &unit,
                  const std::string &sentence);
  /// List of points "x, y, z; x, y, z". With @p reduce the points may also have three coordinates in fewer dimensions.
  template <int dim>
  void add_points(const std::string &name, std::vector<dealii::Point<dim>> &value, const std::string &unit,
                  const std::string                                                 &sentence,
                  const std::function<dealii::Point<dim>(const dealii::Point<3> &)> &reduce = {});
  void add_integer(const std::string &name, unsigned int &value, unsigned int lower, unsigned int upper,
                   const std::string &sentence);
  void add_flag(const std::string &name, bool &value, const std::string &sentence);
  void add_text(const std::string &name, std::string &value, const std::string &sentence);
  void add_list(const std::string &name, std::vector<std::string> &value, const std::string &sentence);
  void add_choice(const std::string &name, std::string &value, const std::vector<std::string> &allowed,
                  const std::string &sentence);
  /// parse() refuses a scene that does not set this entry of the current section; call it after the add_....
  void require(const std::string &name);

  /// An entry of which a scene sets some but not all, such as elastic constants: echo() leaves it out when it is not set.
  void leave_out_if_unset(const std::string &name);

  /// Strict pass: fills the members, or raises one InputError that lists every unknown, malformed, out-of-range or missing
  /// entry with file:line, value, rule and nearest name, and leaves the members alone. Values that are replaced do not count.
  void parse();

  /// True if the user set this entry (declared or not).
  bool is_set(const std::string &path) const;

  /// Raise InputError "file:line: [Section / Sub] Entry = value: <reason>" for a rule that only the caller knows. The
  /// path of a section refuses the section as a whole.
  [[noreturn]] void refuse(const std::string &path, const std::string &reason) const;

  /// Path of the current section, for members that keep it to refuse() later in finalize().
  std::string current_path() const;

  /// All declared entries with their values and sentences, as a .prm that repeats the run.
  std::string echo() const;

  /// Path and value of all declared entries that have one.
  std::map<std::string, std::string> values() const;

  /// All declared entries as Markdown tables (entry, default, unit, admissible, meaning), one per section.
  std::string manual() const;

  /// The winning settings, one "Section/Entry = value" per line, sorted: equal for scenes that set the same, however
  /// they are written or split into files.
  std::string source_text() const;

private:
  struct Entry
  {
    std::string path, default_value, value, unit, admissible, sentence;
    bool        required = false, only_if_set = false;

    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
    /// Rule that a text breaks, or nothing; the text may be anything.
    std::function<std::string(const std::string &)> complaint;
    /// Fill the member from an admissible text; returns the text that repeats the value.
    std::function<std::string(const std::string &)> store;
  };

  /// Add @p entry to the current section; its path is still the bare name.
  void add(Entry entry);

  void adopt(const Prescan &scanned);

  const Setting *last_setting(const std::string &path, bool opens_section = false) const;
  std::string    unknown_section(const Setting &setting, const std::string &section) const;
  std::string    unknown_entry(const Setting &setting) const;

  std::string              input_name = "scene"; ///< stands in messages about what is missing
  std::vector<Setting>     settings;
  std::vector<Entry>       entries;
  std::vector<std::string> sections; ///< all declared, with their parents, in order of declaration
  std::vector<std::string> path;
};
} // namespace Arenite
