#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/factory.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/experiment/config.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/neat/genome.hpp"
#include "amble/robot/spec.hpp"
#include "amble/score/score.hpp"
#include "amble/trial/noise_settings.hpp"
#include "amble/trial/scenario.hpp"
#include "amble/trial/settings.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

/// Everything that maps a genome to a trajectory: robot, engine, architecture, trial. Const, shared by all
/// workers.
struct Problem {
  robot::RobotSpec robot;
  std::string engine;
  cppn::Settings cppn;
  controllers::ControllerSettings controller;
  trial::Settings trial;
  trial::NoiseSettings noise;
  score::Settings score;
  std::shared_ptr<const controllers::Architecture> architecture;

  /// `robot` as in its file; the problem's robot starts Config::drop_m higher. Throws UserError if the parts
  /// do not fit together (an engine that cannot simulate the robot, a controller for other legs).
  static Problem make(const Config& config, robot::RobotSpec robot);
  /// Makes `architecture` from the other members and checks that they fit.
  void complete();

  int cppn_inputs() const { return static_cast<int>(architecture->cppn_inputs().size()); }
  int cppn_outputs() const { return static_cast<int>(architecture->cppn_outputs().size()); }
  /// `torques`: see physics::EngineSettings; always with them if the score measures energy.
  std::unique_ptr<physics::Engine> make_engine(bool torques = false) const;
  std::unique_ptr<controllers::Parameters> decode(const neat::Genome& genome) const;
  score::Score scorer() const;
  trial::Protocol protocol(const record::PathSampling& path) const;
  trial::Scenario scenario(const trial::ScenarioKey& key) const;
  /// The scenarios of a generation, the same for all genomes, one per episode; empty without noise.
  std::vector<trial::Scenario> scenarios(std::int64_t seed, int generation) const;
};

/// The robot of a config. Throws UserError; if its file is missing, with the place that names it.
robot::RobotSpec load_robot(const Config& config);
/// A robot file: the TOML side file of a model, or the robot.json of a run folder. `notes`, if given, gets
/// what became of the model's parts. Throws UserError.
robot::RobotSpec load_robot_file(const std::filesystem::path& path,
                                 morphology::ReadingNotes* notes = nullptr);
/// The text of a robot.json.
std::string robot_file_text(const robot::RobotSpec& robot);

}  // namespace amble::experiment
