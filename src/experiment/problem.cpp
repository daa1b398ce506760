#include "amble/experiment/problem.hpp"

#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/io/printable.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/robot/json.hpp"

namespace amble::experiment {
namespace {

constexpr int robot_version = 1;

}  // namespace

Problem Problem::make(const Config& config, robot::RobotSpec robot) {
  robot.bodies[0].position_m.z += config.drop_m;
  Problem problem{.robot = std::move(robot),
                  .engine = config.engine,
                  .cppn = config.cppn,
                  .controller = config.controller,
                  .trial = config.trial,
                  .noise = config.noise,
                  .score = config.score,
                  .architecture = nullptr};
  try {
    problem.complete();
  } catch (const SettingError& error) {
    throw config.placed(error);
  }
  return problem;
}

void Problem::complete() {
  trial.validate();
  noise.validate(trial);
  score.validate();
  // Champion files have the nodes themselves, however the config came by them.
  controller.substrate = controllers::substrate_of(controller, robot);
  architecture = controllers::make_architecture(controller, robot, trial.timestep_s);
  make_engine();  // throws if the engine cannot simulate the robot
}

std::unique_ptr<physics::Engine> Problem::make_engine(bool torques) const {
  const bool needed = torques || scorer().measures().energy;
  return physics::make_engine(engine, robot, {.timestep_s = trial.timestep_s, .torques = needed});
}

std::unique_ptr<controllers::Parameters> Problem::decode(const neat::Genome& genome) const {
  return architecture->decode(cppn::Network(genome, cppn));
}

score::Score Problem::scorer() const {
  return score::Score(score, trial.steps() * trial.timestep_s,
                      robot.total_mass_kg() * std::abs(robot.gravity_m_s2.z));
}

trial::Protocol Problem::protocol(const record::PathSampling& path) const {
  return {.steps = trial.steps(),
          .timestep_s = trial.timestep_s,
          .first_command = trial.first_command,
          .path = path,
          .measures = scorer().measures(),
          .fall_height_m = robot.fall_height_m,
          .start_rotation = robot.bodies[0].rotation};
}

trial::Scenario Problem::scenario(const trial::ScenarioKey& key) const {
  return trial::draw_scenario(noise, robot, trial.steps(), trial.timestep_s, key);
}

std::vector<trial::Scenario> Problem::scenarios(std::int64_t seed, int generation) const {
  std::vector<trial::Scenario> all;
  if (!noise.any()) return all;
  for (int episode = 0; episode < noise.episodes; ++episode)
    all.push_back(scenario({.seed = static_cast<std::uint64_t>(seed),
                            .generation = static_cast<std::uint32_t>(generation),
                            .episode = static_cast<std::uint32_t>(episode)}));
  return all;
}

robot::RobotSpec load_robot_file(const std::filesystem::path& path, morphology::ReadingNotes* notes) {
  if (path.extension() != ".json") return morphology::load_robot(path, notes);
  const auto sealed = io::unseal_json("amble-robot", robot_version, io::read_file(path), path.string());
  return robot::from_json(io::JsonView(sealed.document, path.string()).at("robot"));
}

robot::RobotSpec load_robot(const Config& config) {
  std::error_code error;
  if (!std::filesystem::exists(config.robot, error) && config.where)
    fail(ExitCode::io, "{}: 'robot': {}: {}", config.where({"robot"}), io::printable(config.robot),
         error ? error.message() : "No such file or directory");
  return load_robot_file(config.robot);
}

std::string robot_file_text(const robot::RobotSpec& robot) {
  return io::sealed_json("amble-robot", robot_version, {{"robot", robot::to_json(robot)}});
}

}  // namespace amble::experiment
