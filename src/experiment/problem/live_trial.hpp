#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "amble/damage/settings.hpp"
#include "amble/experiment/problem/problem.hpp"
#include "amble/ground/settings.hpp"
#include "amble/neat/genome.hpp"
#include "amble/trial/commands.hpp"
#include "amble/trial/observers.hpp"
#include "amble/trial/trial.hpp"

namespace amble::experiment {

/// What is done to a walker from outside before a step.
struct Input {
  int step = 1;                                 ///< the step that it comes before; steps count from 1
  std::optional<Vec3> push_n_s = {};            ///< physics::Engine::push
  std::optional<double> lift_m = {};            ///< it is lifted by so much, as it is, and falls; in (0, 100]
  std::optional<ground::Settings> ground = {};  ///< the ground from now on
  std::optional<damage::Settings> damage = {};  ///< all that is wrong with the robot from now on
  std::optional<trial::Command> command = {};   ///< what it is told from now on
};

/// A trial without an end, step by step, in which anything may be done to the robot between two steps.
/// Without inputs its steps are those of the trial without noise, to the bit; with them they depend on the
/// inputs and the steps before which they came, and on nothing else.
///
/// When the ground or the damage changes, the robot goes on with its pose and velocities (as in
/// docs/DAMAGE.md), and is lifted where it would be in the new ground. Damages begin when they did, counted
/// from the trial's beginning. The controller does not know of it.
class LiveTrial {
 public:
  /// Throws UserError if the engine of `problem` cannot simulate its robot.
  LiveTrial(const Problem& problem, const neat::Genome& genome);
  LiveTrial(const LiveTrial&) = delete;
  LiveTrial& operator=(const LiveTrial&) = delete;

  /// What comes before the next step; Input::step is that one's. Throws UserError, and then nothing has
  /// changed, if the robot has no such part, the ground is none, the controller senses no commands, or the
  /// lift is out of its range.
  void apply(const Input& input);
  /// Advances by one step. False if the simulation had broken down before or does so: nothing can follow.
  bool step();

  int steps() const { return steps_; }  ///< made so far
  /// Whether the controller senses commands.
  bool obeys() const;
  /// What it was told in the last step; of one that obeys.
  trial::Command told() const;
  /// Whether RobotSpec::fall_rule was met after the last step.
  bool fallen() const;
  const Problem& problem() const { return problem_; }
  const physics::Engine& engine() const { return *engine_; }
  const controllers::Batch& controllers() const { return *controllers_; }
  const controllers::Parameters& parameters() const { return *parameters_; }
  const LaneArray& targets_rad() const { return runner_->targets_rad(); }
  static constexpr int lane = 0;  ///< of the robot in engine() and controllers()

 private:
  void move_to(Problem next, double lift_m);

  Problem problem_;
  std::shared_ptr<const ground::Ground> ground_;
  std::unique_ptr<physics::Engine> engine_;
  std::unique_ptr<controllers::Batch> controllers_;
  std::shared_ptr<const controllers::Parameters> parameters_;
  std::unique_ptr<trial::OneTask> task_;
  std::unique_ptr<trial::Runner> runner_;
  int steps_ = 0;
  bool healthy_ = true;
};

}  // namespace amble::experiment
