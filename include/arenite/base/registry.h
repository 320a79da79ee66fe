#pragma once

#include <arenite/base/names.h>
#include <arenite/base/parameters.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace Arenite
{
/// From a name in the .prm to an object: the list of all kinds of a Base that a scene may choose.
///
///   Registry<Load> loads("load");
///   loads.add<CavityPressure>("cavity pressure", "Pressure history on a named boundary.");
///   std::unique_ptr<Load> load = loads.make(parameters.peek("Loads/blast/Type", ""));
///
/// Registration is explicit, in one function that the reader can find; the order of add() is the order of the manual.
template <typename Base, typename... Args>
class Registry
{
public:
  /// @p kind is the word for Base in messages, for example "material law".
  explicit Registry(std::string kind)
    : kind(std::move(kind))
  {}

  /// Derived is constructed from Args. The sentence tells the user when to choose it.
  template <typename Derived>
  void add(const std::string &name, const std::string &sentence)
  {
    for (const Item &item : items)
      if (item.name == name)
        throw std::logic_error("The " + kind + " '" + name + "' is registered twice.");
    items.push_back({name, sentence, [](Args... args) -> std::unique_ptr<Base> {
                       return std::make_unique<Derived>(std::forward<Args>(args)...);
                     }});
  }

  /// A new object of the kind called @p name; InputError with the nearest name when there is none. For an error that
  /// also names file and line, read the name with Parameters::peek_choice(path, fallback, names()).
  std::unique_ptr<Base> make(const std::string &name, Args... args) const
  {
    for (const Item &item : items)
      if (item.name == name)
        return item.factory(std::forward<Args>(args)...);
    throw InputError("'" + name + "' is not a " + kind + "." + suggestion(name, names()));
  }

  std::vector<std::string> names() const
  {
    std::vector<std::string> result;
    for (const Item &item : items)
      result.push_back(item.name);
    return result;
  }

  /// One Markdown line per kind: "- **name**: sentence".
  std::string catalogue() const
  {
    std::string result;
    for (const Item &item : items)
      result += "- **" + item.name + "**: " + item.sentence + "\n";
    return result;
  }

private:
  struct Item
  {
    std::string                                   name, sentence;
    std::function<std::unique_ptr<Base>(Args...)> factory;
  };

  std::string       kind;
  std::vector<Item> items;
};
} // namespace Arenite
