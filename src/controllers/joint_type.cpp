#include "amble/controllers/joint_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {

std::size_t joint_type_index(const robot::RobotSpec& robot, std::string_view type, const std::string& key,
                             std::string_view said) {
  const auto found = std::ranges::find(robot.joint_types, type);
  if (found == robot.joint_types.end())
    fail_setting({key}, "{} = \"{}\": the robot has no joint type {}; expected {}", key, said, type,
                 fmt::join(robot.joint_types, ", "));
  return to_index(found - robot.joint_types.begin());
}

}  // namespace amble::controllers
