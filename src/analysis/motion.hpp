#pragma once

#include <vector>

#include "amble/core/math.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/robot/pose.hpp"

namespace amble::analysis {

/// What a robot did in one trial, in the world's frame (docs/CONVENTIONS.md). Frame k is the state after step
/// k + 1, so it belongs to time (k + 1) × frame_s.
struct Motion {
  double frame_s = 0.0;
  record::Outcome outcome = record::Outcome::completed;
  Vec3 com_start_m;                 ///< whole-body centre of mass before the first step
  std::vector<Vec3> root_m;         ///< origin of the root body
  std::vector<Quat> root_rotation;  ///< from its frame to the world's
  std::vector<Vec3> com_m;
  std::vector<std::vector<float>> angle_rad;  ///< joint by joint, each frame by frame
  std::vector<std::vector<bool>> touch;       ///< leg by leg
  /// Leg by leg; empty if the controller has no timers. Ticks, −1 while stopped.
  std::vector<std::vector<float>> timer_ticks;
  /// Leg by leg; empty if the controller has none. Set in the frame whose step began with a trigger, which is
  /// the one after the frame in which the foot was first seen touching.
  std::vector<std::vector<bool>> trigger;

  int frames() const { return static_cast<int>(root_m.size()); }
  double seconds() const { return frames() * frame_s; }
  double time_s(int frame) const { return (frame + 1) * frame_s; }
};

/// Frames of all bodies of the robot that moved so, in one frame.
std::vector<robot::Pose> body_poses(const robot::RobotSpec& robot, const Motion& motion, int frame);

}  // namespace amble::analysis
