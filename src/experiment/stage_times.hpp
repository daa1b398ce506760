#pragma once

#include <array>
#include <string_view>

namespace amble::experiment {

/// Where the wall time of a generation goes, in seconds. What the workers do counts as their mean. What is
/// left over goes to books: trajectories, statistics, the champion's re-run but for its physics.
struct StageTimes {
  double physics_s = 0.0;   ///< in the engine
  double decode_s = 0.0;    ///< from genomes to controllers
  double control_s = 0.0;   ///< controllers, and noise
  double waiting_s = 0.0;   ///< of workers that found no more trials for others that had one
  double judge_s = 0.0;     ///< the search: from behaviours to fitness
  double breed_s = 0.0;     ///< NEAT
  double referees_s = 0.0;  ///< trials of champions in the referees
  double files_s = 0.0;     ///< written and synced
};

struct Stage {
  std::string_view column;  ///< of generations.csv
  double StageTimes::*seconds;
};
inline constexpr std::array<Stage, 8> stages{{
    {"physics_s", &StageTimes::physics_s},
    {"decode_s", &StageTimes::decode_s},
    {"control_s", &StageTimes::control_s},
    {"waiting_s", &StageTimes::waiting_s},
    {"judge_s", &StageTimes::judge_s},
    {"breed_s", &StageTimes::breed_s},
    {"referees_s", &StageTimes::referees_s},
    {"files_s", &StageTimes::files_s},
}};

}  // namespace amble::experiment
