#include "amble/experiment/run_state.hpp"

#include "amble/core/error.hpp"
#include "amble/search/strategies.hpp"
#include "amble/search/usable_memory.hpp"

namespace amble::experiment {
namespace {

search::SearchSpace space_of(const Config& config, const Problem& problem) {
  return {.neat = config.neat,
          .inputs = problem.cppn_inputs(),
          .outputs = problem.cppn_outputs(),
          .recurrent = config.cppn.recurrent,
          .seed = static_cast<std::uint64_t>(config.seed),
          .behaviour_length = config.make_behaviour()->length()};
}

}  // namespace

RunState::RunState(const Config& config, const Problem& problem)
    : strategy(search::strategy_kind(config.search).make(config.search, space_of(config, problem))) {}

void check_search(const Config& config, const Problem& problem) {
  try {
    config.make_behaviour(&problem.robot);
    search::strategy_kind(config.search)
        .check_memory(config.search, space_of(config, problem), search::usable_memory_bytes());
  } catch (const SettingError& error) {
    throw config.placed(error);
  }
}

}  // namespace amble::experiment
