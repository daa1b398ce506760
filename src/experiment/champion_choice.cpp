#include "amble/experiment/champion_choice.hpp"

#include <fmt/format.h>
#include <span>
#include <utility>

#include "amble/core/clock.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/champion.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/experiment/referees.hpp"
#include "amble/experiment/replay.hpp"

namespace amble::experiment {

ChampionChoice::ChampionChoice(const Config& config, const Problem& problem, const RunPaths& paths)
    : problem_(problem), paths_(&paths) {
  problem_.noise.score = config.champion.episode_score(problem.noise.score);
  const int episodes = config.champion.episodes;
  if (episodes == 0) return;
  trial::ScenarioKey key = episode_key(EpisodeSet::deciding, config.seed);
  ground_ = problem_.make_ground(ground_of(key));
  for (int i = 0; i < episodes; ++i, ++key.episode)
    scenarios_.push_back(problem_.scenario(key, ground_.get()));
  constexpr int one_worker = 1;  // all episodes of one genome are in one block of lanes
  evaluator_ = std::make_unique<Evaluator>(problem_, record::PathSampling(), one_worker);
}

std::optional<double> ChampionChoice::judged(const neat::Genome& genome, const std::atomic<bool>& stop) {
  if (last_ && last_->first == genome) return last_->second;
  const auto result = evaluator_->evaluate(std::span(&genome, 1), stop, scenarios_, ground_);
  if (!result) return std::nullopt;
  last_.emplace(genome, objectives(problem_, *result).front());
  return last_->second;
}

std::optional<bool> ChampionChoice::prefers(const neat::Genome& genome, double objective,
                                            const Progress& progress, const std::atomic<bool>& stop) {
  if (evaluator_ == nullptr) return objective > progress.best;
  if (!champion_ && progress.best_generation >= 0) {
    champion_ = judged(load_champion(paths_->champion(progress.best_generation)).genome, stop);
    if (!champion_) return std::nullopt;
  }
  const auto candidate = judged(genome, stop);
  if (!candidate) return std::nullopt;
  if (champion_ && *candidate <= *champion_) return false;
  champion_ = candidate;
  return true;
}

namespace {

/// The trials of evolution's own engine; false if `stop` was set.
bool try_at_home(Champion& champion, StageTimes& times, const std::atomic<bool>& stop) {
  const Problem& problem = champion.problem;
  const auto undisturbed = replay(problem, champion.genome, {}, stop);
  if (!undisturbed) return false;
  champion.result = undisturbed->result;
  champion.trace = undisturbed->trace;
  times.physics_s += undisturbed->physics_s;
  if (!problem.trials_vary()) return true;
  for (std::size_t i = 0; i < to_index(problem.noise.episodes); ++i) {
    const auto again = replay(problem, champion.genome, {.noise = champion.scenario_key(i)}, stop);
    if (!again) return false;
    champion.episodes.push_back({again->result, again->trace});
    times.physics_s += again->physics_s;
  }
  return true;
}

}  // namespace

std::optional<Champion> try_champion(const Config& config, const Problem& problem, const NewBest& best,
                                     int jobs, StageTimes& times, const std::atomic<bool>& stop) {
  Champion champion{.experiment = config.name,
                    .seed = config.seed,
                    .generation = best.generation,
                    .index = best.index,
                    .problem = problem,
                    .genome = best.genome,
                    .result = {},
                    .trace = {},
                    .episodes = {},
                    .draw = config.evaluation.draw};
  champion.problem.noise.episodes = config.evaluation.episodes_of_best(problem.noise.episodes);
  champion.problem.ground_key = champion.ground_key();
  if (!try_at_home(champion, times, stop)) return std::nullopt;
  if (best.objective && champion.objective() != *best.objective)
    fail(ExitCode::differs,
         "generation {}: the champion reached {}, and {} when run again: the engine does not repeat",
         best.generation, score::with_unit(fmt::format("{}", *best.objective), config.score),
         score::with_unit(fmt::format("{}", champion.objective()), config.score));
  if (!config.referees.empty()) {
    const Stopwatch watch(times.referees_s);
    auto judged = run_referees(champion.problem, champion.genome, config.referees, jobs, stop);
    if (!judged) return std::nullopt;
    champion.referees = std::move(*judged);
  }
  return champion;
}

}  // namespace amble::experiment
