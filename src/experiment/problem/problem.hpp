#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/factory.hpp"
#include "amble/cppn/settings.hpp"
#include "amble/damage/settings.hpp"
#include "amble/ground/ground.hpp"
#include "amble/ground/settings.hpp"
#include "amble/io/own_settings.hpp"
#include "amble/neat/genome.hpp"
#include "amble/robot/spec.hpp"
#include "amble/score/score.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/noise_settings.hpp"
#include "amble/trial/scenario.hpp"
#include "amble/trial/settings.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

struct Config;

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
  ground::Settings ground;
  damage::Settings damage = {};
  trial::CommandSettings command = {};
  io::OwnSettings engine_own = {};  ///< of an engine that is not one of amble's own
  ground::Key ground_key = {};      ///< of uneven ground in trials without noise
  std::shared_ptr<const controllers::Architecture> architecture;

  /// `robot` as in its file, intact whatever `damage` says: that is done to the engine's; the problem's robot
  /// starts Config::drop_m higher, feels gravity as on the ground's slope, and has its friction. Throws
  /// UserError if the parts do not fit together (an engine that cannot simulate the robot, a controller for
  /// other legs). Defined beside Config (experiment/problem.hpp), which programs without configs do not need.
  static Problem make(const Config& config, robot::RobotSpec robot);
  /// Makes `architecture` from the other members and checks that they fit.
  void complete();

  /// Changes the ground, and with it the robot's gravity and friction. Throws UserError if `other` leaves
  /// friction to the robot's file and the ground so far did not.
  void set_ground(const ground::Settings& other);
  /// Changes the damage. Throws SettingError if the robot has no such parts, UserError if the engine cannot
  /// simulate what is left.
  void set_damage(const damage::Settings& other);
  /// Changes what the robot is told. Throws SettingError for commands that do not fit the trial.
  void set_commands(const trial::CommandSettings& other);
  /// Has the walker steered by hand, or not. Throws SettingError where nothing is commanded, or where the
  /// robot cannot be steered so.
  void set_differential(const controllers::DifferentialSettings& other);
  /// Throws SettingError if the start pose is in uneven ground.
  void check_start() const;

  int cppn_inputs() const { return static_cast<int>(architecture->cppn_inputs().size()); }
  int cppn_outputs() const { return static_cast<int>(architecture->cppn_outputs().size()); }
  /// `torques`: see physics::EngineSettings; always with them if the score measures energy.
  std::unique_ptr<physics::Engine> make_engine(bool torques = false) const;
  std::unique_ptr<controllers::Parameters> decode(const neat::Genome& genome) const;
  score::Score make_score() const;
  /// Weight of what is left of the robot after damage at the start, N.
  double weight_n() const;
  /// What a trial of this score counts in evolution: with trial.fall_factor for a fall.
  double credited(double score_of_trial, record::Outcome outcome) const {
    return score::credited(score_of_trial, outcome, trial.fall_factor);
  }
  /// `measures`: those that the score does not need itself.
  trial::Protocol protocol(const record::PathSampling& path, const record::Measures& measures = {}) const;
  /// Whether trials differ: by noise, that of sensors included, by the place where they start, or by
  /// commands.
  bool trials_vary() const {
    return noise.any() || ground.start_place_m > 0.0 || controller.sensing.is_noisy() || command.varies();
  }
  /// Null for the plane.
  std::shared_ptr<const ground::Ground> make_ground(const ground::Key& key) const;
  /// `on`: the ground of the trial, null for the plane.
  trial::Scenario scenario(const trial::ScenarioKey& key, const ground::Ground* on = nullptr) const;
  /// The scenarios of a generation, the same for all genomes, one per episode; empty unless trials_vary().
  std::vector<trial::Scenario> scenarios(std::int64_t seed, int generation,
                                         const ground::Ground* on = nullptr) const;

 private:
  void make_architecture();
};

/// The ground of a trial under noise: that of its generation, or of its EpisodeSet.
ground::Key ground_of(const trial::ScenarioKey& key);

/// The ground of each generation of a run, made anew only when it changes.
class GenerationGround {
 public:
  std::shared_ptr<const ground::Ground> of(const Problem& problem, std::int64_t seed, int generation);

 private:
  std::optional<ground::Key> key_;
  std::shared_ptr<const ground::Ground> ground_;
};

/// The text of a robot.json.
std::string robot_file_text(const robot::RobotSpec& robot);
/// What robot_file_text() wrote. `what` names the file. Throws UserError(ExitCode::bad_file).
robot::RobotSpec robot_from_text(const std::string& text, const std::string& what);

}  // namespace amble::experiment
