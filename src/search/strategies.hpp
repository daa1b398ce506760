#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "amble/core/circle.hpp"
#include "amble/neat/settings.hpp"
#include "amble/search/settings.hpp"
#include "amble/search/strategy.hpp"

namespace amble::search {

/// The genomes that a strategy searches, and its seed.
struct SearchSpace {
  const neat::Settings& neat;        ///< genomes, variation, speciation; valid
  int inputs = 0;                    ///< the CPPN's, without the bias
  int outputs = 1;                   ///< the CPPN's, at least 1
  bool recurrent = false;            ///< whether CPPNs may have cycles
  std::uint64_t seed = 0;            ///< the run's, from which all randomness follows
  std::size_t behaviour_length = 0;  ///< numbers in each Evaluation::behaviour
  std::vector<Circle> circles = {};  ///< of each of these numbers; empty: none is one of a circle
};

/// A search that configs can choose, as the rest of the program sees it.
struct StrategyKind {
  std::string name;  ///< value of search.kind: a–z, 0–9, "-" and "_"
  /// Which behaviour its evaluations need (score/behaviour.hpp): "path", "descriptors"; "": none.
  std::string behaviour;
  /// Must be there (AMBLE_CHECK). `settings.own` has all of `numbers`. What `space` refers to need not
  /// outlive the call.
  std::function<std::unique_ptr<Strategy>(const Settings& settings, const SearchSpace& space)> make;
  /// Candidates of a round, for estimates of time and memory alone: ask() decides. Empty: population.size.
  std::function<int(const Settings& settings, const neat::Settings& neat)> candidates = {};
  /// Throws SettingError where the settings do not fit behaviours of this length; empty: they always do.
  std::function<void(const Settings& settings, std::size_t behaviour_length)> validate = {};
  /// Throws SettingError if the search of `space` could need more than `memory_bytes`; empty: it needs
  /// little. For running it only: a config may be read on a smaller machine.
  std::function<void(const Settings& settings, const SearchSpace& space, double memory_bytes)> check_memory =
      {};
  std::vector<io::OwnNumber> numbers = {};  ///< its settings: [search.own]
  /// Tables of a config that it reads and other kinds may not, "search.novelty"; empty: it is not known.
  std::vector<std::string> tables = {};
};

/// All kinds, in the order in which they are listed to users.
const std::deque<StrategyKind>& strategy_kinds();

/// Adds a search, from then on one of those that configs can choose. Before the first config is read; not
/// thread safe. Throws UserError for a name that is taken or cannot be one.
void register_search(StrategyKind kind);

/// The kind of the settings, its functions none of them empty. AMBLE_CHECK: it is known, as describe()
/// ensures.
const StrategyKind& strategy_kind(const Settings& settings);

}  // namespace amble::search
