#pragma once

#include <optional>
#include <vector>

#include "amble/analysis/motion.hpp"

namespace amble::analysis {

/// A time during which a foot touched the ground.
struct Stance {
  double start_s = 0.0, end_s = 0.0;

  friend bool operator==(const Stance&, const Stance&) = default;
};

/// Stances of one foot from its touch sensor, frame by frame. One that holds in the first frame began at time
/// zero.
std::vector<Stance> stances(const std::vector<bool>& touch, double frame_s);

/// Share of the frames in which the foot touched, in [0, 1].
double contact_share(const std::vector<bool>& touch);

/// The frames in which a foot came down: touching, and not in the frame before. The first frame is none of
/// them.
std::vector<int> touchdown_frames(const std::vector<bool>& touch);

/// When the triggers came, s: at the beginning of the step that they influenced. Of triggers step after step,
/// which a foot gives that triggers as long as it stands, only the first.
std::vector<double> trigger_times_s(const std::vector<bool>& trigger, double frame_s);

/// How far one leg's timer had come when each trigger reset it: ticks, or nothing if it had stopped. A
/// trigger in the first frame has no earlier timer and is left out.
std::vector<std::optional<double>> timer_at_triggers(const std::vector<bool>& trigger,
                                                     const std::vector<float>& timer_ticks);

}  // namespace amble::analysis
