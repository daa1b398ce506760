#pragma once

#include <string>
#include <vector>

#include "amble/robot/spec.hpp"

namespace amble::robot {

/// The best servos give about 50 N m per kg of their own, and half of a robot is not motors: those of a small
/// robot hardly sum up to more than so much per kg of all that it is, N m/kg. Motors of larger robots may.
constexpr double strongest_nm_per_kg = 25.0;
/// What a motor of a leg has, at most, of the torque that bears the leg's share of the weight at right
/// angles.
constexpr double strongest_times = 8.0;
/// N m of a kg·cm, the unit in which servos are sold.
constexpr double nm_per_kg_cm = 0.0980665;

/// A joint's name and its motor's largest torque.
struct MotorTorque {
  std::string joint;
  double most_nm = 0.0;
};

/// The line on motors that are too strong to be of a robot of that mass, as torques in kg·cm are: those of
/// more than `strongest_times` what bears a leg's share of its weight, if the sum of all these is more than
/// `strongest_nm_per_kg`. Neither alone is odd: short legs have small shares, large robots large motors.
/// Empty: none is.
std::string strength_line(const std::vector<MotorTorque>& motors, double mass_kg, double bearing_nm);

/// Adds that line on a robot with legs. Velocity servos count alone, as --init makes them of a URDF's effort:
/// torque servos come of actuators in MJCF, whose force is times a gear and which --init itself doubts, and
/// of tasks.
void doubt_strength(const RobotSpec& robot, std::vector<std::string>& lines);

/// Adds a line on joints of legs whose axis passes through the foot however the joints beyond them are bent,
/// so that they only spin what hangs on them. A joint near its foot (an ankle, a wheel) may do so.
void doubt_axes(const RobotSpec& robot, std::vector<std::string>& lines);

/// Adds a line on joints without stops at which a round foot turns about its middle.
void doubt_wheels(const RobotSpec& robot, std::vector<std::string>& lines);

}  // namespace amble::robot
