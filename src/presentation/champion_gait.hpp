#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "amble/experiment/champion.hpp"
#include "amble/gait/report.hpp"
#include "amble/presentation/shown_trial.hpp"

namespace amble::presentation {

/// The gait of a champion in the trial that is shown of it (shown_trial()).
struct ChampionGait {
  ShownTrial shown;
  gait::Report report;
};

/// Lets it walk. `origin`: what a message calls it; `seconds` and `engine` as in experiment::ReplayOptions.
/// Nothing if `stop` was set meanwhile. Throws UserError.
std::optional<ChampionGait> champion_gait(const experiment::Champion& champion, const std::string& origin,
                                          std::optional<double> seconds,
                                          const std::optional<std::string>& engine,
                                          const gait::Settings& settings, const TrialChoice& choice, int jobs,
                                          const std::atomic<bool>& stop);

}  // namespace amble::presentation
