#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::motion {

/// The meaning of a leg's offset: the timer starts at that tick, or starts that many ticks later.
enum class Offset { phase, delay };

/// The temporal patterns of a SUPG controller (Morse et al. 2013, sec. 3).
struct SupgPatterns {
  int period_ticks = 0;
  double timestep_s = 0.0;
  Offset offset = Offset::phase;
  std::vector<int> offset_ticks;  ///< per leg
  /// [joint][tick] in the order of robot::RobotSpec::joints: the target angle at each tick of the timer, from
  /// 0 to period_ticks.
  std::vector<std::vector<double>> patterns_rad;

  double period_s() const { return period_ticks * timestep_s; }
};

/// From a recording's controller_json, of a controller that has "patterns_rad". Throws
/// UserError(ExitCode::bad_file) naming `what`: not JSON, or a key is missing or has a bad value.
SupgPatterns parse_supg(const std::string& controller_json, const robot::RobotSpec& robot,
                        const std::string& what);

}  // namespace amble::motion
