#pragma once

#include <cstddef>
#include <string>

#include "amble/io/settings.hpp"
#include "amble/search/map_elites_settings.hpp"
#include "amble/search/novelty_settings.hpp"

namespace amble::search {

/// The search strategy, a row of strategies.cpp, and the settings of each.
struct Settings {
  std::string kind = "objective";
  NoveltySettings novelty;
  MapElitesSettings map_elites;

  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::search
