#include "amble/trial/observers.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/robot/pose.hpp"

namespace amble::trial {
namespace {

record::RecordingHeader with_columns(record::RecordingHeader header, const robot::RobotSpec& robot,
                                     const physics::Engine& engine, const controllers::Batch& controllers,
                                     bool commands) {
  std::vector<std::string> joints, legs;
  for (const auto& joint : robot.joints) joints.push_back(joint.name);
  for (const auto& leg : robot.legs) legs.push_back(leg.name);
  header.columns = record::standard_columns(joints, legs);
  if (engine.motor_torque_nm() != nullptr)
    for (auto& name : record::torque_columns(joints)) header.columns.push_back(std::move(name));
  if (engine.foot_load_n() != nullptr)
    for (auto& name : record::load_columns(legs)) header.columns.push_back(std::move(name));
  for (auto& name : controllers.state_names()) header.columns.push_back(std::move(name));
  if (commands)
    for (auto& name : record::command_columns()) header.columns.push_back(std::move(name));
  return header;
}

}  // namespace

void TraceObserver::on_step(int, const physics::Engine& engine, const controllers::Batch&, const LaneArray&,
                            int lane) {
  trace_.push_back(static_cast<std::uint32_t>(engine.state_hash(lane)));
}

EventObserver::EventObserver(const controllers::Batch& controllers) : columns_(controllers.events()) {
  const auto names = controllers.state_names();
  state_.resize(names.size());
  for (const std::size_t column : columns_) counts_.push_back({.name = names[column]});
}

void EventObserver::on_step(int, const physics::Engine&, const controllers::Batch& controllers,
                            const LaneArray&, int lane) {
  if (columns_.empty()) return;
  controllers.state(lane, state_);
  for (std::size_t i = 0; i < columns_.size(); ++i) counts_[i].count += state_[columns_[i]] > 0.5f;
}

std::vector<float> bent_start(const LaneArray& angle_rad, int lane) {
  constexpr float rounding_rad = 1e-7f;
  std::vector<float> angles_rad;
  bool is_bent = false;
  for (int joint = 0; joint < angle_rad.rows(); ++joint) {
    angles_rad.push_back(angle_rad.at(joint, lane));
    is_bent = is_bent || std::abs(angles_rad.back()) > rounding_rad;
  }
  return is_bent ? angles_rad : std::vector<float>();
}

RecordingObserver::RecordingObserver(const std::filesystem::path& path, record::RecordingHeader header,
                                     const robot::RobotSpec& robot, const physics::Engine& engine,
                                     const controllers::Batch& controllers, const CommandSchedule* commands)
    : path_(path),
      header_(with_columns(std::move(header), robot, engine, controllers, commands != nullptr)),
      com_start_m_(robot::start_com_m(robot)),
      state_count_(controllers.state_names().size()),
      commands_(commands) {}

void RecordingObserver::on_start(const physics::Engine& engine, int lane) {
  const Vec3 com_m = engine.com_m(lane);
  if (robot::starts_elsewhere(com_m, com_start_m_)) header_.com_start_m = {com_m.x, com_m.y, com_m.z};
  header_.angle_start_rad = bent_start(engine.sensors().joint_angle_rad, lane);
  writer_.emplace(path_, header_);
}

void RecordingObserver::finish(record::Outcome outcome) {
  AMBLE_CHECK(writer_, "a trial was begun");
  writer_->finish(outcome);
}

void RecordingObserver::on_step(int step, const physics::Engine& engine,
                                const controllers::Batch& controllers, const LaneArray& targets_rad,
                                int lane) {
  frame_.clear();
  const auto put = [this](double value) { frame_.push_back(static_cast<float>(value)); };
  const auto put_lane = [&](const LaneArray& rows) {
    for (int row = 0; row < rows.rows(); ++row) frame_.push_back(rows.at(row, lane));
  };
  const auto pose = engine.root_pose(lane);
  const Vec3 com_m = engine.com_m(lane);
  for (const double value : {pose.position_m.x, pose.position_m.y, pose.position_m.z, pose.rotation.w,
                             pose.rotation.x, pose.rotation.y, pose.rotation.z, com_m.x, com_m.y, com_m.z})
    put(value);
  put_lane(engine.sensors().joint_angle_rad);
  put_lane(targets_rad);
  put_lane(engine.sensors().touch);
  if (const LaneArray* torques_nm = engine.motor_torque_nm()) put_lane(*torques_nm);
  if (const LaneArray* loads_n = engine.foot_load_n()) put_lane(*loads_n);
  frame_.resize(frame_.size() + state_count_);
  controllers.state(lane, std::span(frame_).last(state_count_));
  if (commands_ != nullptr) {
    const Command command = commands_->at(step - 1);
    frame_.insert(frame_.end(), {command.speed_m_s, command.turn_rad_s});
  }
  writer_->add(frame_);
}

void ObserverList::on_start(const physics::Engine& engine, int lane) {
  for (Observer* observer : observers_) observer->on_start(engine, lane);
}

void ObserverList::on_step(int step, const physics::Engine& engine, const controllers::Batch& controllers,
                           const LaneArray& targets_rad, int lane) {
  for (Observer* observer : observers_) observer->on_step(step, engine, controllers, targets_rad, lane);
}

}  // namespace amble::trial
