#include <arenite/base/names.h>

#include <algorithm>
#include <cctype>

namespace Arenite
{
namespace
{
std::string lower_case(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](const unsigned char c) { return std::tolower(c); });
  return word;
}

std::size_t distance(const std::string &a, const std::string &b)
{
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j)
      {
        if (i == 0 || j == 0)
          {
            d[i][j] = i + j;
            continue;
          }
        d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
          d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
  return d[a.size()][b.size()];
}
} // namespace

std::string nearest_name(const std::string &name, const std::vector<std::string> &known)
{
  // Nobody mistypes that long a name, and the table above is quadratic.
  if (name.empty() || name.size() > 200)
    return "";

  const std::string word = lower_case(name);
  std::string       nearest;
  std::size_t       smallest = 0;
  for (const std::string &candidate : known)
    {
      const std::string other   = lower_case(candidate);
      const std::size_t longer  = std::max(word.size(), other.size());
      const std::size_t shorter = std::min(word.size(), other.size());
      const std::size_t cut_off = longer <= 3 ? 1 : longer / 3;

      std::size_t slips = distance(word, other);
      if (shorter >= 3 && word.compare(0, shorter, other, 0, shorter) == 0)
        slips = std::min(slips, cut_off);
      if (slips <= cut_off && slips < longer && (nearest.empty() || slips < smallest))
        {
          nearest  = candidate;
          smallest = slips;
        }
    }
  return nearest;
}

bool same_ignoring_case(const std::string &a, const std::string &b) { return lower_case(a) == lower_case(b); }

std::string join(const std::vector<std::string> &words, const std::string &separator)
{
  std::string result;
  for (const std::string &word : words)
    result += (result.empty() ? "" : separator) + word;
  return result;
}

std::string suggestion(const std::string &name, const std::vector<std::string> &known, const std::size_t longest_list)
{
  std::string       result;
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty())
    result += " Did you mean '" + nearest + "'?";
  if (!known.empty() && known.size() <= longest_list)
    result += " Known: " + join(known) + ".";
  return result;
}
} // namespace Arenite
