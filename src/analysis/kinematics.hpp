#pragma once

#include <span>
#include <vector>

#include "amble/analysis/motion.hpp"
#include "amble/analysis/robot_model.hpp"
#include "amble/core/math.hpp"

namespace amble::analysis {

/// A body's frame in the world.
struct BodyPose {
  Vec3 position_m;
  Quat rotation;  ///< body axes → world axes
};

/// Forward kinematics: where all bodies are, given the root and the joint angles (rad, in the order of
/// RobotModel::joints).
std::vector<BodyPose> body_poses(const RobotModel& robot, const BodyPose& root,
                                 std::span<const double> angles_rad);

/// The same for a frame of a recording.
std::vector<BodyPose> body_poses(const RobotModel& robot, const Motion& motion, int frame);

/// Centre of a geom in the world.
Vec3 geom_centre_m(const Geom& geom, const std::vector<BodyPose>& poses);

/// Height of a geom's lowest point in the world.
double geom_bottom_m(const Geom& geom, const std::vector<BodyPose>& poses);

}  // namespace amble::analysis
