#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/io/json_file.hpp"

namespace amble::experiment {

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
