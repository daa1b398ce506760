#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/search/elites.hpp"

namespace amble::experiment {

/// The map of a run under MAP-Elites, as its files have it: complete, or up to its last whole round.
struct Repertoire {
  Config config;
  Problem problem;
  search::Elites elites;
};

/// Whether a run of this config fills a map.
bool fills_map(const Config& config);

/// Throws UserError: no such run, or one of another search.
Repertoire load_repertoire(const RunPaths& paths);

/// The whole map as one JSON document (docs/FORMATS.md): dimensions, figures, and each elite with its cell,
/// descriptor, objective and genome, cells in ascending order.
std::string repertoire_json(const Repertoire& repertoire);

/// The elite of a cell as a champion: with a trial without noise, and the episodes of its first evaluation.
/// Nothing if `stop` was set. Throws UserError if the cell does not exist or is empty.
std::optional<Champion> elite_champion(const Repertoire& repertoire, std::uint32_t cell, int jobs,
                                       const std::atomic<bool>& stop);

}  // namespace amble::experiment
