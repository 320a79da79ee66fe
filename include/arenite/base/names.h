#pragma once

#include <string>
#include <vector>

namespace Arenite
{
/// The member of @p known that the user most likely meant by @p name; empty when nothing is close.
///
/// Case is ignored. Close means: at most one slip (insertion, deletion, substitution or exchange of two neighbours; the
/// Damerau-Levenshtein distance with non-overlapping exchanges) per three letters, or one name begins with the other.
std::string nearest_name(const std::string &name, const std::vector<std::string> &known);

/// True if the words differ at most in case (ASCII).
bool same_ignoring_case(const std::string &a, const std::string &b);

/// "a, b, c".
std::string join(const std::vector<std::string> &words, const std::string &separator = ", ");

/// " Did you mean 'x'? Known: x, y, z." for the end of a message; without the list when it is longer than
/// @p longest_list.
std::string suggestion(const std::string &name, const std::vector<std::string> &known, std::size_t longest_list = 12);
} // namespace Arenite
