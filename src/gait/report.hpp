#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "amble/gait/gait.hpp"
#include "amble/gait/seam.hpp"
#include "amble/gait/travel.hpp"
#include "amble/record/trajectory.hpp"

namespace amble::gait {

/// How footfalls are found (docs/GAIT.md says why these are the defaults).
struct Settings {
  double debounce_s = 0.08;       ///< shorter gaps in a stance, then shorter stances, are chatter
  double transient_s = 2.0;       ///< at the beginning; not counted in anything about footfalls
  double window_s = 5.0;          ///< the gait is classified anew for each window of at least this length
  double longest_stride_s = 5.0;  ///< a longer time between two touch-downs is a rest

  /// Throws UserError(ExitCode::bad_input) unless debounce is in [0, 1] s, transient in [0, 1e6] s, window in
  /// [0.1, 3600] s and the longest stride in (0, 3600] s.
  void validate() const;
};

/// A window is extended up to this many times window_s while a foot that strides has made fewer than
/// min_strides strides in it.
inline constexpr int longest_window = 5;

/// One leg after the transient.
struct LegGait {
  std::string name;
  std::optional<double> contact_share;   ///< of the time on the ground, [0, 1]; none where no time counts
  std::int64_t raw_touchdowns = 0;       ///< rising edges of the sensor itself, in the whole trial
  std::int64_t late_raw_touchdowns = 0;  ///< of these, those after the transient
  std::int64_t touchdowns = 0;
  std::int64_t strides = 0;             ///< from touch-down to touch-down
  std::optional<double> stride_s;       ///< mean; this and the next two need a stride
  std::optional<double> stride_sd_s;    ///< standard deviation
  std::optional<double> duty_factor;    ///< stance / stride
  std::optional<PairPhase> phase;       ///< relative to the reference leg
  std::optional<double> drift_strides;  ///< of that phase, first window to last; needs three windows
  std::optional<double> drift_per_min;  ///< slope of the regression line through the windows' phases
};

/// A part of the trial: one window of the measurement, or 2, 4, 8, … of them merged in a long trial.
struct Window {
  double start_s = 0.0, end_s = 0.0;
  std::optional<Classification> classification;     ///< the one that lasted longest; as in Report
  double speed_m_s = 0.0;                           ///< along the straight line from its start to its end
  std::vector<std::optional<double>> duty_factors;  ///< by leg, as in LegGait
  std::vector<std::optional<PairPhase>> phases;     ///< by leg
};

/// All measurements of one trial. docs/GAIT.md defines them, docs/FORMATS.md names them in JSON.
struct Report {
  std::string robot;
  record::Outcome outcome = record::Outcome::completed;
  double seconds = 0.0;
  Settings settings;

  // After the transient.
  std::optional<Classification> classification;  ///< none for legs whose gaits have no names
  std::optional<QuadrupedPhases> quadruped;      ///< one of these three, if gaits have names
  std::optional<HexapodPhases> hexapod;
  std::optional<BipedPhases> biped;
  std::vector<double> gait_seconds;   ///< by Gait: how long each lasted, window by window; empty as above
  std::optional<double> duty_factor;  ///< mean over the legs that stride; above 0.5 walking, below running
  std::optional<double> stride_s;     ///< mean over those legs
  int reference_leg = -1;             ///< its touch-downs are phase 0; −1: no leg strides
  std::vector<LegGait> legs;
  std::vector<Window> windows;

  // What follows is of the whole trial, the transient included.
  double distance_m = 0.0;             ///< of the centre of mass over the ground from start to end
  double path_m = 0.0;                 ///< along its path, measured from second to second
  double speed_m_s = 0.0;              ///< distance / time
  std::optional<double> straightness;  ///< distance / path, [0, 1]
  double path_speed_m_s = 0.0;
  double leg_length_m = 0.0;
  std::optional<double> froude;  ///< path speed² / (g × leg length)
  double mass_kg = 0.0;
  std::optional<MotorWork> work;                     ///< none if torques are not known
  std::optional<double> cost_of_transport_positive;  ///< work / (mass × g × path)
  std::optional<double> cost_of_transport_absolute;
  std::optional<SeamReport> seam;  ///< of recordings of controllers with timers
};

/// A time during which all windows have the same classification.
struct Segment {
  double start_s = 0.0, end_s = 0.0;
  Classification classification;
};

/// The windows' classifications in order, equal neighbours joined: where the gait changes. Empty where
/// gaits have no names.
std::vector<Segment> segments_of(const Report& report);

}  // namespace amble::gait
