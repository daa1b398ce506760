#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/gait/body.hpp"
#include "amble/gait/circular.hpp"
#include "amble/gait/contact_filter.hpp"
#include "amble/gait/report.hpp"
#include "amble/gait/strides.hpp"
#include "amble/gait/travel.hpp"
#include "amble/gait/windows.hpp"

namespace amble::gait {

/// The state of a robot after a step.
struct Frame {
  Vec3 com_m;                        ///< of the whole robot, in the world
  std::span<const float> touch;      ///< by leg: above 0.5 while the foot touches the ground
  std::span<const float> angle_rad;  ///< by joint
  std::span<const float> torque_nm;  ///< by joint: applied by the motor in the step; empty: not known
};

/// Measures the gait of a trial frame by frame. Memory does not grow with the length of the trial.
class Meter {
 public:
  /// `frame_s`: time between frames. Throws UserError for settings out of range.
  Meter(const Body& body, double frame_s, const Settings& settings);

  void add(const Frame& frame);
  /// The measurements. No frames may follow.
  Report finish(record::Outcome outcome);

 private:
  Stretch stretch_from_here() const;
  void add_debounced(const std::vector<bool>& touch);
  bool window_is_full() const;
  void close_window(Stretch window);

  std::optional<QuadrupedPhases> quadruped_phases(const StrideSums& sums) const;
  std::optional<HexapodPhases> hexapod_phases(const StrideSums& sums) const;
  std::optional<BipedPhases> biped_phases(const StrideSums& sums) const;
  std::optional<Classification> classification(const StrideSums& sums) const;
  int reference_leg() const;
  LegGait leg_gait(std::size_t leg, int reference) const;
  Window window(const Stretch& stretch, int reference) const;
  void report_footfalls(Report& report) const;
  void report_travel(Report& report) const;

  Body body_;
  double frame_s_;
  Settings settings_;
  std::int64_t transient_frames_, window_frames_;

  TravelMeter travel_;
  std::vector<bool> raw_touch_;
  std::vector<std::int64_t> raw_touchdowns_;

  // The members below lag behind by the latency of the contact filters.
  std::vector<ContactFilter> filters_;
  std::deque<Vec3> pending_com_m_;
  Vec3 com_m_;
  std::int64_t frames_ = 0;
  StrideTracker tracker_;
  StrideSums total_;
  Stretch open_;                 ///< the window in progress
  std::optional<Stretch> last_;  ///< the one before it
  Windows windows_;
  std::vector<std::vector<PhaseDrift>> drifts_;  ///< of the windows' mean phases, as StrideSums::phases
};

}  // namespace amble::gait
