#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "amble/neat/settings.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// What a strategy is made for.
struct SearchSpace {
  const neat::Settings& neat;        ///< how genomes begin, vary and are told apart; valid
  int inputs = 0;                    ///< of the CPPN, without the bias
  int outputs = 1;                   ///< of the CPPN
  bool recurrent = false;            ///< whether CPPNs may have cycles
  std::uint64_t seed = 0;            ///< of all randomness
  std::size_t behaviour_length = 0;  ///< numbers in each Evaluation::behaviour
};

/// One strategy: all that the rest of the program needs to know of it.
struct StrategyKind {
  std::string_view name;       ///< value of search.kind
  std::string_view behaviour;  ///< which behaviour its evaluations need (score/behaviour.hpp); "": none
  std::unique_ptr<Strategy> (*make)(const Settings& settings, const SearchSpace& space);
  /// Throws SettingError where the settings do not go with behaviours of so many numbers.
  void (*validate)(const Settings& settings, std::size_t behaviour_length);
  /// Throws SettingError if the search of `space` could need more than `memory_bytes`. For those who run it:
  /// a config may be read on a smaller machine.
  void (*check_memory)(const Settings& settings, const SearchSpace& space, double memory_bytes);
};

/// All strategies, in the order in which they are listed to users.
std::span<const StrategyKind> strategies();
/// The row of the settings' kind. An unknown kind is a programmer's mistake: describe() lets none through.
const StrategyKind& strategy_kind(const Settings& settings);

}  // namespace amble::search
