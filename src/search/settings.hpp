#pragma once

#include <cstddef>
#include <string>

#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"
#include "amble/search/cma_es_settings.hpp"
#include "amble/search/map_elites_settings.hpp"
#include "amble/search/novelty_settings.hpp"

namespace amble::search {

/// The search strategy, the name of a StrategyKind, and the settings of each.
struct Settings {
  std::string kind = "objective";
  NoveltySettings novelty;
  MapElitesSettings map_elites;
  CmaEsSettings cma_es;
  io::OwnSettings own;  ///< of a kind that a program or a plugin has added

  void describe(io::SettingsVisitor& visitor);
};

}  // namespace amble::search
