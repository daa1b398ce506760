#include "amble/experiment/episodes.hpp"

#include "amble/score/score.hpp"

namespace amble::experiment {

trial::ScenarioKey episode_key(EpisodeSet set, std::int64_t seed, std::uint32_t n) {
  return {.seed = static_cast<std::uint64_t>(seed), .generation = 0, .episode = episode_number(set, n)};
}

std::vector<trial::Scenario> unseen_scenarios(const Problem& problem, std::int64_t seed, int first, int count,
                                              const ground::Ground* ground) {
  std::vector<trial::Scenario> scenarios;
  for (int i = 0; i < count && problem.trials_vary(); ++i)
    scenarios.push_back(problem.scenario(
        episode_key(EpisodeSet::unseen, seed, static_cast<std::uint32_t>(first + i)), ground));
  return scenarios;
}

std::vector<double> credited_scores(const Problem& problem, std::span<const record::Trajectory> trials) {
  const score::Score score = problem.make_score();
  std::vector<double> scores;
  for (const auto& trajectory : trials)
    scores.push_back(problem.credited(score.of(trajectory), trajectory.outcome));
  return scores;
}

std::vector<double> objectives(const Problem& problem, const GenerationResult& result) {
  const auto scores = credited_scores(problem, result.trajectories);
  std::vector<double> objectives;
  for (std::size_t first = 0; first < scores.size(); first += result.episodes)
    objectives.push_back(objective(problem.noise.score, std::span(scores).subspan(first, result.episodes)));
  return objectives;
}

}  // namespace amble::experiment
