#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/plan/typical_level.hpp"
#include "amble/score/typical.hpp"

namespace amble::experiment {

/// Trials that tell it where commands do: 64, or 16 in an engine that has one lane.
int reported_trials(std::string_view engine);

/// The [noise] of a config. Throws UserError if it is none.
TypicalLevel level_of_config(const std::filesystem::path& config);

/// Runs trials that neither evolution, nor the choice of champions, nor unseen_scenarios() has: the same for
/// all genomes of a run. They are as new to a champion as its next trial will be.
class TypicalTrials {
 public:
  /// `trials` ≥ 1, of the problem's length and in its engine.
  TypicalTrials(const Problem& problem, std::int64_t seed, int trials, TypicalLevel level, int jobs = 1);
  /// `level`: as typical_level() takes it. Throws UserError.
  TypicalTrials(const Problem& problem, std::int64_t seed, int trials, const std::string& level = {},
                int jobs = 1)
      : TypicalTrials(problem, seed, trials, typical_level(problem, level), jobs) {}

  const TypicalLevel& level() const { return level_; }
  /// The problem with the noise of these trials: their scenarios are those of
  /// episode_key(EpisodeSet::typical, seed) and the episodes after it.
  const Problem& problem() const { return *problem_; }
  /// All trials of one genome. Nothing if `stop` was set meanwhile.
  std::optional<std::vector<TrialResult>> run(const neat::Genome& genome, const std::atomic<bool>& stop);

 private:
  TypicalLevel level_;
  std::unique_ptr<const Problem> problem_;
  std::shared_ptr<const ground::Ground> ground_;
  std::int64_t seed_;
  std::size_t trials_;
  std::vector<trial::Scenario> scenarios_;  ///< drawn by the first run()
  std::unique_ptr<Evaluator> evaluator_;
};

/// The trial that shows what is typical: that of the median distance; of an even number the lower one of the
/// two in the middle.
struct MedianTrial {
  Problem problem;          ///< with the noise of the trials
  trial::ScenarioKey key;   ///< of this one, for ReplayOptions::noise
  score::Typical distance;  ///< of all trials, m
  std::string under;        ///< TypicalLevel::under()
};
/// Nothing if `stop` was set meanwhile.
std::optional<MedianTrial> median_trial(TypicalTrials& trials, const neat::Genome& genome, std::int64_t seed,
                                        const std::atomic<bool>& stop);

/// "typically 3.12 m in 15 s: half of 64 trials under its own noise 2.40 to 3.80 m, 3 % fell (luckiest 5.10
/// m)". `score`: what the values are.
std::string typical_text(const score::Typical& typical, const score::Settings& score, double seconds,
                         const std::string& under);

}  // namespace amble::experiment
