#include "amble/experiment/episodes.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/score/score.hpp"

namespace amble::experiment {

double objective(trial::EpisodeScore combined, std::span<const double> scores) {
  AMBLE_CHECK(!scores.empty(), "an evaluation has an episode");
  if (combined == trial::EpisodeScore::worst) return *std::ranges::min_element(scores);
  double sum = 0.0;
  for (const double score : scores) sum += score;
  return sum / static_cast<double>(scores.size());
}

trial::ScenarioKey unseen_key(std::int64_t seed) {
  return {.seed = static_cast<std::uint64_t>(seed), .generation = 0, .episode = first_unseen_episode};
}

trial::ScenarioKey judging_key(std::int64_t seed) {
  return {.seed = static_cast<std::uint64_t>(seed), .generation = 0, .episode = 1000 * first_unseen_episode};
}

std::vector<trial::Scenario> unseen_scenarios(const Problem& problem, std::int64_t seed, int first, int count,
                                              const ground::Ground* ground) {
  std::vector<trial::Scenario> scenarios;
  for (int i = 0; i < count && problem.disturbed(); ++i) {
    trial::ScenarioKey key = unseen_key(seed);
    key.episode += static_cast<std::uint32_t>(first + i);
    scenarios.push_back(problem.scenario(key, ground));
  }
  return scenarios;
}

std::vector<double> objectives(const Problem& problem, const GenerationResult& result) {
  const score::Score score = problem.scorer();
  std::vector<double> objectives, scores;
  for (std::size_t i = 0; i < result.trajectories.size() / result.episodes; ++i) {
    scores.clear();
    for (const auto& trajectory : result.of_genome(i))
      scores.push_back(score::credited(score.of(trajectory), trajectory.outcome, problem.trial.fall_factor));
    objectives.push_back(objective(problem.noise.score, scores));
  }
  return objectives;
}

}  // namespace amble::experiment
