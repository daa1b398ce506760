#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "amble/record/trajectory.hpp"

namespace amble::record {

/// The header of a recording (docs/FORMATS.md).
struct RecordingHeader {
  double frame_s = 0.0;              ///< time between frames
  std::vector<std::string> columns;  ///< names of the float32 numbers of a frame; see standard_columns()
  std::string robot_json;            ///< robot::to_json of the robot
  std::string controller_json;       ///< {"kind": "supg", …}: Architecture::parameters_json
  std::string origin;                ///< the champion it was made from, for titles
  std::string ground_json = {};      ///< ground::to_json of uneven ground; empty: the plane z = 0
  std::string damage_json = {};      ///< damage::Settings of a damaged robot; `robot_json` is intact
  /// Centre of mass and joint angles before the first step, and mass, where the robot does not begin as
  /// `robot_json` says.
  std::optional<std::array<double, 3>> com_start_m = {};
  std::vector<float> angle_start_rad = {};  ///< by joint; empty: as there, 0
  std::optional<double> mass_kg = {};
};

/// The columns every recording has, in order: root.x .y .z .qw .qx .qy .qz, com.x .y .z, then per joint
/// angle.NAME and target.NAME (joint by joint: all angles, then all targets), then touch.LEG. Torques and
/// loads, if there are any, and a controller's state names follow.
std::vector<std::string> standard_columns(const std::vector<std::string>& joints,
                                          const std::vector<std::string>& legs);

/// The columns that follow the standard ones if the engine has motor torques (N m): torque.NAME, joint by
/// joint.
std::vector<std::string> torque_columns(const std::vector<std::string>& joints);

/// The columns that follow those if the engine measures the feet's loads (N): load.LEG, leg by leg.
std::vector<std::string> load_columns(const std::vector<std::string>& legs);

/// The last columns of a trial with commands: command.speed (m/s) and command.turn (rad/s to the left).
std::vector<std::string> command_columns();

/// Writes a recording chunk by chunk, so that memory does not grow with its length. The file appears under
/// its name only with finish(); without it the temporary file is removed. Throws UserError(ExitCode::io).
class RecordingWriter {
 public:
  RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header);
  ~RecordingWriter();
  /// One number per column of the header.
  void add(std::span<const float> frame);
  void finish(Outcome outcome);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a recording chunk by chunk. Throws UserError(ExitCode::bad_file): foreign, another version,
/// truncated, altered.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& path);
  /// From the bytes of a file, in memory. `path`: its name, for messages.
  RecordingReader(std::string bytes, const std::filesystem::path& path);
  ~RecordingReader();
  const RecordingHeader& header() const;
  /// Index of a column; throws UserError if there is none of that name.
  int column(const std::string& name) const;
  /// The next frame, or false after the last one, when outcome() is known. The checksum of every chunk is
  /// checked.
  bool next(std::vector<float>& frame);
  Outcome outcome() const;
  std::uint64_t frames_read() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace amble::record
