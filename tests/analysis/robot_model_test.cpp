#include "amble/analysis/robot_model.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "tests/analysis/fixture.hpp"

namespace amble::analysis {
namespace {

std::string error_after(const std::function<void(nlohmann::json&)>& change) {
  auto json = nlohmann::json::parse(tests::robot_json());
  change(json);
  return tests::error_of([&] { parse_robot(json.dump(), "walk.rec: robot"); });
}

TEST(RobotModel, IsReadFromJson) {
  const RobotModel robot = tests::robot();
  EXPECT_EQ(robot.name, "test robot");
  ASSERT_EQ(robot.bodies.size(), 9u);
  ASSERT_EQ(robot.joints.size(), 12u);
  ASSERT_EQ(robot.legs.size(), 4u);
  EXPECT_EQ(robot.joints[4].name, "FR_hip_fb");
  EXPECT_EQ(robot.joints[4].upper_rad, 0.8);
  EXPECT_EQ(robot.joint_types[2], "hip_io");
  EXPECT_EQ(robot.geoms[3].shape, Shape::sphere);
  EXPECT_EQ(robot.legs[1].foot_geom, 6);
}

TEST(RobotModel, OrdersTheJointsOfABodyByTheirChain) {
  EXPECT_EQ(tests::robot().joints_of_body(1), (std::vector<int>{2, 1}));
  EXPECT_EQ(tests::robot().joints_of_body(0), (std::vector<int>{}));
}

TEST(RobotModel, KnowsWhichBodiesBelongToALeg) {
  const RobotModel robot = tests::robot();
  EXPECT_EQ(robot.leg_of_body(0), -1);
  EXPECT_EQ(robot.leg_of_body(1), 0);
  EXPECT_EQ(robot.leg_of_body(8), 3);
}

TEST(RobotModel, ABodyThatHangsOnALegBelongsToIt) {
  auto json = nlohmann::json::parse(tests::robot_json());
  auto toe = json["bodies"][2];
  toe["parent"] = 2;
  json["bodies"].push_back(toe);
  EXPECT_EQ(parse_robot(json.dump(), "x").leg_of_body(9), 0);
}

TEST(RobotModel, HasItsCentreOfMassWhereTheMassesSay) {
  // 1 kg at z = 1; with two legs 2 × 0.1 kg at x = 0.5, z = 0.5.
  const Vec3 com = tests::robot(2).com_at_start_m();
  EXPECT_NEAR(com.x, 0.1 / 1.2, 1e-12);
  EXPECT_NEAR(com.y, 0.0, 1e-12);
  EXPECT_NEAR(com.z, 1.1 / 1.2, 1e-12);
}

TEST(RobotModel, NamesWhatIsWrong) {
  EXPECT_EQ(error_after([](auto& json) { json.erase("geoms"); }), "walk.rec: robot: key 'geoms' is missing");
  EXPECT_EQ(error_after([](auto& json) { json["bodies"][1]["parent"] = 1; }),
            "walk.rec: robot: key 'bodies[1].parent' must be a whole number from 0 to 0");
  EXPECT_EQ(error_after([](auto& json) { json["geoms"][0]["body"] = 9; }),
            "walk.rec: robot: key 'geoms[0].body' must be a whole number from 0 to 8");
  EXPECT_EQ(error_after([](auto& json) { json["geoms"][0]["shape"] = "cone"; }),
            "walk.rec: robot: key 'geoms[0].shape' must be one of sphere, capsule, cylinder, box");
  EXPECT_EQ(error_after([](auto& json) {
              json["joints"][0]["axis"] = {0, 1};
            }),
            "walk.rec: robot: key 'joints[0].axis' must be a list of 3 numbers");
  EXPECT_EQ(error_after([](auto& json) { json["joints"][0]["upper_rad"] = "inf"; }),
            "walk.rec: robot: key 'joints[0].upper_rad' must be a finite number");
  EXPECT_EQ(error_after([](auto& json) { json["legs"][0]["joints"] = {0}; }),
            "walk.rec: robot: key 'legs[0].joints' must be a list with a joint for each joint type");
  EXPECT_EQ(error_after([](auto& json) { json["legs"] = nlohmann::json::array(); }),
            "walk.rec: robot: key 'legs' must be a list with at least one leg");
  EXPECT_EQ(error_after([](auto& json) {
              for (auto& body : json["bodies"]) body["mass_kg"] = 0;
            }),
            "walk.rec: robot: key 'bodies' must be a list of bodies with mass");
}

}  // namespace
}  // namespace amble::analysis
