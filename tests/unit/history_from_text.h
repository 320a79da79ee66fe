#pragma once

#include <arenite/base/parameters.h>
#include <arenite/base/time_history.h>

#include <memory>
#include <string>

/// The history called @p name with @p entries such as "set Rise time = 1e-3", as a scene would make it.
inline std::shared_ptr<const Arenite::TimeHistory> history_from_text(const std::string &name,
                                                                     const std::string &entries)
{
  struct Scene
  {
    Arenite::Parameters                   parameters;
    std::unique_ptr<Arenite::TimeHistory> history;
  };
  auto scene = std::shared_ptr<Scene>(
    new Scene{Arenite::Parameters::from_text(entries, "scene.prm"), Arenite::make_time_history(name)});
  scene->history->declare_parameters(scene->parameters);
  scene->parameters.parse();
  scene->history->finalize();
  return {scene, scene->history.get()}; // the parameters live as long: histories may refuse a value later
}
