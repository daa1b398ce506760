#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/typical.hpp"

namespace amble::presentation {

/// Which trial of a champion is measured or shown.
struct TrialChoice {
  std::string level;         ///< as in experiment::TypicalTrials
  int trials = 0;            ///< 0: experiment::reported_trials()
  bool undisturbed = false;  ///< the one trial without noise instead

  /// Whether a level or a number of trials was asked for.
  bool asked() const { return !level.empty() || trials > 0; }
};

/// Trials of `problem`, a champion's or one made of it, by `jobs` workers. Throws UserError.
experiment::TypicalTrials typical_trials(const experiment::Problem& problem, std::int64_t seed,
                                         const TrialChoice& choice, int jobs);

/// The trial that is shown of a champion: without noise if it was evolved without, or if asked for; else the
/// median of several.
struct ShownTrial {
  trial::NoiseSettings noise;             ///< under which `key` is
  std::optional<trial::ScenarioKey> key;  ///< for ReplayOptions::noise; nothing: the trial without noise
  std::string typical;  ///< experiment::typical_text(); empty if `undisturbed` was asked for
};
/// `seconds` and `engine`: as in experiment::ReplayOptions. Nothing if `stop` was set meanwhile. Throws
/// UserError.
std::optional<ShownTrial> shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                                      const std::optional<std::string>& engine, const TrialChoice& choice,
                                      int jobs, const std::atomic<bool>& stop);

}  // namespace amble::presentation
