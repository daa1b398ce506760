#pragma once

#include <functional>
#include <string>
#include <vector>

#include "amble/morphology/model_file.hpp"

namespace amble::morphology {

/// What moves a joint of a model.
enum class Drive {
  motor,  ///< an actuator of its own, or it follows a joint that has one, or the model has no actuators
  held,   ///< nothing that amble has: an actuator of a tendon, or a constraint that fixes its angle
  none,   ///< no actuator, while other joints have some: it moves freely
};

/// How a compiled model is seen as one robot.
struct RobotOfModel {
  std::function<bool(int joint)> has_joint;  ///< whether it is one of the robot's, not fixed nor the root's
  std::function<int(int body)> rigid_body;   ///< the rigid body that a body is part of; −1: not the robot's
};

/// The actuators that make a joint's servo: a position actuator with what dampens the joint beside it
/// (<velocity>), else the first one. Empty: none acts on it.
std::vector<int> servo_actuators(const mjModel_& model, int joint);

/// What moves each of MuJoCo's joints; of those that are not the robot's it means nothing. Adds a note on
/// each actuator, equality constraint and tendon. A coupling of two joints, by an equality constraint or a
/// tendon, is left out: a joint without an actuator that is coupled with one that has gets a motor of its
/// own, as a URDF's mimic joint does. Throws UserError for closed loops, by the names of the constraints.
std::vector<Drive> drives_of(const ModelFile& file, const RobotOfModel& robot, ReadingNotes& notes);

}  // namespace amble::morphology
