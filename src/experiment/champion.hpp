#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
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
  std::optional<double> score = {};  ///< by Problem::score; nothing where that is the distance
  int steps = 0;
  double seconds = 0.0;
  record::Outcome outcome = record::Outcome::completed;

  double value() const { return score.value_or(distance_m); }
};
TrialResult summarise(const Problem& problem, const record::Trajectory& trajectory);

/// One of the trials under noise that made a genome a champion.
struct NoisyTrial {
  TrialResult result;
  std::vector<std::uint32_t> trace;
};

/// What a champion's genome came to in another engine than its own, without noise.
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
  TrialResult result;                   ///< of its trial without noise
  std::vector<std::uint32_t> trace;     ///< trial::TraceObserver of that trial: one hash per step
  std::vector<NoisyTrial> episodes;     ///< Problem::noise; empty if there is none
  std::vector<Refereed> referees = {};  ///< in the order of Config::referees; empty if there are none

  /// Names the noise of an episode that made it a champion.
  trial::ScenarioKey scenario_key(std::size_t episode) const;
  /// Names noise that it has not met.
  trial::ScenarioKey unmet_scenario_key(std::size_t episode) const;
  /// By what it became the champion: what its episodes make of it, or its score without noise.
  double objective() const;
};

/// Share of a distance that is kept elsewhere; nothing if there was none to keep.
std::optional<double> share_kept(double distance_m, double of_m);

/// What a champion file says of how to try it again, but for the noise.
io::Json problem_json(const Problem& problem);

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
