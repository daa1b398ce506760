#pragma once

#include <memory>
#include <string_view>

#include "amble/damage/settings.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics {

/// An engine for a robot that is damaged or becomes so (docs/DAMAGE.md). Joints, legs and targets are those
/// of `robot`, which is intact: joints that are missing are at angle 0 without torque, missing legs touch
/// nothing. Without damage of the body it is make_engine() of the robot.
///
/// There is an engine of that name for each stage of the damage (damage::stages_of); a lane moves from one to
/// the next, poses and velocities being kept, at the beginning of the stage's first step. So the result of a
/// lane depends on its own targets alone, as in all engines. Numb feet are left to trial::Runner.
///
/// A joint that is locked from the start begins at its angle, and the robot is lifted by what of it would
/// otherwise be lower than in the pose that it is placed in.
std::unique_ptr<Engine> make_damaged_engine(std::string_view name, const robot::RobotSpec& robot,
                                            const damage::Settings& damage, const EngineSettings& settings);

}  // namespace amble::physics
