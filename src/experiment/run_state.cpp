#include "amble/experiment/run_state.hpp"

#include <fmt/format.h>

#include "amble/core/error.hpp"
#include "amble/experiment/memory_need.hpp"
#include "amble/search/usable_memory.hpp"

namespace amble::experiment {

void check_search(const Config& config, const Problem& problem) {
  try {
    config.make_behaviour(&problem.robot);
    const double usable_bytes = search::usable_memory_bytes();
    if (const auto need = memory_of_generation(config, problem); need.bytes > usable_bytes)
      throw SettingError(
          need.keys,
          fmt::format(
              "not enough memory: a generation asks for {:.2g} GB by {}; this process may use {:.2g} GB",
              need.bytes / 1e9, need.what, usable_bytes / 1e9));
    search::strategy_kind(config.search).check_memory(config.search, space_of(config, problem), usable_bytes);
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
}

}  // namespace amble::experiment
