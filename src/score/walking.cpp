#include "amble/score/walking.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/check.hpp"

namespace amble::score {
namespace {

constexpr double sample_s = 0.1;

}  // namespace

WalkingMeter::WalkingMeter(Vec3 start_m, double frame_s, StandingRule rule)
    : frame_s_(frame_s),
      rule_(rule),
      sample_frames_(std::max<std::int64_t>(1, std::llround(sample_s / frame_s))),
      anchors_{{.com_m = start_m}} {
  AMBLE_CHECK(frame_s > 0.0 && rule.window_s > 0.0 && rule.radius_m >= 0.0, "a window of time and space");
}

void WalkingMeter::add(Vec3 com_m) {
  ++frames_;
  if (stood_ || frames_ % sample_frames_ != 0) return;
  const double time_s = frame_s_ * static_cast<double>(frames_);
  for (Anchor& anchor : anchors_)
    anchor.left |= std::hypot(com_m.x - anchor.com_m.x, com_m.y - anchor.com_m.y) > rule_.radius_m;
  // Half a sample of tolerance: times are multiples of the sample only up to rounding.
  while (!anchors_.empty() && time_s - anchors_.front().time_s >= rule_.window_s - 0.5 * sample_s) {
    if (!anchors_.front().left) {
      stood_ = true;
      stood_at_s_ = anchors_.front().time_s;
      return;
    }
    anchors_.pop_front();
  }
  anchors_.push_back({.com_m = com_m, .time_s = time_s});
}

}  // namespace amble::score
