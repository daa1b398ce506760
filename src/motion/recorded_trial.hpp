#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "amble/motion/motion.hpp"
#include "amble/motion/neural_network.hpp"
#include "amble/motion/supg_patterns.hpp"
#include "amble/robot/spec.hpp"

namespace amble::motion {

/// A recording in memory.
struct RecordedTrial {
  robot::RobotSpec robot;
  Motion motion;
  std::string controller_kind;
  std::optional<SupgPatterns> supg;      ///< of controllers that have patterns
  std::optional<NeuralNetwork> network;  ///< of controllers that have nodes and links
};

/// Frames from the first that is not finite on are left out. Throws UserError: the file is missing or
/// altered, lacks a column, or its robot or controller JSON is not valid.
RecordedTrial read_recorded_trial(const std::filesystem::path& path);

}  // namespace amble::motion
