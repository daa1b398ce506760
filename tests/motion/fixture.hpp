#pragma once

#include <string>
#include <vector>

#include "amble/motion/recorded_trial.hpp"
#include "amble/robot/spec.hpp"
#include "tests/core/error_of.hpp"

namespace amble::tests {

/// The JSON of a robot with a trunk 1 m long, 0.4 m wide and 0.2 m high at a height of 1 m, and legs at its
/// corners (more than four: further back). Each has an upper leg of 0.5 m (a capsule) on two hinges and a
/// lower leg of 0.4 m (a box) ending in a foot of radius 0.1 m. Joint types in the order knee, hip_fb,
/// hip_io; in the chain hip_io comes before hip_fb. All of it weighs 1 kg in the trunk and 0.1 kg in each
/// lower leg, at its joint.
std::string robot_json(int legs = 4);
robot::RobotSpec robot(int legs = 4);

/// The JSON of a SUPG controller for that robot: period 10 ticks of 0.1 s; joint j has the target j × 0.01 +
/// tick × 0.001 rad; leg l starts at tick l + 1.
std::string supg_json(int legs = 4);

/// The JSON of a CTRNN: a sensor "foot" at (−1, 0), hidden "inner" at (0, 0.5) and "knee" at (1, 0), with
/// links foot → inner of weight 2 and inner → knee of weight −0.5, of 4 possible ones.
std::string network_json();

/// A walk of `frames` frames of 0.1 s straight along x at 0.5 m/s, standing. Leg l touches in the frames k
/// with (k + l) mod 4 < 2; a trigger follows each touch-down by a frame and sets the timer to 1.
motion::RecordedTrial walk(int frames, int legs = 4);

}  // namespace amble::tests
