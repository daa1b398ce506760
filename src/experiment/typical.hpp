#pragma once

#include <atomic>
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
#include "amble/score/typical.hpp"

namespace amble::experiment {

/// What stands in place of a level's name for the noise of the run itself.
inline constexpr std::string_view own_noise = "own";

/// Trials that tell what a walker typically does while a run goes on.
inline constexpr int running_trials = 16;
/// The same for what commands say of it: 64, or 16 in an engine that has one lane.
int reported_trials(std::string_view engine);

/// What disturbs a problem's typical trials.
struct TypicalLevel {
  std::string name;  ///< of a record::Level, or `own_noise`; empty: noise from elsewhere
  trial::NoiseSettings noise;
  std::string from = {};  ///< where that noise is from: a config's name

  /// "under its own noise", "at the level milli" or "under the noise of windy.toml".
  std::string under() const;
};
/// `asked`: a level's name, or `own_noise`; empty: own noise where the problem has some, else
/// record::default_level. Throws UserError for an unknown level, and for own noise where there is none.
TypicalLevel typical_level(const Problem& problem, const std::string& asked = {});

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
  std::vector<trial::Scenario> scenarios_;
  std::unique_ptr<Evaluator> evaluator_;
};

/// The typical distance of the trials, m.
score::Typical typical_distance(std::span<const TrialResult> trials);
/// The same of what they count in evolution: the problem's score, with its factor for falls.
score::Typical typical_objective(const Problem& problem, std::span<const TrialResult> trials);

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
