#pragma once

#include <array>
#include <string_view>

namespace amble::experiment {

/// Wall time of a generation by stage, in seconds; of stages of workers, the mean. The rest is overhead:
/// trajectories, statistics, the champion's re-run except its physics.
struct StageTimes {
  double physics_s = 0.0;   ///< in the engine
  double decode_s = 0.0;    ///< from genomes to controllers
  double control_s = 0.0;   ///< controllers, and noise
  double waiting_s = 0.0;   ///< of workers without a trial for those that had one
  double search_s = 0.0;    ///< the search: from evaluations to the next candidates
  double referees_s = 0.0;  ///< trials of champions in the referees
  double files_s = 0.0;     ///< written and synced
};

struct Stage {
  std::string_view column;  ///< of generations.csv
  std::string_view name;    ///< as displayed
  double StageTimes::*seconds;
};
inline constexpr std::array<Stage, 7> stages{{
    {"physics_s", "physics", &StageTimes::physics_s},
    {"decode_s", "genomes to controllers", &StageTimes::decode_s},
    {"control_s", "controllers, noise", &StageTimes::control_s},
    {"waiting_s", "waiting for others", &StageTimes::waiting_s},
    {"search_s", "search", &StageTimes::search_s},
    {"referees_s", "referees", &StageTimes::referees_s},
    {"files_s", "files", &StageTimes::files_s},
}};

}  // namespace amble::experiment
