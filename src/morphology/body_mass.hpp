#pragma once

#include <span>
#include <vector>

#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

struct mjModel_;

namespace amble::morphology {

/// Sets mass, centre and principal moments of a rigid body that consists of these bodies of the model (at
/// least one); `pose_in_group`: the pose of each of the model's bodies in the rigid body's frame.
void set_mass(const mjModel_& model, const std::vector<int>& members,
              std::span<const robot::Pose> pose_in_group, robot::Body& body);

}  // namespace amble::morphology
