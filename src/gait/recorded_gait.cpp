#include "amble/gait/recorded_gait.hpp"
#include "amble/core/error.hpp"
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

bool has_columns(const record::RecordingReader& reader, const std::string& prefix,
                 const std::vector<std::string>& names) {
  const auto& columns = reader.header().columns;
  return std::ranges::all_of(names, [&](const std::string& name) {
    return std::ranges::find(columns, prefix + name) != columns.end();
  });
}

/// The columns that show seams, in a recording of a controller whose legs have timers.
struct Seams {
  Seams(const record::RecordingReader& reader, const robot::RobotSpec& robot, const Body& body)
      : target(reader, "target.", body.joints),
        timer(reader, "timer.", body.legs),
        trigger(reader, "trigger.", body.legs),
        meter(robot, reader.header().frame_s) {}

  Columns target, timer, trigger;
  SeamMeter meter;
};

/// How many frames `seconds` are; endless without them.
double frames_of(std::optional<double> seconds, double frame_s, const std::string& what) {
  if (!seconds) return std::numeric_limits<double>::infinity();
  const double frames = std::round(*seconds / frame_s);
  if (std::abs(frames * frame_s - *seconds) > 1e-9 * *seconds)
    fail(ExitCode::bad_input, "{}: seconds = {}: expected a whole number of timesteps of {} s", what,
         *seconds, frame_s);
  return frames;
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
  const robot::RobotSpec robot = robot::parse_robot(reader.header().robot_json, what + ": robot");
  Body body = body_of(robot);
  if (const auto& start = reader.header().com_start_m)
    body.com_start_m = {(*start)[0], (*start)[1], (*start)[2]};
  if (reader.header().angle_start_rad.size() == body.joints.size())
    body.angle_start_rad = reader.header().angle_start_rad;
  body.mass_kg = reader.header().mass_kg.value_or(body.mass_kg);
  Columns com(reader, "com.", {"x", "y", "z"}), touch(reader, "touch.", body.legs),
      angle(reader, "angle.", body.joints);
  std::optional<Columns> torque;
  if (has_columns(reader, "torque.", body.joints)) torque.emplace(reader, "torque.", body.joints);
  std::optional<Seams> seams;
  if (has_columns(reader, "timer.", body.legs) && has_columns(reader, "trigger.", body.legs) &&
      has_columns(reader, "target.", body.joints))
    seams.emplace(reader, robot, body);

  Meter meter(body, frame_s, settings);
  const double limit = frames_of(seconds, frame_s, what);
  bool healthy = true;
  std::vector<float> frame;
  while (reader.next(frame)) {
    healthy = healthy && std::ranges::all_of(frame, [](float value) { return std::isfinite(value); });
    if (!healthy || static_cast<double>(reader.frames_read()) > limit) continue;
    const auto at = com.of(frame), angle_rad = angle.of(frame),
               torque_nm = torque ? torque->of(frame) : std::span<const float>();
    meter.add({.com_m = {at[0], at[1], at[2]},
               .touch = touch.of(frame),
               .angle_rad = angle_rad,
               .torque_nm = torque_nm});
    if (seams)
      seams->meter.add({.target_rad = seams->target.of(frame),
                        .angle_rad = angle_rad,
                        .torque_nm = torque_nm,
                        .timer = seams->timer.of(frame),
                        .trigger = seams->trigger.of(frame)});
  }
  const auto frames = static_cast<double>(reader.frames_read());
  if (seconds && frames < limit && reader.outcome() == record::Outcome::completed)
    fail(ExitCode::bad_input, "{}: seconds = {}: it is {:g} s long; expected at most that", what, *seconds,
         frames * frame_s);
  const bool whole = frames <= limit;
  Report report = meter.finish(whole ? reader.outcome() : record::Outcome::completed);
  if (seams) report.seam = seams->meter.report();
  return report;
}

}  // namespace amble::gait
