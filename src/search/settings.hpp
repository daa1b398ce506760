#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/own_settings.hpp"
#include "amble/io/settings.hpp"

namespace amble::search {

enum class Distance { squared, root };
inline constexpr std::array<std::string_view, 2> distance_names{"squared", "root"};

/// The behaviours that a candidate's novelty is measured against.
enum class Neighbours { archive, archive_and_population };
inline constexpr std::array<std::string_view, 2> neighbours_names{"archive", "archive_and_population"};

/// After the threshold was lowered because so many generations in a row added no candidate: whether each
/// further such generation lowers it again, or the count starts anew.
enum class Lowering { each_generation, count_anew };
inline constexpr std::array<std::string_view, 2> lowering_names{"each_generation", "count_anew"};

/// Novelty search (Lehman & Stanley 2011; Morse et al. 2013, sec. 4). The defaults are what the authors' code
/// did.
struct NoveltySettings {
  int path_stride = 2;
  int path_first_step = 1;
  Distance distance = Distance::squared;
  Neighbours compare_with = Neighbours::archive;
  int neighbours = 15;
  double threshold = 1000.0;
  int first_members = 15;
  bool count_first_members = false;
  int raise_above = 4;
  double raise_factor = 1.2;
  int lower_after = 4;
  Lowering lowering = Lowering::each_generation;
  double lower_factor = 0.8;
  double lowest_threshold = 0.0;
  int archive_limit = 50000;

  void describe(io::SettingsVisitor& visitor);
  /// Throws UserError where these settings do not fit behaviours of this length.
  void validate(std::size_t behaviour_length) const;
  /// Throws UserError where a full archive and a generation of `population` candidates would not fit into
  /// `memory_bytes`. For running a search only: a config may be read on a smaller machine.
  void check_memory(std::size_t behaviour_length, int population, double memory_bytes) const;
};

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

/// CMA-ES on the weights of a CPPN that never grows.
struct CmaEsSettings {
  double step = 0.3;
  double least_step = 1e-6;

  void describe(io::SettingsVisitor& visitor);
  bool operator==(const CmaEsSettings&) const = default;
};

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
