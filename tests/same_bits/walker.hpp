#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/factory.hpp"
#include "amble/cppn/network.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/damage/settings.hpp"
#include "amble/ground/ground.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/physics/damaged_engine.hpp"
#include "amble/robot/json.hpp"
#include "amble/trial/observers.hpp"
#include "amble/trial/scenario.hpp"
#include "amble/trial/settings.hpp"
#include "amble/trial/trial.hpp"

namespace amble::tests {

/// A champion's file, read without what reads models of robots: its walk can be repeated where there is no
/// MuJoCo.
struct Walker {
  explicit Walker(const std::string& robot_name)
      : document(io::parse_json(io::read_file(AMBLE_SOURCE_DIR "/robots/" + robot_name + "/champion.json"),
                                robot_name)),
        root(document, robot_name),
        robot(robot::from_json(root.at("robot"))),
        controller(io::settings_from_json<controllers::ControllerSettings>(root.at("controller"))),
        cppn(io::settings_from_json<cppn::Settings>(root.at("cppn"))),
        trial(io::settings_from_json<trial::Settings>(root.at("trial"))),
        noise(io::settings_from_json<trial::NoiseSettings>(root.at("noise").at("settings"))),
        genome(neat::genome_from_json(root.at("genome"))) {}

  trial::Scenario scenario(std::uint32_t episode) const {
    return trial::draw_scenario(noise, robot, trial.steps(), trial.timestep_s,
                                {.seed = static_cast<std::uint64_t>(root.at("seed").integer()),
                                 .generation = static_cast<std::uint32_t>(root.at("generation").integer()),
                                 .episode = episode});
  }

  /// The state after each step of a trial in the batch engine, 32 bits of its hash.
  std::vector<std::uint32_t> trace(const trial::Scenario* scenario = nullptr,
                                   std::shared_ptr<const ground::Ground> ground = nullptr,
                                   const damage::Settings& damage = {}) const {
    const auto architecture = controllers::make_architecture(controller, robot, trial.timestep_s);
    const auto engine =
        physics::make_damaged_engine("batch", robot, damage, {.timestep_s = trial.timestep_s});
    if (ground) engine->set_ground(ground);
    const auto batch = architecture->make_batch(engine->lanes());
    trial::TraceObserver observer;
    trial::OneTask task(architecture->decode(cppn::Network(genome, cppn)), &observer, scenario);
    const std::atomic<bool> never{false};
    trial::Runner(*engine, *batch,
                  {.steps = trial.steps(),
                   .timestep_s = trial.timestep_s,
                   .first_command = trial.first_command,
                   .path = {},
                   .measures = {},
                   .fall = robot.fall_rule(),
                   .start_rotation = robot.bodies[0].rotation})
        .run(task, never);
    return observer.trace();
  }

  io::Json document;
  io::JsonView root;
  robot::RobotSpec robot;
  controllers::ControllerSettings controller;
  cppn::Settings cppn;
  trial::Settings trial;
  trial::NoiseSettings noise;
  neat::Genome genome;
};

}  // namespace amble::tests
