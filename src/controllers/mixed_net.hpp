#pragma once

#include "amble/controllers/mixed.hpp"

namespace amble::controllers {

/// From a layout of which kind and ports of all links have been checked. `of_legs`: SupgJoints. Throws
/// SettingError for a clock among the sensors, and for a leg that is coupled to itself.
MixedNet make_mixed_net(const substrate::Layout& layout, const std::vector<int>& of_legs, int types,
                        const robot::RobotSpec& robot, const std::vector<SensorModel>& models);

}  // namespace amble::controllers
