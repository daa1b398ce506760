#pragma once

#include <cstddef>
#include <string>

#include "amble/io/settings.hpp"
#include "amble/search/novelty_settings.hpp"

namespace amble::search {

/// How genomes are searched for: which row of strategies.cpp, and the settings of those that have any.
struct Settings {
  std::string kind = "objective";
  NoveltySettings novelty;

  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::search
