#include "amble/experiment/plan/told_generation.hpp"

#include <algorithm>

#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/score/score.hpp"
#include "amble/score/tracking.hpp"

namespace amble::experiment {

trial::ScenarioKey episode_key(EpisodeSet set, std::int64_t seed, std::uint32_t n) {
  return {.seed = static_cast<std::uint64_t>(seed), .generation = 0, .episode = episode_number(set, n)};
}

std::vector<double> credited_scores(const Problem& problem, std::span<const record::Trajectory> trials) {
  const score::Score score = problem.make_score();
  std::vector<double> scores;
  for (const auto& trajectory : trials)
    scores.push_back(problem.credited(score.of(trajectory), trajectory.outcome));
  return scores;
}

std::vector<double> objectives(const Problem& problem, std::span<const record::Trajectory> trials,
                               std::size_t episodes) {
  const auto scores = credited_scores(problem, trials);
  std::vector<double> objectives;
  for (std::size_t first = 0; first < scores.size(); first += episodes)
    objectives.push_back(objective(problem.noise.score, std::span(scores).subspan(first, episodes)));
  return objectives;
}

record::Measures tracking_measures(const Problem& problem) {
  return problem.command.kind == trial::CommandKind::none ? record::Measures() : score::tracking_measures;
}

ToldGeneration told(std::span<const record::Trajectory> trials, std::size_t episodes,
                    std::span<const double> objectives, const score::Behaviour& behaviour) {
  const std::size_t genomes = objectives.size();
  ToldGeneration all;
  all.behaviours.reserve(genomes);  // the evaluations refer to what is in it
  all.evaluations.reserve(genomes);
  for (std::size_t i = 0; i < genomes; ++i) {
    const auto own = trials.subspan(i * episodes, episodes);
    all.behaviours.push_back(behaviour.of(own));
    const bool viable = std::ranges::count(own, record::Outcome::diverged, &record::Trajectory::outcome) == 0;
    all.evaluations.push_back(
        {.objective = objectives[i], .behaviour = all.behaviours.back(), .viable = viable});
  }
  return all;
}

}  // namespace amble::experiment
