#pragma once

#include <memory>

#include "amble/physics/engine.hpp"

namespace amble::physics {

/// MuJoCo 2.2: one robot per engine, double precision, joint angles as coordinates, semi-implicit Euler
/// without substeps, at most 20 iterations of Newton's method to a tolerance of 1e-10, elliptic friction
/// cones. Contacts, stops and velocity servos have the erp and cfm of RobotSpec::contact, as in ODE
/// (mujoco/model.cpp); the torque servo applies its torque for a whole step. A cfm so small that MuJoCo's
/// impedance would exceed 0.9999 is raised to that. Bodies joined by a joint never collide; of more than 512
/// contacts the rest is left out. Healthy means: the speeds of the root and of all joints. Throws UserError
/// for what MuJoCo's compiler refuses.
std::unique_ptr<Engine> make_mujoco_engine(const robot::RobotSpec& robot, const EngineSettings& settings);

}  // namespace amble::physics
