#include <vector>

#include "amble/experiment/checkpoint.hpp"
#include "fuzz/target.hpp"

// The input is the payload behind a valid seal and the hash of the config, which would keep the fuzzer out.
AMBLE_FUZZ_TARGET(bytes) {
  using namespace amble;
  experiment::Config config;
  config.neat.population.size = 4;
  config.neat.speciation.target_min = config.neat.speciation.target_max = 2;
  const search::SearchSpace space{
      .neat = config.neat, .inputs = 3, .outputs = 2, .recurrent = true, .seed = 1, .behaviour_length = 0};
  const auto strategy = search::strategy_kind(config.search).make(config.search, space);

  experiment::load_progress(bytes, "payload", *strategy);
  // What was accepted is a population to go on with.
  strategy->tell(
      std::vector<search::Evaluation>(strategy->ask().size(), {.objective = 1.0, .behaviour = {}}));
}
