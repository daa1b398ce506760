#include "amble/experiment/plan/run_state.hpp"

namespace amble::experiment {

search::SearchSpace space_of(const Config& config, const Problem& problem) {
  return {.neat = config.neat,
          .inputs = problem.cppn_inputs(),
          .outputs = problem.cppn_outputs(),
          .recurrent = config.cppn.recurrent,
          .seed = static_cast<std::uint64_t>(config.seed),
          .behaviour_length = config.make_behaviour()->length()};
}

RunState::RunState(const Config& config, const Problem& problem)
    : strategy(search::strategy_kind(config.search).make(config.search, space_of(config, problem))) {}

}  // namespace amble::experiment
