#include "amble/experiment/typical.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/config.hpp"
#include "amble/experiment/episodes.hpp"
#include "amble/physics/engine.hpp"
#include "amble/record/levels.hpp"
#include "amble/score/score.hpp"

namespace amble::experiment {
namespace {

score::Typical typical_of(std::span<const TrialResult> trials, auto value) {
  std::vector<double> values;
  std::vector<record::Outcome> outcomes;
  for (const TrialResult& trial : trials) {
    values.push_back(value(trial));
    outcomes.push_back(trial.outcome);
  }
  return score::typical(values, outcomes);
}

}  // namespace

int reported_trials(std::string_view engine) {
  return physics::engine_traits(engine).lanes > 1 ? 64 : running_trials;
}

TypicalLevel typical_level(const Problem& problem, const std::string& asked) {
  const bool own = asked == own_noise || (asked.empty() && problem.trials_vary());
  if (own && !problem.trials_vary())
    fail(ExitCode::bad_input, "level '{}': it was evolved without noise, and from one place; expected {}",
         asked, record::level_names());
  TypicalLevel found{.name = std::string(own_noise), .noise = problem.noise};
  if (!own) {
    const record::Level* const level = record::find_level(asked.empty() ? record::default_level : asked);
    if (level == nullptr)
      fail(ExitCode::bad_input, "level '{}': expected {} or {}", asked, own_noise, record::level_names());
    found = {.name = std::string(level->name), .noise = trial::noise_of(*level)};
  }
  found.noise.first_undisturbed = false;
  return found;
}

std::string TypicalLevel::under() const {
  if (name.empty()) return "under the noise of " + from;
  return name == own_noise ? "under its own noise" : fmt::format("at the level {}", name);
}

TypicalLevel level_of_config(const std::filesystem::path& config) {
  auto noise = load_config(config, {}).noise;
  if (!noise.any()) fail(ExitCode::bad_input, "--noise: {} is without noise", config.string());
  noise.first_undisturbed = false;
  return {.name = {}, .noise = noise, .from = config.string()};
}

TypicalTrials::TypicalTrials(const Problem& problem, std::int64_t seed, int trials, TypicalLevel level,
                             int jobs)
    : level_(std::move(level)) {
  AMBLE_CHECK(trials >= 1, "what is typical needs a trial");
  auto disturbed = std::make_unique<Problem>(problem);
  disturbed->noise = level_.noise;
  problem_ = std::move(disturbed);
  trial::ScenarioKey key = episode_key(EpisodeSet::typical, seed);
  ground_ = problem_->make_ground(ground_of(key));
  for (int i = 0; i < trials; ++i, ++key.episode)
    scenarios_.push_back(problem_->scenario(key, ground_.get()));
  evaluator_ = std::make_unique<Evaluator>(*problem_, record::PathSampling(), jobs);
}

std::optional<std::vector<TrialResult>> TypicalTrials::run(const neat::Genome& genome,
                                                           const std::atomic<bool>& stop) {
  const auto result = evaluator_->evaluate(std::span(&genome, 1), stop, scenarios_, ground_);
  if (!result) return std::nullopt;
  std::vector<TrialResult> trials;
  for (const auto& trajectory : result->trajectories) trials.push_back(summarise(*problem_, trajectory));
  return trials;
}

score::Typical typical_distance(std::span<const TrialResult> trials) {
  return typical_of(trials, [](const TrialResult& trial) { return trial.distance_m; });
}

score::Typical typical_objective(const Problem& problem, std::span<const TrialResult> trials) {
  return typical_of(trials, [&problem](const TrialResult& trial) {
    return problem.credited(trial.value(), trial.outcome);
  });
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
  return fmt::format("typically {} in {:g} s: half of {} trials {} {:.2f} to {}, {:.0f} % fell (luckiest {})",
                     text(typical.median), seconds, typical.trials, under, typical.lower_quartile,
                     text(typical.upper_quartile), 100.0 * typical.fell_share, text(typical.best));
}

}  // namespace amble::experiment
