#include "amble/experiment/episodes.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/score/distance.hpp"

namespace amble::experiment {

double objective_m(trial::EpisodeScore score, std::span<const double> distances_m) {
  AMBLE_CHECK(!distances_m.empty(), "an evaluation has an episode");
  if (score == trial::EpisodeScore::worst) return *std::ranges::min_element(distances_m);
  double sum = 0.0;
  for (const double distance_m : distances_m) sum += distance_m;
  return sum / static_cast<double>(distances_m.size());
}

std::vector<double> objectives_m(trial::EpisodeScore score, double fall_factor,
                                 const GenerationResult& result) {
  std::vector<double> objectives, distances_m;
  for (std::size_t i = 0; i < result.trajectories.size() / result.episodes; ++i) {
    distances_m.clear();
    for (const auto& trajectory : result.of_genome(i))
      distances_m.push_back(
          score::credited_m(score::distance_m(trajectory), trajectory.outcome, fall_factor));
    objectives.push_back(objective_m(score, distances_m));
  }
  return objectives;
}

}  // namespace amble::experiment
