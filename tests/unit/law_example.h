#pragma once

#include <arenite/base/parameters.h>

#include <algorithm>
#include <list>
#include <string>
#include <vector>

/// A law with the parameters of one block of tests/data/laws/<law name>.prm, or of another file.
template <typename Law>
Law law_of_block(const std::string &file, const std::string &block)
{
  Arenite::Parameters    parameters = Arenite::Parameters::from_files({file});
  std::list<Law>         laws; // entries are bound to them until parse()
  std::list<std::string> texts;
  const Law             *wanted = nullptr;
  {
    const auto materials = parameters.section("Materials");
    for (const std::string &name : parameters.peek_list("Blocks"))
      {
        const auto section = parameters.section(name);
        parameters.add_text("Law", texts.emplace_back(), "");
        laws.emplace_back().declare_parameters(parameters);
        if (name == block)
          wanted = &laws.back();
      }
  }
  std::vector<std::string> names;
  parameters.add_list("Blocks", names, "");
  parameters.parse();
  for (Law &law : laws)
    law.finalize(parameters);
  return *wanted;
}

inline std::string example_file(std::string law_name)
{
  std::replace(law_name.begin(), law_name.end(), ' ', '_');
  return ARENITE_SOURCE_DIR "/tests/data/laws/" + law_name + ".prm";
}

inline std::vector<std::string> example_blocks(const std::string &law_name)
{
  return Arenite::Parameters::from_files({example_file(law_name)}).peek_list("Blocks");
}
