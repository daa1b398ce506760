#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/experiment/problem/evaluation_settings.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/io/file.hpp"
#include "amble/neat/genome.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::experiment {

/// How well commands were followed (docs/SCORES.md).
struct Tracking {
  double tracking = 0.0;
  /// Means over the trial's whole seconds; nothing for a trial that ended within its first, whose tracking is
  /// 0.
  std::optional<double> speed_error_m_s = {}, turn_error_rad_s = {};
};

/// The result of a trial.
struct TrialResult {
  double distance_m = 0.0;
  std::optional<double> score = {};  ///< by Problem::score; nothing if that is the distance
  int steps = 0;
  double seconds = 0.0;
  record::Outcome outcome = record::Outcome::completed;
  std::optional<Tracking> tracking = {};  ///< where commands were measured
  double energy_j = 0.0;                  ///< where record::Measures::energy was
  double way_m = 0.0;  ///< from whole second to whole second, where record::Measures::seconds was

  double value() const { return score.value_or(distance_m); }
};
TrialResult summarise(const Problem& problem, const record::Trajectory& trajectory);

/// One of the trials under noise that made a genome a champion.
struct NoisyTrial {
  TrialResult result;
  std::vector<std::uint32_t> trace;
};

/// A trial of a champion in another engine than its own, without noise.
struct RefereeResult {
  std::string engine;
  TrialResult result;
};

/// The best genome of a run so far, with all that is needed to run it again: robot, controller, trial,
/// engine. Self-contained.
struct Champion {
  std::string experiment;  ///< Config::name of its run
  std::int64_t seed = 0;
  int generation = 0;
  int index = 0;  ///< in its population
  Problem problem;
  neat::Genome genome;
  TrialResult result;                        ///< of its trial without noise
  std::vector<std::uint32_t> trace;          ///< trial::TraceObserver of that trial: one hash per step
  std::vector<NoisyTrial> episodes;          ///< Problem::noise; empty if there is none
  std::vector<RefereeResult> referees = {};  ///< in the order of Config::referees; empty if there are none
  Draw draw = Draw::each_generation;         ///< EvaluationSettings::draw

  /// Key of the ground of its generation.
  ground::Key ground_key() const;
  /// Key of the noise of an episode that made it a champion.
  trial::ScenarioKey scenario_key(std::size_t episode) const;
  /// Key of noise that evolution has not used.
  trial::ScenarioKey unseen_scenario_key(std::size_t episode) const;
  /// The objective that made it the champion: of its episodes, or its score without noise.
  double objective() const;
};

/// distance_m / of_m, the share of a distance kept in another engine or test; nothing if of_m is not
/// positive.
std::optional<double> share_kept(double distance_m, double of_m);

/// The text of a champion file (docs/FORMATS.md).
std::string champion_text(const Champion& champion);

struct LoadedChampion {
  Champion champion;
  bool altered = false;  ///< the checksum does not match (only where that is accepted)
};

/// Throws UserError: (bad_file) foreign, truncated, altered, of another version, or an invalid genome.
LoadedChampion parse_champion(const std::string& text, const std::string& what,
                              io::Altered altered = io::Altered::refuse);
/// The same to walk in this engine whatever it was evolved in, and without the robot's own model
/// (RobotSpec::original), which only one engine needs.
Champion parse_champion_for(std::string_view engine, const std::string& text, const std::string& what);

}  // namespace amble::experiment
