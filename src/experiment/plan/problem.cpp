#include "amble/experiment/problem/problem.hpp"

#include <utility>

#include "amble/core/error.hpp"
#include "amble/experiment/plan/config.hpp"
#include "amble/io/text.hpp"
#include "amble/robot/check.hpp"

namespace amble::experiment {

Problem Problem::make(const Config& config, robot::RobotSpec robot) {
  if (const auto fault = robot::gravity_fault(robot.gravity_m_s2); !fault.empty())
    fail(ExitCode::bad_input, "robot '{}': {}", io::printable(robot.name), fault);
  robot.bodies[0].position_m.z += config.drop_m;
  try {
    robot.gravity_m_s2 = config.ground.tilted(robot.gravity_m_s2);
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
  if (config.ground.friction >= 0.0) robot.contact.friction = config.ground.friction;
  Problem problem{.robot = std::move(robot),
                  .engine = config.engine,
                  .cppn = config.cppn,
                  .controller = config.controller,
                  .trial = config.trial,
                  .noise = config.noise,
                  .score = config.score,
                  .ground = config.ground,
                  .damage = config.damage,
                  .command = config.command,
                  .engine_own = config.engine_own,
                  .architecture = nullptr};
  try {
    problem.complete();
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
  return problem;
}

}  // namespace amble::experiment
