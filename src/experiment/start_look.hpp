#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::experiment {

struct Config;

/// What is odd about a robot before it has a controller: one line each, none for one that simply stands.
/// Mass for its size, where its centres of mass are and its legs point, and what it does in a second on the
/// plane while its servos hold the start pose: whether it diverges, falls, tips over, lies on its trunk,
/// sinks, is thrown up, touches the ground with no foot; without legs it is not held. None of these forbids a
/// run: a biped may fall that will learn to walk. Throws UserError if the engine cannot simulate the robot.
std::vector<std::string> odd_at_start(const robot::RobotSpec& robot, const std::string& engine,
                                      double timestep_s);

/// What may make a run of this config meaningless, a line each: the same, but for gravity that the config's
/// ground tilts, and motors that are too weak. `robot`: on that ground (Problem::robot). Throws UserError.
std::vector<std::string> odd_for_run(const robot::RobotSpec& robot, const Config& config);

/// Those of these that its start pose is to blame for: where its legs point, and what it does while it is
/// held.
std::vector<std::string> odd_pose(const robot::RobotSpec& robot, const std::string& engine,
                                  double timestep_s);

}  // namespace amble::experiment
