#include "amble/morphology/mjcf_writer.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

robot::RobotSpec load(const std::string& name) {
  return load_robot(std::string(AMBLE_SOURCE_DIR "/") + name + ".toml");
}

/// What MuJoCo reads from what was written of a robot, in that robot's own order.
robot::RobotSpec through_mjcf(const robot::RobotSpec& robot) {
  const Mjcf mjcf = write_mjcf(robot);
  ModelFile file;
  file.model = compile_mjcf(mjcf.text, "text");
  const ModelParts parts = extract_parts(file);
  robot::RobotSpec again = robot;
  again.gravity_m_s2 = parts.gravity_m_s2;
  for (std::size_t place = 0; place < parts.bodies.size(); ++place) {
    robot::Body& body = again.bodies[static_cast<std::size_t>(mjcf.bodies[place])];
    body = parts.bodies[place];
    if (body.parent >= 0) body.parent = mjcf.bodies[static_cast<std::size_t>(body.parent)];
  }
  for (std::size_t place = 0; place < parts.joints.size(); ++place) {
    robot::Joint& joint = again.joints[static_cast<std::size_t>(mjcf.joints[place])];
    const robot::Servo servo = joint.servo;
    joint = parts.joints[place];
    joint.body = mjcf.bodies[static_cast<std::size_t>(joint.body)];
    joint.servo = servo;
  }
  for (std::size_t place = 0; place < parts.geoms.size(); ++place) {
    robot::Geom& geom = again.geoms[static_cast<std::size_t>(mjcf.geoms[place])];
    geom = parts.geoms[place];
    geom.body = mjcf.bodies[static_cast<std::size_t>(geom.body)];
  }
  return again;
}

class EachRobot : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(MjcfWriter, EachRobot,
                         testing::Values("robots/quadruped/authors", "robots/quadruped/paper", "scenes/sled",
                                         "scenes/pendulum"));

TEST_P(EachRobot, IsReadBackByMujocoToTheBit) {
  const robot::RobotSpec robot = load(GetParam());
  EXPECT_EQ(to_json(through_mjcf(robot)).dump(1), to_json(robot).dump(1));
}

TEST(MjcfWriter, PutsABodyBehindItsParentWhateverTheOrderOfTheRobot) {
  // Upper legs first, then lower legs: MJCF nests them, leg by leg.
  robot::RobotSpec robot = load("robots/quadruped/paper");
  const std::vector<int> order{0, 1, 3, 5, 7, 2, 4, 6, 8};
  std::vector<int> now_at(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    now_at[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  const auto moved = [&](int body) { return body < 0 ? body : now_at[static_cast<std::size_t>(body)]; };
  const std::vector<robot::Body> before = robot.bodies;
  for (std::size_t i = 0; i < order.size(); ++i) {
    robot.bodies[i] = before[static_cast<std::size_t>(order[i])];
    robot.bodies[i].parent = moved(robot.bodies[i].parent);
  }
  for (robot::Joint& joint : robot.joints) joint.body = moved(joint.body);
  for (robot::Geom& geom : robot.geoms) geom.body = moved(geom.body);
  EXPECT_EQ(robot.bodies[5].name, "FL_lower");

  const Mjcf mjcf = write_mjcf(robot);
  EXPECT_EQ(mjcf.bodies, (std::vector<int>{0, 1, 5, 2, 6, 3, 7, 4, 8}));
  EXPECT_EQ(to_json(through_mjcf(robot)).dump(1), to_json(robot).dump(1));
}

TEST(MjcfWriter, AcceptsAnyNames) {
  robot::RobotSpec robot = load("robots/quadruped/paper");
  robot.name = R"(<"quadruped"> & 'friends')";
  for (robot::Body& body : robot.bodies) body.name = "world";
  for (robot::Geom& geom : robot.geoms) geom.name = "ground";
  for (robot::Joint& joint : robot.joints) joint.name = "a\"<&";
  const auto model = compile_mjcf(write_mjcf(robot).text, "text");
  EXPECT_EQ(std::string(model->names), robot.name);
  EXPECT_EQ(model->nbody, 10);
  EXPECT_EQ(model->njnt, 13);
}

/// The mean of a mesh's corners, in the frame of its body; for other shapes their place.
Vec3 middle_of_corners_m(const robot::Geom& geom) {
  Vec3 sum_m;
  for (const Vec3 vertex : geom.vertices_m) sum_m = sum_m + vertex;
  const auto count = static_cast<double>(std::max<std::size_t>(geom.vertices_m.size(), 1));
  return robot::Pose{geom.position_m, geom.rotation} * (1.0 / count * sum_m);
}

TEST(MjcfWriter, WritesMeshesBesideOtherShapes) {
  const robot::RobotSpec without = load("robots/quadruped/paper");
  for (const std::size_t meshes : {std::size_t{0}, std::size_t{1}, std::size_t{2}, without.geoms.size()}) {
    robot::RobotSpec robot = without;
    for (std::size_t g = 0; g < meshes; ++g) {
      robot::Geom& geom = robot.geoms[robot.geoms.size() - 1 - g];
      geom.shape = robot::Shape::mesh;
      const double edge_m = 0.01 * static_cast<double>(g + 1);
      geom.vertices_m = {{0.0, 0.0, 0.0}, {edge_m, 0.0, 0.0}, {0.0, edge_m, 0.0}, {0.0, 0.0, edge_m}};
      geom.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
    }
    const robot::RobotSpec again = through_mjcf(robot);
    for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
      EXPECT_EQ(again.geoms[g].shape, robot.geoms[g].shape) << meshes << " " << g;
      EXPECT_EQ(again.geoms[g].vertices_m.size(), robot.geoms[g].vertices_m.size());
      EXPECT_NEAR(norm(middle_of_corners_m(again.geoms[g]) - middle_of_corners_m(robot.geoms[g])), 0.0, 1e-6);
    }
  }
}

TEST(MjcfWriter, LetsLegsCollideOnlyIfTheRobotSaysSo) {
  for (const bool self_collision : {false, true}) {
    robot::RobotSpec robot = load("robots/quadruped/paper");
    robot.self_collision = self_collision;
    robot.geoms[0].collides = false;
    const auto model = compile_mjcf(write_mjcf(robot).text, "text");
    const auto meet = [&](int a, int b) {
      return ((model->geom_contype[a] & model->geom_conaffinity[b]) |
              (model->geom_contype[b] & model->geom_conaffinity[a])) != 0;
    };
    EXPECT_FALSE(meet(0, 1));  // the ground and what does not collide
    EXPECT_FALSE(meet(1, 4));
    EXPECT_TRUE(meet(0, 4));
    EXPECT_EQ(meet(4, 5), self_collision);
  }
}

TEST(MjcfWriter, WritesFrictionAsMujocoKnowsIt) {
  robot::RobotSpec robot = load("scenes/box");
  for (const auto& [friction, written, dimensions] :
       {std::tuple{0.5, 0.5, 3}, {0.0, 0.0, 1}, {std::numeric_limits<double>::infinity(), grip, 3}}) {
    robot.contact.friction = friction;
    const auto model = compile_mjcf(write_mjcf(robot).text, "text");
    EXPECT_EQ(model->geom_friction[3], written);
    EXPECT_EQ(model->geom_condim[1], dimensions);
  }
}

TEST(CompileMjcf, RefusesInOneLine) {
  try {
    compile_mjcf("<mujoco><worldbody><body/></worldbody>", "the text");
    FAIL() << "accepted";
  } catch (const UserError& error) {
    const std::string what = error.what();
    EXPECT_TRUE(what.starts_with("the text: MuJoCo refuses the model: ")) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos);
  }
}

TEST(MjcfWriter, WritesStopsAtEitherEndOfAJointOrAtBoth) {
  constexpr double none = std::numeric_limits<double>::infinity(), never_rad = 1e6;
  robot::RobotSpec robot = load("robots/quadruped/paper");
  const std::pair<double, double> stops[] = {
      {-0.5, 0.7}, {-none, 0.7}, {-0.5, none}, {-none, none}, {0.0, none}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    std::tie(robot.joints[j].lower_rad, robot.joints[j].upper_rad) = stops[j % std::size(stops)];
  const robot::RobotSpec again = through_mjcf(robot);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const auto [lower, upper] = stops[j % std::size(stops)];
    const bool limited = lower > -none || upper < none;
    EXPECT_EQ(again.joints[j].lower_rad, limited ? std::max(lower, -never_rad) : -none) << j;
    EXPECT_EQ(again.joints[j].upper_rad, limited ? std::min(upper, never_rad) : none) << j;
  }
}

}  // namespace
}  // namespace amble::morphology
