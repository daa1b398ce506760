#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/gait/body.hpp"
#include "amble/gait/circular.hpp"
#include "amble/gait/report.hpp"
#include "amble/gait/strides.hpp"
#include "amble/gait/travel.hpp"
#include "amble/gait/windows.hpp"

namespace amble::gait {

/// Debounces a foot's touch sensor frame by frame: every gap of fewer than `debounce_frames` frames between
/// two touches is closed, then every stance of fewer frames is dropped. The stances that remain keep their
/// first and last frames; only the output is delayed, by lag() frames. With 0 or 1 frames the signal is
/// unchanged.
class ContactFilter {
 public:
  explicit ContactFilter(int debounce_frames);

  /// Takes the next frame's touch; returns the debounced touch of the frame lag() frames earlier, if there is
  /// one.
  std::optional<bool> add(bool touch);
  /// After the last frame: the debounced touch of the last lag() frames (or of all, if there are fewer).
  std::vector<bool> finish() const;
  int lag() const { return static_cast<int>(debounced_.size()) - 1; }

 private:
  std::size_t slot(std::int64_t frame) const;

  int debounce_frames_;
  std::vector<char> debounced_;  ///< of the last lag() + 1 frames, a ring buffer
  std::int64_t frames_ = 0;
  std::int64_t first_ = 0, last_ = 0;  ///< frames of the current stance; meaningless without one
  bool stance_ = false;                ///< there has been a touch
  bool confirmed_ = false;             ///< the current stance is long enough
};

/// The same for a whole signal.
std::vector<bool> debounced(const std::vector<bool>& touch, int debounce_frames);

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
  std::vector<std::int64_t> raw_touchdowns_, late_raw_touchdowns_;

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
