#include "amble/experiment/problem/problem_json.hpp"

#include "amble/experiment/problem/implied_settings.hpp"
#include "amble/physics/engine_kinds.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/original_model.hpp"

namespace amble::experiment {

io::Json problem_json(const Problem& problem) {
  io::Json json{{"cppn", io::settings_to_json(problem.cppn)},
                {"controller", io::settings_to_json(problem.controller)},
                {"engine", problem.engine},
                {"trial", io::settings_to_json(problem.trial)},
                {"robot", robot::to_json(problem.robot)},
                {"score", io::settings_to_json(problem.score)},
                {"ground", io::settings_to_json(problem.ground)},
                {"damage", io::settings_to_json(problem.damage)},
                {"command", io::settings_to_json(problem.command)}};
  if (!problem.engine_own.numbers.empty()) json["engine_own"] = problem.engine_own.numbers;
  leave_out_implied(json, problem.score, problem.ground, problem.damage, problem.command);
  return json;
}

Problem problem_from_json(const io::JsonView& root) {
  Problem problem{
      .robot = robot::from_json(root.at("robot")),
      .engine = root.at("engine").text(),
      .cppn = io::settings_from_json<cppn::Settings>(root.at("cppn")),
      .controller = io::settings_from_json<controllers::ControllerSettings>(root.at("controller")),
      .trial = io::settings_from_json<trial::Settings>(root.at("trial")),
      .noise = {},
      .score = {},
      .ground = {},
      .damage = {},
      .architecture = nullptr};
  if (root.has("original_model"))
    problem.robot.original = robot::original_model_from_json(root.at("original_model"), problem.robot);
  if (root.has("noise"))
    problem.noise = io::settings_from_json<trial::NoiseSettings>(root.at("noise").at("settings"));
  if (root.has("score")) problem.score = io::settings_from_json<score::Settings>(root.at("score"));
  if (root.has("ground")) problem.ground = io::settings_from_json<ground::Settings>(root.at("ground"));
  if (root.has("damage")) problem.damage = io::settings_from_json<damage::Settings>(root.at("damage"));
  if (root.has("command"))
    problem.command = io::settings_from_json<trial::CommandSettings>(root.at("command"));
  if (const auto* kind = physics::find_engine(problem.engine); kind != nullptr)
    for (const io::OwnNumber& number : kind->numbers)
      problem.engine_own.numbers[number.name] = root.at("engine_own").at(number.name).finite_number();
  problem.complete();
  return problem;
}

}  // namespace amble::experiment
