#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/champion.hpp"

namespace amble::experiment {

struct RefereeOptions {
  std::optional<double> seconds = {};  ///< length of the trials; nothing: as in the problem
  int jobs = 1;                        ///< at least 1; more: the engines work side by side
  /// One trial under the problem's noise for each of these; none: one trial without noise.
  std::vector<trial::ScenarioKey> noise = {};
};

/// What one genome came to in one engine.
struct Judgement {
  std::string engine;
  std::vector<TrialResult> trials;  ///< at least one, in the order of RefereeOptions::noise

  /// The trial itself if there is one; else the median of all.
  double distance_m() const;
};

/// Tries a genome in each of the engines. Nothing if `stop` was set before all were done.
/// Throws UserError for an engine that is unknown or cannot simulate the robot.
std::optional<std::vector<Judgement>> judge(const Problem& problem, const neat::Genome& genome,
                                            const std::vector<std::string>& engines,
                                            const RefereeOptions& options, const std::atomic<bool>& stop);

/// The same without noise, as champion files keep it.
std::optional<std::vector<Refereed>> ask_referees(const Problem& problem, const neat::Genome& genome,
                                                  const std::vector<std::string>& engines, int jobs,
                                                  const std::atomic<bool>& stop);

}  // namespace amble::experiment
