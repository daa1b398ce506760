#include "bench/workload.hpp"

#include <hwy/highway.h>

#include <cstdint>

#include "amble/neat/population.hpp"

namespace amble::bench {

experiment::Config authors_config(std::vector<std::string> assignments) {
  return experiment::load_config(AMBLE_SOURCE_DIR "/configs/authors/supg-objective.toml",
                                 {.assignments = std::move(assignments), .seed = {}, .generations = {}});
}

std::vector<neat::Genome> evolved_genomes(int count, int inputs, int outputs) {
  constexpr double hidden_wanted = 6.4;
  constexpr int links_wanted = 40;
  neat::Settings settings;
  settings.population.size = count;
  settings.speciation.target_min = settings.speciation.target_max = 1;
  settings.mutation.add_link_share = 2.0;
  settings.mutation.add_node_share = 0.5;
  neat::Population population(settings, inputs, outputs, true, 1);
  // Links grow faster than nodes here, so whichever is reached first is held.
  while (population.statistics().mean_hidden < hidden_wanted &&
         population.statistics().mean_links < links_wanted)
    population.advance(std::vector<neat::Fitness>(static_cast<std::size_t>(count), {1.0, 1.0}));
  return {population.genomes().begin(), population.genomes().end()};
}

void without_avx512(const std::function<void()>& measure) {
  const std::int64_t instructions = hwy::SupportedTargets();
  if ((instructions & HWY_AVX2) == 0 || (instructions & HWY_AVX3) == 0) return;
  hwy::SetSupportedTargetsForTest(HWY_AVX2);
  measure();
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace amble::bench
