#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/plan/size_settings.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/spec.hpp"

namespace amble::experiment {

/// A robot that was made from a model alone.
struct NewRobot {
  morphology::RobotGuess guess;           ///< its file
  std::optional<robot::RobotSpec> robot;  ///< none: the file must be completed first
  morphology::ReadingNotes notes;         ///< how the model's parts were handled
};

/// Makes a robot file of a model. It starts as the model does, if it then stands on all its legs for a second
/// (odd_at_start()) and no joint is far outside its stops; else other keyframes and standing poses from the
/// geometry are tried, and the first is taken that stands, or that has the fewest faults. `model`: as the
/// file names the model; `file`: what messages call the robot file, whose folder `model` is relative to.
/// Throws UserError for models that cannot be read.
NewRobot make_new_robot(const morphology::ModelFile& model_file, const std::filesystem::path& model,
                        const std::filesystem::path& file);

/// The fastest engine that can simulate a robot: batch, or ode and why not batch, or mujoco-model where
/// servos hold their torques.
struct EngineChoice {
  std::string engine, why_not_batch;
};
EngineChoice fastest_engine(const robot::RobotSpec& robot);

}  // namespace amble::experiment
