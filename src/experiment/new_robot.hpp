#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

/// The fastest engine that can simulate a robot: batch, or ode and why not batch.
struct EngineChoice {
  std::string engine, why_not_batch;
};
EngineChoice fastest_engine(const robot::RobotSpec& robot);

/// Settings for a robot of another size than the presets' quadruped, by Froude's rule: times go with the
/// square root of the legs' height over gravity, speeds with that of the legs' height times gravity. None for
/// a robot of about that size.
struct SizeSettings {
  double leg_height_m = 0.0, preset_leg_height_m = 0.0;
  double period_s = 0.0, push_m_s = 0.0, start_height_m = 0.0;
};
std::optional<SizeSettings> settings_of_size(const robot::RobotSpec& robot);

/// The greatest commands for a robot, by the height of its hips over its feet (Froude): a brisk walk, and a
/// turn of half a circle in some ten to twenty strides. None without legs on both sides.
struct CommandSizes {
  double leg_height_m = 0.0, most_speed_m_s = 0.0, most_turn_rad_s = 0.0;
};
std::optional<CommandSizes> commands_of_size(const robot::RobotSpec& robot);

}  // namespace amble::experiment
