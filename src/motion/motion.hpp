#pragma once

#include <array>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/record/trajectory.hpp"
#include "amble/robot/pose.hpp"

/// A recording in memory: what a robot did in one trial, and the controller that drove it.
///
/// - recorded_trial.hpp: a recording file → robot, motion and controller (the patterns of a SUPG, or neurons
/// and
///   links); start here
/// - motion.hpp: frames of root, joints, centre of mass, contacts, timers; distance and speed
/// - footfalls.hpp: when feet touched and triggered, by the raw sensors (amble::gait debounces)
namespace amble::motion {

/// What a robot did in one trial, in the world frame (docs/CONVENTIONS.md). Frame k is the state after step
/// k + 1, so its time is (k + 1) × frame_s.
struct Motion {
  double frame_s = 0.0;
  record::Outcome outcome = record::Outcome::completed;
  Vec3 com_start_m;                 ///< whole-body centre of mass before the first step
  std::vector<Vec3> root_m;         ///< origin of the root body
  std::vector<Quat> root_rotation;  ///< from its frame to the world frame
  std::vector<Vec3> com_m;
  std::vector<std::vector<float>> angle_rad;  ///< [joint][frame]
  std::vector<std::vector<bool>> touch;       ///< [leg][frame]
  /// [leg][frame]; empty if the controller has no timers. Ticks, −1 while stopped.
  std::vector<std::vector<float>> timer_ticks;
  /// [leg][frame]; empty if the controller has none. Set in the frame whose step began with a trigger, which
  /// is the one after the frame in which the foot was first seen touching.
  std::vector<std::vector<bool>> trigger;

  /// What it was told in the step that led to the frame, speed (m/s) and turn to the left (rad/s); empty if
  /// nothing.
  std::vector<std::array<float, 2>> command;

  int frames() const { return static_cast<int>(root_m.size()); }
  double seconds() const { return frames() * frame_s; }
  double time_s(int frame) const { return (frame + 1) * frame_s; }
};

/// World poses of all bodies in one frame.
std::vector<robot::Pose> body_poses(const robot::RobotSpec& robot, const Motion& motion, int frame);

/// Where the commands lead, over the ground: from the start of its centre of mass, along its forward axis in
/// the first frame, frame by frame; empty without commands. At the height of the start.
std::vector<Vec3> commanded_path_m(const robot::RobotSpec& robot, const Motion& motion);

/// The headline numbers of a recording.
struct Summary {
  double distance_m = 0.0;  ///< of the whole-body centre of mass from its start, over the ground
  double seconds = 0.0;     ///< until the time was up or the robot fell
  double mean_speed_m_s = 0.0;
  record::Outcome outcome = record::Outcome::completed;
  std::vector<int> triggers;  ///< per leg; empty without triggers
};

Summary summarise(const Motion& motion);

}  // namespace amble::motion
