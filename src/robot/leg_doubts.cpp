#include "amble/robot/leg_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::robot {
namespace {

/// Whether its torque may be a data sheet's number.
bool is_bought(const Joint& joint) {
  return joint.servo.mode == ServoMode::velocity;
}

/// How far a joint's axis passes the foot of its leg.
double passes_foot_m(const RobotSpec& robot, const Leg& leg, const Joint& joint,
                     const std::vector<Pose>& poses) {
  const Pose& pose = poses[to_index(joint.body)];
  return norm(cross(rotate(pose.rotation, joint.axis), foot_m(robot, leg, poses) - pose * joint.anchor_m));
}

/// The joints of a leg between one of them and its foot.
std::vector<int> beyond(const RobotSpec& robot, const Leg& leg, int j) {
  const Joint& joint = robot.joints[to_index(j)];
  std::vector<int> joints;
  for (int body = robot.foot_body(leg); body > 0; body = robot.bodies[to_index(body)].parent) {
    for (const int other : robot.joints_of_body(body))
      if (std::ranges::find(leg.joints, other) != leg.joints.end() &&
          (body != joint.body || robot.joints[to_index(other)].chain_index > joint.chain_index))
        joints.push_back(other);
    if (body == joint.body) return joints;
  }
  return {};
}

/// The farthest that a joint's axis passes its foot while one of the joints beyond is bent.
double farthest_m(const RobotSpec& robot, const Leg& leg, int j) {
  constexpr double right_angle = 0.5 * std::numbers::pi;
  const Joint& joint = robot.joints[to_index(j)];
  const Pose root{robot.bodies[0].position_m, robot.bodies[0].rotation};
  std::vector<double> angles_rad(robot.joints.size(), 0.0);
  double farthest = passes_foot_m(robot, leg, joint, poses_at(robot, root, angles_rad));
  for (const int other : beyond(robot, leg, j)) {
    const Joint& bent = robot.joints[to_index(other)];
    for (const double angle_rad :
         {std::max(bent.lower_rad, -right_angle), std::min(bent.upper_rad, right_angle)}) {
      angles_rad[to_index(other)] = angle_rad;
      farthest = std::max(farthest, passes_foot_m(robot, leg, joint, poses_at(robot, root, angles_rad)));
    }
    angles_rad[to_index(other)] = 0.0;
  }
  return farthest;
}

}  // namespace

std::string strength_line(const std::vector<MotorTorque>& motors, double mass_kg, double bearing_nm) {
  double sum_nm = 0.0;
  for (const MotorTorque& motor : motors) sum_nm += motor.most_nm;
  if (sum_nm <= strongest_nm_per_kg * mass_kg) return {};
  std::vector<std::string> strong;
  double least_nm = 0.0;
  for (const MotorTorque& motor : motors) {
    if (motor.most_nm <= strongest_times * bearing_nm) continue;
    least_nm = strong.empty() ? motor.most_nm : std::min(least_nm, motor.most_nm);
    strong.push_back(fmt::format("{} ({:.3g} N m)", motor.joint, motor.most_nm));
  }
  if (strong.empty()) return {};
  return fmt::format(
      "torques of more than {:g} times the {:.2g} N m that bear a leg's share of {:.3g} kg, and in sum "
      "{:.0f} N m per kg, more than a robot can carry motors for: {}; are they in kg·cm, as on data "
      "sheets? "
      "× 0.098 makes {:.3g} N m of {:.3g}",
      strongest_times, bearing_nm, mass_kg, sum_nm / mass_kg, io::first_few(strong), nm_per_kg_cm * least_nm,
      least_nm);
}

void doubt_strength(const RobotSpec& robot, std::vector<std::string>& lines) {
  if (robot.legs.empty()) return;
  std::vector<MotorTorque> motors;
  for (const Joint& joint : robot.joints)
    if (is_bought(joint)) motors.push_back({joint.name, joint.servo.max_torque_nm});
  const double mass_kg = robot.total_mass_kg();
  const double bearing_nm =
      mass_kg * norm(robot.gravity_m_s2) * longest_leg_m(robot) / static_cast<double>(robot.legs.size());
  if (std::string line = strength_line(motors, mass_kg, bearing_nm); !line.empty())
    lines.push_back(std::move(line));
}

void doubt_axes(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double near_foot_share = 0.2, through_foot_share = 0.03;
  const std::vector<Pose> poses = start_poses(robot);
  std::vector<std::string> idle;
  for (const Leg& leg : robot.legs) {
    const double length_m = leg_length_m(robot, leg, poses);
    for (const int j : leg.joints) {
      if (j < 0) continue;
      const Joint& joint = robot.joints[to_index(j)];
      const double lever_m = norm(foot_m(robot, leg, poses) - poses[to_index(joint.body)] * joint.anchor_m);
      if (lever_m <= near_foot_share * length_m || farthest_m(robot, leg, j) > through_foot_share * length_m)
        continue;
      const Vec3 axis = rotate(poses[to_index(joint.body)].rotation, joint.axis);
      const auto rounded = [](double value) { return std::round(100.0 * value) / 100.0 + 0.0; };
      idle.push_back(
          fmt::format("{} ({:g} {:g} {:g})", joint.name, rounded(axis.x), rounded(axis.y), rounded(axis.z)));
    }
  }
  if (!idle.empty())
    lines.push_back(fmt::format(
        "joints that spin their leg about itself and hardly move its foot, through which their "
        "axis passes: {}, axes in the world; check <axis>, which in a URDF is in the joint's own frame",
        io::first_few(idle)));
}

void doubt_wheels(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double at_centre_share = 0.3;
  const std::vector<Pose> poses = start_poses(robot);
  std::vector<std::string> wheels;
  for (const Leg& leg : robot.legs)
    for (const int j : leg.joints) {
      if (j < 0) continue;
      const Joint& joint = robot.joints[to_index(j)];
      const Geom& foot = robot.geoms[to_index(leg.foot_geoms.front())];
      const bool is_round = foot.shape == Shape::cylinder || foot.shape == Shape::sphere;
      if (std::isinf(joint.upper_rad - joint.lower_rad) && joint.body == foot.body && is_round &&
          passes_foot_m(robot, leg, joint, poses) < at_centre_share * foot.size_m.x)
        wheels.push_back(joint.name);
    }
  if (!wheels.empty())
    lines.push_back(
        fmt::format("wheels do not roll here: servos turn joints to angles within their range of "
                    "command, and no farther: {}",
                    io::first_few(wheels)));
}

}  // namespace amble::robot
