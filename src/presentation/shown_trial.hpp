#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/typical.hpp"

namespace amble::presentation {

/// TrialChoice::trials at most.
inline constexpr int most_typical_trials = 100000;

/// Which trial of a champion is measured or shown.
struct TrialChoice {
  std::string level;                                ///< as experiment::typical_level() takes it
  std::optional<std::filesystem::path> noise = {};  ///< a config whose [noise] disturbs, in place of a level
  int trials = 0;                                   ///< 0: experiment::reported_trials()
  bool undisturbed = false;                         ///< the one trial without noise instead

  /// Whether a level, a noise or a number of trials was asked for.
  bool asked() const { return !level.empty() || noise || trials > 0; }
};

/// What disturbs the trials. Throws UserError.
experiment::TypicalLevel level_of(const experiment::Problem& problem, const TrialChoice& choice);

/// Trials of `problem`, a champion's or one made of it, by `jobs` workers. Throws UserError.
experiment::TypicalTrials typical_trials(const experiment::Problem& problem, std::int64_t seed,
                                         const TrialChoice& choice, int jobs);

/// The trial that is shown of a champion: without noise if it was evolved without, or if asked for; else the
/// median of several.
struct ShownTrial {
  trial::NoiseSettings noise;             ///< under which `key` is
  std::optional<trial::ScenarioKey> key;  ///< for ReplayOptions::noise; nothing: the trial without noise
  std::string typical;  ///< experiment::typical_text(); empty if `undisturbed` was asked for

  const char* which() const { return key ? "its median trial" : "its trial without noise"; }
};
/// `seconds` and `engine`: as in experiment::ReplayOptions. Nothing if `stop` was set meanwhile. Throws
/// UserError.
std::optional<ShownTrial> shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                      const std::optional<std::string>& engine, const TrialChoice& choice,
                                      int jobs, const std::atomic<bool>& stop);

}  // namespace amble::presentation
