#include <array>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/search/map_elites.hpp"
#include "bench/benches.hpp"

namespace amble::bench {
namespace {

constexpr int joints = 10, bins = 64, batch = 128, evaluations = 1'000'000;

/// A planar arm of ten links of length 1/10: where its hand is, and how little its joint angles differ (the
/// benchmark of Vassiliades, Chatzilygeroudis & Mouret 2018). The angles are the weights of the genome's
/// links.
struct Arm {
  double objective = 0.0;
  std::array<float, 2> hand{};  ///< 0 … 1 each
};

Arm arm_of(const neat::Genome& genome) {
  AMBLE_CHECK(genome.links.size() >= joints, "nothing takes links away");
  double mean = 0.0;
  for (int i = 0; i < joints; ++i) mean += genome.links[static_cast<std::size_t>(i)].weight / joints;
  double variance = 0.0, angle = 0.0, x = 0.0, y = 0.0;
  for (int i = 0; i < joints; ++i) {
    const double bend = genome.links[static_cast<std::size_t>(i)].weight;
    variance += (bend - mean) * (bend - mean) / joints;
    angle += bend;
    x += std::cos(angle) / joints;
    y += std::sin(angle) / joints;
  }
  return {4.0 - std::sqrt(variance), {static_cast<float>(0.5 + 0.5 * x), static_cast<float>(0.5 + 0.5 * y)}};
}

/// A search over genomes of ten links: nine inputs and a bias, one output.
search::MapElites make_search() {
  search::MapElitesSettings settings;
  settings.descriptors.resize(2);
  for (auto& descriptor : settings.descriptors) descriptor.bins = bins;
  settings.batch = settings.initial = batch;
  settings.reevaluate_share = 0.0;
  neat::Settings neat;
  neat.genome.weight_limit = 3.14159265358979;
  neat.mutation.add_link_share = neat.mutation.add_node_share = 0.0;
  return {settings,
          {.neat = neat,
           .inputs = joints - 1,
           .outputs = 1,
           .recurrent = false,
           .seed = 1,
           .behaviour_length = 2}};
}

}  // namespace

void measure_map_elites(std::vector<Figure>& figures) {
  auto search = make_search();
  std::vector<Arm> arms(batch);
  std::vector<search::Evaluation> results(batch);
  double arms_s = 0.0, qd_score = 0.0;
  const double start_s = now_s();
  for (int done = 0; done < evaluations; done += batch) {
    const auto candidates = search.ask();
    const double arms_start_s = now_s();
    for (std::size_t i = 0; i < candidates.size(); ++i) arms[i] = arm_of(candidates[i]);
    arms_s += now_s() - arms_start_s;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      results[i] = {.objective = arms[i].objective, .behaviour = arms[i].hand};
    search.tell(results);
    search.take_log_growth(0);
    qd_score = search.elites().objective_sum();
  }
  const double total_s = now_s() - start_s;
  const double filled = search.elites().size();
  figures.push_back(
      {"map_elites_arm_s", total_s, "s",
       "a million evaluations of a 10-D arm, 64 x 64 cells, batches of 128, one thread, with the log"});
  figures.push_back({"map_elites_us_per_evaluation", (total_s - arms_s) / evaluations * 1e6, "us",
                     "the same without the arm itself: breeding, map, log"});
  figures.push_back({"map_elites_arm_qd_score", qd_score, "rad",
                     "sum over cells of 4 less the standard deviation of the angles"});
  figures.push_back(
      {"map_elites_arm_coverage", filled / (bins * bins), "1", "share of the cells that it filled"});
}

}  // namespace amble::bench
