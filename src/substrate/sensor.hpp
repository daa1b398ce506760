#pragma once

#include <span>
#include <string>
#include <string_view>

#include "amble/robot/sensors.hpp"
#include "amble/robot/spec.hpp"

namespace amble::substrate {

/// What a controller senses.
struct Sensor {
  enum class Kind {
    angle,  ///< of joint `index`, rad
    touch,  ///< of leg `index`: 1 while its foot is on the ground, else 0
    roll,   ///< of the root, rad
    pitch,
    yaw,
    sine,           ///< sin(2π t / period), t from 0 at the first tick
    speed,          ///< of joint `index`, rad/s
    torque,         ///< of the motor of joint `index`, N m
    yaw_rate,       ///< of the root, rad/s
    load,           ///< of the foot of leg `index`, N
    command_speed,  ///< that the robot is told, m/s
    command_turn,   ///< that the robot is told, rad/s to the left
    command_stop,   ///< 1 while the robot is told to stop, else 0
    heading_error,  ///< how far the heading it was told is to its left, rad
  };
  Kind kind = Kind::sine;
  int index = 0;  ///< joint or leg

  friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// What there is one sensor for.
enum class SensorOwner { robot, joint, leg, clock };

/// A row of the table of what can be sensed. All engines of amble's own have all of them.
struct SensorKind {
  std::string_view name;
  Sensor::Kind kind;
  SensorOwner owner;
  std::string_view unit;
  /// What counts as 1 where a number of about ± 1 is wanted, in `unit`. 0: half the joint's range about its
  /// middle, the motor's greatest torque, the robot's weight.
  double full;
  std::string_view what;
};

/// A new one is a row there, a value of Sensor::Kind, and where robot::SensorFrame has it a case in row_of().
std::span<const SensorKind> sensor_kinds();
const SensorKind& kind_of(const Sensor& sensor);
/// What parse_sensor() understands: "angle.JOINT, touch.LEG, … or sine".
std::string expected_sensors();

/// Whether what is done to the readings of one changes the other's: the same sensor, or roll and yaw, which
/// Attitude::misordered_quaternion exchanges.
bool shares_rows(const Sensor& a, const Sensor& b);

/// The sensor of that name: KIND.JOINT, KIND.LEG or KIND by sensor_kinds(). Throws SettingError "KEY = …: …"
/// if there is no such sensor or the robot lacks the joint or leg.
Sensor parse_sensor(std::string_view name, const robot::RobotSpec& robot, const std::string& key);
/// The reverse.
std::string sensor_name(const Sensor& sensor, const robot::RobotSpec& robot);

/// What a sensor reads over the lanes, or null: of a sine, or where the frame lacks what was not asked for.
const float* row_of(const Sensor& sensor, const robot::SensorFrame& frame);

/// What must be asked for to have the sensor.
robot::ExtraSenses extra_senses(const Sensor& sensor);

}  // namespace amble::substrate
