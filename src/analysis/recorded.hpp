#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "amble/analysis/motion.hpp"
#include "amble/analysis/network.hpp"
#include "amble/analysis/supg.hpp"
#include "amble/robot/spec.hpp"

namespace amble::analysis {

/// A recording, read into memory.
struct Recorded {
  robot::RobotSpec robot;
  Motion motion;
  std::string controller_kind;
  std::optional<Supg> supg;              ///< for controllers of kind "supg"
  std::optional<NeuralNetwork> network;  ///< for controllers of kind "network" and "ctrnn"
};

/// Throws UserError: the file is missing or altered, lacks a column, or its robot or controller JSON does not
/// fit. Frames from the first that is not finite on are left out.
Recorded read_recorded(const std::filesystem::path& path);

}  // namespace amble::analysis
