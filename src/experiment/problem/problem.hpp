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
///
/// Members may be read; those that belong together are changed by the functions below. Of these complete()
/// may have changed some when it throws; the others leave all as it was.
struct Problem {
  robot::RobotSpec robot;  ///< intact, with the gravity and friction of the ground, as high as trials start
  std::string engine;      ///< one of physics::engine_names()
  cppn::Settings cppn;     ///< how genomes are evaluated
  controllers::ControllerSettings controller;  ///< with the lists of its substrate, once it is complete
  trial::Settings trial;                       ///< length and timestep of a trial
  trial::NoiseSettings noise;                  ///< noise, and episodes of an evaluation
  score::Settings score;                       ///< what a trial is worth
  ground::Settings ground;                     ///< what the robot walks on
  damage::Settings damage = {};                ///< what is done to the engine's robot
  trial::CommandSettings command = {};         ///< what the robot is told
  io::OwnSettings engine_own = {};             ///< settings of an engine that has its own
  ground::Key ground_key = {};                 ///< names the uneven ground of trials without noise
  /// The kind of controller; null until complete().
  std::shared_ptr<const controllers::Architecture> architecture;

  /// `robot` as in its file, intact whatever `damage` says: that is done to the engine's; the problem's robot
  /// starts Config::drop_m higher, feels gravity as on the ground's slope, and has its friction. Throws
  /// UserError if the parts do not fit together (an engine that cannot simulate the robot, a controller for
  /// other legs, a robot whose gravity does not point down). Defined beside Config (experiment/problem.hpp),
  /// which programs without configs do not need.
  static Problem make(const Config& config, robot::RobotSpec robot);
  /// Makes `architecture` from the other members and checks that they fit. Throws SettingError, or UserError
  /// as make_engine().
  void complete();

  /// Changes the ground, and with it the robot's gravity and friction. Throws SettingError if `other` is not
  /// valid, leaves friction to the robot's file where the ground so far did not, or has the robot start in
  /// it.
  void set_ground(const ground::Settings& other);
  /// Changes the damage. Throws SettingError if the robot has no such parts, UserError if the engine cannot
  /// simulate what is left.
  void set_damage(const damage::Settings& other);
  /// Changes what the robot is told. Throws SettingError for commands that do not fit the trial. A controller
  /// that senses commands is not looked at: with CommandKind::none it senses a stop.
  void set_commands(const trial::CommandSettings& other);
  /// Has the walker steered by hand, or not. Throws SettingError where nothing is commanded, or where the
  /// robot cannot be steered so.
  void set_differential(const controllers::DifferentialSettings& other);
  /// Throws SettingError if the start pose is in uneven ground.
  void check_start() const;

  /// Inputs of a genome for this problem, the bias not counted.
  int cppn_inputs() const { return static_cast<int>(architecture->cppn_inputs().size()); }
  /// Outputs of a genome for this problem.
  int cppn_outputs() const { return static_cast<int>(architecture->cppn_outputs().size()); }
  /// The engine of the damaged robot, on the plane: set_ground() gives it another. `torques`: see
  /// physics::EngineSettings; always with them if the score or the controller needs them. Throws UserError if
  /// it cannot simulate the robot.
  std::unique_ptr<physics::Engine> make_engine(bool torques = false) const;
  /// The controller that a genome is, for batches of `architecture`. The genome is valid for cppn_inputs(),
  /// cppn_outputs() and cppn.recurrent (neat::validate).
  std::unique_ptr<controllers::Parameters> decode(const neat::Genome& genome) const;
  /// What scores its trials.
  score::Score make_score() const;
  /// Of what is left of the robot after damage at the start, with its loads.
  double mass_kg() const;
  /// Weight of what is left of the robot after damage at the start, N.
  double weight_n() const;
  /// What a trial of this score counts in evolution: times trial.fall_factor after a fall.
  double credited(double score_of_trial, record::Outcome outcome) const {
    return score::credited(score_of_trial, outcome, trial.fall_factor);
  }
  /// What a trial::Runner runs trials by. `path`: how paths are sampled; `measures`: those that the score
  /// does not need itself.
  trial::Protocol protocol(const record::PathSampling& path, const record::Measures& measures = {}) const;
  /// Whether trials differ: by noise, that of sensors included, by the place where they start, or by
  /// commands that the controller senses.
  bool trials_vary() const;
  /// The uneven ground of this key, for this robot; null for the plane. Takes a while.
  std::shared_ptr<const ground::Ground> make_ground(const ground::Key& key) const;
  /// The noise of a trial. `on`: its ground, null for the plane; it need not outlive the call.
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
  /// What it was at the last call, if that is the same. Null for the plane. Not thread safe.
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
