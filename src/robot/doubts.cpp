#include "amble/robot/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/robot/leg_doubts.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::robot {
namespace {

constexpr double pi = std::numbers::pi;

/// A solid: volume, ∫ r dV and ∫ |r|² dV.
struct Solid {
  double volume_m3 = 0.0;
  Vec3 first;
  double second = 0.0;
};

/// About the origin of the geom's axes.
Solid mesh_solid(const Geom& geom) {
  Solid solid;
  for (const auto& triangle : geom.triangles) {
    const Vec3 a = geom.vertices_m[to_index(triangle[0])], b = geom.vertices_m[to_index(triangle[1])],
               c = geom.vertices_m[to_index(triangle[2])];
    // A tetrahedron with its fourth corner at the origin.
    const double volume = dot(a, cross(b, c)) / 6.0;
    solid.volume_m3 += volume;
    solid.first = solid.first + 0.25 * volume * (a + b + c);
    solid.second += 0.1 * volume * (dot(a, a) + dot(b, b) + dot(c, c) + dot(a, b) + dot(b, c) + dot(c, a));
  }
  return solid;
}

/// About the origin of the geom's axes.
Solid solid_of(const Geom& geom) {
  const Vec3 s = geom.size_m;
  const double ball = 4.0 / 3.0 * pi * s.x * s.x * s.x, tube = 2.0 * pi * s.x * s.x * s.y;
  const double of_tube = tube * (s.x * s.x / 2.0 + s.y * s.y / 3.0);
  switch (geom.shape) {
    case Shape::sphere:
      return {ball, {}, ball * 0.6 * s.x * s.x};
    case Shape::capsule:
      return {tube + ball, {}, of_tube + ball * (0.6 * s.x * s.x + 0.75 * s.x * s.y + s.y * s.y)};
    case Shape::cylinder:
      return {tube, {}, of_tube};
    case Shape::box: {
      const double volume = 8.0 * s.x * s.y * s.z;
      return {volume, {}, volume * dot(s, s) / 3.0};
    }
    case Shape::mesh:
      return mesh_solid(geom);
  }
  return {};
}

/// Some shapes of a body together, about the origin of its frame.
Solid solid_of(const RobotSpec& robot, std::size_t body, bool colliding_only) {
  Solid sum;
  for (const Geom& geom : robot.geoms) {
    if (to_index(geom.body) != body || (colliding_only && !geom.collides)) continue;
    const Solid own = solid_of(geom);
    const Vec3 shift = geom.position_m, first = rotate(geom.rotation, own.first);
    sum.volume_m3 += own.volume_m3;
    sum.first = sum.first + first + own.volume_m3 * shift;
    sum.second += own.second + 2.0 * dot(shift, first) + own.volume_m3 * dot(shift, shift);
  }
  return sum;
}

/// Sum of the principal moments of these shapes, filled evenly with the body's mass; 0: they say nothing.
double moments_of_shapes(const Solid& solid, const Body& body) {
  if (!(solid.volume_m3 > 0.0) || body.mass_kg > densest_kg_m3 * solid.volume_m3) return 0.0;
  const Vec3 centre = (1.0 / solid.volume_m3) * solid.first, off = centre - body.com_m;
  const double gyration_m2 = solid.second / solid.volume_m3 - dot(centre, centre);
  return dot(off, off) > gyration_m2 ? 0.0 : 2.0 * body.mass_kg * gyration_m2;
}

void doubt_inertia(const RobotSpec& robot, std::vector<std::string>& lines) {
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    const Body& body = robot.bodies[b];
    const double moments = body.inertia_kg_m2.x + body.inertia_kg_m2.y + body.inertia_kg_m2.z;
    double nearest = 0.0;
    // Shapes that collide may be simpler than those to look at: the more favourable counts.
    for (const bool colliding_only : {true, false}) {
      const double expected = moments_of_shapes(solid_of(robot, b, colliding_only), body);
      if (expected > 0.0 &&
          (nearest == 0.0 || std::abs(std::log(moments / expected)) < std::abs(std::log(moments / nearest))))
        nearest = expected;
    }
    if (nearest == 0.0) continue;
    const double ratio = moments / nearest;
    if (ratio <= doubted_inertia_factor && ratio >= 1.0 / doubted_inertia_factor) continue;
    lines.push_back(fmt::format(
        "body '{}': its moments of inertia, {:.3g} kg m² in sum, are {:.3g} times those of its shapes with "
        "its mass of {:.3g} kg: check inertia, mass and units",
        body.name, moments, ratio, body.mass_kg));
  }
}

/// How far the robot reaches from its root's frame.
double reach_m(const RobotSpec& robot) {
  const std::vector<Pose> poses = start_poses(robot);
  double reach = 0.0;
  for (const Geom& geom : robot.geoms)
    reach = std::max(reach, norm(centre_m(geom, poses) - poses[0].position_m) +
                                (geom.shape == Shape::mesh ? geom.size_m.x : norm(geom.size_m)));
  return reach;
}

void doubt_placeholders(const RobotSpec& robot, std::vector<std::string>& lines) {
  const double reach = reach_m(robot);
  std::vector<std::string> names;
  for (const Body& body : robot.bodies) {
    const double moments = body.inertia_kg_m2.x + body.inertia_kg_m2.y + body.inertia_kg_m2.z;
    if (is_larger_than_robot(moments, body.mass_kg, reach))
      names.push_back(
          fmt::format("{} ({:.3g} kg m² in sum for {:.3g} kg)", body.name, moments, body.mass_kg));
  }
  if (!names.empty())
    lines.push_back(fmt::format(
        "moments of inertia that would need a body larger than the robot, which reaches {:.2g} m, as "
        "templates have them: {}: check inertia, mass and units",
        reach, io::first_few(names)));
}

/// work(joint, axis, lever, force) of each joint between a foot and the root, in the start pose: the lever to
/// the foot's centre, and the weight on half of the legs.
template <typename Work>
void for_bearing_joints(const RobotSpec& robot, Work work) {
  const std::vector<Pose> poses = start_poses(robot);
  const std::size_t standing = (robot.legs.size() + 1) / 2;
  for (const Leg& leg : robot.legs) {
    const Vec3 foot = foot_m(robot, leg, poses);
    const Vec3 force_n = (-robot.total_mass_kg() / static_cast<double>(standing)) * robot.gravity_m_s2;
    for (int body = robot.foot_body(leg); body > 0; body = robot.bodies[to_index(body)].parent)
      for (const int j : robot.joints_of_body(body)) {
        const Joint& joint = robot.joints[to_index(j)];
        const Pose& pose = poses[to_index(body)];
        work(j, rotate(pose.rotation, joint.axis), foot - pose * joint.anchor_m, force_n);
      }
  }
}

/// Joints whose motors have less than these torques, with both.
std::vector<std::string> weaker_than(const RobotSpec& robot, const std::vector<double>& torques_nm) {
  std::vector<std::string> weak;
  for (std::size_t j = 0; j < torques_nm.size(); ++j)
    if (robot.joints[j].has_motor() && std::abs(torques_nm[j]) > robot.joints[j].servo.max_torque_nm)
      weak.push_back(fmt::format("{} ({:.3g} of {:.3g} N m)", robot.joints[j].name,
                                 robot.joints[j].servo.max_torque_nm, std::abs(torques_nm[j])));
  return weak;
}

/// Straight legs need no torque to stand, but to step.
void doubt_torques(const RobotSpec& robot, std::vector<std::string>& lines) {
  if (const auto weak = weak_joints(robot); !weak.empty())
    lines.push_back(fmt::format(
        "torques that do not hold the weight of {:.3g} kg on half of the legs in the start pose: {}; check "
        "max_torque_nm, masses, and the start pose",
        robot.total_mass_kg(), io::first_few(weak)));
  else if (const auto stepping = weaker_than(robot, stepping_torques_nm(robot)); !stepping.empty())
    lines.push_back(fmt::format(
        "torques that do not hold the weight of {:.3g} kg on half of the legs once a foot is a quarter of "
        "its "
        "leg's length ahead or aside: {}; the robot may stand and not walk: check max_torque_nm and masses",
        robot.total_mass_kg(), io::first_few(stepping)));
}

/// Joints that hardly move whatever their motor does.
void doubt_held_joints(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double slow_rad_s = 1.0, far_rad = 0.8, long_s = 1.0;
  std::vector<std::string> stuck, damped, heavy;
  for (const Joint& joint : robot.joints) {
    if (!joint.has_motor()) continue;
    const double torque_nm = joint.servo.max_torque_nm;
    if (joint.friction_loss_nm >= torque_nm)
      stuck.push_back(
          fmt::format("{} ({:.3g} of {:.3g} N m)", joint.name, torque_nm, joint.friction_loss_nm));
    else if (joint.damping_nm_s_per_rad * slow_rad_s > torque_nm)
      damped.push_back(fmt::format("{} ({:.2g} rad/s)", joint.name, torque_nm / joint.damping_nm_s_per_rad));
    else if (2.0 * far_rad * joint.armature_kg_m2 > torque_nm * long_s * long_s)
      heavy.push_back(fmt::format("{} ({:.2g} s)", joint.name,
                                  std::sqrt(2.0 * far_rad * joint.armature_kg_m2 / torque_nm)));
  }
  if (!stuck.empty())
    lines.push_back(
        fmt::format("motors that do not overcome the dry friction of their joints, which stay where "
                    "they are: {}; check max_torque_nm and friction",
                    io::first_few(stuck)));
  if (!damped.empty())
    lines.push_back(
        fmt::format("joints whose damping leaves their motors hardly any speed, at most: {}; check damping",
                    io::first_few(damped)));
  if (!heavy.empty())
    lines.push_back(fmt::format("rotors so heavy that motors need long to turn {} rad: {}; check armature",
                                far_rad, io::first_few(heavy)));
}

/// With less friction than ice has no foot finds a hold.
void doubt_friction(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double of_ice = 0.03;
  if (!robot.legs.empty() && robot.contact.friction < of_ice)
    lines.push_back(
        fmt::format("friction = {:.3g} under [contact] is less than that of ice, {}: feet find no hold; 1 is "
                    "rubber on a floor",
                    robot.contact.friction, of_ice));
}

/// Stops that are whole turns away, but not so far as the numbers that exporters write for none.
void doubt_stops(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double two_turns_rad = 4.0 * pi, most_degrees = 720.0;
  std::vector<std::string> odd;
  for (const Joint& joint : robot.joints) {
    const auto is_odd = [&](double stop_rad) {
      return std::abs(stop_rad) > two_turns_rad && std::abs(stop_rad) <= most_degrees;
    };
    if (is_odd(joint.lower_rad) || is_odd(joint.upper_rad))
      odd.push_back(fmt::format("{} ({:.4g} to {:.4g} rad)", joint.name, joint.lower_rad, joint.upper_rad));
  }
  if (!odd.empty())
    lines.push_back(fmt::format(
        "stops more than two turns away, which look like degrees: {}; a URDF has radians, an MJCF what its "
        "<compiler angle> says",
        io::first_few(odd)));
}

/// Stops so near each other, of most joints, as radians are when they are read as degrees.
void doubt_narrow_stops(const RobotSpec& robot, std::vector<std::string>& lines) {
  constexpr double narrow_rad = 0.1;
  std::vector<std::string> narrow;
  std::size_t moving = 0;
  for (const Joint& joint : robot.joints) {
    if (!joint.has_motor()) continue;
    ++moving;
    if (joint.upper_rad - joint.lower_rad < narrow_rad)
      narrow.push_back(
          fmt::format("{} ({:.3g} to {:.3g} rad)", joint.name, joint.lower_rad, joint.upper_rad));
  }
  if (2 * narrow.size() > moving)
    lines.push_back(fmt::format(
        "most joints hardly move: {}; are these radians? An MJCF has degrees unless its <compiler angle> is "
        "\"radian\"",
        io::first_few(narrow)));
}

}  // namespace

std::vector<double> bearing_torques_nm(const RobotSpec& robot) {
  std::vector<double> torques(robot.joints.size(), 0.0);
  for_bearing_joints(robot, [&](int j, const Vec3& axis, const Vec3& lever_m, const Vec3& force_n) {
    torques[to_index(j)] = dot(axis, cross(lever_m, force_n));
  });
  return torques;
}

std::vector<double> stepping_torques_nm(const RobotSpec& robot) {
  constexpr double step_share = 0.25;
  std::vector<double> torques(robot.joints.size(), 0.0);
  for_bearing_joints(robot, [&](int j, const Vec3& axis, const Vec3& lever_m, const Vec3& force_n) {
    // What a foot there adds is greatest where it is aside of the axis.
    torques[to_index(j)] = step_share * norm(lever_m) * norm(cross(axis, force_n));
  });
  return torques;
}

std::vector<std::string> weak_joints(const RobotSpec& robot) {
  return weaker_than(robot, bearing_torques_nm(robot));
}

std::vector<std::string> doubts(const RobotSpec& robot) {
  std::vector<std::string> lines;
  doubt_inertia(robot, lines);
  doubt_placeholders(robot, lines);
  doubt_torques(robot, lines);
  doubt_strength(robot, lines);
  doubt_held_joints(robot, lines);
  doubt_axes(robot, lines);
  doubt_wheels(robot, lines);
  doubt_friction(robot, lines);
  doubt_stops(robot, lines);
  doubt_narrow_stops(robot, lines);
  return lines;
}

}  // namespace amble::robot
