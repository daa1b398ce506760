#include "amble/experiment/generation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/episodes.hpp"

namespace amble::experiment {
namespace {

/// The scenarios of further trials, after those that every genome has.
std::vector<trial::Scenario> further_scenarios(const Problem& problem, int count, std::int64_t seed,
                                               int generation, const ground::Ground* ground) {
  std::vector<trial::Scenario> scenarios;
  scenarios.reserve(to_index(count));
  for (int i = 0; i < count; ++i)
    scenarios.push_back(problem.scenario({.seed = static_cast<std::uint64_t>(seed),
                                          .generation = static_cast<std::uint32_t>(generation),
                                          .episode = static_cast<std::uint32_t>(problem.noise.episodes + i)},
                                         ground));
  return scenarios;
}

/// Tries the finalists again; false if `stop` was set meanwhile.
bool final_round(Evaluator& evaluator, const Problem& problem, std::span<const neat::Genome> genomes,
                 double share, std::span<const trial::Scenario> scenarios,
                 const std::shared_ptr<const ground::Ground>& ground, EvaluatedGeneration& evaluated,
                 const std::atomic<bool>& stop) {
  const auto& finalists = evaluated.finalists = finalists_of(evaluated.objectives, share);
  std::vector<neat::Genome> best;
  best.reserve(finalists.size());
  for (const std::size_t i : finalists) best.push_back(genomes[i]);
  const auto again = evaluator.evaluate(best, stop, scenarios, ground);
  if (!again) return false;

  double worst = evaluated.objectives[finalists.front()];
  for (std::size_t f = 0; f < finalists.size(); ++f) {
    auto scores = credited_scores(problem, evaluated.result.of_genome(finalists[f]));
    const auto further = again->of_genome(f);
    for (const double score : credited_scores(problem, further)) scores.push_back(score);
    if (std::ranges::count(further, record::Outcome::diverged, &record::Trajectory::outcome) > 0)
      evaluated.diverged.push_back(finalists[f]);
    double& own = evaluated.objectives[finalists[f]];
    own = objective(problem.noise.score, scores);
    worst = f == 0 ? own : std::min(worst, own);
  }
  for (std::size_t i = 0; i < evaluated.objectives.size(); ++i)
    if (!std::ranges::binary_search(finalists, i))
      evaluated.objectives[i] = std::min(evaluated.objectives[i], worst);

  evaluated.result.steps += again->steps;
  for (const Stage& stage : stages) evaluated.result.times.*stage.seconds += again->times.*stage.seconds;
  return true;
}

}  // namespace

std::vector<std::size_t> finalists_of(std::span<const double> objectives, double share) {
  AMBLE_CHECK(!objectives.empty(), "a generation has members");
  const auto exact = share * static_cast<double>(objectives.size());
  const auto count = std::clamp<std::size_t>(to_index(std::llround(exact)), 1, objectives.size());
  std::vector<std::size_t> order(objectives.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return objectives[i]; });
  order.resize(count);
  std::ranges::sort(order);
  return order;
}

std::size_t EvaluatedGeneration::best() const {
  if (finalists.empty()) return to_index(std::ranges::max_element(objectives) - objectives.begin());
  return *std::ranges::max_element(finalists, {}, [this](std::size_t i) { return objectives[i]; });
}

ToldGeneration told(const EvaluatedGeneration& evaluated, const score::Behaviour& behaviour) {
  ToldGeneration all =
      told(evaluated.result.trajectories, evaluated.result.episodes, evaluated.objectives, behaviour);
  for (const std::size_t i : evaluated.diverged) all.evaluations[i].viable = false;
  return all;
}

std::optional<EvaluatedGeneration> evaluate_generation(Evaluator& evaluator, const Problem& problem,
                                                       const EvaluationSettings& settings,
                                                       GenerationMemory& memory, std::int64_t seed,
                                                       int generation, std::span<const neat::Genome> genomes,
                                                       const std::atomic<bool>& stop) {
  const int drawn = noise_generation(settings.draw, generation);
  const auto on = memory.ground.of(problem, seed, drawn);
  const bool varies = problem.trials_vary() || on != nullptr;
  auto result = memory.trials.evaluate(evaluator, genomes, stop, {seed, varies ? drawn : 0},
                                       problem.scenarios(seed, drawn, on.get()), on);
  if (!result) return std::nullopt;
  EvaluatedGeneration evaluated{.result = std::move(*result), .objectives = {}};
  evaluated.objectives = objectives(problem, evaluated.result);
  if (settings.finalists > 0.0 && problem.trials_vary() && !genomes.empty()) {
    const auto further = further_scenarios(problem, settings.finalist_episodes, seed, drawn, on.get());
    if (!final_round(evaluator, problem, genomes, settings.finalists, further, on, evaluated, stop))
      return std::nullopt;
  }
  return evaluated;
}

}  // namespace amble::experiment
