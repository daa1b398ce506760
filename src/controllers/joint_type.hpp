#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "amble/robot/spec.hpp"

namespace amble::controllers {

/// Index in robot.joint_types of the type that the setting `key` names; `said` is all of its value. Throws
/// UserError that names both and the robot's types: it has no such type.
std::size_t joint_type_index(const robot::RobotSpec& robot, std::string_view type, const std::string& key,
                             std::string_view said);

}  // namespace amble::controllers
