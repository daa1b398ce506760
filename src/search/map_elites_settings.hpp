#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::search {

/// One dimension of a map: a quantity of trials and its range.
struct DescriptorSettings {
  std::string quantity = "duty_factor";  ///< a row of score::quantities()
  std::string leg;                       ///< of a quantity that legs have; empty: the mean over legs
  double least = 0.0, most = 1.0;
  int bins = 10;  ///< of a grid

  std::string label() const { return leg.empty() ? quantity : quantity + " " + leg; }
  void describe(io::SettingsVisitor& visitor);
};

enum class Archive { grid, cvt };
inline constexpr std::array<std::string_view, 2> archive_names{"grid", "cvt"};

/// How parents are drawn from the elites.
enum class Selection { uniform, objective, curiosity };
inline constexpr std::array<std::string_view, 3> selection_names{"uniform", "objective", "curiosity"};

/// MAP-Elites (Mouret & Clune 2015).
struct MapElitesSettings {
  std::vector<DescriptorSettings> descriptors = {};
  Archive archive = Archive::grid;
  int cells = 10000;
  int centroid_samples = 100000;
  std::int64_t centroid_seed = 1;
  int batch = 1024;
  int initial = 4096;
  Selection select = Selection::uniform;
  double crossover_probability = 0.0;
  double reevaluate_share = 0.0;
  int trials = 1;
  double challenger_share = 0.35;

  void describe(io::SettingsVisitor& visitor);
  /// Throws SettingError for what cannot be: a map without descriptors, an empty range, too many cells.
  void validate() const;
  /// Cells of the map; 0 if there are more than most_cells.
  std::uint32_t cell_count() const;
  /// How many candidates of a batch are elites evaluated again; at most the number of elites.
  std::size_t reevaluations(std::size_t elites) const;
  /// Whether a candidate can need more than one evaluation to enter the map.
  bool tries_candidates_again() const { return trials > 1; }
  /// Candidates at most that are tried again in a round before they enter.
  std::size_t most_challengers() const;
};

inline constexpr std::uint32_t most_cells = 20'000'000;

}  // namespace amble::search
