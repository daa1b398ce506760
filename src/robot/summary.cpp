#include "amble/robot/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::robot {
namespace {

using Row = std::vector<std::string>;

/// Columns as wide as their widest cell, two blanks between them.
std::string table(std::vector<Row> rows) {
  for (Row& row : rows)
    for (std::string& cell : row) cell = io::printable(cell);
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) line += fmt::format(" {:<{}} ", row[c], widths[c]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string number(double value) {
  return fmt::format("{:.5g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

std::string numbers(Vec3 v) {
  return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

std::string servo_text(const Joint& joint) {
  const Servo& servo = joint.servo;
  if (!joint.has_motor()) {
    if (joint.stiffness_nm_per_rad == 0.0) return "no motor";
    return fmt::format("no motor, a spring of {} N m/rad towards {} rad", number(joint.stiffness_nm_per_rad),
                       number(joint.rest_rad));
  }
  if (servo.mode == ServoMode::velocity) {
    return fmt::format("velocity, {} /s, at most {} N m", number(servo.gain_per_s),
                       number(servo.max_torque_nm));
  }
  return fmt::format("torque, {} N m/rad, {} N m s/rad, at most {} N m", number(servo.kp_nm_per_rad),
                     number(servo.kd_nm_s_per_rad), number(servo.max_torque_nm));
}

std::string passive_text(const Joint& joint) {
  std::string text;
  const auto add = [&](std::string_view what, double value, std::string_view unit) {
    if (value != 0.0) text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", what, number(value), unit);
  };
  add("armature", joint.armature_kg_m2, "kg m2");
  add("damping", joint.damping_nm_s_per_rad, "N m s/rad");
  add("friction loss", joint.friction_loss_nm, "N m");
  return text;
}

std::string shape_text(const Geom& geom) {
  const Vec3 size = geom.size_m;
  switch (geom.shape) {
    case Shape::sphere:
      return fmt::format("sphere, radius {}", number(size.x));
    case Shape::capsule:
      return fmt::format("capsule, radius {}, straight part {}", number(size.x), number(2 * size.y));
    case Shape::cylinder:
      return fmt::format("cylinder, radius {}, length {}", number(size.x), number(2 * size.y));
    case Shape::box:
      return fmt::format("box, {} x {} x {}", number(2 * size.x), number(2 * size.y), number(2 * size.z));
    case Shape::mesh:
      return fmt::format("mesh, {} vertices within {}", geom.vertices_m.size(), number(size.x));
  }
  return {};
}

std::string bodies_text(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  std::vector<Row> rows{
      {"body", "parent", "mass kg", "principal inertia kg m2", "centre of mass in the world, m"}};
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    const std::string parent = body.parent < 0 ? "-" : robot.bodies[to_index(body.parent)].name;
    rows.push_back({body.name, parent, number(body.mass_kg), numbers(body.inertia_kg_m2),
                    numbers(poses[b] * body.com_m)});
  }
  return table(rows);
}

std::string joints_text(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  std::vector<Row> rows{{"joint", "moves", "axis in the world", "range rad", "command rad", "servo", ""}};
  for (const Joint& joint : robot.joints) {
    const auto body = to_index(joint.body);
    const AngleRange command = joint.command_range();
    rows.push_back({joint.name, robot.bodies[body].name, numbers(rotate(poses[body].rotation, joint.axis)),
                    number(joint.lower_rad) + " to " + number(joint.upper_rad),
                    joint.driven()      ? number(command.lower_rad) + " to " + number(command.upper_rad)
                    : joint.has_motor() ? "held"
                                        : "passive",
                    servo_text(joint), passive_text(joint)});
  }
  return table(rows);
}

std::string legs_text(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  std::vector<Row> rows{{"leg", "foot", "over the ground, m", "joints"}};
  for (const Leg& leg : robot.legs) {
    std::string joints;
    for (const int j : leg.joints)
      if (j >= 0) joints += (joints.empty() ? "" : ", ") + robot.joints[to_index(j)].name;
    std::string foot;
    for (const int g : leg.foot_geoms) foot += (foot.empty() ? "" : ", ") + robot.geoms[to_index(g)].name;
    rows.push_back({leg.name, foot, number(foot_bottom_m(robot, leg, poses)), joints});
  }
  return table(rows);
}

std::string geoms_text(const RobotSpec& robot) {
  std::vector<Row> rows{{"geom", "body", "shape, m", ""}};
  for (const Geom& geom : robot.geoms) {
    rows.push_back({geom.name, robot.bodies[to_index(geom.body)].name, shape_text(geom),
                    geom.collides ? "" : "only to look at"});
  }
  return table(rows);
}

}  // namespace

std::string summary(const RobotSpec& robot) {
  std::string text =
      fmt::format("robot {}: {} bodies, {} joints, {} legs, {} kg\n\n", robot.name, robot.bodies.size(),
                  robot.joints.size(), robot.legs.size(), number(robot.total_mass_kg()));
  text += bodies_text(robot) + "\n";
  if (!robot.joints.empty()) text += joints_text(robot) + "\n";
  if (!robot.legs.empty()) text += legs_text(robot) + "\n";
  text += geoms_text(robot) + "\n";
  const Contact& contact = robot.contact;
  text += fmt::format("contact: friction {}, erp {}, cfm {} m/s per N; self-collision {}\n",
                      number(contact.friction), number(contact.erp), number(contact.cfm_s_per_kg),
                      robot.self_collision ? "on" : "off");
  text += fmt::format("gravity: {} m/s2; the robot has fallen below {} m", numbers(robot.gravity_m_s2),
                      number(robot.fall_height_m));
  if (std::isfinite(robot.fall_above_m)) text += fmt::format(", above {} m", number(robot.fall_above_m));
  if (std::isfinite(robot.fall_tilt_rad))
    text += fmt::format(", tilted by more than {} rad", number(robot.fall_tilt_rad));
  text += "\n";
  return text;
}

}  // namespace amble::robot
