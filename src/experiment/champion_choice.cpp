#include "amble/experiment/champion_choice.hpp"

#include <span>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/episodes.hpp"

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

}  // namespace amble::experiment
