#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::experiment {

/// What the batch engine's solver leaves undone of this robot, as a line; none if that engine cannot simulate
/// it.
std::optional<std::string> solver_line(const robot::RobotSpec& robot);

/// The line for the table [contact] of a robot file whose robot needs more sweeps than it has; else empty.
std::string sweeps_line(const robot::RobotSpec& robot);

/// "warnings:" and a line each; empty without any.
std::string doubts_text(const std::vector<std::string>& doubts);

/// What a robot does in a second in which its start pose is held, and what else is odd about it.
std::string start_text(const robot::RobotSpec& robot);

/// The preset that makes walkers of most robots in a minute (docs/ROBOTS.md), below the folder
/// that has amble's configs.
inline constexpr const char* robot_preset = "configs/quick/supg.toml";
/// What makes of such a config one of a robot that obeys (docs/STEERING.md), as seen from the preset's
/// folder.
inline constexpr const char* steer_part = "../parts/steer.toml";

/// What write_robot_folder() wrote.
struct RobotFolder {
  std::filesystem::path robot_file, config_file;
  std::filesystem::path steer_file;                   ///< empty: robots on fewer than three legs have none
  bool ready = false;                                 ///< to evolve: the robot was read, and has legs
  std::vector<std::string> settled, asked, warnings;  ///< a line each; asked: what is still to be given
  std::string text;  ///< all of it, what was read and what to do next, as `amble robot --init` prints it
};

/// Guesses a robot file from a model, MJCF (.xml) or URDF (.urdf), and writes it, a config that extends
/// `preset`, and one that extends that by commands (steer.toml) (none: a path to be corrected) into `folder`
/// (empty: one of the model's name, below the current folder). Nothing if `stop` was set meanwhile; then
/// files may have been written. Throws UserError for a model that cannot be read and for files that are there
/// already.
std::optional<RobotFolder> write_robot_folder(const std::filesystem::path& model,
                                              std::filesystem::path folder,
                                              const std::optional<std::filesystem::path>& preset,
                                              const std::atomic<bool>& stop);

}  // namespace amble::experiment
