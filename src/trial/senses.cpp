#include "amble/trial/senses.hpp"

#include <cmath>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::trial {
namespace {

constexpr int yaw_row = 2;

/// The row of a frame that is to be changed.
float* row_of(const substrate::Sensor& sensor, robot::SensorFrame& frame) {
  return const_cast<float*>(substrate::row_of(sensor, frame));
}

}  // namespace

float rate_of(float before_rad, float now_rad, float rate_hz) {
  return (now_rad - before_rad) * rate_hz;
}

float turning_rate_of(float before_rad, float now_rad, float rate_hz) {
  return wrapped_rad(now_rad - before_rad) * rate_hz;
}

float wrapped_rad(float angle_rad) {
  constexpr float half_turn = 3.14159265f, turn = 6.28318531f;
  const float once_rad = angle_rad > half_turn    ? angle_rad - turn
                         : angle_rad < -half_turn ? angle_rad + turn
                                                  : angle_rad;
  return std::abs(once_rad) <= half_turn ? once_rad : std::remainder(once_rad, turn);
}

float ToldHeading::error_rad(float yaw_rad, float turned_rad) {
  float error_rad = wrapped_rad(wanted_yaw_rad_ - yaw_rad);
  if (lead_rad_ > 0.0f && std::abs(error_rad) > lead_rad_) {
    error_rad = std::copysign(lead_rad_, error_rad);
    wanted_yaw_rad_ = wrapped_rad(yaw_rad + error_rad);
  }
  wanted_yaw_rad_ = wrapped_rad(wanted_yaw_rad_ + turned_rad);
  return error_rad;
}

Senses::Senses(const Sensing& sensing, const robot::SensorFrame& sensors, double timestep_s)
    : sensing_(sensing),
      rate_hz_(static_cast<float>(1.0 / timestep_s)),
      timestep_s_(static_cast<float>(timestep_s)),
      lanes_(to_index(sensors.touch.lanes())),
      angle_before_rad_(sensors.joint_angle_rad),
      yaw_before_rad_(1, sensors.touch.lanes()) {
  const int lanes = sensors.touch.lanes();
  for (Lane& lane : lanes_) lane.heading = ToldHeading(sensing.heading_lead_rad);
  read_ = sensors;
  if (sensing.extra.speed) read_.joint_speed_rad_s = LaneArray(sensors.joint_angle_rad.rows(), lanes);
  if (sensing.extra.torque) read_.joint_torque_nm = LaneArray(sensors.joint_angle_rad.rows(), lanes);
  if (sensing.extra.load) read_.foot_load_n = LaneArray(sensors.touch.rows(), lanes);
  if (sensing.extra.yaw_rate) read_.yaw_rate_rad_s = LaneArray(1, lanes);
  if (sensing.extra.command) {
    read_.command = LaneArray(2, lanes);
    read_.command_stop = LaneArray(1, lanes);
  }
  if (sensing.extra.heading_error) read_.heading_error_rad = LaneArray(1, lanes);
  for (const controllers::SensorModel& model : sensing.models)
    if (model.is_imperfect() && substrate::row_of(model.sensor, read_) != nullptr)
      imperfect_.push_back({model, LaneArray(model.delay_ticks, lanes), LaneArray(1, lanes)});
}

void Senses::load(int lane, const physics::Engine& engine, const Scenario* scenario,
                  const CommandSchedule* commands) {
  Lane& slot = lanes_[to_index(lane)];
  slot.tick = 0;
  slot.commands = commands;
  face(lane, engine);
  slot.noise.reset();
  if (scenario != nullptr) slot.noise = scenario->readings;
  const robot::SensorFrame& sensors = engine.sensors();
  for (int joint = 0; joint < angle_before_rad_.rows(); ++joint)
    angle_before_rad_.at(joint, lane) = sensors.joint_angle_rad.at(joint, lane);
  yaw_before_rad_.at(0, lane) = sensors.attitude_rad.at(yaw_row, lane);
}

void Senses::face(int lane, const physics::Engine& engine) {
  lanes_[to_index(lane)].heading.face(engine.sensors().attitude_rad.at(yaw_row, lane));
}

const robot::SensorFrame& Senses::read(const physics::Engine& engine) {
  if (!sensing_.extra.any() && imperfect_.empty()) return engine.sensors();
  const robot::SensorFrame& sensors = engine.sensors();
  read_.joint_angle_rad = sensors.joint_angle_rad;
  read_.touch = sensors.touch;
  read_.attitude_rad = sensors.attitude_rad;
  take_rates(engine);
  if (sensing_.extra.commands()) take_commands(sensors);
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    for (Imperfect& sensor : imperfect_) read_imperfect(sensor, static_cast<int>(i));
    ++lanes_[i].tick;
  }
  return read_;
}

void Senses::take_rates(const physics::Engine& engine) {
  const robot::SensorFrame& sensors = engine.sensors();
  const int lanes = sensors.touch.lanes();
  if (sensing_.extra.speed) {
    for (int joint = 0; joint < angle_before_rad_.rows(); ++joint)
      for (int lane = 0; lane < lanes; ++lane)
        read_.joint_speed_rad_s.at(joint, lane) =
            rate_of(angle_before_rad_.at(joint, lane), sensors.joint_angle_rad.at(joint, lane), rate_hz_);
    angle_before_rad_ = sensors.joint_angle_rad;
  }
  if (sensing_.extra.yaw_rate)
    for (int lane = 0; lane < lanes; ++lane) {
      const float yaw_rad = sensors.attitude_rad.at(yaw_row, lane);
      read_.yaw_rate_rad_s.at(0, lane) = turning_rate_of(yaw_before_rad_.at(0, lane), yaw_rad, rate_hz_);
      yaw_before_rad_.at(0, lane) = yaw_rad;
    }
  if (sensing_.extra.load) {
    AMBLE_CHECK(engine.foot_load_n() != nullptr, "the engine measures loads");
    read_.foot_load_n = *engine.foot_load_n();
  }
  if (!sensing_.extra.torque) return;
  AMBLE_CHECK(engine.motor_torque_nm() != nullptr, "the engine measures torques");
  read_.joint_torque_nm = *engine.motor_torque_nm();
}

void Senses::take_commands(const robot::SensorFrame& sensors) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    Lane& slot = lanes_[i];
    const int lane = static_cast<int>(i);
    const Command command = slot.commands != nullptr ? slot.commands->at(slot.tick) : Command();
    if (sensing_.extra.command) {
      read_.command.at(0, lane) = command.speed_m_s;
      read_.command.at(1, lane) = command.turn_rad_s;
      read_.command_stop.at(0, lane) = command.is_stop() ? 1.0f : 0.0f;
    }
    if (!sensing_.extra.heading_error) continue;
    const float turned_rad = command.turn_rad_s * timestep_s_;
    read_.heading_error_rad.at(0, lane) =
        slot.heading.error_rad(sensors.attitude_rad.at(yaw_row, lane), turned_rad);
  }
}

void Senses::read_imperfect(Imperfect& sensor, int lane) {
  Lane& slot = lanes_[to_index(lane)];
  const controllers::SensorModel& model = sensor.model;
  float& reading = row_of(model.sensor, read_)[lane];
  float value = reading;
  if (model.delay_ticks > 0) {
    if (slot.tick == 0)
      for (int row = 0; row < model.delay_ticks; ++row) sensor.past.at(row, lane) = value;
    std::swap(value, sensor.past.at(slot.tick % model.delay_ticks, lane));
  }
  float& held = sensor.held.at(0, lane);
  if (slot.tick % model.hold_ticks == 0) {
    held = value;
    if (model.noise > 0.0f && slot.noise) {
      const auto noise = static_cast<double>(model.noise);
      held += static_cast<float>(slot.noise->uniform(-noise, noise));
    }
  }
  reading = held;
}

}  // namespace amble::trial
