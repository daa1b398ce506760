#pragma once

#include <string>
#include <utility>

#include "amble/damage/settings.hpp"
#include "amble/morphology/robot_file.hpp"

namespace amble::damage {

inline robot::RobotSpec quadruped() {
  return morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
}

inline Part missing(std::string leg, double from_s = 0.0) {
  return {.kind = Kind::missing, .leg = std::move(leg), .from_s = from_s};
}
inline Part numb(std::string leg, double from_s = 0.0) {
  return {.kind = Kind::numb, .leg = std::move(leg), .from_s = from_s};
}
inline Part locked(std::string joint, double angle_rad, double from_s = 0.0) {
  return {.kind = Kind::locked, .joint = std::move(joint), .angle_rad = angle_rad, .from_s = from_s};
}
inline Part slack(std::string joint, double from_s = 0.0) {
  return {.kind = Kind::slack, .joint = std::move(joint), .from_s = from_s};
}
inline Part weak(std::string joint, double share, double from_s = 0.0) {
  return {.kind = Kind::weak, .joint = std::move(joint), .share = share, .from_s = from_s};
}
inline Part payload(double mass_kg, double x_m, double y_m, double z_m, double from_s = 0.0) {
  return {.kind = Kind::payload, .mass_kg = mass_kg, .x_m = x_m, .y_m = y_m, .z_m = z_m, .from_s = from_s};
}

}  // namespace amble::damage
