#include <vector>

#include "amble/experiment/checkpoint.hpp"
#include "fuzz/target.hpp"

// The input is the payload behind a valid seal and the hash of the config, which would keep the fuzzer out.
AMBLE_FUZZ_TARGET(bytes) {
  using namespace amble;
  experiment::Config config;
  config.neat.population.size = 4;
  config.neat.speciation.target_min = config.neat.speciation.target_max = 2;
  neat::Population population(config.neat, 3, 2, true, 1);
  const auto search = search::make_search(config.search, config.behaviour_length());

  experiment::load_progress(bytes, "payload", population, *search);
  // What was accepted is a population to go on with.
  population.advance(std::vector<neat::Fitness>(population.genomes().size(), neat::Fitness{1.0, 1.0}));
}
