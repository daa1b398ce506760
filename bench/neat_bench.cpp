#include <vector>

#include "amble/neat/population.hpp"
#include "bench/benches.hpp"

namespace amble::bench {

void measure_neat(std::vector<Figure>& figures) {
  neat::Settings settings;
  settings.mutation.add_link_share = 2.0;
  settings.mutation.add_node_share = 0.5;
  neat::Population population(settings, 3, 2, true, 1);
  const auto advance = [&] {
    std::vector<neat::Fitness> fitness;
    for (int i = 0; i < settings.population.size; ++i) {
      const double value = 1.0 + i % 7;
      fitness.push_back({value, value});
    }
    population.advance(fitness);
  };
  while (population.statistics().mean_links < 40.0) advance();
  constexpr int measured = 20;
  const double start_s = now_s();
  for (int i = 0; i < measured; ++i) advance();
  figures.push_back({"neat_generation_ms", (now_s() - start_s) / measured * 1e3, "ms",
                     "breeding and speciating 300 genomes of 40 links"});
}

}  // namespace amble::bench
