#include "amble/browser/plan.hpp"

#include <utility>

#include "amble/browser/session.hpp"
#include "amble/core/error.hpp"
#include "amble/experiment/plan/size_settings.hpp"
#include "amble/experiment/problem/champion.hpp"
#include "amble/io/json_file.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/legs.hpp"

namespace amble::browser {
namespace {

experiment::Config config_in(const io::JsonView& plan) {
  auto config = io::settings_from_json<experiment::Config>(plan.at("config"));
  if (config.engine != engine)
    fail(ExitCode::bad_input, "engine '{}': in a page robots walk in the engine {}", config.engine, engine);
  if (!config.referees.empty()) fail(ExitCode::bad_input, "referees: in a page there are none");
  if (config.champion.episodes > 0)
    fail(ExitCode::bad_input, "champion.episodes = {}: expected 0 in a page", config.champion.episodes);
  if (config.evaluation.finalists > 0.0)
    fail(ExitCode::bad_input, "evaluation.finalists = {}: expected 0 in a page", config.evaluation.finalists);
  if (config.search.map_elites.tries_candidates_again())  // there WebAssembly could have other bits
    fail(ExitCode::bad_input, "search.map_elites.trials = {}: expected 1 in a page",
         config.search.map_elites.trials);
  if (plan.has("new") && plan.at("new").flag())
    config.neat.speciation.scale_targets(config.neat.population.size);
  config.validate();
  return config;
}

robot::RobotSpec robot_of(const io::JsonView& plan) {
  robot::RobotSpec robot = robot_in(plan.at("robot").text());
  if (plan.has("gravity")) robot.gravity_m_s2 = plan.at("gravity").finite_number() * robot.gravity_m_s2;
  return robot;
}

io::Json parsed(const std::string& json) {
  return io::parse_json(json, "plan");
}

}  // namespace

Plan::Plan(const std::string& json)
    : config(config_in(io::JsonView(parsed(json), "plan"))),
      robot(robot_of(io::JsonView(parsed(json), "plan"))),
      problem(experiment::Problem::make(config, robot)),
      behaviour(config.make_behaviour(&problem.robot)) {
  problem.make_engine();  // throws if it cannot simulate the robot
  problem.check_start();
}

robot::RobotSpec robot_in(const std::string& text) {
  if (!io::Json::accept(text)) fail(ExitCode::bad_file, "the robot's file: not valid JSON");
  const io::Json document = io::parse_json(text, "the robot's file");
  const auto format = document.is_object() ? document.value("format", "") : std::string();
  if (format == "amble-champion") {
    robot::RobotSpec robot =
        experiment::parse_champion_for(engine, text, "the champion's file").problem.robot;
    return robot;
  }
  if (format != "amble-robot")
    fail(ExitCode::bad_file, "the file: expected a robot.json of a run's folder, or a champion's file");
  io::Json without = document;
  const bool has_model = without.erase("original_model") > 0;
  if (!has_model) return experiment::robot_from_text(text, "the robot's file");
  const auto sealed = io::unseal_json("amble-robot", document.value("version", 0), text, "the robot's file");
  return robot::from_json(io::JsonView(sealed.document, "the robot's file").at("robot"));
}

std::string robot_facts(const std::string& text) {
  const robot::RobotSpec robot = robot_in(text);
  io::Json legs = io::Json::array();
  for (const auto& leg : robot.legs) legs.push_back(leg.name);
  io::Json facts{{"name", robot.name},
                 {"legs", std::move(legs)},
                 {"joints", robot.joints.size()},
                 {"mass_kg", robot.total_mass_kg()},
                 {"leg_height_m", robot::leg_height_m(robot)},
                 {"gravity_m_s2", norm(robot.gravity_m_s2)}};
  if (const auto size = experiment::settings_of_size(robot))
    facts["size"] = {
        {"period_s", size->period_s}, {"push_m_s", size->push_m_s}, {"start_height_m", size->start_height_m}};
  return facts.dump();
}

std::string config_json(const experiment::Config& config) {
  return io::settings_to_json(config).dump();
}

}  // namespace amble::browser
