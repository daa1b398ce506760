#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::motion {

/// The temporal patterns of a SUPG controller (Morse et al. 2013, sec. 3).
struct SupgPatterns {
  int period_ticks = 0;
  double timestep_s = 0.0;
  bool starts_at_offset = true;   ///< whether a leg's timer starts at its offset, or after that many ticks
  std::vector<int> offset_ticks;  ///< per leg
  /// [joint][tick] in the order of robot::RobotSpec::joints, of those that belong to legs: the target angle
  /// at each tick of the timer, from 0 to period_ticks.
  std::vector<std::vector<double>> patterns_rad;

  double period_s() const { return period_ticks * timestep_s; }
};

/// From a recording's controller_json, of a controller that has "patterns_rad". Throws
/// UserError(ExitCode::bad_file) naming `what`: not JSON, or a key is missing or has a bad value.
SupgPatterns parse_supg(const std::string& controller_json, const robot::RobotSpec& robot,
                        const std::string& what);

}  // namespace amble::motion
