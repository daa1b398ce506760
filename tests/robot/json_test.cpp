#include "amble/robot/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/random.hpp"
#include "amble/morphology/robot_file.hpp"
#include "tests/robot/legged.hpp"

namespace amble::robot {
namespace {

using morphology::load_robot;

RobotSpec quadruped() {
  return load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
}

RobotSpec through_text(const RobotSpec& robot) {
  const io::Json parsed = io::Json::parse(to_json(robot).dump());
  return from_json({parsed, "FILE", "robot"});
}

TEST(RobotJson, WritesHeldTorquesAndFurtherFallsOnlyWhereThereAreSome) {
  RobotSpec robot = quadruped();
  const std::string text = to_json(robot).dump();
  for (const char* key : {"hold_torque", "fall_above_m", "fall_tilt_rad"})
    EXPECT_EQ(text.find(key), std::string::npos) << key;
  EXPECT_TRUE(std::isinf(through_text(robot).fall_above_m) && std::isinf(through_text(robot).fall_tilt_rad));
  robot.fall_above_m = 2.5;
  robot.fall_tilt_rad = 0.1;
  robot.joints[1].servo = {.mode = ServoMode::torque,
                           .gain_per_s = 0.0,
                           .max_torque_nm = 3.0,
                           .kp_nm_per_rad = 2.0,
                           .kd_nm_s_per_rad = 1.0,
                           .hold_torque = true};
  const RobotSpec again = through_text(robot);
  EXPECT_EQ(again.fall_above_m, 2.5);
  EXPECT_EQ(again.fall_tilt_rad, 0.1);
  EXPECT_TRUE(again.joints[1].servo.hold_torque);
  EXPECT_FALSE(again.joints[0].servo.hold_torque);
}

TEST(RobotJson, ReadsBackTheSameRobotToTheBit) {
  RobotSpec robot = quadruped();
  // Numbers without a short decimal form.
  Stream stream(3, Purpose::test);
  for (Body& body : robot.bodies) {
    body.mass_kg *= stream.uniform(0.5, 2.0);
    body.com_m = {stream.normal(), stream.normal(), 1e-300 * stream.normal()};
    body.inertia_rotation = axis_angle({0.0, 0.6, 0.8}, stream.uniform());
  }
  for (Geom& geom : robot.geoms) geom.rgba[1] = static_cast<float>(stream.uniform());
  robot.joints[3].servo = {.mode = ServoMode::torque,
                           .gain_per_s = 0.0,
                           .kp_nm_per_rad = stream.uniform(),
                           .kd_nm_s_per_rad = 0.1};

  const RobotSpec again = through_text(robot);
  EXPECT_EQ(to_json(again), to_json(robot));
  EXPECT_EQ(to_json(again).dump(), to_json(robot).dump());
  for (std::size_t b = 0; b < robot.bodies.size(); ++b) {
    EXPECT_EQ(again.bodies[b].mass_kg, robot.bodies[b].mass_kg);
    EXPECT_EQ(again.bodies[b].com_m, robot.bodies[b].com_m);
    EXPECT_EQ(again.bodies[b].inertia_rotation, robot.bodies[b].inertia_rotation);
  }
  for (std::size_t g = 0; g < robot.geoms.size(); ++g) {
    EXPECT_EQ(again.geoms[g].rgba, robot.geoms[g].rgba);
    EXPECT_EQ(again.geoms[g].shape, robot.geoms[g].shape);
    EXPECT_EQ(again.geoms[g].collides, robot.geoms[g].collides);
  }
  EXPECT_EQ(again.joints[3].servo.mode, ServoMode::torque);
  EXPECT_EQ(again.joints_of_body(1), robot.joints_of_body(1));
}

TEST(RobotJson, KeepsWhatOnlySomeRobotsHave) {
  RobotSpec robot = quadruped();
  const std::string before = to_json(robot).dump();
  for (const char* key : {"command_rad", "armature", "damping", "friction_loss", "stiffness", "rest_rad",
                          "foot_geoms", "vertices_m", "sweeps"})
    EXPECT_EQ(before.find(key), std::string::npos) << key;  // so that its hash is what it was

  constexpr double infinity = std::numeric_limits<double>::infinity();
  Joint& joint = robot.joints[3];
  joint.upper_rad = infinity;
  joint.command = AngleRange{-0.1, 1.0 / 3.0};
  joint.armature_kg_m2 = 0.1 / 3.0;
  joint.damping_nm_s_per_rad = 0.2 / 3.0;
  joint.friction_loss_nm = 0.4 / 3.0;
  robot.contact.sweeps = 80;
  Geom& geom = robot.geoms[0];
  geom.shape = Shape::mesh;
  geom.vertices_m = {{0, 0, 1.0 / 3.0}, {0.1, 0, 0}, {0, 0.1, 0}, {-0.1, -0.1, 0}};
  geom.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  geom.size_m = {0.34, 0, 0};

  const RobotSpec again = through_text(robot);
  EXPECT_EQ(to_json(again).dump(), to_json(robot).dump());
  EXPECT_EQ(again.joints[3].upper_rad, infinity);
  ASSERT_TRUE(again.joints[3].command);
  EXPECT_EQ(again.joints[3].command->upper_rad, 1.0 / 3.0);
  EXPECT_EQ(again.joints[3].armature_kg_m2, 0.1 / 3.0);
  EXPECT_EQ(again.joints[3].damping_nm_s_per_rad, 0.2 / 3.0);
  EXPECT_EQ(again.joints[3].friction_loss_nm, 0.4 / 3.0);
  EXPECT_EQ(again.contact.sweeps, 80);
  EXPECT_EQ(again.geoms[0].vertices_m, geom.vertices_m);
  EXPECT_EQ(again.geoms[0].triangles, geom.triangles);
}

TEST(RobotJson, KeepsJointsWithoutAMotorAndTheirSprings) {
  RobotSpec robot = tests::legged_robot(1);
  const int held = robot.legs[1].joints[2];
  robot.legs[1].joints[2] = -1;
  Joint& joint = robot.joints[to_index(held)];
  joint.servo = {.mode = ServoMode::none, .gain_per_s = 0.0, .max_torque_nm = 0.0};
  joint.command = AngleRange{};
  joint.stiffness_nm_per_rad = 7.0 / 3.0;
  joint.rest_rad = -0.1 / 3.0;
  const RobotSpec again = through_text(robot);
  EXPECT_EQ(to_json(again).dump(), to_json(robot).dump());
  const Joint& read = again.joints[to_index(held)];
  EXPECT_FALSE(read.has_motor());
  EXPECT_FALSE(read.driven());
  EXPECT_EQ(read.stiffness_nm_per_rad, 7.0 / 3.0);
  EXPECT_EQ(read.rest_rad, -0.1 / 3.0);
}

TEST(RobotJson, WritesAFootOfOneShapeAsBeforeAndSeveralAsAList) {
  RobotSpec robot = tests::legged_robot(1);
  const int foot = robot.legs[0].foot_geoms[0];
  EXPECT_EQ(to_json(robot)["legs"][0]["foot_geom"], foot);
  robot.geoms.push_back(robot.geoms[to_index(foot)]);
  const int heel = static_cast<int>(robot.geoms.size()) - 1;
  robot.legs[0].foot_geoms = {heel, foot};
  const io::Json json = to_json(robot);
  EXPECT_EQ(json["legs"][0]["foot_geoms"], (std::vector<int>{heel, foot}));
  EXPECT_FALSE(json["legs"][0].contains("foot_geom"));
  EXPECT_TRUE(json["legs"][1].contains("foot_geom"));
  EXPECT_EQ(through_text(robot).legs[0].foot_geoms, (std::vector<int>{heel, foot}));
}

TEST(RobotJson, WritesInfiniteFrictionAsInf) {
  EXPECT_EQ(to_json(quadruped()).at("contact").at("friction"), "inf");
  EXPECT_TRUE(std::isinf(through_text(quadruped()).contact.friction));
}

TEST(RobotJson, RefusesWhatIsNotARobot) {
  const auto error_of = [](const std::function<void(io::Json&)>& change) -> std::string {
    io::Json json = to_json(quadruped());
    change(json);
    try {
      from_json({json, "FILE", "robot"});
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_file);
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of([](io::Json& j) { j.erase("gravity_m_s2"); }),
            "FILE: key 'robot.gravity_m_s2' is missing");
  EXPECT_EQ(error_of([](io::Json& j) { j["gravity_m_s2"].push_back(1.0); }),
            "FILE: key 'robot.gravity_m_s2' must be an array of 3 numbers");
  EXPECT_EQ(error_of([](io::Json& j) { j["geoms"][0]["shape"] = "blob"; }),
            error_of([](io::Json& j) { j["geoms"][0]["shape"] = "blub"; }));
  EXPECT_NE(error_of([](io::Json& j) {
              j["geoms"][0]["shape"] = "blob";
            }).find("must be one of sphere, capsule, cylinder, box"),
            std::string::npos);
  EXPECT_EQ(error_of([](io::Json& j) { j["bodies"][1]["mass_kg"] = -1.0; }),
            "FILE: key 'robot' holds no valid robot: body 'FL_upper' must have a positive mass");
  EXPECT_EQ(error_of([](io::Json& j) { j["bodies"][1]["mass_kg"] = "inf"; }),
            "FILE: key 'robot' holds no valid robot: body 'FL_upper' must have a positive mass");
  EXPECT_EQ(
      error_of([](io::Json& j) { j["joints"][0]["body"] = 900; }),
      "FILE: key 'robot' holds no valid robot: joint 'FL_knee' names a body that is not there, or the root");
}

TEST(RobotJson, TellsListsOfAWrongLengthAndIndicesOutOfRange) {
  const auto error_at = [](const char* pointer, const io::Json& value) -> std::string {
    io::Json json = to_json(quadruped());
    json[io::Json::json_pointer(pointer)] = value;
    try {
      from_json({json, "FILE", "robot"});
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto says = [&](const char* pointer, const io::Json& value, const char* expected) {
    EXPECT_NE(error_at(pointer, value).find(std::string(" must be ") + expected), std::string::npos)
        << pointer << ": " << error_at(pointer, value);
  };
  const io::Json two{1.0, 0.0}, three{1.0, 0.0, 0.0}, four{1.0, 0.0, 0.0, 0.0}, five{1.0, 0.0, 0.0, 0.0, 0.0};
  for (const char* pointer : {"/bodies/1/position_m", "/joints/0/axis", "/geoms/0/size_m"})
    for (const io::Json& value : {two, four}) says(pointer, value, "an array of 3 numbers");
  for (const char* pointer : {"/bodies/1/rotation", "/geoms/0/rotation", "/geoms/0/rgba"})
    for (const io::Json& value : {three, five}) says(pointer, value, "an array of 4 numbers");
  for (const io::Json& value : {io::Json{0.0}, three})
    says("/joints/0/command_rad", value, "an array of 2 numbers");
  EXPECT_EQ(error_at("/joints/0/command_rad", {0.0, 0.0}), "accepted");
  for (const char* pointer : {"/bodies/1/parent", "/joints/0/body", "/joints/0/chain_index", "/geoms/0/body",
                              "/legs/0/foot_geom", "/legs/0/joints/0", "/contact/sweeps"})
    for (const int value : {-2, 1'000'001}) says(pointer, value, "an index");
  for (const int value : {-1, 1'000'000})
    EXPECT_NE(error_at("/joints/0/body", value).find("names a body that is not there"), std::string::npos)
        << value;
  EXPECT_EQ(error_at("/joints/0/chain_index", 1'000'000), "accepted");
  says("/joints/0/servo/mode", "force", "one of velocity, torque");
}

}  // namespace
}  // namespace amble::robot
