#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "amble/neat/settings.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// The genomes that a strategy searches, and its seed.
struct SearchSpace {
  const neat::Settings& neat;        ///< genomes, variation, speciation; valid
  int inputs = 0;                    ///< of the CPPN, without the bias
  int outputs = 1;                   ///< of the CPPN
  bool recurrent = false;            ///< whether CPPNs may have cycles
  std::uint64_t seed = 0;            ///< of all randomness
  std::size_t behaviour_length = 0;  ///< numbers in each Evaluation::behaviour
};

/// One strategy, as the rest of the program sees it.
struct StrategyKind {
  std::string_view name;       ///< value of search.kind
  std::string_view behaviour;  ///< which behaviour its evaluations need (score/behaviour.hpp); "": none
  std::unique_ptr<Strategy> (*make)(const Settings& settings, const SearchSpace& space);
  /// Candidates of a round.
  int (*candidates)(const Settings& settings, const neat::Settings& neat);
  /// Throws SettingError where the settings do not fit behaviours of this length.
  void (*validate)(const Settings& settings, std::size_t behaviour_length);
  /// Throws SettingError if the search of `space` could need more than `memory_bytes`. For running it only: a
  /// config may be read on a smaller machine.
  void (*check_memory)(const Settings& settings, const SearchSpace& space, double memory_bytes);
};

/// The row of the settings' kind. AMBLE_CHECK: the kind is known, as describe() ensures.
const StrategyKind& strategy_kind(const Settings& settings);

}  // namespace amble::search
