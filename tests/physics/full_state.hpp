#pragma once

#include <array>
#include <vector>

#include "amble/physics/batch/batch_engine.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {

/// State of a robot by its root and joints.
struct FullState {
  RootPose root;
  Vec3 root_velocity_m_s;            ///< of the root frame's origin, world
  Vec3 root_angular_velocity_rad_s;  ///< world
  std::vector<double> angle_rad, speed_rad_s;
};

/// A body as maximal coordinates see it, world.
struct BodyMotion {
  Vec3 com_m;
  Quat rotation;
  Vec3 velocity_m_s;  ///< of the centre of mass
  Vec3 angular_velocity_rad_s;
};

/// Velocities of all bodies by forward kinematics in double precision.
inline std::vector<BodyMotion> body_motions(const robot::RobotSpec& robot, const FullState& state) {
  struct Frame {
    robot::Pose pose;
    Vec3 velocity, angular_velocity;  // of the frame's origin
  };
  std::vector<Frame> frames{{{state.root.position_m, state.root.rotation},
                             state.root_velocity_m_s,
                             state.root_angular_velocity_rad_s}};
  for (int b = 1; b < static_cast<int>(robot.bodies.size()); ++b) {
    const robot::Body& body = robot.bodies[static_cast<std::size_t>(b)];
    const Frame& parent = frames[static_cast<std::size_t>(body.parent)];
    Frame frame{parent.pose * robot::Pose{body.position_m, body.rotation}, {}, parent.angular_velocity};
    frame.velocity =
        parent.velocity + cross(parent.angular_velocity, frame.pose.position_m - parent.pose.position_m);
    for (const int j : robot.joints_of_body(b)) {
      const robot::Joint& joint = robot.joints[static_cast<std::size_t>(j)];
      const Vec3 anchor = frame.pose * joint.anchor_m;
      const Vec3 anchor_velocity =
          frame.velocity + cross(frame.angular_velocity, anchor - frame.pose.position_m);
      frame.angular_velocity = frame.angular_velocity + state.speed_rad_s[static_cast<std::size_t>(j)] *
                                                            rotate(frame.pose.rotation, joint.axis);
      frame.pose =
          frame.pose *
          robot::Pose{joint.anchor_m, axis_angle(joint.axis, state.angle_rad[static_cast<std::size_t>(j)])} *
          robot::Pose{-joint.anchor_m, {}};
      frame.velocity = anchor_velocity + cross(frame.angular_velocity, frame.pose.position_m - anchor);
    }
    frames.push_back(frame);
  }
  std::vector<BodyMotion> motions;
  for (std::size_t b = 0; b < frames.size(); ++b) {
    const Frame& frame = frames[b];
    const Vec3 com = frame.pose * robot.bodies[b].com_m;
    motions.push_back({com, frame.pose.rotation,
                       frame.velocity + cross(frame.angular_velocity, com - frame.pose.position_m),
                       frame.angular_velocity});
  }
  return motions;
}

/// Angular momentum of a body about its own centre of mass, I ω, world.
inline Vec3 rotational_momentum(const robot::Body& body, Quat rotation, Vec3 angular_velocity) {
  const Quat principal = rotation * body.inertia_rotation;
  const Vec3 w = rotate(conjugate(principal), angular_velocity);
  return rotate(principal,
                {body.inertia_kg_m2.x * w.x, body.inertia_kg_m2.y * w.y, body.inertia_kg_m2.z * w.z});
}

inline RobotState robot_state(const robot::RobotSpec& robot, const FullState& state) {
  const auto motions = body_motions(robot, state);
  RobotState result{.com_m = {},
                    .rotation = state.root.rotation,
                    .velocity_m_s = {},
                    .angular_momentum_kg_m2_s = {},
                    .angle_rad = state.angle_rad,
                    .speed_rad_s = state.speed_rad_s};
  const double mass = robot.total_mass_kg();
  for (std::size_t b = 0; b < motions.size(); ++b) {
    result.com_m = result.com_m + (robot.bodies[b].mass_kg / mass) * motions[b].com_m;
    result.velocity_m_s = result.velocity_m_s + (robot.bodies[b].mass_kg / mass) * motions[b].velocity_m_s;
  }
  for (std::size_t b = 0; b < motions.size(); ++b) {
    const Vec3 arm = motions[b].com_m - result.com_m;
    result.angular_momentum_kg_m2_s =
        result.angular_momentum_kg_m2_s +
        rotational_momentum(robot.bodies[b], motions[b].rotation, motions[b].angular_velocity_rad_s) +
        robot.bodies[b].mass_kg * cross(arm, motions[b].velocity_m_s);
  }
  return result;
}

/// Solves m x = b for a symmetric 3 × 3 matrix given by its columns.
inline Vec3 solved(const std::array<Vec3, 3>& m, Vec3 b) {
  const double determinant = dot(m[0], cross(m[1], m[2]));
  return {dot(b, cross(m[1], m[2])) / determinant, dot(m[0], cross(b, m[2])) / determinant,
          dot(m[0], cross(m[1], b)) / determinant};
}

/// The inverse of robot_state(): the root's velocity from the robot's momentum.
inline FullState full_state(const robot::RobotSpec& robot, const RootPose& root, const RobotState& state) {
  FullState result{root, {}, {}, state.angle_rad, state.speed_rad_s};
  const RobotState moved = robot_state(robot, result);  // by the joints alone
  FullState still = result;
  still.speed_rad_s.assign(still.speed_rad_s.size(), 0.0);
  std::array<Vec3, 3> inertia;
  for (int k = 0; k < 3; ++k) {
    still.root_angular_velocity_rad_s = {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    inertia[static_cast<std::size_t>(k)] = robot_state(robot, still).angular_momentum_kg_m2_s;
  }
  result.root_angular_velocity_rad_s =
      solved(inertia, state.angular_momentum_kg_m2_s - moved.angular_momentum_kg_m2_s);
  result.root_velocity_m_s = state.velocity_m_s - moved.velocity_m_s -
                             cross(result.root_angular_velocity_rad_s, moved.com_m - root.position_m);
  return result;
}

/// Solves m x = b, m positive definite.
inline std::vector<double> solved(std::vector<std::vector<double>> m, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t r = i + 1; r < n; ++r) {
      const double factor = m[r][i] / m[i][i];
      for (std::size_t c = i; c < n; ++c) m[r][c] -= factor * m[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t c = i + 1; c < n; ++c) b[i] -= m[i][c] * b[c];
    b[i] /= m[i][i];
  }
  return b;
}

/// The velocities of root and joints nearest to those of the bodies, by kinetic energy: after a step ODE's
/// bodies move as the joints allowed in the pose before, and its next step begins with this projection.
inline FullState nearest(const robot::RobotSpec& robot, const FullState& pose,
                         const std::vector<BodyMotion>& bodies) {
  const std::size_t joints = robot.joints.size(), count = 6 + joints;
  const auto moving = [&](const std::vector<double>& speeds) {
    FullState state{pose.root,
                    {speeds[0], speeds[1], speeds[2]},
                    {speeds[3], speeds[4], speeds[5]},
                    pose.angle_rad,
                    {speeds.begin() + 6, speeds.end()}};
    return state;
  };
  std::vector<std::vector<BodyMotion>> columns;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> unit(count, 0.0);
    unit[k] = 1.0;
    columns.push_back(body_motions(robot, moving(unit)));
  }
  const auto product = [&](const std::vector<BodyMotion>& a, const std::vector<BodyMotion>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += robot.bodies[i].mass_kg * dot(a[i].velocity_m_s, b[i].velocity_m_s) +
             dot(rotational_momentum(robot.bodies[i], a[i].rotation, a[i].angular_velocity_rad_s),
                 b[i].angular_velocity_rad_s);
    return sum;
  };
  std::vector<std::vector<double>> mass(count, std::vector<double>(count));
  std::vector<double> momentum(count);
  for (std::size_t r = 0; r < count; ++r) {
    for (std::size_t c = 0; c < count; ++c) mass[r][c] = product(columns[r], columns[c]);
    momentum[r] = product(columns[r], bodies);
  }
  return moving(solved(mass, momentum));
}

inline double kinetic_energy(const robot::RobotSpec& robot, const std::vector<BodyMotion>& motions) {
  double energy = 0.0;
  for (std::size_t b = 0; b < motions.size(); ++b) {
    const BodyMotion& m = motions[b];
    energy += 0.5 * robot.bodies[b].mass_kg * dot(m.velocity_m_s, m.velocity_m_s) +
              0.5 * dot(m.angular_velocity_rad_s,
                        rotational_momentum(robot.bodies[b], m.rotation, m.angular_velocity_rad_s));
  }
  return energy;
}

}  // namespace amble::physics
