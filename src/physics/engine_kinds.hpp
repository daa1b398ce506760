#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "amble/io/own_settings.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics {

/// An engine that configs can choose by name.
struct EngineKind {
  std::string name;          ///< value of `engine`: a–z, 0–9, "-" and "_"
  EngineTraits traits = {};  ///< the same for all robots
  /// Must be there (AMBLE_CHECK). `settings.own` has all of `numbers`. Its lanes are those of `traits`.
  /// Throws UserError for a robot that it cannot simulate.
  std::function<std::unique_ptr<Engine>(const robot::RobotSpec& robot, const EngineSettings& settings)> make;
  std::vector<io::OwnNumber> numbers = {};  ///< its settings: [engine_own]
};

/// Adds an engine, from then on one of those that configs can choose. amble's own are added by linking them
/// (amble::physics_batch and so on). Before the first config is read; not thread safe. Throws UserError for a
/// name that is taken or cannot be one.
void register_engine(EngineKind kind);

/// Null if there is none. It stays where it is.
const EngineKind* find_engine(std::string_view name);

}  // namespace amble::physics
