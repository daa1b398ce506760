#include "amble/experiment/episodes.hpp"

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/score/score.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {

double objective(trial::EpisodeScore combined, std::span<const double> scores) {
  AMBLE_CHECK(!scores.empty(), "an evaluation has an episode");
  switch (combined) {
    case trial::EpisodeScore::worst:
      return std::ranges::min(scores);
    case trial::EpisodeScore::median:
      return statistics::median(scores);
    case trial::EpisodeScore::lower_quartile:
      return statistics::quantile(scores, 0.25);
    case trial::EpisodeScore::mean:
      break;
  }
  double sum = 0.0;
  for (const double score : scores) sum += score;
  return sum / static_cast<double>(scores.size());
}

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
