#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "amble/core/math.hpp"

namespace amble::record {

/// How a trial ended. Physics is never an error.
enum class Outcome : std::uint8_t {
  completed = 0,  ///< ran its full time
  fell = 1,       ///< the root's centre of mass came below RobotSpec::fall_height_m
  diverged = 2,  ///< the simulation gave values that are not finite, or absurd; the last healthy state counts
};
inline constexpr std::array<std::string_view, 3> outcome_names{"completed", "fell", "diverged"};

/// What every trial leaves behind: enough for scoring. In the world's frame (docs/CONVENTIONS.md).
struct Trajectory {
  Outcome outcome = Outcome::completed;
  int steps = 0;  ///< steps simulated, the last of them included
  double timestep_s = 0.0;
  Vec3 com_start_m;     ///< whole-body centre of mass before the first step
  Vec3 com_end_m;       ///< and after the last
  int path_stride = 1;  ///< every how many steps the path was sampled
  std::vector<float>
      com_path_m;  ///< x0, y0, x1, y1, … after steps stride, 2 × stride, …; relative to com_start_m

  double seconds() const { return steps * timestep_s; }
};

}  // namespace amble::record
