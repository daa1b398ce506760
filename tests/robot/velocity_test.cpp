#include "amble/robot/velocity.hpp"

#include <gtest/gtest.h>

#include "amble/core/random.hpp"
#include "amble/morphology/robot_file.hpp"

namespace amble::robot {
namespace {

TEST(Velocity, OfEachBodyIsTheDifferenceOfItsPoses) {
  const RobotSpec robot = morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  Stream stream(1, Purpose::trial_noise, 0, 0);
  const auto vector = [&] {
    return Vec3{stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0)};
  };
  constexpr double h = 1e-6;
  for (int i = 0; i < 100; ++i) {
    std::vector<double> angles, speeds;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      angles.push_back(stream.uniform(-0.8, 0.8));
      speeds.push_back(stream.uniform(-2.0, 2.0));
    }
    const Twist root{vector(), vector()};
    const Vec3 axis = vector();
    const Pose pose{vector(), axis_angle((1.0 / norm(axis)) * axis, 1.0)};
    const auto at = [&](double t) {
      std::vector<double> moved = angles;
      for (std::size_t j = 0; j < moved.size(); ++j) moved[j] += t * speeds[j];
      const double spin = norm(root.angular_velocity_rad_s);
      const Quat turn = axis_angle((1.0 / spin) * root.angular_velocity_rad_s, t * spin);
      return poses_at(robot, {pose.position_m + t * root.velocity_m_s, turn * pose.rotation}, moved);
    };
    const auto poses = at(0.0), before = at(-h), after = at(h);
    const auto twists = twists_at(robot, poses, root, {angles, speeds});
    const Vec3 point{0.3, -0.2, 0.1};
    for (std::size_t b = 0; b < poses.size(); ++b) {
      const Vec3 expected = (0.5 / h) * (after[b] * point - before[b] * point);
      ASSERT_NEAR(norm(twists[b].of_point(rotate(poses[b].rotation, point)) - expected), 0.0, 1e-7) << b;
    }
  }
}

TEST(Velocity, OfTheWholeRobotIsThatOfItsCentreOfMassAndItTurnsAsOneWhenRigid) {
  const RobotSpec robot = morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  const std::vector<double> zero(robot.joints.size(), 0.0);
  const auto poses = start_poses(robot);
  const Vec3 v{0.1, 0.2, 0.3};
  const auto gliding = whole_motion(robot, poses, twists_at(robot, poses, {v, {}}, {zero, zero}));
  EXPECT_NEAR(norm(gliding.com_velocity_m_s - v), 0.0, 1e-14);
  EXPECT_NEAR(norm(gliding.angular_momentum_kg_m2_s), 0.0, 1e-13);
  EXPECT_NEAR(norm(gliding.com_m - start_com_m(robot)), 0.0, 1e-14);
  const Vec3 spin{0.0, 0.0, 2.0};
  const auto turning = whole_motion(robot, poses, twists_at(robot, poses, {{}, spin}, {zero, zero}));
  const Vec3 expected = cross(spin, gliding.com_m - poses[0].position_m);
  EXPECT_NEAR(norm(turning.com_velocity_m_s - expected), 0.0, 1e-14);
  EXPECT_GT(turning.angular_momentum_kg_m2_s.z, 0.0);
}

/// The momentum of a body's points, from its moments: I = Σ m (|r|² − r rᵀ) about its centre of mass.
Vec3 spin_momentum(const Body& body, const Pose& pose, Vec3 spin_rad_s) {
  const Vec3 moments = body.inertia_kg_m2;
  Vec3 sum;
  for (const auto& [axis, moment] :
       {std::pair{Vec3{1, 0, 0}, moments.x}, {{0, 1, 0}, moments.y}, {{0, 0, 1}, moments.z}}) {
    const Vec3 along = rotate(pose.rotation, rotate(body.inertia_rotation, axis));
    sum = sum + (moment * dot(along, spin_rad_s)) * along;
  }
  return sum;
}

TEST(Velocity, AngularMomentumIsThatOfTheBodiesAboutTheCentreOfMassHoweverTheirPrincipalAxesLie) {
  RobotSpec robot = morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  Stream stream(1, Purpose::test);
  const auto vector = [&] {
    return Vec3{stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0), stream.uniform(-1.0, 1.0)};
  };
  const auto rotation = [&] {
    const Vec3 axis = vector();
    return axis_angle((1.0 / norm(axis)) * axis, stream.uniform(-3.0, 3.0));
  };
  for (int round = 0; round < 50; ++round) {
    for (Body& body : robot.bodies) {
      body.inertia_rotation = rotation();
      body.inertia_kg_m2 = {stream.uniform(0.1, 1.0), stream.uniform(1.0, 2.0), stream.uniform(2.0, 3.0)};
    }
    std::vector<double> angles, speeds;
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      angles.push_back(stream.uniform(-0.8, 0.8));
      speeds.push_back(stream.uniform(-2.0, 2.0));
    }
    const auto poses = poses_at(robot, {vector(), rotation()}, angles);
    const auto twists = twists_at(robot, poses, {vector(), vector()}, {angles, speeds});
    const auto whole = whole_motion(robot, poses, twists);
    Vec3 expected;
    for (std::size_t b = 0; b < poses.size(); ++b) {
      const Body& body = robot.bodies[b];
      const Vec3 arm = poses[b] * body.com_m - whole.com_m,
                 velocity = twists[b].of_point(rotate(poses[b].rotation, body.com_m));
      expected = expected + body.mass_kg * cross(arm, velocity) +
                 spin_momentum(body, poses[b], twists[b].angular_velocity_rad_s);
    }
    EXPECT_NEAR(norm(whole.angular_momentum_kg_m2_s - expected), 0.0, 1e-10);
  }
}

}  // namespace
}  // namespace amble::robot
