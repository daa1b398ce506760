#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/physics/engine.hpp"

namespace amble::physics {

/// The MJCF that the robot was made from (RobotSpec::original), as its author wrote it: solver, integrator,
/// timestep, softness and friction of contacts, actuators with their gains, springs, tendons, all by MuJoCo's
/// own mj_step, as often as its timestep fits into a tick. Targets become the controls of its actuators, or
/// are followed by the robot's servos where it has only motors (mujoco_model/actuation.hpp). The start pose,
/// the rule of falls and the ground are amble's: on the plane the model's own, if it has one, on uneven
/// ground ground::Ground's contacts. A foot touches if a shape of it does that at the beginning of the last
/// of MuJoCo's steps. Throws UserError: a robot without such a model (URDF, or not kept), actuators that no
/// angle can be given to; on uneven ground the integrator RK4.
std::unique_ptr<Engine> make_mujoco_model_engine(const robot::RobotSpec& robot,
                                                 const EngineSettings& settings);

/// What a reader should know of how a robot's RobotSpec::original is simulated, in lines. Throws UserError as
/// the engine does.
std::vector<std::string> original_model_notes(const robot::RobotSpec& robot, double timestep_s);

}  // namespace amble::physics
