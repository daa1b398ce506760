#pragma once

#include <memory>

#include "amble/physics/engine.hpp"

namespace amble::physics {

/// Open Dynamics Engine 0.16, dWorldStep: one robot per engine, double precision. Every constraint, contact
/// or joint, has the erp and cfm of RobotSpec::contact. Infinite friction is ODE's mu = infinity; finite
/// friction is a pyramid proportional to the normal force (dContactApprox1), along the world's x and y on the
/// plane, and along ODE's own pair of tangents (dPlaneSpace) elsewhere.
/// Bodies joined by a joint never collide. motors.hpp says what acts in the joints.
std::unique_ptr<Engine> make_ode_engine(const robot::RobotSpec& robot, const EngineSettings& settings);

}  // namespace amble::physics
