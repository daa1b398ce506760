#pragma once

#include <string>
#include <string_view>

#include "amble/robot/spec.hpp"

namespace amble::substrate {

/// What a sensor node senses.
struct Sensor {
  enum class Kind {
    angle,  ///< of joint `index`, rad
    touch,  ///< of leg `index`: 1 while its foot is on the ground, else 0
    roll,   ///< of the root, rad
    pitch,
    yaw,
    sine,  ///< sin(2π t / period), t from 0 at the first tick
  };
  Kind kind = Kind::sine;
  int index = 0;  ///< joint or leg

  friend bool operator==(const Sensor&, const Sensor&) = default;
};

/// The sensor of that name: angle.JOINT, touch.LEG, roll, pitch, yaw, sine. Throws UserError "KEY = …: …" if
/// there is no such sensor or the robot lacks the joint or leg.
Sensor parse_sensor(std::string_view name, const robot::RobotSpec& robot, const std::string& key);

}  // namespace amble::substrate
