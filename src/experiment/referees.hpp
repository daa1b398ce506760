#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"

namespace amble::experiment {

struct RefereeOptions {
  std::optional<double> seconds = {};  ///< length of the trials; nothing: as in the problem
  int jobs = 1;                        ///< at least 1; more: the engines run in parallel
  /// One trial under the problem's noise for each of these; none: one trial without noise.
  std::vector<trial::ScenarioKey> noise = {};
  /// Called after each trial, by several threads at once if the engines run in parallel.
  std::function<void()> on_trial = {};
};

/// The trials of one genome in one engine.
struct EngineResult {
  std::string engine;
  std::vector<TrialResult> trials;  ///< at least one, in the order of RefereeOptions::noise

  /// The trial itself if there is one; else the median of all.
  double distance_m() const;
};

/// Runs trials of a genome in each of the engines. Nothing if `stop` was set before all were done. Throws
/// UserError for an engine that is unknown or cannot simulate the robot.
std::optional<std::vector<EngineResult>> try_in_engines(const Problem& problem, const neat::Genome& genome,
                                                        const std::vector<std::string>& engines,
                                                        const RefereeOptions& options,
                                                        const std::atomic<bool>& stop);

/// One trial per engine, without noise, as champion files store it.
std::optional<std::vector<RefereeResult>> run_referees(const Problem& problem, const neat::Genome& genome,
                                                       const std::vector<std::string>& engines, int jobs,
                                                       const std::atomic<bool>& stop);

}  // namespace amble::experiment
