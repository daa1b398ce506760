#include "amble/motion/recorded_trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "amble/io/json_file.hpp"
#include "amble/record/recording.hpp"
#include "amble/robot/json.hpp"

namespace amble::motion {
namespace {

using io::JsonView;

bool read_starts_at_offset(const JsonView& json) {
  const std::string name = json.text();
  if (name == "phase") return true;
  if (name == "delay") return false;
  json.bad("phase or delay");
}

std::int64_t read_period_ticks(const JsonView& json) {
  const std::int64_t ticks = json.integer();
  if (ticks < 1 || ticks > 1'000'000) json.bad("a whole number from 1 to 1000000");
  return ticks;
}

int read_offset_ticks(const JsonView& json) {
  const std::int64_t ticks = json.integer();
  if (std::abs(ticks) > 1'000'000) json.bad("a whole number from -1000000 to 1000000");
  return static_cast<int>(ticks);
}

double read_timestep_s(const JsonView& json) {
  const double timestep_s = json.number();
  if (!(timestep_s > 0.0) || !std::isfinite(timestep_s)) json.bad("a number above 0");
  return timestep_s;
}

std::vector<double> read_pattern(const JsonView& json, int period_ticks) {
  if (json.size() != static_cast<std::size_t>(period_ticks) + 1)
    json.bad("a number for each tick from 0 to period_ticks");
  std::vector<double> pattern;
  for (std::size_t tick = 0; tick < json.size(); ++tick) {
    pattern.push_back(json.at(tick).number());
    if (!std::isfinite(pattern.back())) json.at(tick).bad("a finite number");
  }
  return pattern;
}

using io::JsonView;

NetworkNode read_node(const JsonView& json, std::size_t coordinates) {
  NetworkNode node;
  node.name = json.at("name").text();
  const JsonView at = json.at("at");
  if (at.size() != coordinates) at.bad("a number for each coordinate");
  for (std::size_t i = 0; i < at.size(); ++i) node.at.push_back(at.at(i).finite_number());
  const std::string role = json.at("role").text();
  if (role != "sensor" && role != "hidden" && role != "joint") json.at("role").bad("sensor, hidden or joint");
  node.role = role == "sensor" ? NodeRole::sensor : role == "joint" ? NodeRole::joint : NodeRole::hidden;
  return node;
}

int read_index(const JsonView& json, std::size_t end) {
  const std::int64_t index = json.integer();
  if (index < 0 || index >= static_cast<std::int64_t>(end)) json.bad("the index of a node");
  return static_cast<int>(index);
}

int read_count(const JsonView& json) {
  const std::int64_t count = json.integer();
  if (count < 0 || count > std::numeric_limits<int>::max()) json.bad("a whole number from 0 to 2147483647");
  return static_cast<int>(count);
}

NetworkLink read_link(const JsonView& json, std::size_t nodes) {
  const double weight = json.at("weight").finite_number();
  return {read_index(json.at("source"), nodes), read_index(json.at("target"), nodes), weight,
          json.has("port") ? json.at("port").text() : std::string()};
}

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

SupgPatterns parse_supg(const std::string& controller_json, const robot::RobotSpec& robot,
                        const std::string& what) {
  const io::Json document = io::parse_json(controller_json, what);
  const JsonView json(document, what);
  SupgPatterns supg;
  supg.period_ticks = static_cast<int>(read_period_ticks(json.at("period_ticks")));
  supg.timestep_s = read_timestep_s(json.at("timestep_s"));
  supg.starts_at_offset = read_starts_at_offset(json.at("offset"));
  const JsonView offsets = json.at("offset_ticks");
  if (offsets.size() != robot.legs.size()) offsets.bad("a number for each leg");
  for (std::size_t leg = 0; leg < offsets.size(); ++leg)
    supg.offset_ticks.push_back(read_offset_ticks(offsets.at(leg)));
  const JsonView patterns = json.at("patterns_rad");
  if (patterns.size() != robot.leg_joint_count()) patterns.bad("a list for each joint of a leg");
  for (std::size_t joint = 0; joint < patterns.size(); ++joint)
    supg.patterns_rad.push_back(read_pattern(patterns.at(joint), supg.period_ticks));
  return supg;
}

NeuralNetwork parse_network(const std::string& controller_json, const std::string& what) {
  const io::Json document = io::parse_json(controller_json, what);
  const JsonView json(document, what);
  NeuralNetwork network;
  const JsonView coordinates = json.at("coordinates");
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    network.coordinates.push_back(coordinates.at(i).text());
  const JsonView nodes = json.at("nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i)
    network.nodes.push_back(read_node(nodes.at(i), coordinates.size()));
  const JsonView links = json.at("links");
  for (std::size_t i = 0; i < links.size(); ++i)
    network.links.push_back(read_link(links.at(i), nodes.size()));
  network.possible_links = read_count(json.at("possible_links"));
  return network;
}

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
  if (const auto& start = header.com_start_m) motion.com_start_m = {(*start)[0], (*start)[1], (*start)[2]};
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
