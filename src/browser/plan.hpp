#pragma once

#include <memory>
#include <string>

#include "amble/experiment/plan/config.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/score/behaviour.hpp"

namespace amble::browser {

/// What a run in pages is: its config, its robot, and what follows from them. Const, shared.
struct Plan {
  /// A JSON object: "config", all keys of experiment::Config; "robot", the text of a robot.json or of a
  /// champion's file; "gravity", how strong it is for the robot, 1 as in its file; "new", whether
  /// what follows from the size of the population is still to be set. Throws UserError.
  explicit Plan(const std::string& json);
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  experiment::Config config;
  robot::RobotSpec robot;  ///< as it is in the run's folder
  experiment::Problem problem;
  std::unique_ptr<const score::Behaviour> behaviour;
};

/// The robot in a robot.json or in a champion's file, without its own model. Throws UserError.
robot::RobotSpec robot_in(const std::string& text);

/// What pages ask of a robot (a text as robot_in() takes it), as JSON: its name, legs, joints, mass, and the
/// times and speeds that fit its size.
std::string robot_facts(const std::string& text);

/// The config, as the JSON of Plan has it.
std::string config_json(const experiment::Config& config);

}  // namespace amble::browser
