#include "amble/substrate/sensor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"

namespace amble::substrate {
namespace {

using Kind = Sensor::Kind;
using Owner = SensorOwner;

constexpr std::array kinds{
    SensorKind{"angle", Kind::angle, Owner::joint, "rad", 0.0, "a joint's angle"},
    SensorKind{"touch", Kind::touch, Owner::leg, "1", 1.0, "1 while a leg's foot is on the ground, else 0"},
    SensorKind{"load", Kind::load, Owner::leg, "N", 0.0,
               "the ground's force on a leg's foot along its normal, in the last step"},
    SensorKind{"speed", Kind::speed, Owner::joint, "rad/s", 10.0,
               "how far a joint has turned since the last tick, by its length"},
    SensorKind{"torque", Kind::torque, Owner::joint, "N m", 0.0,
               "the torque of a joint's motor in the last step"},
    SensorKind{"roll", Kind::roll, Owner::robot, "rad", 0.5, "of the root, in the level frame"},
    SensorKind{"pitch", Kind::pitch, Owner::robot, "rad", 0.5, "of the root, in the level frame"},
    SensorKind{"yaw", Kind::yaw, Owner::robot, "rad", std::numbers::pi, "of the root, in the level frame"},
    SensorKind{"yaw_rate", Kind::yaw_rate, Owner::robot, "rad/s", 2.0,
               "how far the yaw has turned since the last tick, by its length"},
    SensorKind{"command_speed", Kind::command_speed, Owner::robot, "m/s", 1.0,
               "the speed along its own forward axis that the robot is told"},
    SensorKind{"command_turn", Kind::command_turn, Owner::robot, "rad/s", 1.0,
               "the rate of turning to the left that the robot is told"},
    SensorKind{"command_stop", Kind::command_stop, Owner::robot, "1", 1.0,
               "1 while the robot is told neither a speed nor a turn, else 0"},
    SensorKind{"heading_error", Kind::heading_error, Owner::robot, "rad", 1.0,
               "how far the heading that the commanded turns have led to is to the left of the robot's"},
    SensorKind{"sine", Kind::sine, Owner::clock, "1", 1.0, "sin(2π t / substrate.sine_period_s)"},
};

std::string placeholder(const SensorKind& row) {
  if (row.owner == Owner::joint) return fmt::format("{}.JOINT", row.name);
  return row.owner == Owner::leg ? fmt::format("{}.LEG", row.name) : std::string(row.name);
}

template <typename Items>
int index_of(const Items& items, std::string_view name) {
  const auto found = std::ranges::find_if(items, [&](const auto& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

template <typename Items>
std::string names_of(const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(item.name);
  return io::first_few(names);
}

}  // namespace

std::span<const SensorKind> sensor_kinds() {
  return kinds;
}

std::string expected_sensors() {
  std::string text;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    text += (i == 0 ? "" : i + 1 == kinds.size() ? " or " : ", ") + placeholder(kinds[i]);
  return text;
}

const SensorKind& kind_of(const Sensor& sensor) {
  return *std::ranges::find(kinds, sensor.kind, &SensorKind::kind);
}

Sensor parse_sensor(std::string_view name, const robot::RobotSpec& robot, const std::string& key) {
  const std::size_t dot = name.find('.');
  const std::string_view what = name.substr(0, dot);
  const auto row = std::ranges::find(kinds, what, &SensorKind::name);
  const bool owned = row != kinds.end() && (row->owner == Owner::joint || row->owner == Owner::leg);
  if (row == kinds.end() || owned != (dot != std::string_view::npos))
    fail_setting({key}, "{} = \"{}\": expected {}", key, name, expected_sensors());
  if (!owned) return {row->kind, 0};
  const std::string_view owner = name.substr(dot + 1);
  const bool of_joint = row->owner == Owner::joint;
  const int index = of_joint ? index_of(robot.joints, owner) : index_of(robot.legs, owner);
  if (index < 0)
    fail_setting({key}, "{} = \"{}\": the robot has no {} {}; expected {}", key, name,
                 of_joint ? "joint" : "leg", owner, of_joint ? names_of(robot.joints) : names_of(robot.legs));
  return {row->kind, index};
}

std::string sensor_name(const Sensor& sensor, const robot::RobotSpec& robot) {
  const SensorKind& row = kind_of(sensor);
  if (row.owner == Owner::joint)
    return fmt::format("{}.{}", row.name, robot.joints[to_index(sensor.index)].name);
  if (row.owner == Owner::leg) return fmt::format("{}.{}", row.name, robot.legs[to_index(sensor.index)].name);
  return std::string(row.name);
}

bool shares_rows(const Sensor& a, const Sensor& b) {
  const auto turns = [](const Sensor& sensor) {
    return sensor.kind == Kind::roll || sensor.kind == Kind::yaw;
  };
  return a == b || (turns(a) && turns(b));
}

const float* row_of(const Sensor& sensor, const robot::SensorFrame& frame) {
  const auto row = [](const LaneArray& rows, int r) { return r < rows.rows() ? rows.row(r) : nullptr; };
  switch (sensor.kind) {
    case Kind::angle:
      return row(frame.joint_angle_rad, sensor.index);
    case Kind::touch:
      return row(frame.touch, sensor.index);
    case Kind::speed:
      return row(frame.joint_speed_rad_s, sensor.index);
    case Kind::torque:
      return row(frame.joint_torque_nm, sensor.index);
    case Kind::roll:
      return row(frame.attitude_rad, 0);
    case Kind::pitch:
      return row(frame.attitude_rad, 1);
    case Kind::yaw:
      return row(frame.attitude_rad, 2);
    case Kind::yaw_rate:
      return row(frame.yaw_rate_rad_s, 0);
    case Kind::load:
      return row(frame.foot_load_n, sensor.index);
    case Kind::command_speed:
      return row(frame.command, 0);
    case Kind::command_turn:
      return row(frame.command, 1);
    case Kind::command_stop:
      return row(frame.command_stop, 0);
    case Kind::heading_error:
      return row(frame.heading_error_rad, 0);
    case Kind::sine:
      break;
  }
  return nullptr;
}

robot::ExtraSenses extra_senses(const Sensor& sensor) {
  return {.speed = sensor.kind == Kind::speed,
          .torque = sensor.kind == Kind::torque,
          .yaw_rate = sensor.kind == Kind::yaw_rate,
          .load = sensor.kind == Kind::load,
          .command = sensor.kind == Kind::command_speed || sensor.kind == Kind::command_turn ||
                     sensor.kind == Kind::command_stop,
          .heading_error = sensor.kind == Kind::heading_error};
}

}  // namespace amble::substrate
