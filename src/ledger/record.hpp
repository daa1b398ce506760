#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/json_file.hpp"
#include "amble/record/mutant.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/score/typical.hpp"

namespace amble::ledger {

/// How well a robot did what it was told (score/tracking.hpp).
struct Obeyed {
  std::optional<double> tracking = {};
  /// Nothing for a trial that ended within its first second.
  std::optional<double> speed_error_m_s = {}, turn_error_rad_s = {};
  std::optional<double> switch_s = {};  ///< nothing where the command never changes

  friend bool operator==(const Obeyed&, const Obeyed&) = default;
};

/// What a trial took (TestSpec::energy).
struct Spent {
  double energy_j = 0.0;  ///< Σ |torque × change of angle| over motors and steps
  double way_m = 0.0;     ///< from whole second to whole second
  double weight_n = 0.0;

  friend bool operator==(const Spent&, const Spent&) = default;
};

/// One trial of a champion.
struct EpisodeResult {
  double distance_m = 0.0;
  double seconds = 0.0;    ///< until it ended
  double walking_s = 0.0;  ///< score::WalkingMeter
  record::Outcome outcome = record::Outcome::completed;
  std::optional<Obeyed> obeyed = {};  ///< of a trial with commands
  std::optional<Spent> spent = {};    ///< of a test that measures it
  std::optional<double> score = {};   ///< as in evolution, in its unit, of a test that measures it

  friend bool operator==(const EpisodeResult&, const EpisodeResult&) = default;
};

/// How the targets of a trial pass from cycle to cycle (gait::SeamReport; TestSpec::seam).
struct Seam {
  std::int64_t jumps = 0;    ///< of all legs
  double mean_rad = 0.0;     ///< how far a leg's farthest target goes in one
  double largest_rad = 0.0;  ///< the farthest
  double power_w = 0.0;      ///< of a leg's motors, the mean over 0.1 s after them

  friend bool operator==(const Seam&, const Seam&) = default;
};

/// When a run first had a champion that gets as far as a test asks (TestSpec::reach_m).
struct Reached {
  int generation = 0;
  std::uint64_t evaluations = 0, steps = 0;  ///< up to and with that generation; simulation steps

  friend bool operator==(const Reached&, const Reached&) = default;
};

/// The result of one test.
struct TestResult {
  std::string name;
  std::string settings;  ///< hash of what defines the test: engine, length, noise, episodes
  std::string engine;
  double trial_s = 0.0;                 ///< length of a trial that completes
  std::vector<EpisodeResult> episodes;  ///< at least one
  std::string gait;                     ///< of the first episode (gait/gait.hpp); empty: no name
  double path_interval_s = 0.0;
  std::vector<double> path_m;           ///< first episode: x0, y0, x1, y1, … from the start, rounded to mm
  std::optional<Seam> seam = {};        ///< of the first episode; nothing of controllers without timers
  double reach_m = 0.0;                 ///< TestSpec::reach_m; 0: not looked for
  std::optional<Reached> reached = {};  ///< nothing: not looked for, or no champion of the run gets that far
  double champion_score = 0.0;  ///< mean over the episodes, of which mutants keep shares; 0 without mutants
  std::vector<record::Mutant> mutants = {};  ///< of the champion, to thousandths; TestSpec::mutants

  double distance_m() const;  ///< median of the episodes
  /// Distances of the episodes, m.
  score::Typical typical() const;
  double upright_s() const;  ///< median
  double walking_s() const;  ///< median
  /// Median of the episodes with commands; nothing if there are none.
  std::optional<double> obeyed(std::optional<double> Obeyed::*value) const;
  /// Median of the episodes that were scored; nothing if there are none.
  std::optional<double> score() const;
  /// Energy of all episodes that were measured, by weight and way; infinite for a robot that went nowhere.
  /// Nothing if there are none.
  std::optional<double> cost_of_transport() const;
  /// Time in motion in the first episode, s: windows of 10 s (or of one sample of the path, if that is more)
  /// over which it gets farther than 25 cm, also after pauses; where one ends in each sample, the first
  /// counts whole. Nothing of trials that are shorter than 10 s, which have no window.
  std::optional<double> moving_s() const;
  /// Whether the median episode neither fell nor diverged.
  bool upright() const { return upright_s() >= trial_s * (1.0 - 1e-9); }
};

/// A new best of a run.
struct CurvePoint {
  int generation = 0;
  double best_objective = 0.0;

  friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// Program, machine and times of a record. Not part of its digest.
struct Provenance {
  std::string version, commit, compiler, flags, cpu;
  std::string finished_utc;  ///< ISO 8601
  std::string claims;        ///< StudySpec::claims_hash() at that time; tests added later change none of this
  double evolution_s = 0.0;  ///< wall time of the run, by one worker unless `workers` says otherwise
  double tests_s = 0.0;
  /// Wall time of the evolution up to TestResult::reached, by the name of the test.
  std::map<std::string, double> reached_s = {};
  /// Tests that were run later than the rest, by name: the commit of the program that ran them.
  std::map<std::string, std::string> added_by = {};
  int workers = 1;
};

/// The record of one finished run of a study: enough for its statistics, and to run its champion again.
struct Record {
  std::string study, condition;
  std::int64_t seed = 0;
  std::string config;  ///< hash of all settings and the robot, without the seed
  int generations = 0;
  std::string engine;
  std::uint64_t evaluations = 0, steps = 0;
  double best_objective = 0.0;  ///< objective of the best genome
  int best_generation = 0;
  int hidden = 0, links = 0;  ///< of the champion's CPPN; of all its gaits' where it switches
  /// What a run that fills a map has at its end: coverage, qd_score, map_best, entering_share, and in studies
  /// with `map_trials` corrected_coverage, corrected_qd_score, staying_share (docs/STUDIES.md).
  std::map<std::string, double> map_figures = {};
  /// StudySpec::map_trials of the corrected ones; 0: it has none, or is older than this number.
  int map_trials = 0;
  std::vector<CurvePoint> curve;  ///< ascending; the best so far stays until the next point
  io::Json champion;              ///< a champion file without its traces (docs/FORMATS.md)
  std::string champion_file;      ///< hash of the champion's file in the run folder, traces included
  std::vector<TestResult> tests;
  Provenance provenance;

  const TestResult* find_test(std::string_view name) const;
  /// The best distance after a generation, m; 0 before the first point.
  double best_after(int generation) const;
  /// Hash of all that does not depend on clocks or machines, hexadecimal.
  std::string digest() const;
};

std::string record_text(const Record& record);
/// Throws UserError(ExitCode::bad_file): truncated, altered, of another version.
Record parse_record(const std::string& text, const std::string& what);

}  // namespace amble::ledger
