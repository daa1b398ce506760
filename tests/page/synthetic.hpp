#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "amble/ground/settings.hpp"
#include "amble/record/recording.hpp"

namespace amble::tests {

/// A made-up trot of the robot of tests/motion/fixture.hpp, as a recording has it: it moves at `speed_m_s`
/// along x, its joints swing once a second, and every number that has a fraction carries noise, so that it is
/// as hard to compress as a measured one. A leg's foot touches in half of each second and triggers when it
/// comes down.
struct SyntheticWalk {
  int frames = 1500;
  double frame_s = 0.01;
  double speed_m_s = 0.25;
  bool touches = true;    ///< false: no foot ever does
  bool chatters = false;  ///< amid each stance a foot lets go, and amid each swing it touches, for 30 ms
  record::Outcome outcome = record::Outcome::completed;
  bool uneven = false;  ///< on hills()

  record::RecordingHeader header() const;
  /// Frame k, the state at (k + 1) × frame_s.
  std::vector<float> frame(int k) const;
  void write(const std::filesystem::path& path) const;
  static ground::Settings hills();
};

}  // namespace amble::tests
