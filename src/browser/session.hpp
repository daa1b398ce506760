#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/problem/champion.hpp"
#include "amble/experiment/problem/live_inputs.hpp"
#include "amble/experiment/problem/live_trial.hpp"

namespace amble::browser {

/// The engine in which all walk here: the one that needs no library.
inline constexpr const char* engine = "batch";

/// A champion that walks in a page, and the record of what was done to it.
class Session {
 public:
  /// Text of a champion file. It walks in the engine `batch`, whatever it was evolved in. Throws UserError.
  explicit Session(const std::string& champion);

  /// Puts the robot into its start pose again, on the ground and with the damage of now (`as_evolved`: of its
  /// file), and begins the record anew.
  void restart(bool as_evolved);
  void push(Vec3 impulse_n_s);
  /// Lifts it, as it is, and lets it fall. Throws UserError for a height out of (0, 100].
  void lift(double height_m);
  /// Throws UserError where the controller senses no commands, or a number is none.
  void command(trial::Command command);
  /// All settings of [ground] or [damage] as a JSON object. Throws UserError; then nothing has changed.
  void set_ground(const std::string& json);
  void set_damage(const std::string& json);
  /// Fewer steps only if the simulation breaks down.
  int step(int count);

  /// What does not change from step to step, as JSON: names of the values of state(), robot, controller,
  /// ground, damage, what became of the champion in its file.
  std::string describe() const;
  /// Steps, whether it has fallen, simulated time (s), then record::standard_columns, the controller's state
  /// and, of one that obeys, what it is told: speed (m/s) and turn (rad/s, to the left). Valid until the
  /// next call of a function that is not const.
  const std::vector<double>& state();
  /// Heights of uneven ground: ground::HeightField::heights_m; null for the plane.
  const float* heights_m() const;
  /// A hash for each step: trial::TraceObserver.
  const std::vector<std::uint32_t>& trace() const { return record_.trace; }
  /// In how many steps from the first on the champion's own trial is that of its file, if that engine is
  /// `batch`. Runs it.
  int steps_as_recorded() const;
  /// The session so far: experiment::inputs_text.
  std::string inputs() const;

 private:
  void note(experiment::Input input);

  experiment::Champion champion_;
  std::string evolved_in_;  ///< its engine
  experiment::LiveInputs record_;
  std::unique_ptr<experiment::LiveTrial> trial_;
  std::optional<trial::Command> told_;  ///< the last command from outside
  std::vector<double> state_;
  std::vector<float> controller_state_;
};

}  // namespace amble::browser
