#include "amble/experiment/typical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/physics/engine.hpp"
#include "amble/score/score.hpp"

namespace amble::experiment {

int reported_trials(std::string_view engine) {
  return physics::engine_traits(engine).lanes > 1 ? 64 : running_trials;
}

TypicalLevel level_of_config(const std::filesystem::path& config) {
  auto noise = load_config(config, {}).noise;
  if (!noise.any()) fail(ExitCode::bad_input, "--noise: {} is without noise", config.string());
  noise.first_undisturbed = false;
  return {.name = {}, .noise = noise, .from = config.string()};
}

TypicalTrials::TypicalTrials(const Problem& problem, std::int64_t seed, int trials, TypicalLevel level,
                             int jobs)
    : level_(std::move(level)), seed_(seed), trials_(to_index(trials)) {
  AMBLE_CHECK(trials >= 1, "what is typical needs a trial");
  auto disturbed = std::make_unique<Problem>(problem);
  disturbed->noise = level_.noise;
  problem_ = std::move(disturbed);
  ground_ = problem_->make_ground(ground_of(episode_key(EpisodeSet::typical, seed)));
  evaluator_ = std::make_unique<Evaluator>(*problem_, record::PathSampling(), jobs);
}

std::optional<std::vector<TrialResult>> TypicalTrials::run(const neat::Genome& genome,
                                                           const std::atomic<bool>& stop) {
  trial::ScenarioKey key = episode_key(EpisodeSet::typical, seed_);
  for (key.episode += static_cast<std::uint32_t>(scenarios_.size()); scenarios_.size() < trials_;
       ++key.episode) {
    if (stop) return std::nullopt;
    scenarios_.push_back(problem_->scenario(key, ground_.get()));
  }
  const auto result = evaluator_->evaluate(std::span(&genome, 1), stop, scenarios_, ground_);
  if (!result) return std::nullopt;
  std::vector<TrialResult> trials;
  for (const auto& trajectory : result->trajectories) trials.push_back(summarise(*problem_, trajectory));
  return trials;
}

std::optional<MedianTrial> median_trial(TypicalTrials& trials, const neat::Genome& genome, std::int64_t seed,
                                        const std::atomic<bool>& stop) {
  const auto results = trials.run(genome, stop);
  if (!results) return std::nullopt;
  std::vector<std::uint32_t> order(results->size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return (*results)[i].distance_m; });
  trial::ScenarioKey key = episode_key(EpisodeSet::typical, seed);
  key.episode += order[(order.size() - 1) / 2];
  return MedianTrial{.problem = trials.problem(),
                     .key = key,
                     .distance = typical_distance(*results),
                     .under = trials.level().under()};
}

std::string typical_text(const score::Typical& typical, const score::Settings& score, double seconds,
                         const std::string& under) {
  const auto text = [&score](double value) { return score::with_unit(fmt::format("{:.2f}", value), score); };
  if (typical.trials == 1)
    return fmt::format("{} in {:.10g} s, in one trial {}{}", text(typical.median), seconds, under,
                       typical.fell_share > 0.0 ? ", and fell" : "");
  return fmt::format(
      "typically {} in {:.10g} s: half of {} trials {} {:.2f} to {}, {:.0f} % fell (luckiest {})",
      text(typical.median), seconds, typical.trials, under, typical.lower_quartile,
      text(typical.upper_quartile), 100.0 * typical.fell_share, text(typical.best));
}

}  // namespace amble::experiment
