#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "amble/experiment/problem.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {

/// What a trial came to.
struct TrialResult {
  double distance_m = 0.0;
  int steps = 0;
  double seconds = 0.0;
  record::Outcome outcome = record::Outcome::completed;
};
TrialResult summarise(const record::Trajectory& trajectory);

/// What a champion's genome came to in another engine than its own.
struct Refereed {
  std::string engine;
  TrialResult result;
};

/// A genome worth keeping, with all that is needed to run it again: robot, controller, trial, engine.
/// Self-contained.
struct Champion {
  std::string experiment;  ///< Config::name of its run
  std::int64_t seed = 0;
  int generation = 0;
  int index = 0;  ///< in its population
  Problem problem;
  neat::Genome genome;
  TrialResult result;                ///< of the trial that made it a champion
  std::vector<Refereed> referees;    ///< in the order of Config::referees
  std::vector<std::uint32_t> trace;  ///< trial::TraceObserver of that trial: one hash per step
};

/// The text of a champion file (docs/FORMATS.md).
std::string champion_text(const Champion& champion);

struct LoadedChampion {
  Champion champion;
  bool altered = false;  ///< the checksum did not fit (only where that is accepted)
};

/// Throws UserError: (bad_file) foreign, truncated, altered, of another version, or a genome that is not
/// sound.
LoadedChampion parse_champion(const std::string& text, const std::string& what,
                              io::Altered altered = io::Altered::refuse);
Champion load_champion(const std::filesystem::path& path);

}  // namespace amble::experiment
