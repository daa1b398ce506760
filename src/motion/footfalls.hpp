#pragma once

#include <optional>
#include <vector>

namespace amble::motion {

/// An interval during which a foot touched the ground.
struct Stance {
  double start_s = 0.0, end_s = 0.0;

  friend bool operator==(const Stance&, const Stance&) = default;
};

/// Stances of one foot from its touch sensor, frame by frame. One that includes the first frame began at time
/// zero.
std::vector<Stance> stances(const std::vector<bool>& touch, double frame_s);

/// Share of the frames in which the foot touched, in [0, 1].
double contact_share(const std::vector<bool>& touch);

/// The frames in which a foot touches and did not in the frame before (record/footfall.hpp); never the first
/// frame.
std::vector<int> touchdown_frames(const std::vector<bool>& touch);

/// Times of triggers, s: at the beginning of the step that they influenced. Of triggers in consecutive steps,
/// which a foot gives that triggers as long as it touches, only the first.
std::vector<double> trigger_times_s(const std::vector<bool>& trigger, double frame_s);

/// One leg's timer just before each trigger reset it: ticks, or none if it had stopped. A trigger in the
/// first frame has no earlier timer and is left out.
std::vector<std::optional<double>> timer_at_triggers(const std::vector<bool>& trigger,
                                                     const std::vector<float>& timer_ticks);

}  // namespace amble::motion
