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
  double tracking = 0.0;  ///< the quantity of this name, 0 … 1: 1 if commands were followed exactly
  /// @{
  /// Mean error over the trial's whole seconds; nothing for a trial that ended within its first, whose
  /// tracking is 0.
  std::optional<double> speed_error_m_s = {}, turn_error_rad_s = {};
  /// @}
  std::optional<double> switch_s = {};  ///< score::switch_s()
};

/// The result of a trial.
struct TrialResult {
  double distance_m = 0.0;           ///< score::distance_m(): 0 if it diverged
  std::optional<double> score = {};  ///< by Problem::score, at least 0; nothing if that is the distance
  int steps = 0;                     ///< steps simulated
  double seconds = 0.0;              ///< time simulated
  record::Outcome outcome = record::Outcome::completed;  ///< how it ended
  std::optional<Tracking> tracking = {};                 ///< where commands were measured
  double energy_j = 0.0;  ///< work of the motors, where record::Measures::energy was set; else 0
  /// Length of the centre of mass's path from whole second to whole second, without the rest of the last,
  /// where record::Measures::seconds was; else 0.
  double way_m = 0.0;

  /// What it is worth, before trial::Settings::fall_factor: the score, or the distance in its place.
  double value() const { return score.value_or(distance_m); }
};
/// The result of a trial of this problem.
TrialResult summarise(const Problem& problem, const record::Trajectory& trajectory);

/// One of the trials under noise that made a genome a champion.
struct NoisyTrial {
  TrialResult result;                ///< what came of it
  std::vector<std::uint32_t> trace;  ///< trial::TraceObserver: one hash per step
};

/// A trial of a champion in another engine than its own, without noise.
struct RefereeResult {
  std::string engine;  ///< its name
  TrialResult result;  ///< what came of it
};

/// The best genome of a run so far, with all that is needed to run it again: robot, controller, trial,
/// engine. Self-contained.
struct Champion {
  std::string experiment;  ///< Config::name of its run
  std::int64_t seed = 0;   ///< Config::seed of its run
  int generation = 0;      ///< in which it was the best, from 0
  int index = 0;           ///< place among the candidates of its generation, from 0
  Problem problem;         ///< what it walks in; noise.episodes are those of its evaluation
  neat::Genome genome;     ///< valid for `problem`
  /// What came of its trial without noise; in one read from a file without tracking, energy_j and way_m,
  /// which files do not have.
  TrialResult result;
  std::vector<std::uint32_t> trace;  ///< trial::TraceObserver of that trial: one hash per step
  std::vector<NoisyTrial> episodes;  ///< of its evaluation, in order; empty unless Problem::trials_vary()
  std::vector<RefereeResult> referees = {};  ///< in the order of Config::referees; empty if there are none
  Draw draw = Draw::each_generation;         ///< EvaluationSettings::draw

  /// Key of the ground of its generation.
  ground::Key ground_key() const;
  /// Key of the noise of an episode of its evaluation, from 0.
  trial::ScenarioKey scenario_key(std::size_t episode) const;
  /// Key of noise that evolution has not used; `episode` from 0, below 999,000.
  trial::ScenarioKey unseen_scenario_key(std::size_t episode) const;
  /// The objective of its evaluation: that of its episodes, or its score without noise; each times
  /// trial.fall_factor after a fall.
  double objective() const;
};

/// distance_m / of_m, the share of a distance kept in another engine or test; nothing if of_m is not
/// positive.
std::optional<double> share_kept(double distance_m, double of_m);

/// The text of a champion file (docs/FORMATS.md), sealed by a checksum.
std::string champion_text(const Champion& champion);

/// What parse_champion() gives.
struct LoadedChampion {
  Champion champion;     ///< complete: Problem::complete() has been called
  bool altered = false;  ///< the checksum does not match (only where that is accepted)
};

/// What champion_text() wrote. `what` names the file in messages. Throws UserError: (bad_file) foreign,
/// truncated, altered, of another version, an invalid genome, or parts that do not fit together, as an engine
/// or a kind of controller that this program does not have.
LoadedChampion parse_champion(const std::string& text, const std::string& what,
                              io::Altered altered = io::Altered::refuse);
/// The same, altered files always refused, to walk in this engine whatever it was evolved in, and without the
/// robot's own model (RobotSpec::original), which only one engine needs.
Champion parse_champion_for(std::string_view engine, const std::string& text, const std::string& what);

}  // namespace amble::experiment
