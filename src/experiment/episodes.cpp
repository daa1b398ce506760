#include "amble/experiment/episodes.hpp"

namespace amble::experiment {

std::optional<std::vector<trial::Scenario>> unseen_scenarios(const Problem& problem, std::int64_t seed,
                                                             int first, int count,
                                                             const ground::Ground* ground,
                                                             const std::atomic<bool>& stop) {
  std::vector<trial::Scenario> scenarios;
  for (int i = 0; i < count && problem.trials_vary(); ++i) {
    if (stop) return std::nullopt;
    scenarios.push_back(problem.scenario(
        episode_key(EpisodeSet::unseen, seed, static_cast<std::uint32_t>(first + i)), ground));
  }
  return scenarios;
}

std::vector<double> objectives(const Problem& problem, const GenerationResult& result) {
  return objectives(problem, result.trajectories, result.episodes);
}

}  // namespace amble::experiment
