#include "amble/page/packed_recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/record/frame_codec.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/pose.hpp"
#include "amble/robot/spec.hpp"

namespace amble::page {
namespace {

/// Some columns of a recording, collected row by row.
class Table {
 public:
  explicit Table(const record::RecordingReader& reader) : reader_(reader) {}

  /// Throws UserError if the recording has no such column.
  void require(const std::string& name) {
    indices_.push_back(to_index(reader_.column(name)));
    names_.push_back(name);
  }
  /// To 1/512, which packs better: enough for a curve of neurons, which say −1 to 1. Behind all others.
  void require_coarse(const std::string& name) {
    require(name);
    ++coarse_;
  }
  void accept(const std::string& name) {
    if (std::ranges::find(reader_.header().columns, name) != reader_.header().columns.end()) require(name);
  }

  void add(const std::vector<float>& frame) {
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      const float value = frame[indices_[i]];
      const bool coarse = i + coarse_ >= indices_.size();
      values_.push_back(coarse ? std::round(value * 512.0f) / 512.0f : value);
    }
  }
  void add_row(const std::vector<float>& row) { values_.insert(values_.end(), row.begin(), row.end()); }

  PackedFrames pack(double first_s, double step_s) const {
    return {.columns = names_,
            .first_s = first_s,
            .step_s = step_s,
            .count = values_.size() / names_.size(),
            .bytes = record::compress_frames(values_, names_.size())};
  }

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::size_t>& indices() const { return indices_; }

 private:
  const record::RecordingReader& reader_;
  std::vector<std::string> names_;
  std::vector<std::size_t> indices_;
  std::size_t coarse_ = 0;  ///< so many at the end
  std::vector<float> values_;
};

/// More of them fill a page more than they say.
constexpr int most_neurons = 64;

Table pose_table(const record::RecordingReader& reader, const robot::RobotSpec& robot) {
  Table table(reader);
  for (const char* name : {"x", "y", "z", "qw", "qx", "qy", "qz"}) table.require(std::string("root.") + name);
  for (const char* name : {"x", "y", "z"}) table.require(std::string("com.") + name);
  for (const auto& joint : robot.joints) table.require("angle." + joint.name);
  for (const auto& joint : robot.joints) table.require("target." + joint.name);
  for (const auto& leg : robot.legs) table.accept("timer." + leg.name);
  for (const std::string& name : record::command_columns()) table.accept(name);
  const auto is_neuron = [](const std::string& name) { return name.starts_with("neuron."); };
  const auto& columns = reader.header().columns;
  if (std::ranges::count_if(columns, is_neuron) <= most_neurons)
    for (const std::string& name : columns)
      if (is_neuron(name)) table.require_coarse(name);
  return table;
}

Table contact_table(const record::RecordingReader& reader, const robot::RobotSpec& robot) {
  Table table(reader);
  for (const auto& leg : robot.legs) table.require("touch." + leg.name);
  for (const auto& leg : robot.legs) table.accept("trigger." + leg.name);
  return table;
}

/// The row of time 0: the robot as its file has it, or where the trial began elsewhere, as in the first
/// frame, but for centre of mass and angles, which the header has. All else is from the first frame (zeros
/// without one).
std::vector<float> start_row(const record::RecordingHeader& header, const robot::RobotSpec& robot,
                             const Table& poses, const std::vector<float>& first_frame) {
  std::vector<float> row(poses.names().size(), 0.0f);
  if (!first_frame.empty())
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = first_frame[poses.indices()[i]];
  const auto put = [&row](std::size_t first, const auto& values) {
    std::ranges::transform(values, row.begin() + static_cast<std::ptrdiff_t>(first),
                           [](double value) { return static_cast<float>(value); });
  };
  constexpr std::size_t com = 7, angles = com + 3;                           // as in pose_table
  const bool elsewhere = header.com_start_m || !header.ground_json.empty();  // on uneven ground anywhere
  if (!elsewhere || first_frame.empty()) {
    const robot::Body& root = robot.bodies.front();
    const Vec3 com_m = robot::start_com_m(robot);
    put(0, std::array{root.position_m.x, root.position_m.y, root.position_m.z, root.rotation.w,
                      root.rotation.x, root.rotation.y, root.rotation.z, com_m.x, com_m.y, com_m.z});
    put(angles, std::vector<double>(robot.joints.size(), 0.0));
  }
  if (header.com_start_m) put(com, *header.com_start_m);
  if (header.angle_start_rad.size() == robot.joints.size()) put(angles, header.angle_start_rad);
  return row;
}

}  // namespace

PackedRecording pack_recording(const std::filesystem::path& path, double pose_interval_s) {
  record::RecordingReader reader(path);
  const record::RecordingHeader& header = reader.header();
  const auto robot = robot::parse_robot(header.robot_json, path.string() + ": robot");
  const auto frames_per_pose =
      static_cast<std::uint64_t>(std::max(1.0, std::round(pose_interval_s / header.frame_s)));
  Table poses = pose_table(reader, robot), contacts = contact_table(reader, robot);

  const auto finite = [](float value) { return std::isfinite(value); };
  std::uint64_t frames = 0;
  bool healthy = true;
  for (std::vector<float> frame; reader.next(frame);) {
    healthy = healthy && std::ranges::all_of(frame, finite);
    if (!healthy) continue;
    if (frames == 0) poses.add_row(start_row(header, robot, poses, frame));
    contacts.add(frame);
    if (++frames % frames_per_pose == 0) poses.add(frame);
  }
  if (frames == 0) poses.add_row(start_row(header, robot, poses, {}));

  return {.robot_json = header.robot_json,
          .controller_json = header.controller_json,
          .origin = header.origin,
          .ground_json = header.ground_json,
          .damage_json = header.damage_json,
          .seconds = static_cast<double>(frames) * header.frame_s,
          .outcome = reader.outcome(),
          .poses = poses.pack(0.0, static_cast<double>(frames_per_pose) * header.frame_s),
          .contacts = contacts.pack(header.frame_s, header.frame_s)};
}

}  // namespace amble::page
