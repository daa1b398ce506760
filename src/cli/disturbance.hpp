#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/typical.hpp"

namespace amble::cli {

/// Which trials of champions a command measures or shows.
struct DisturbanceOptions {
  std::string level;         ///< as in experiment::TypicalTrials
  int trials = 0;            ///< 0: experiment::reported_trials()
  bool undisturbed = false;  ///< the one trial without noise instead

  /// Whether `--level` or `--trials` was given.
  bool asked() const { return !level.empty() || trials > 0; }
};

/// Adds --level, --trials and --undisturbed.
void add_disturbance(CLI::App& command, DisturbanceOptions& options);

/// Trials of this champion's problem by the options, on all processors.
experiment::TypicalTrials typical_trials(const experiment::Champion& champion,
                                         const experiment::Problem& problem,
                                         const DisturbanceOptions& options);

/// The trial that a command shows of a champion: without noise if it was evolved without, or if asked for;
/// else the median of several.
struct ShownTrial {
  trial::NoiseSettings noise;             ///< under which `key` is
  std::optional<trial::ScenarioKey> key;  ///< for ReplayOptions::noise; nothing: the trial without noise
  std::string typical;                    ///< experiment::typical_text() of all of them; empty without
};
/// `seconds` and `engine`: as in ReplayOptions.
ShownTrial shown_trial(const experiment::Champion& champion, std::optional<double> seconds,
                       const std::optional<std::string>& engine, const DisturbanceOptions& options);

/// As many as the machine has, at least 1.
int processors();

}  // namespace amble::cli
