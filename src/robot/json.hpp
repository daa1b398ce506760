#pragma once

#include <string>

#include "amble/io/json_file.hpp"
#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The whole robot as JSON (docs/FORMATS.md), so that a champion or a recording needs no other file. Numbers
/// read back to the same bits; infinite friction is "inf".
io::Json to_json(const RobotSpec& robot);

/// Throws UserError(ExitCode::bad_file) for a missing or wrong key, and for a robot that violates RobotSpec's
/// invariants.
RobotSpec from_json(const io::JsonView& json);

/// The same from the text in a recording, whose robot has at least one leg. `what` names it in the error.
RobotSpec parse_robot(const std::string& text, const std::string& what);

}  // namespace amble::robot
