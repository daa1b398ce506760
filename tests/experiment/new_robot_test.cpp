#include "amble/experiment/new_robot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "amble/core/index.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/gait/body.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"
#include "tests/models/posed_models.hpp"
#include "tests/models/small_models.hpp"

namespace amble::experiment {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::flat_footed_biped;
using tests::FlatFootedLeg;
using tests::posed_legs;
using tests::posed_model;
using tests::PosedLeg;

class NewRobotOf : public testing::Test {
 protected:
  NewRobotOf() { std::filesystem::create_directories(folder_); }
  ~NewRobotOf() override { std::filesystem::remove_all(folder_); }

  NewRobot make(const std::string& text, const std::string& extension = ".xml") const {
    const auto path = folder_ / ("model" + extension);
    std::ofstream(path) << text;
    return make_new_robot(morphology::compile_model(path), path.filename(), folder_ / "model.toml");
  }

  /// A robot that is made from this model alone, and stands in the batch engine and in ODE.
  robot::RobotSpec standing(const std::string& text, std::size_t legs, const std::string& what) const {
    NewRobot made = make(text);
    if (!made.robot) {
      ADD_FAILURE() << what << ": " << fmt::format("{}", fmt::join(made.guess.asked, ", "));
      return {};
    }
    EXPECT_EQ(made.robot->legs.size(), legs) << what;
    for (const char* engine : {"batch", "ode"})
      EXPECT_THAT(odd_at_start(*made.robot, engine, 0.01), IsEmpty()) << what << " in " << engine;
    return std::move(*made.robot);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("amble_new_robot_" + std::to_string(getpid()));
};

std::vector<std::string> names_of(const robot::RobotSpec& robot) {
  std::vector<std::string> names;
  for (const robot::Leg& leg : robot.legs) names.push_back(leg.name);
  return names;
}

/// How far the feet are from below their hips, at most, as a share of the height of the hips.
double farthest_foot(const robot::RobotSpec& robot) {
  const auto poses = robot::start_poses(robot);
  const auto hips = robot::hips_m(robot, poses), feet = robot::feet_m(robot, poses);
  double farthest = 0.0;
  for (std::size_t l = 0; l < feet.size(); ++l)
    farthest = std::max(farthest, std::hypot(feet[l].x - hips[l].x, feet[l].y - hips[l].y));
  return farthest / robot::leg_height_m(robot);
}

TEST_F(NewRobotOf, QuadrupedsWhoseLegsAreElsewhereAtAngle0StandWithFeetBelowTheirHips) {
  const std::map<std::string, PosedLeg> ways{
      {"folded beside the trunk", {.thigh_deg = 90.0, .shin_deg = 180.0}},
      {"folded the other way", {.thigh_deg = -80.0, .shin_deg = 170.0}},
      {"stretched back", {.thigh_deg = 90.0}},
      {"stretched forward", {.thigh_deg = -90.0}},
      {"stretched to the sides", {.spread_deg = 90.0, .roll = "-110 110"}},
      {"stops that exclude 0", {.hip = "20 100", .knee = "-150 -60"}},
      {"stops that exclude 0 the other way", {.hip = "-100 -15", .knee = "45 150"}}};
  for (const auto& [what, leg] : ways) {
    const robot::RobotSpec robot = standing(posed_model(posed_legs(leg)), 4, what);
    EXPECT_THAT(names_of(robot), ElementsAre("LF", "RF", "LH", "RH")) << what;
    EXPECT_LT(farthest_foot(robot), 0.05) << what;
    for (const robot::Leg& leg_of : robot.legs)
      EXPECT_LT(robot::start_clearance_m(robot, leg_of.foot_geoms.front()), 0.002) << what;
  }
}

TEST_F(NewRobotOf, LegsThatPointUpAreBentDownIfTheirStopsAllow) {
  const PosedLeg up{.thigh_deg = 180.0, .hip = "-200 200"};
  const robot::RobotSpec robot = standing(posed_model(posed_legs(up)), 4, "up");
  EXPECT_GT(rotate(robot.bodies[0].rotation, Vec3{0.0, 0.0, 1.0}).z, 0.999);
}

TEST_F(NewRobotOf, ItsFileSaysWhatWasMadeAndWhy) {
  const NewRobot folded = make(posed_model(posed_legs({.thigh_deg = 90.0, .shin_deg = 180.0})));
  EXPECT_THAT(folded.guess.settled,
              Contains(AllOf(HasSubstr("no leg was found"), HasSubstr("[start_angle]"))));
  EXPECT_THAT(folded.guess.toml,
              AllOf(HasSubstr("A standing start"), HasSubstr("[start_angle]\nLF_fold = ")));
}

TEST_F(NewRobotOf, RobotsThatStandAreLeftAsTheyAre) {
  for (const tests::SmallModel& model : tests::small_models()) {
    if (model.name == "effort") continue;  // its knees are outside their stops at angle 0
    const NewRobot made = make(model.text, "." + model.extension);
    ASSERT_TRUE(made.robot) << model.name;
    EXPECT_THAT(made.guess.settled, Not(Contains(HasSubstr("as the model starts")))) << model.name;
    EXPECT_THAT(made.guess.toml, Not(HasSubstr("start_angle"))) << model.name;
  }
}

TEST_F(NewRobotOf, HexapodsFoldedOrFlatStandWithTheirFeetOutside) {
  for (const auto& [femur, tibia] : {std::pair{-75.0, 165.0}, {0.0, 0.0}, {-60.0, 0.0}}) {
    const std::string what = fmt::format("{} {}", femur, tibia);
    const robot::RobotSpec robot = standing(tests::sprawling_hexapod(femur, tibia), 6, what);
    const auto poses = robot::start_poses(robot);
    const auto hips = robot::hips_m(robot, poses), feet = robot::feet_m(robot, poses);
    for (std::size_t l = 0; l < feet.size(); ++l)
      EXPECT_GT(std::abs(feet[l].y), std::abs(hips[l].y) + 0.02) << what;
  }
}

TEST_F(NewRobotOf, BipedsStandOnFlatFeetHoweverTheirKneesBend) {
  const std::string spheres =
      R"(<geom size="0.012" pos="-0.07 -0.03 -0.02" mass="0.05"/><geom size="0.012" pos="-0.07 0.03 -0.02" mass="0.05"/>
      <geom size="0.012" pos="0.1 -0.03 -0.02" mass="0.05"/><geom size="0.012" pos="0.1 0.03 -0.02" mass="0.05"/>)";
  const std::map<std::string, FlatFootedLeg> ways{{"forwards", {.knee = "25 130"}},
                                                  {"backwards", {.knee = "-130 -25"}},
                                                  {"on four balls", {.knee = "25 130", .foot = spheres}}};
  for (const auto& [what, leg] : ways) {
    const robot::RobotSpec robot = standing(flat_footed_biped(leg), 2, what);
    const auto poses = robot::start_poses(robot);
    for (const robot::Leg& leg_of : robot.legs) {
      const Quat foot = poses[to_index(robot.geoms[to_index(leg_of.foot_geoms.front())].body)].rotation;
      EXPECT_GT(rotate(foot, Vec3{0.0, 0.0, 1.0}).z, 0.999) << what;
    }
  }
}

TEST_F(NewRobotOf, JointsSlightlyOutsideTheirStopsGoToTheNearestAngleInside) {
  const NewRobot made = make(flat_footed_biped({.knee = "3 130"}));
  EXPECT_THAT(made.guess.toml, HasSubstr("[start_angle]\nleft_knee = 0.0524\nright_knee = 0.0524\n"));
  EXPECT_THAT(made.guess.settled, Contains(HasSubstr("left_knee, right_knee")));
  const NewRobot upper = make(flat_footed_biped({.knee = "-130 -3"}));
  EXPECT_THAT(upper.guess.toml, HasSubstr("[start_angle]\nleft_knee = -0.0524\nright_knee = -0.0524\n"));
}

/// A keyframe for posed_legs(): thighs and shins, one pair for each leg.
std::string key_of(const std::string& name, double height_m, double hip, double knee) {
  std::string qpos = fmt::format("0 0 {} 1 0 0 0", height_m);
  for (int l = 0; l < 4; ++l) qpos += fmt::format(" {} {}", hip, knee);
  return fmt::format(R"(<keyframe><key name="{}" qpos="{}"/></keyframe>)", name, qpos);
}

TEST_F(NewRobotOf, AKeyframeThatLiesIsSaidAndAnotherStartIsTaken) {
  const std::string lying = key_of("home", 0.06, 2.25, -2.55);
  const NewRobot default_pose = make(posed_model(posed_legs(), "", "", lying));
  EXPECT_THAT(default_pose.guess.settled, Contains(AllOf(HasSubstr("in its keyframe 'home' it "),
                                                         HasSubstr("its default pose is taken"))));
  EXPECT_THAT(default_pose.guess.toml, Not(HasSubstr("start = \"home\"")));

  const NewRobot second = make(posed_model(posed_legs(), "", "", lying + key_of("up", 0.25, 0.5, -1.0)));
  EXPECT_THAT(second.guess.toml, HasSubstr("start = \"up\""));

  const PosedLeg folded{.thigh_deg = 90.0, .shin_deg = 180.0};
  const NewRobot posed = make(posed_model(posed_legs(folded), "", "", key_of("home", 0.05, 0.1, 0.1)));
  EXPECT_THAT(posed.guess.toml, HasSubstr("A standing start"));
  for (const NewRobot* made : {&default_pose, &second, &posed}) {
    ASSERT_TRUE(made->robot);
    EXPECT_THAT(odd_at_start(*made->robot, "batch", 0.01), IsEmpty());
  }
}

TEST_F(NewRobotOf, AKeyframeWithBentKneesOfABipedIsTaken) {
  const std::string key =
      R"(<keyframe><key name="home" qpos="0 0 0.5 1 0 0 0 -0.3 0.6 -0.3 -0.3 0.6 -0.3"/></keyframe>)";
  EXPECT_THAT(make(flat_footed_biped({}, "", "", key)).guess.toml, HasSubstr("start = \"home\""));
}

TEST_F(NewRobotOf, ARootThatLiesIsTurnedUpright) {
  for (const char* turn : {R"(euler="90 0 0")", R"(euler="-90 0 0")", R"(euler="0 90 0")",
                           R"(euler="0 -90 0")", R"(euler="180 0 0")", R"(quat="0.5 0.5 0.5 0.5")"}) {
    const std::string model = posed_model(posed_legs({.hip = "-60 60", .knee = "-60 60"}), "", turn);
    const robot::RobotSpec robot = standing(model, 4, turn);
    const auto up = rotate(robot.bodies[0].rotation, Vec3{0.0, 0.0, 1.0});
    EXPECT_GT(up.z, 0.999) << turn;
    EXPECT_THAT(names_of(robot), ElementsAre("LF", "RF", "LH", "RH")) << turn;
  }
  const robot::RobotSpec biped =
      standing(flat_footed_biped({.knee = "20 130"}, "", R"(euler="0 90 0")"), 2, "biped");
  EXPECT_GT(rotate(biped.bodies[0].rotation, Vec3{0.0, 0.0, 1.0}).z, 0.999);
}

TEST_F(NewRobotOf, LegsThatDoNotMatchTheOthersStayLegs) {
  const auto with = [](auto change) {
    auto legs = posed_legs();
    change(legs);
    return posed_model(legs);
  };
  const std::map<std::string, std::string> ways{
      {"two spread", with([](auto& legs) { legs[0].spread_deg = legs[2].spread_deg = 55.0; })},
      {"two raised", with([](auto& legs) { legs[0].thigh_deg = legs[1].thigh_deg = -75.0; })},
      {"one short", with([](auto& legs) { legs[3].shin_m = 0.1; })},
      {"one raised", with([](auto& legs) { legs[1].thigh_deg = 85.0; })}};
  for (const auto& [what, model] : ways) {
    const robot::RobotSpec robot = standing(model, 4, what);
    EXPECT_EQ(robot.leg_joint_count(), 8u) << what;
    for (const robot::Leg& leg : robot.legs)
      EXPECT_LT(robot::start_clearance_m(robot, leg.foot_geoms.front()), 0.02) << what << " " << leg.name;
  }
}

std::string toes(int count) {
  std::string text;
  for (int t = 0; t < count; ++t)
    text += fmt::format(
        R"(<body name="NAME_digit{0}" pos="0.01 {1} -0.14"><joint name="NAME_curl{0}" axis="0 1 0" range="-25 25"/>
        <geom type="capsule" fromto="0 0 0 0.03 0 -0.01" size="0.008" mass="0.01"/></body>)",
        t, 0.02 * t - 0.01 * (count - 1));
  return text;
}

TEST_F(NewRobotOf, ToesAndLeversLeaveTheLegsAndAreNamed) {
  const std::string lever =
      R"(<body name="NAME_rod" pos="0.01 0 -0.04"><joint name="NAME_pivot" axis="0 1 0"/>
      <geom type="box" size="0.02 0.004 0.004" mass="0.01"/></body>)";
  const std::map<std::string, std::pair<PosedLeg, std::string>> ways{
      {"two toes", {{.on_shin = toes(2), .ball = false}, "LF_curl0"}},
      {"three toes", {{.on_shin = toes(3), .ball = false}, "RH_curl2"}},
      {"a lever on the shin", {{.on_shin = lever}, "LH_pivot"}},
      {"a lever on the thigh", {{.on_thigh = lever}, "RF_pivot"}}};
  for (const auto& [what, way] : ways) {
    const std::string model = posed_model(posed_legs(way.first));
    const robot::RobotSpec robot = standing(model, 4, what);
    EXPECT_EQ(robot.joints.size(), 8u) << what;
    EXPECT_EQ(robot.leg_joint_count(), 8u) << what;
    EXPECT_THAT(make(model).guess.settled, Contains(HasSubstr(way.second))) << what;
  }
}

TEST_F(NewRobotOf, ARobotThatFacesElsewhereIsTurnedToFaceXAndItsGaitIsNamedSo) {
  // The same quadruped, its legs placed and its hinges turned by the angle.
  for (const double deg : {90.0, -90.0, 180.0}) {
    const double c = std::cos(deg * std::numbers::pi / 180.0), s = std::sin(deg * std::numbers::pi / 180.0);
    for (const bool named : {true, false}) {
      auto legs = posed_legs();
      for (std::size_t l = 0; l < 4; ++l) {
        PosedLeg& leg = legs[l];
        leg = {.name = named ? leg.name : fmt::format("m{}", 7 * l % 4),
               .x = c * leg.x - s * leg.y,
               .y = s * leg.x + c * leg.y,
               .axis = fmt::format("{} {} 0", -s, c)};
      }
      const std::string snout = fmt::format(
          R"(<body name="snout" pos="{} {} 0.03"><joint name="nod" axis="0 0 1" range="-40 40"/><geom size="0.02" mass="0.05"/></body>)",
          0.26 * c, 0.26 * s);
      const robot::RobotSpec robot = standing(posed_model(legs, snout), 4, fmt::format("{} {}", deg, named));
      const auto hips = robot::hips_m(robot, robot::start_poses(robot));
      const auto quadruped = gait::body_of(robot).quadruped;
      ASSERT_TRUE(quadruped);
      if (named) {
        EXPECT_THAT(names_of(robot), ElementsAre("LF", "RF", "LH", "RH"));
        EXPECT_EQ(robot.legs[to_index(quadruped->fore_left)].name, "LF");
        EXPECT_EQ(robot.legs[to_index(quadruped->hind_right)].name, "RH");
      }
      EXPECT_NEAR(hips[to_index(quadruped->fore_left)].x, 0.18, 1e-6);
      EXPECT_NEAR(hips[to_index(quadruped->fore_left)].y, 0.11, 1e-6);
    }
  }
}

TEST_F(NewRobotOf, LimbsOfTheTrunkAreHeldAndNamed) {
  const std::string tail =
      R"(<body name="whip" pos="-0.21 0 0"><joint name="whip1" axis="0 1 0" range="-60 60"/>
      <geom type="capsule" fromto="0 0 0 -0.13 0 0" size="0.01" mass="0.05"/>
      <body name="whip_tip" pos="-0.15 0 0"><joint name="whip2" axis="0 1 0" range="-60 60"/>
      <geom type="capsule" fromto="0 0 0 -0.13 0 0" size="0.01" mass="0.05"/></body></body>)";
  const PosedLeg folded{.thigh_deg = 90.0, .shin_deg = 180.0};
  const std::string model = posed_model(posed_legs(folded), tail);
  EXPECT_EQ(standing(model, 4, "a tail").leg_joint_count(), 8u);
  EXPECT_THAT(make(model).guess.settled, Contains(HasSubstr("of no leg: whip1, whip2")));

  std::string arms;
  for (const auto& [name, y] : {std::pair{"l", 0.16}, {"r", -0.16}})
    arms += fmt::format(
        R"(<body name="{0}_limb" pos="0 {1} 0.2"><joint name="{0}_raise" axis="0 1 0" range="-90 90"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="0.2"/>
        <body name="{0}_limb2" pos="0 0 -0.22"><joint name="{0}_bend" axis="0 1 0" range="-90 90"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.02" mass="0.1"/></body></body>)",
        name, y);
  EXPECT_EQ(standing(flat_footed_biped({.knee = "30 130"}, arms), 2, "arms").leg_joint_count(), 6u);
}

/// A biped with flat feet, whose knees are at their stop when they are straight.
std::string straight_biped(const char* lower_stop) {
  std::string text = R"(<robot name="b"><link name="base"><inertial><mass value="4"/>
<inertia ixx=".03" iyy=".03" izz=".03" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0 0 .1"/><geometry><box size=".12 .2 .2"/></geometry></collision></link>)";
  for (const std::string side : {"left", "right"}) {
    const double y = side == "left" ? 0.09 : -0.09;
    const auto link = [&](const char* name, double kg, double moment, const char* shape) {
      text += fmt::format(R"(<link name="{0}_{1}"><inertial><mass value="{2}"/>
<inertia ixx="{3}" iyy="{3}" izz="{3}" ixy="0" ixz="0" iyz="0"/></inertial><collision>{4}</collision></link>)",
                          side, name, kg, moment, shape);
    };
    const auto joint = [&](const char* name, const std::string& parent, const char* child, double y_m,
                           double z_m, const char* lower) {
      text += fmt::format(R"(<joint name="{0}_{1}" type="revolute"><parent link="{2}"/><child link="{0}_{3}"/>
<origin xyz="0 {4} {5}"/><axis xyz="0 1 0"/><limit lower="{6}" upper="1.5" effort="30" velocity="8"/></joint>)",
                          side, name, parent, child, y_m, z_m, lower);
    };
    constexpr const char* bone =
        R"(<origin xyz="0 0 -.12"/><geometry><cylinder radius=".03" length=".2"/></geometry>)";
    link("thigh", 0.8, 0.004, bone);
    link("shin", 0.5, 0.003, bone);
    link("foot", 0.2, 0.0005, R"(<origin xyz=".02 0 -.02"/><geometry><box size=".16 .08 .02"/></geometry>)");
    joint("hip", "base", "thigh", y, 0.0, "-1");
    joint("knee", side + "_thigh", "shin", 0.0, -0.25, lower_stop);
    joint("ankle", side + "_shin", "foot", 0.0, -0.25, "-.8");
  }
  return text + "</robot>";
}

// In ODE, and so in the batch engine, a motor that pushes against a stop gives all its torque.
TEST_F(NewRobotOf, ABipedWhoseMotorsWouldPushAgainstStopsStandsWithBentKnees) {
  const NewRobot at_stop = make(straight_biped("0"), ".urdf"), free = make(straight_biped("-.1"), ".urdf");
  ASSERT_TRUE(at_stop.robot && free.robot);
  for (const NewRobot* made : {&at_stop, &free})
    for (const char* engine : {"batch", "ode"})
      EXPECT_THAT(odd_at_start(*made->robot, engine, 0.01), IsEmpty()) << engine;
  EXPECT_THAT(at_stop.guess.toml, HasSubstr("with joints at their stops: left_knee, right_knee"));
  EXPECT_THAT(free.guess.toml, Not(HasSubstr("[start_angle]")));
}

}  // namespace
}  // namespace amble::experiment
