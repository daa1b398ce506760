#pragma once

#include <optional>

#include "amble/record/trajectory.hpp"
#include "amble/score/score.hpp"

namespace amble::score {

/// A direction over the ground, of unit length.
struct Direction {
  double x = 1.0, y = 0.0;
};

inline double along(Direction direction, double x_m, double y_m) {
  return x_m * direction.x + y_m * direction.y;
}

/// Cosine and sine of an angle, degrees; exact for multiples of 90. The same on every CPU.
Direction unit_direction(double angle_deg);
/// The robot's forward axis at the start, turned counter-clockwise.
Direction turned(const record::Trajectory& trajectory, double angle_deg);
/// Angle of a direction to the x axis, −180 … 180 degrees. The same on every CPU.
double angle_deg(Direction direction);

}  // namespace amble::score

/// How well a robot does what it is told (trial::CommandSettings), second by second: a second is about a
/// stride, so that the sway within strides is not taken for an error.
///
/// In second k the robot moved by Δ and turned by δ; its forward axis in the middle of the second, f, is that
/// of the start turned by the mean of how far it had turned before and after. Commanded were, on average, the
/// speed v and the turn w. Seconds that a trial does not complete are left out, but for `tracking`.
namespace amble::score {

inline constexpr record::Measures tracking_measures{.seconds = true, .headings = true, .commands = true};

inline constexpr record::Measures own_speed_measures{.seconds = true, .headings = true};

/// Mean of Δ f / 1 s, m/s: how fast it walks along its own forward axis; 0 without seconds.
double own_speed(const record::Trajectory& trajectory, const Context& context);
/// Turned from start to end by the trial's length, rad/s, to the left; 0 for a trial of no steps.
double yaw_rate(const record::Trajectory& trajectory, const Context& context);
/// Mean of |Δ / 1 s − v f|, m/s: moving sideways is an error, too. Without commands v = 0; 0 without seconds.
double speed_error(const record::Trajectory& trajectory, const Context& context);
/// Mean of |δ / 1 s − w|, rad/s.
double turn_error(const record::Trajectory& trajectory, const Context& context);
/// Mean of |turned − Σ w × 1 s| after each second, rad.
double heading_error(const record::Trajectory& trajectory, const Context& context);
/// 0 … 1. With a = max(0, 1 − |Δ / 1 s − v f| / max(|v|, v₀)), b = max(0, 1 − |δ / 1 s − w| / max(|w|, w₀))
/// (v₀, w₀: TrackingSettings) and m = (a + b)/2, a second in which something is commanded counts
/// max(0, (m − s)/(1 − s)), s being the m of a robot that stands still, so 0. A second in which a stop is
/// commanded counts m times the mean of all others (without others, of a trial that completes, 1). The mean
/// over the whole seconds of a trial that completes; those that a fall cuts off count 0. A trial of less than
/// a second counts 0.
double tracking(const record::Trajectory& trajectory, const Context& context);

/// A second in which both errors are at most these follows its command.
inline constexpr double followed_speed_m_s = 0.1, followed_turn_rad_s = 0.2;

/// Mean over the changes of command, s, of the whole seconds from a change to the first second that follows;
/// one that none follows until the next change, or the end of the trial, counts all of them. Seconds that a
/// fall cuts off count as well, and so do the commands that would have come in them. The start is a change
/// unless a stop is commanded; seconds of a ramp are one until one of them follows. Nothing without a change.
std::optional<double> switch_s(const record::Trajectory& trajectory, const Context& context);

}  // namespace amble::score
