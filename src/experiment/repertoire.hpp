#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/problem.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/io/json_file.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/search/elites.hpp"

namespace amble::experiment {

/// The map of a run under MAP-Elites, as its files have it: complete, or up to its last whole round.
struct Repertoire {
  Config config;
  Problem problem;
  search::Elites elites;
  record::Generations generations;  ///< how the map filled; none where the run's table is missing
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

/// The map of a run, and how it differs from the first one's.
struct ComparedMap {
  std::string name;
  std::uint32_t cells = 0, filled = 0;
  double qd_score = 0.0, best = 0.0;
  std::string unit;
  struct Difference {
    std::uint32_t common = 0;             ///< cells filled in both
    std::uint32_t better = 0, worse = 0;  ///< of these: objective larger or smaller than in the first
    std::uint32_t only_here = 0, only_there = 0;
  };
  std::optional<Difference> from_first;  ///< nothing: it is the first, or cells mean something else there
};

/// The maps of those inputs that are runs under MAP-Elites. Throws UserError for a run that cannot be read.
std::vector<ComparedMap> compare_maps(const std::vector<std::filesystem::path>& inputs);

/// As docs/FORMATS.md describes it.
io::Json map_json(const ComparedMap& map);

}  // namespace amble::experiment
