#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"
#include "amble/experiment/referees.hpp"
#include "amble/experiment/repertoire.hpp"
#include "amble/io/json_file.hpp"
#include "amble/presentation/shown_trial.hpp"

namespace amble::presentation {

struct NamedChampion {
  std::string name;
  experiment::Champion champion;
};

/// One champion with trials of one length in several engines.
struct ComparedChampion {
  std::string name;
  std::string home;  ///< the engine in which it evolved
  double trial_s = 0.0;
  std::string under;  ///< what disturbs the trials: "at the level milli", "without noise"
  std::vector<experiment::EngineResult> in;  ///< including its home; the same engines in every row

  /// The distance in the engine in which it evolved.
  double home_m() const;
};

/// How champions are compared.
struct CompareOptions {
  std::vector<double> seconds = {};  ///< lengths of trials; none: as in each champion's evolution
  std::vector<std::string> engines =
      {};                        ///< besides the champions' own; none: all that can simulate the robots
  TrialChoice disturbance = {};  ///< `trials` 0: experiment::running_trials, the same in every engine
  /// In place of `disturbance.trials` so many episodes of an evaluation that evolution has not met.
  std::optional<std::uint32_t> episodes = {};
  /// Called after each trial, by one thread at a time, with how many are done and how many there are in all.
  std::function<void(std::size_t done, std::size_t of)> on_trial = {};
};

/// Lets champions walk in several engines: a row per champion and length. The engines of one row run in
/// parallel. Nothing if `stop` was set meanwhile. Throws UserError: unknown engines, or one that
/// cannot simulate the robot.
std::optional<std::vector<ComparedChampion>> compare(const std::vector<NamedChampion>& champions,
                                                     const CompareOptions& options,
                                                     const std::atomic<bool>& stop);

/// An array, one object per row (docs/FORMATS.md); a row of a run with a map has it.
io::Json comparison_json(const std::vector<ComparedChampion>& rows,
                         const std::vector<experiment::ComparedMap>& maps = {});

}  // namespace amble::presentation
