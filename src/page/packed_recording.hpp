#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "amble/record/trajectory.hpp"

namespace amble::page {

/// Numbers at equal intervals of time, for the page: `count` rows, the first at `first_s`.
struct PackedFrames {
  std::vector<std::string> columns;
  double first_s = 0.0, step_s = 0.0;
  std::size_t count = 0;
  /// record::compress_frames of all rows: a zlib stream of float32, the recorded bits.
  std::string bytes;
};

/// The part of a recording that the page contains.
struct PackedRecording {
  std::string robot_json, controller_json, origin;
  std::string ground_json, damage_json;  ///< as in record::RecordingHeader
  double seconds = 0.0;                  ///< until the time was up or the robot fell
  record::Outcome outcome = record::Outcome::completed;
  /// Root, centre of mass, angles, targets and timers, `pose_interval_s` apart. The first row is the start
  /// pose, time 0 (where a trial begins elsewhere, as on uneven ground, the root is that after the first
  /// step); its targets and timers are those of the first step.
  PackedFrames poses;
  /// Touches and triggers of every recorded frame: between two poses a foot may come down and leave.
  PackedFrames contacts;
};

/// Reads a recording frame by frame; memory grows by what the page keeps (about 12 kB per second of the
/// quadruped). Frames from the first that is not finite on are left out. Throws UserError: the file is
/// missing, foreign, truncated or altered, lacks a column, or holds no robot with legs.
PackedRecording pack_recording(const std::filesystem::path& path, double pose_interval_s = 0.02);

}  // namespace amble::page
