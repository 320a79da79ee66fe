#pragma once

#include <string>
#include <vector>

namespace Arenite
{
/// One line of the input that matters: an entry with its value, or the opening of a subsection.
struct Setting
{
  std::string  path;              ///< "Section/Sub section/Entry name", white space normalised
  std::string  value;             ///< as written, without comment, white space normalised as deal.II does
  std::string  file;              ///< file as the user wrote it, or "--set 'Mesh/Refinement=3'"
  unsigned int line          = 0; ///< from 1; 0 for an override
  bool         opens_section = false;

  /// "scene.prm:14" or "--set 'Mesh/Refinement=3'", the beginning of every message.
  std::string place() const { return line == 0 ? file : file + ":" + std::to_string(line); }

  template <typename Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &path &value &file &line &opens_section;
  }
};

/// A line lint over .prm text: follows subsection, end, set and include to know where each setting stands, and sees
/// what deal.II's ParameterHandler accepts silently, crashes on or reports without a line. It knows nothing of
/// declarations and reads no numbers: that is the ParameterHandler's business.
///
/// Byte order marks, CRLF or CR line ends and a missing final newline are accepted. An include is relative to the
/// folder of the file that includes it, and may stand inside a subsection. `subsection A / B` opens A and B, one `end`
/// closes both.
class Prescan
{
public:
  /// Read @p file and everything it includes.
  void scan_file(const std::string &file);

  /// The same for a text; @p name stands for the file name.
  void scan_text(const std::string &text, const std::string &name);

  /// "Section/Entry=value".
  void scan_override(const std::string &assignment);

  std::vector<Setting>     settings; ///< in the order of reading: the last one of a path wins
  std::vector<std::string> problems; ///< complete messages, in the order of reading

private:
  void scan_include(const std::string &target, const std::string &place, const std::string &including_file);

  std::vector<std::string> path;       ///< open subsections
  std::vector<std::string> open_files; ///< names, outermost first
  unsigned int             n_files = 0;
};

/// Content of a text file with normalised line ends and without byte order mark. InputError (one line) if the file is
/// absent, unreadable, a directory, binary or larger than 16 MB. Not collective.
std::string read_text_file(const std::string &file);

/// Trimmed, with every sequence of blanks replaced by one.
std::string normalise_blanks(const std::string &text);

/// " a /b / c" -> {"a", "b", "c"}.
std::vector<std::string> split_path(const std::string &path);

/// " a /b / c" -> "a/b/c".
std::string normalise_path(const std::string &path);

/// Text of the user made fit for a message: one line, not longer than 60 characters.
std::string excerpt(const std::string &text);

/// Raise one InputError with the first eight messages, one per line; return if there is none.
void refuse_all(const std::vector<std::string> &problems);
} // namespace Arenite
