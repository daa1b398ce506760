#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/analysis/gait_class.hpp"
#include "amble/analysis/travel.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::analysis {

/// How footfalls are found (docs/GAIT.md says why these are the defaults).
struct GaitSettings {
  double debounce_s = 0.08;  ///< shorter gaps in a stance, then shorter stances, are chatter
  double transient_s = 2.0;  ///< of the beginning, left out of all that is about footfalls
  double window_s = 5.0;     ///< the gait is named anew for each part of the trial that lasts so long …
  double longest_stride_s = 5.0;  ///< a longer time between two touch-downs is a rest

  /// Throws UserError(ExitCode::bad_input) unless 0 ≤ debounce ≤ 1, 0 ≤ transient, 0.1 ≤ window ≤ 3600 and 0
  /// < longest stride.
  void validate() const;
};

/// One leg after the transient.
struct LegGait {
  std::string name;
  double contact_share = 0.0;       ///< of the time on the ground, [0, 1]
  std::int64_t raw_touchdowns = 0;  ///< rising edges of the sensor itself, in the whole trial
  std::int64_t touchdowns = 0;
  std::int64_t strides = 0;             ///< from touch-down to touch-down
  std::optional<double> stride_s;       ///< mean; this and the next two need a stride
  std::optional<double> stride_sd_s;    ///< standard deviation
  std::optional<double> duty_factor;    ///< stance / stride
  std::optional<PairPhase> phase;       ///< after the reference leg
  std::optional<double> drift_strides;  ///< of that phase, first window to last; needs three
  std::optional<double> drift_per_min;  ///< slope of the line that fits the windows' phases best
};

/// … and up to this many times as long while a foot that strides has not made min_strides strides in it.
inline constexpr std::int64_t longest_window = 5;

/// A part of the trial: a window, or 2, 4, 8, … of them in a long trial.
struct GaitWindow {
  double start_s = 0.0, end_s = 0.0;
  std::optional<Verdict> verdict;  ///< what held longest in it; nothing for robots without gait names
  double speed_m_s = 0.0;          ///< along the straight line from its beginning to its end
  std::vector<std::optional<double>> duty_factors;  ///< by leg, as in LegGait
  std::vector<std::optional<PairPhase>> phases;
};

/// All figures of one trial. docs/GAIT.md defines them, docs/FORMATS.md names them in JSON.
struct GaitReport {
  std::string robot;
  record::Outcome outcome = record::Outcome::completed;
  double seconds = 0.0;
  GaitSettings settings;

  std::optional<Verdict> verdict;  ///< of the time after the transient; nothing unless a quadruped
  std::optional<QuadrupedPhases> quadruped;
  std::vector<double> gait_seconds;   ///< by Gait: how long each held, window by window; empty as above
  std::optional<double> duty_factor;  ///< mean over the legs that stride: over 0.5 walks, under 0.5 runs
  std::optional<double> stride_s;     ///< mean over those legs
  int reference_leg = -1;             ///< its touch-downs are phase 0; −1: no leg strides
  std::vector<LegGait> legs;
  std::vector<GaitWindow> windows;

  // Of the whole trial, the transient included.
  double distance_m = 0.0;             ///< of the centre of mass over the ground from start to end
  double path_m = 0.0;                 ///< along its path, measured from second to second
  double speed_m_s = 0.0;              ///< distance / time
  std::optional<double> straightness;  ///< distance / path, [0, 1]
  double path_speed_m_s = 0.0;
  double leg_length_m = 0.0;
  std::optional<double> froude;  ///< path speed² / (g × leg length)
  double mass_kg = 0.0;
  std::optional<MotorWork> work;                     ///< nothing if torques are not known
  std::optional<double> cost_of_transport_positive;  ///< work / (mass × g × path)
  std::optional<double> cost_of_transport_absolute;
};

/// A time during which the windows have one verdict.
struct GaitSegment {
  double start_s = 0.0, end_s = 0.0;
  Verdict verdict;
};
/// The windows' verdicts in order, equal neighbours joined: where the gait changes. Empty for robots without
/// gait names.
std::vector<GaitSegment> gait_segments(const GaitReport& report);

/// How every gait_json() begins.
inline constexpr std::string_view gait_json_start = "{\n  \"format\": \"amble-gait\"";
/// As a JSON document, "format": "amble-gait" (docs/FORMATS.md).
std::string gait_json(const GaitReport& report);
/// As a table of plain text for people.
std::string gait_table(const GaitReport& report);
/// In a few lines: name, stride and duty factor, phases, speed.
std::string gait_summary(const GaitReport& report);

}  // namespace amble::analysis
