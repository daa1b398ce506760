#pragma once

#include <array>
#include <cstddef>
#include <string_view>

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

}  // namespace amble::search
