#include "amble/motion/recorded_trial.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "amble/io/json_file.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"

namespace amble::motion {
namespace {

/// The columns of a recording that a Motion holds, by index.
class FrameColumns {
 public:
  FrameColumns(const record::RecordingReader& reader, const robot::RobotSpec& robot) {
    for (const char* name : {"root.x", "root.y", "root.z", "root.qw", "root.qx", "root.qy", "root.qz"})
      root_.push_back(find(reader, name));
    for (const char* name : {"com.x", "com.y", "com.z"}) com_.push_back(find(reader, name));
    for (const robot::Joint& joint : robot.joints) angle_.push_back(find(reader, "angle." + joint.name));
    const auto& columns = reader.header().columns;
    const auto has = [&](const std::string& name) {
      return std::ranges::find(columns, name) != columns.end();
    };
    for (const robot::Leg& leg : robot.legs) {
      touch_.push_back(find(reader, "touch." + leg.name));
      if (has("timer." + leg.name)) timer_.push_back(find(reader, "timer." + leg.name));
      if (has("trigger." + leg.name)) trigger_.push_back(find(reader, "trigger." + leg.name));
    }
    if (has("command.speed") && has("command.turn"))
      command_ = {find(reader, "command.speed"), find(reader, "command.turn")};
    // Timers of only some legs are ignored: all that use them compare legs.
    if (timer_.size() != robot.legs.size()) timer_.clear();
    if (trigger_.size() != robot.legs.size()) trigger_.clear();
  }

  void prepare(Motion& motion) const {
    motion.angle_rad.resize(angle_.size());
    motion.touch.resize(touch_.size());
    motion.timer_ticks.resize(timer_.size());
    motion.trigger.resize(trigger_.size());
  }

  void append(const std::vector<float>& frame, Motion& motion) const {
    const auto root = [&](std::size_t i) { return static_cast<double>(frame[root_[i]]); };
    motion.root_m.push_back({root(0), root(1), root(2)});
    motion.root_rotation.push_back({root(3), root(4), root(5), root(6)});
    motion.com_m.push_back({frame[com_[0]], frame[com_[1]], frame[com_[2]]});
    for (std::size_t i = 0; i < angle_.size(); ++i) motion.angle_rad[i].push_back(frame[angle_[i]]);
    for (std::size_t i = 0; i < touch_.size(); ++i) motion.touch[i].push_back(frame[touch_[i]] > 0.5f);
    if (!command_.empty()) motion.command.push_back({frame[command_[0]], frame[command_[1]]});
    for (std::size_t i = 0; i < timer_.size(); ++i) motion.timer_ticks[i].push_back(frame[timer_[i]]);
    for (std::size_t i = 0; i < trigger_.size(); ++i) motion.trigger[i].push_back(frame[trigger_[i]] > 0.5f);
  }

 private:
  static std::size_t find(const record::RecordingReader& reader, const std::string& name) {
    return static_cast<std::size_t>(reader.column(name));
  }

  std::vector<std::size_t> root_, com_, angle_, touch_, timer_, trigger_, command_;
};

}  // namespace

RecordedTrial read_recorded_trial(const std::filesystem::path& path) {
  record::RecordingReader reader(path);
  const record::RecordingHeader& header = reader.header();
  RecordedTrial recorded;
  recorded.robot = robot::parse_robot(header.robot_json, path.string() + ": robot");
  const std::string controller = path.string() + ": controller";
  const io::Json document = io::parse_json(header.controller_json, controller);
  const io::JsonView parameters(document, controller);
  recorded.controller_kind = parameters.at("kind").text();
  // What a controller has decides what can be shown of it, not its kind.
  if (parameters.has("patterns_rad"))
    recorded.supg = parse_supg(header.controller_json, recorded.robot, controller);
  if (parameters.has("nodes")) recorded.network = parse_network(header.controller_json, controller);

  Motion& motion = recorded.motion;
  motion.frame_s = header.frame_s;
  motion.com_start_m = robot::start_com_m(recorded.robot);
  const FrameColumns columns(reader, recorded.robot);
  columns.prepare(motion);
  // The outcome of a trial with a frame that is not finite is `diverged`.
  const auto finite = [](float value) { return std::isfinite(value); };
  bool healthy = true;
  for (std::vector<float> frame; reader.next(frame);) {
    healthy = healthy && std::ranges::all_of(frame, finite);
    if (healthy) columns.append(frame, motion);
  }
  motion.outcome = reader.outcome();
  return recorded;
}

}  // namespace amble::motion
