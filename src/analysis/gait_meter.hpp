#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "amble/analysis/circular.hpp"
#include "amble/analysis/contact_filter.hpp"
#include "amble/analysis/gait.hpp"
#include "amble/analysis/gait_body.hpp"
#include "amble/analysis/gait_windows.hpp"
#include "amble/analysis/strides.hpp"
#include "amble/analysis/travel.hpp"
#include "amble/core/math.hpp"

namespace amble::analysis {

/// State of a robot after a step.
struct GaitFrame {
  Vec3 com_m;                        ///< of the whole robot, in the world
  std::span<const float> touch;      ///< by leg: over 0.5 while the foot touches
  std::span<const float> angle_rad;  ///< by joint
  std::span<const float> torque_nm;  ///< by joint: what the motor gave in the step; empty: not known
};

/// Follows a trial frame by frame and measures its gait. Memory does not grow with the trial.
class GaitMeter {
 public:
  /// `frame_s`: time between frames. Throws UserError for settings out of range.
  GaitMeter(const GaitBody& body, double frame_s, const GaitSettings& settings);

  void add(const GaitFrame& frame);
  /// What was seen. No frames may follow.
  GaitReport finish(record::Outcome outcome);

 private:
  Stretch stretch_from_here() const;
  void settle(const std::vector<bool>& touch);
  bool window_is_full() const;
  void book(Stretch window);

  std::optional<QuadrupedPhases> quadruped_phases(const StrideSums& sums) const;
  std::optional<Verdict> verdict(const StrideSums& sums) const;
  int reference_leg() const;
  LegGait leg_gait(std::size_t leg, int reference) const;
  GaitWindow window(const Stretch& stretch, int reference) const;
  void report_footfalls(GaitReport& report) const;
  void report_travel(GaitReport& report) const;

  GaitBody body_;
  double frame_s_;
  GaitSettings settings_;
  std::int64_t transient_frames_, window_frames_;

  TravelMeter travel_;
  std::vector<bool> raw_touch_;
  std::vector<std::int64_t> raw_touchdowns_;

  // What follows lags behind by the time that touches need to settle.
  std::vector<ContactFilter> filters_;
  std::deque<Vec3> unsettled_com_m_;
  Vec3 com_m_;
  std::int64_t frames_ = 0;
  StrideTracker tracker_;
  StrideSums total_;
  Stretch open_;                 ///< the window in progress
  std::optional<Stretch> last_;  ///< the one before it
  GaitWindows windows_;
  std::vector<std::vector<PhaseDrift>> drifts_;  ///< of the windows' mean phases, as StrideSums::phases
};

}  // namespace amble::analysis
