#include <arenite/base/names.h>
#include <arenite/base/parameters.h>
#include <arenite/base/prescan.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

namespace Arenite
{
namespace
{
constexpr std::size_t  largest_file       = 16 * 1024 * 1024;
constexpr unsigned int most_files         = 1000;
constexpr std::size_t  longest_excerpt    = 60;
constexpr std::size_t  most_problem_lines = 8;

bool is_blank(const unsigned char c) { return std::isspace(c) != 0; }

/// Number of the first byte that is not part of a valid UTF-8 sequence, or npos.
std::size_t first_invalid_utf8(const std::string &text)
{
  for (std::size_t i = 0; i < text.size();)
    {
      const unsigned char lead   = text[i];
      const std::size_t   length = lead < 0x80                   ? 1
                                   : lead >= 0xC2 && lead < 0xE0 ? 2
                                   : lead >= 0xE0 && lead < 0xF0 ? 3
                                   : lead >= 0xF0 && lead < 0xF5 ? 4
                                                                 : 0;
      if (length == 0 || i + length > text.size())
        return i;
      for (std::size_t k = 1; k < length; ++k)
        if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80)
          return i;
      i += length;
    }
  return std::string::npos;
}

/// What is wrong with the characters of a line without its comment; empty if nothing.
std::string complaint_about_characters(const std::string &line)
{
  if (first_invalid_utf8(line) != std::string::npos)
    return "is not UTF-8 text. Save the file in UTF-8.";
  // no-break space, zero-width space, byte order mark: pasted from web pages and word processors, and impossible to see
  for (const char *invisible : {"\xC2\xA0", "\xE2\x80\x8B", "\xEF\xBB\xBF"})
    if (line.find(invisible) != std::string::npos)
      return "contains an invisible character (such as a no-break space). Type the line again.";
  return "";
}

std::pair<std::string, std::string> first_word_and_rest(const std::string &line)
{
  const std::size_t blank = line.find(' ');
  if (blank == std::string::npos)
    return {line, ""};
  return {line.substr(0, blank), line.substr(blank + 1)};
}
} // namespace

std::string normalise_blanks(const std::string &text)
{
  std::string result;
  for (const unsigned char c : text)
    if (!is_blank(c))
      result += c;
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
  if (!result.empty() && result.back() == ' ')
    result.pop_back();
  return result;
}

std::vector<std::string> split_path(const std::string &path)
{
  std::vector<std::string> names(1);
  for (const char c : path)
    if (c == '/')
      names.emplace_back();
    else
      names.back() += c;
  for (std::string &name : names)
    name = normalise_blanks(name);
  return names;
}

std::string normalise_path(const std::string &path) { return join(split_path(path), "/"); }

std::string excerpt(const std::string &text)
{
  std::string result = text;
  for (char &c : result)
    if (std::iscntrl(static_cast<unsigned char>(c)))
      c = '?';
  if (result.size() > longest_excerpt)
    {
      std::size_t end = longest_excerpt;
      while (end > 0 && (static_cast<unsigned char>(result[end]) & 0xC0) == 0x80) // do not cut a UTF-8 sequence
        --end;
      result = result.substr(0, end) + "...";
    }
  return result;
}

void refuse_all(const std::vector<std::string> &problems)
{
  if (problems.empty())
    return;
  std::vector<std::string> lines(problems.begin(), problems.begin() + std::min(problems.size(), most_problem_lines));
  if (problems.size() > most_problem_lines)
    lines.push_back("... and " + std::to_string(problems.size() - most_problem_lines) + " more.");
  throw InputError(join(lines, "\n"));
}

std::string read_text_file(const std::string &file)
{
  const auto refuse = [&](const std::string &reason) { throw InputError("'" + excerpt(file) + "' " + reason); };

  std::error_code error;
  const auto      status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    refuse("does not exist.");
  if (status.type() == std::filesystem::file_type::directory)
    refuse("is a directory, not a file.");

  const std::unique_ptr<std::FILE, int (*)(std::FILE *)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream)
    refuse(std::string("cannot be opened: ") + std::strerror(errno) + ".");
  std::string       content;
  std::vector<char> buffer(65536);
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), stream.get()))
    {
      content.append(buffer.data(), n);
      if (content.size() > largest_file)
        refuse("is larger than 16 MB: this is not a parameter file.");
    }
  if (std::ferror(stream.get()))
    refuse(std::string("cannot be read: ") + std::strerror(errno) + ".");

  if (content.compare(0, 3, "\xEF\xBB\xBF") == 0)
    content.erase(0, 3);
  if (content.compare(0, 2, "\xFF\xFE") == 0 || content.compare(0, 2, "\xFE\xFF") == 0)
    refuse("is UTF-16 text. Save it in UTF-8.");

  std::string text;
  for (std::size_t i = 0; i < content.size(); ++i)
    {
      const unsigned char c = content[i];
      if ((c < 0x20 && !is_blank(c)) || c == 0x7F)
        refuse("is not a text file (control character in byte " + std::to_string(i + 1) + ").");
      if (c != '\r')
        text += c;
      else if (i + 1 == content.size() || content[i + 1] != '\n')
        text += '\n';
    }
  return text;
}

void Prescan::scan_file(const std::string &file)
{
  path.clear();
  try
    {
      scan_text(read_text_file(file), file);
    }
  catch (const InputError &error)
    {
      problems.push_back(error.what());
    }
}

void Prescan::scan_include(const std::string &target, const std::string &place, const std::string &including_file)
{
  namespace fs = std::filesystem;

  std::string name = target;
  if (name.size() > 1 && name.front() == '"' && name.back() == '"')
    name = name.substr(1, name.size() - 2);
  if (name.empty())
    {
      problems.push_back(place + ": 'include' needs a file name.");
      return;
    }
  const std::string file = (fs::path(including_file).parent_path() / name).string(); // an absolute name stays as it is

  std::error_code ignored;
  for (std::size_t i = 0; i < open_files.size(); ++i)
    if (fs::weakly_canonical(open_files[i], ignored) == fs::weakly_canonical(file, ignored))
      {
        std::vector<std::string> chain(open_files.begin() + i, open_files.end());
        chain.push_back(file);
        problems.push_back(place + ": a file must not include itself: " + join(chain, " -> ") + ".");
        return;
      }
  if (++n_files > most_files)
    {
      if (n_files == most_files + 1)
        problems.push_back(place + ": more than " + std::to_string(most_files) + " included files.");
      return;
    }

  std::string text;
  try
    {
      text = read_text_file(file);
    }
  catch (const InputError &error)
    {
      problems.push_back(place + ": included file " + error.what());
      return;
    }
  scan_text(text, file);
}

void Prescan::scan_text(const std::string &text, const std::string &name)
{
  struct Subsection
  {
    std::string  name;
    unsigned int line;
    std::size_t  outer_depth;
  };
  std::vector<Subsection>             open;
  std::map<std::string, unsigned int> first_line; // of each path in this file
  const std::size_t                   depth = path.size();

  open_files.push_back(name);
  std::istringstream input(text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? text.substr(3) : text);
  std::string        raw;
  for (unsigned int n_lines = 0; std::getline(input, raw);)
    {
      // one statement, which a backslash continues on the next line
      const unsigned int line_number = ++n_lines;
      const std::string  place       = name + ":" + std::to_string(line_number);
      std::string        line        = normalise_blanks(raw.substr(0, raw.find('#')));
      while (!line.empty() && line.back() == '\\')
        {
          line.pop_back();
          if (!std::getline(input, raw))
            {
              problems.push_back(place + ": the file ends after the '\\' that continues this line.");
              line.clear();
              break;
            }
          ++n_lines;
          line += normalise_blanks(raw.substr(0, raw.find('#')));
        }
      line = normalise_blanks(line);
      if (line.empty())
        continue;
      const std::string complaint = complaint_about_characters(line);
      if (!complaint.empty())
        {
          problems.push_back(place + ": the line " + complaint);
          continue;
        }

      const auto [keyword, rest] = first_word_and_rest(line);
      if (keyword == "subsection" || keyword == "SUBSECTION")
        {
          const std::vector<std::string> names = split_path(rest);
          open.push_back({rest, line_number, path.size()});
          for (const std::string &section : names)
            path.push_back(section);
          if (std::find(names.begin(), names.end(), "") != names.end())
            problems.push_back(place + ": 'subsection' needs a name, for example 'subsection Mesh'.");
          else
            settings.push_back({join(path, "/"), "", name, line_number, true});
        }
      else if (keyword == "end" || keyword == "END")
        {
          if (!rest.empty())
            problems.push_back(place + ": 'end' stands alone on its line; '" + excerpt(rest) + "' is too much.");
          if (open.empty())
            problems.push_back(place + ": 'end' without an open subsection.");
          else
            {
              path.resize(open.back().outer_depth);
              open.pop_back();
            }
        }
      else if (keyword == "include" || keyword == "INCLUDE")
        scan_include(rest, place, name);
      else if (keyword == "set" || keyword == "SET")
        {
          const std::size_t equals = rest.find('=');
          const std::string entry  = normalise_blanks(rest.substr(0, equals));
          if (equals == std::string::npos)
            problems.push_back(place + ": '" + excerpt(line) + "' lacks a '='. Write 'set Name = value'.");
          else if (entry.empty())
            problems.push_back(place + ": '" + excerpt(line) + "' lacks the name. Write 'set Name = value'.");
          else if (entry.find('/') != std::string::npos)
            problems.push_back(place + ": '" + excerpt(entry) +
                               "' contains '/'. In a file, write 'subsection ...' around the entry.");
          else
            {
              const std::string full    = path.empty() ? entry : join(path, "/") + "/" + entry;
              const auto [seen, is_new] = first_line.insert({full, line_number});
              if (is_new)
                settings.push_back({full, normalise_blanks(rest.substr(equals + 1)), name, line_number, false});
              else
                problems.push_back(place + ": " + (path.empty() ? "" : "[" + join(path, " / ") + "] ") + "'" + entry +
                                   "' was set already in line " + std::to_string(seen->second) +
                                   ". Remove one of them.");
            }
        }
      else
        {
          const std::string nearest = nearest_name(keyword, {"set", "subsection", "end", "include"});
          problems.push_back(place + ": '" + excerpt(line) + "' is not understood. " +
                             (line.find('=') != std::string::npos && nearest != "set" ? "Is 'set' missing in front?"
                              : !nearest.empty() ? "Did you mean '" + nearest + "'?"
                                                 : "A line begins with set, subsection, end, include or #."));
        }
    }

  for (const Subsection &subsection : open)
    problems.push_back(name + ":" + std::to_string(subsection.line) + ": subsection '" + excerpt(subsection.name) +
                       "' is never closed with 'end'.");
  path.resize(depth);
  open_files.pop_back();
}

void Prescan::scan_override(const std::string &assignment)
{
  const std::string place  = "--set '" + excerpt(assignment) + "'";
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos)
    {
      problems.push_back(place + ": lacks a '='. Write --set \"Section/Entry=value\".");
      return;
    }
  const std::vector<std::string> names     = split_path(assignment.substr(0, equals));
  const std::string              value     = normalise_blanks(assignment.substr(equals + 1));
  const std::string              complaint = complaint_about_characters(assignment);
  if (!complaint.empty())
    problems.push_back(place + ": " + complaint);
  else if (std::find(names.begin(), names.end(), "") != names.end())
    problems.push_back(place + ": a name is empty. Write --set \"Section/Entry=value\".");
  else if (assignment.find_first_of("#\n\r") != std::string::npos || (!value.empty() && value.back() == '\\'))
    problems.push_back(place + ": '#', a line break or a final '\\' cannot be part of a value.");
  else
    settings.push_back({join(names, "/"), value, place, 0, false});
}
} // namespace Arenite
