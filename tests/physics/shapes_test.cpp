#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class Cylinder : public OnEachEngine {};
ON_EACH_ENGINE(Cylinder);
class Mesh : public OnEachEngine {};
ON_EACH_ENGINE(Mesh);

/// A cylinder of 2 kg, radius 0.1 m and length 0.3 m, on the ground; `rotation` turns its axis from z.
robot::RobotSpec cylinder(Quat rotation, double height_m) {
  robot::RobotSpec robot = scene("box");
  robot.geoms[0].shape = robot::Shape::cylinder;
  robot.geoms[0].size_m = {0.1, 0.15, 0.0};
  robot.geoms[0].rotation = rotation;
  robot.bodies[0].position_m.z = height_m - robot.bodies[0].com_m.z;
  robot.bodies[0].inertia_kg_m2 = {0.02, 0.01, 0.02};
  robot.bodies[0].inertia_rotation = {};
  return robot;
}

TEST_P(Cylinder, RollsWithTheSpeedThatAPushGivesIt) {
  // Without slip J = (m + I / r²) v.
  Bench bench(GetParam(), cylinder(axis_angle({1, 0, 0}, 0.5 * std::numbers::pi), 0.1));
  bench.steps(100);
  const double start_m = bench.engine->com_m(0).x;
  bench.engine->push(0, {1.0, 0.0, 0.0});
  bench.steps(200);
  const double speed = 1.0 / (2.0 + 0.01 / 0.01);
  EXPECT_NEAR(bench.engine->momentum_kg_m_s(0).x, 2.0 * speed, 0.03 * speed);
  EXPECT_NEAR(bench.engine->com_m(0).x - start_m, speed * 2.0, 0.03 * speed * 2.0);
  EXPECT_NEAR(bench.engine->com_m(0).y, 0.0, 1e-3);
  EXPECT_NEAR(bench.engine->com_m(0).z, 0.1, 2e-3);
}

TEST_P(Cylinder, StandsUprightAndRocksBackWhenPushedALittle) {
  for (const double impulse_n_s : {0.0, 0.5}) {
    Bench bench(GetParam(), cylinder({}, 0.15));
    bench.steps(50);
    bench.engine->push(0, {impulse_n_s, 0.3 * impulse_n_s, 0.0});
    bench.steps(500);
    EXPECT_NEAR(bench.engine->com_m(0).z, 0.15, 4e-3) << impulse_n_s;
    EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, 0.02) << impulse_n_s;
  }
}

TEST_P(Mesh, StandsOnItsCornersAndNotOnWhatLiesBetween) {
  robot::RobotSpec robot = scene("box");
  become_pyramid(robot.geoms[0]);
  robot.bodies[0].com_m = {};
  robot.geoms[0].position_m = {};
  robot.geoms[0].rotation = {};
  robot.bodies[0].position_m.z = 0.03;
  Bench bench(GetParam(), robot);
  bench.steps(300);
  EXPECT_NEAR(bench.engine->com_m(0).z, 0.03, 1e-3);
  EXPECT_NEAR(norm(bench.engine->momentum_kg_m_s(0)), 0.0, 1e-3);
  const RollPitchYaw attitude = roll_pitch_yaw(bench.engine->root_pose(0).rotation);
  EXPECT_NEAR(std::hypot(attitude.roll_rad, attitude.pitch_rad), 0.0, 0.01);
}

/// Its corners crowd at the top, so that their mean is far above its tip.
TEST_P(Mesh, TouchesTheGroundWithATipFarFromTheMeanOfItsCorners) {
  robot::RobotSpec robot = scene("box");
  robot::Geom& geom = robot.geoms[0];
  geom.shape = robot::Shape::mesh;
  geom.vertices_m = {
      {0.0, 0.0, -0.12}, {0.02, 0.0, -0.1}, {-0.02, 0.0, -0.1}, {0.0, 0.02, -0.1}, {0.0, -0.02, -0.1}};
  constexpr int corners = 20;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    geom.vertices_m.push_back({0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.06});
  }
  geom.triangles = {{0, 1, 3}, {0, 3, 2}, {0, 2, 4}, {0, 4, 1}};
  for (int i = 0; i < corners; ++i) {
    const int a = 5 + i, b = 5 + (i + 1) % corners;
    geom.triangles.push_back({5, b, a});
    geom.triangles.push_back({1 + i % 4, a, b});
  }
  geom.size_m = {0.12, 0.0, 0.0};
  geom.position_m = {};
  geom.rotation = {};
  robot.bodies[0].com_m = {};
  robot.bodies[0].position_m.z = 0.119;
  Bench bench(GetParam(), robot);
  bench.steps(3);
  EXPECT_GT(bench.engine->com_m(0).z, 0.117) << "held up from the first millimetre on";
}

}  // namespace
}  // namespace amble::physics
