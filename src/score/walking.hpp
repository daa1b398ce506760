#pragma once

#include <cstdint>
#include <deque>

#include "amble/core/math.hpp"

namespace amble::score {

/// Standing still is staying within `radius_m` for `window_s`: upright, but slower than radius / window, 2.5
/// cm/s.
struct StandingRule {
  double window_s = 10.0;
  double radius_m = 0.25;
};

/// How long a robot walks: until the beginning of the first window in which its centre of mass, projected on
/// the ground and sampled ten times a second, stays within the radius of where it was at that beginning.
/// Keeps one window in memory, whatever the length of the trial.
class WalkingMeter {
 public:
  /// `frame_s`: time between calls of add(), > 0.
  WalkingMeter(Vec3 start_m, double frame_s, StandingRule rule = {});

  /// The centre of mass after one more frame, world frame.
  void add(Vec3 com_m);
  /// Seconds of walking so far: all of them, unless the robot stood still before. A window that the end of
  /// the trial cuts short does not count as standing.
  double walking_s() const { return stood_ ? stood_at_s_ : frame_s_ * static_cast<double>(frames_); }

 private:
  /// Where a window began.
  struct Anchor {
    Vec3 com_m;
    double time_s = 0.0;
    bool left = false;  ///< the robot has been outside the radius since
  };

  double frame_s_;
  StandingRule rule_;
  std::int64_t sample_frames_;
  std::deque<Anchor> anchors_;
  std::int64_t frames_ = 0;
  bool stood_ = false;
  double stood_at_s_ = 0.0;
};

}  // namespace amble::score
