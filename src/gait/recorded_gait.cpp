#include "amble/gait/recorded_gait.hpp"
#include "amble/core/index.hpp"
#include "amble/robot/json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amble/gait/meter.hpp"

namespace amble::gait {
namespace {

/// Some columns of each frame, by index.
class Columns {
 public:
  Columns(const record::RecordingReader& reader, const std::string& prefix,
          const std::vector<std::string>& names)
      : values_(names.size()) {
    for (const std::string& name : names) indices_.push_back(to_index(reader.column(prefix + name)));
  }
  std::span<const float> of(const std::vector<float>& frame) {
    for (std::size_t i = 0; i < indices_.size(); ++i) values_[i] = frame[indices_[i]];
    return values_;
  }

 private:
  std::vector<std::size_t> indices_;
  std::vector<float> values_;
};

bool has_torques(const record::RecordingReader& reader, const Body& body) {
  const auto& columns = reader.header().columns;
  return std::ranges::all_of(body.joints, [&](const std::string& joint) {
    return std::ranges::find(columns, "torque." + joint) != columns.end();
  });
}

}  // namespace

Report recorded_gait(const std::filesystem::path& path, const Settings& settings,
                     std::optional<double> seconds) {
  record::RecordingReader reader(path);
  return recorded_gait(reader, path.string(), settings, seconds);
}

Report recorded_gait(record::RecordingReader& reader, const std::string& what, const Settings& settings,
                     std::optional<double> seconds) {
  const double frame_s = reader.header().frame_s;
  const Body body = body_of(robot::parse_robot(reader.header().robot_json, what + ": robot"));
  Columns com(reader, "com.", {"x", "y", "z"}), touch(reader, "touch.", body.legs),
      angle(reader, "angle.", body.joints);
  std::optional<Columns> torque;
  if (has_torques(reader, body)) torque.emplace(reader, "torque.", body.joints);

  Meter meter(body, frame_s, settings);
  const double limit = seconds ? std::round(*seconds / frame_s) : std::numeric_limits<double>::infinity();
  bool healthy = true;
  std::vector<float> frame;
  while (reader.next(frame)) {
    healthy = healthy && std::ranges::all_of(frame, [](float value) { return std::isfinite(value); });
    if (!healthy || static_cast<double>(reader.frames_read()) > limit) continue;
    const auto at = com.of(frame);
    meter.add({.com_m = {at[0], at[1], at[2]},
               .touch = touch.of(frame),
               .angle_rad = angle.of(frame),
               .torque_nm = torque ? torque->of(frame) : std::span<const float>()});
  }
  const bool whole = static_cast<double>(reader.frames_read()) <= limit;
  return meter.finish(whole ? reader.outcome() : record::Outcome::completed);
}

}  // namespace amble::gait
