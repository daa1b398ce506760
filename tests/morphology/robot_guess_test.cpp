#include "amble/morphology/robot_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "amble/core/random.hpp"
#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/robot/pose.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using tests::four_legs;
using tests::model_text;
using tests::SmallModel;

SmallModel model_of(const std::string& name) {
  for (const SmallModel& model : tests::small_models())
    if (model.name == name) return model;
  throw std::logic_error("no such model");
}

/// The robot file that is guessed.
RobotGuess guess(const Files& files, const SmallModel& model) {
  const std::string name = model.name + "." + model.extension;
  return guess_robot(compile_model(files.write(name, model.text)), name);
}

robot::RobotSpec load(const Files& files, const SmallModel& model) {
  return load_robot(files.write(model.name + ".toml", guess(files, model).toml));
}

LegsGuess legs_of(const Files& files, const std::string& text) {
  return guess_legs(extract_parts(compile_model(files.write("m.xml", text))));
}

class EachModel : public testing::TestWithParam<SmallModel> {};
INSTANTIATE_TEST_SUITE_P(RobotGuess, EachModel, testing::ValuesIn(tests::small_models()),
                         [](const auto& each) { return each.param.name; });

TEST_P(EachModel, BecomesARobotThatStands) {
  const Files files;
  const RobotGuess guessed = guess(files, GetParam());
  EXPECT_TRUE(guessed.asked.empty());
  const robot::RobotSpec robot = load(files, GetParam());
  EXPECT_EQ(robot.legs.size(), GetParam().legs);
  EXPECT_EQ(std::ranges::count_if(robot.joints, &robot::Joint::driven), static_cast<int>(GetParam().driven));
  EXPECT_EQ(robot.joints.size(), GetParam().driven + GetParam().held);
  double lowest = 1.0;
  for (const robot::Leg& leg : robot.legs)
    lowest = std::min(lowest, robot::start_clearance_m(robot, leg.foot_geoms[0]));
  EXPECT_NEAR(lowest, 0.0, 1e-3);
  EXPECT_GE(lowest, -1e-9) << "not in the ground";
  for (const robot::Joint& joint : robot.joints) {
    const robot::AngleRange command = joint.command_range();
    EXPECT_GE(command.lower_rad, -0.8001);
    EXPECT_LE(command.upper_rad, 0.8001);
    EXPECT_GT(joint.servo.max_torque_nm, 0.0);
  }
  // It falls at half the height at which the root's centre of mass starts.
  const double com_m = (robot::start_poses(robot)[0] * robot.bodies[0].com_m).z;
  EXPECT_NEAR(robot.fall_height_m, 0.5 * com_m, 1.1e-3);
  EXPECT_LE(robot.fall_height_m, 0.5 * com_m);
}

TEST_P(EachModel, HasFixedJointsOnlyWhereAmbleHasNoSuchJoint) {
  const Files files;
  const std::string toml = guess(files, GetParam()).toml;
  const SideFile side = read_side_file(files.write("side.toml", toml));
  EXPECT_EQ(side.fixed,
            GetParam().name == "arm" ? std::vector<std::string>{"lift"} : std::vector<std::string>{});
}

TEST_P(EachModel, SaysWhyInALineOfAtMost120Columns) {
  const Files files;
  const std::string toml = guess(files, GetParam()).toml;
  for (std::size_t at = 0; at < toml.size(); at = toml.find('\n', at) + 1)
    EXPECT_LE(toml.find('\n', at) - at, 120u) << toml.substr(at, 120);
}

TEST(RobotGuess, TakesServosFromPositionActuators) {
  const Files files;
  const robot::Servo servo = load(files, model_of("keyframe")).joints[0].servo;
  EXPECT_EQ(servo.mode, robot::ServoMode::torque);
  EXPECT_EQ(servo.kp_nm_per_rad, 40.0);
  EXPECT_EQ(servo.max_torque_nm, 9.0);
}

TEST(RobotGuess, TakesServosFromAttributesThatThisMujocoDoesNotKnow) {
  const Files files;
  const robot::RobotSpec robot = load(files, model_of("newer_mujoco"));
  const auto& hip = robot.joints[1];
  ASSERT_EQ(hip.name, "FL_hip");
  EXPECT_EQ(hip.servo.kp_nm_per_rad, 30.0);
  EXPECT_EQ(hip.servo.kd_nm_s_per_rad, 1.5);
  EXPECT_EQ(hip.servo.max_torque_nm, 11.0);
}

TEST(RobotGuess, TakesEffortDampingAndFrictionFromUrdf) {
  const Files files;
  const robot::RobotSpec robot = load(files, model_of("effort"));
  const auto& hip = robot.joints[1];
  ASSERT_EQ(hip.name, "left_hip_joint");
  EXPECT_EQ(hip.servo.max_torque_nm, 12.0);
  EXPECT_EQ(hip.damping_nm_s_per_rad, 0.3);
  EXPECT_EQ(hip.friction_loss_nm, 0.1);
  // The knee cannot be straight: it starts inside its stops, by a fifth of its range.
  EXPECT_NEAR(robot.joints[0].upper_rad, 0.4, 1e-9);
}

TEST(RobotGuess, LetsATrunkOnSixLegsSinkNearlyToTheGround) {
  const Files files;
  const auto fall_height_m = [&](std::size_t pairs) {
    std::vector<tests::LegText> legs;
    for (std::size_t i = 0; i < 2 * pairs; ++i)
      legs.push_back({.name = std::string(1, static_cast<char>('a' + i)),
                      .x = 0.2 * (1.0 - static_cast<double>(i / 2)),
                      .y = i % 2 == 0 ? 0.12 : -0.12});
    return load(files, {"legs", "xml", model_text(legs), 2 * pairs, 4 * pairs, 0}).fall_height_m;
  };
  // Feet reach 0.43 m down; the trunk is 0.1 m high.
  EXPECT_NEAR(fall_height_m(2), 0.215, 1e-9);
  EXPECT_NEAR(fall_height_m(3), 0.05 + 0.1 * 0.38, 1.5e-3);  // rounded down to the millimetre
}

TEST(RobotGuess, TakesAGainThatKeepsToTheVelocityLimitOfUrdf) {
  const Files files;
  SmallModel model = model_of("effort");
  // 5 rad/s with 0.8 rad to go.
  EXPECT_EQ(load(files, model).joints[0].servo.gain_per_s, 6.25);
  for (std::size_t at = 0; (at = model.text.find("velocity=\"5\"", at)) != std::string::npos;)
    model.text.replace(at, 12, "velocity=\"8\"");
  EXPECT_EQ(load(files, model).joints[0].servo.gain_per_s, 9.0);
}

TEST(RobotGuess, TakesNoEffortLimitThatStandsForNone) {
  const Files files;
  const auto torque_nm = [&](const std::string& effort) {
    SmallModel model = model_of("effort");
    model.text = with(with(model.text, "effort=\"12\"", effort), "effort=\"12\"", effort);
    const robot::RobotSpec robot = load(files, model);
    return robot.joints[1].servo.max_torque_nm;
  };
  // 3.6 kg and 4.2 kg of links; two legs of some 0.4 m bear less than 10 N m each.
  EXPECT_EQ(torque_nm("effort=\"300\""), 300.0);
  EXPECT_LT(torque_nm("effort=\"1000\""), 40.0);
  EXPECT_GT(torque_nm("effort=\"1000\""), 5.0);
  EXPECT_THAT(guess(files, model_of("effort")).toml, HasSubstr("the model's effort limit; gain"));
}

TEST(RobotGuess, GivesAMotorAGainThatBearsTheWeight) {
  const Files files;
  const SmallModel model{
      "motors",
      "xml",
      model_text(four_legs(), "<freejoint/>", "", tests::motors(R"(motor gear="2" ctrlrange="-3 3")")),
      4,
      8,
      0};
  const robot::RobotSpec robot = load(files, model);
  const robot::Servo servo = robot.joints[0].servo;
  EXPECT_EQ(servo.max_torque_nm, 6.0);
  // Weight × leg length / legs at 0.1 rad: 5.2 kg, 0.41 m to the foot's centre.
  EXPECT_NEAR(servo.kp_nm_per_rad * 0.1, 5.2 * 9.81 * 0.41 / 4, 0.01);
}

TEST(RobotGuess, LimitsAMotorByTheWeakerSideOfItsControlRangeAsOfAForceRange) {
  const Files files;
  for (const auto& [range, torque_nm] :
       {std::pair{"-3 1", 2.0}, {"-1 3", 2.0}, {"0 3", 6.0}, {"-3 3", 6.0}}) {
    const std::string motor = fmt::format(R"(motor gear="2" ctrlrange="{}")", range);
    const SmallModel model{
        "lopsided", "xml", model_text(four_legs(), "<freejoint/>", "", tests::motors(motor)), 4, 8, 0};
    EXPECT_EQ(load(files, model).joints[0].servo.max_torque_nm, torque_nm) << range;
    const auto stronger = testing::Contains(HasSubstr("stronger to one side")),
               alone = testing::Contains(HasSubstr("pushes to one side alone"));
    const std::vector<std::string> doubts = guess(files, model).doubts;
    if (std::string_view(range) == "-3 3")
      EXPECT_THAT(doubts, AllOf(Not(stronger), Not(alone))) << range;
    else if (std::string_view(range) == "0 3")
      EXPECT_THAT(doubts, AllOf(Not(stronger), alone)) << range;
    else
      EXPECT_THAT(doubts, AllOf(stronger, Not(alone))) << range;
  }
}

TEST(RobotGuess, CountsGearsInTheGainsAndTorquesOfPositionActuators) {
  // Torque = gear × force, force = kp (control − gear × angle).
  const Files files;
  const SmallModel model{
      "geared",
      "xml",
      model_text(
          four_legs(), "<freejoint/>", "",
          tests::motors(
              R"(general biastype="affine" gainprm="40" biasprm="0 -40 -2" gear="3" forcerange="-9 9")")),
      4,
      8,
      0};
  const robot::Servo servo = load(files, model).joints[0].servo;
  EXPECT_EQ(servo.mode, robot::ServoMode::torque);
  EXPECT_EQ(servo.kp_nm_per_rad, 360.0);
  EXPECT_EQ(servo.kd_nm_s_per_rad, 18.0);
  EXPECT_EQ(servo.max_torque_nm, 27.0);
}

TEST(RobotGuess, CommandsEachLegWithinItsOwnStops) {
  // Hips of the front legs turn further than commands are to reach, those of the hind legs do not.
  const Files files;
  std::vector<tests::LegText> legs = four_legs();
  legs[0].hip = legs[1].hip = R"(range="-90 90")";
  const robot::RobotSpec robot = load(files, {"two_ranges", "xml", model_text(legs), 4, 8, 0});
  for (std::size_t l = 0; l < 4; ++l) {
    const auto hip = std::ranges::find(robot.joints, robot.legs[l].name + "_hip", &robot::Joint::name);
    ASSERT_NE(hip, robot.joints.end());
    const double farthest_rad = l < 2 ? 0.8 : 40.0 * std::acos(-1.0) / 180.0;
    EXPECT_NEAR(hip->command_range().lower_rad, -farthest_rad, 1e-3) << l;
    EXPECT_NEAR(hip->command_range().upper_rad, farthest_rad, 1e-3) << l;
  }
}

TEST(RobotGuess, GivesJointsWithoutMotorsTwiceTheTorqueThatBearsTheWeight) {
  const Files files;
  const robot::Servo servo = load(files, model_of("no_limits")).joints[0].servo;
  EXPECT_EQ(servo.mode, robot::ServoMode::velocity);
  EXPECT_NEAR(servo.max_torque_nm, 2 * 5.2 * 9.81 * 0.41 / 4, 0.01);
}

TEST(RobotGuess, TakesSoftnessFromTheMass) {
  const Files files;
  EXPECT_NEAR(load(files, model_of("head")).contact.cfm_s_per_kg, 1e-4 * 5.4 / 5.4, 2e-6);
}

TEST(RobotGuess, TakesFrictionFromFootAndFloorAsMujocoDoes) {
  const Files files;
  const std::string text = model_of("head").text, floor = R"(<geom type="plane" size="9 9 1")";  // feet: 0.7
  const auto of = [&](const std::string& of_floor, const std::string& behind = "") {
    const std::string model = with(with(text, floor, floor + of_floor), "</mujoco>", behind + "</mujoco>");
    return guess(files, {"floor", "xml", model, 4, 8, 1}).toml;
  };
  EXPECT_THAT(of(R"( friction="0.5")"),
              HasSubstr("friction = 0.7  # the greater of the first foot's, 0.7, and the floor's, 0.5"));
  EXPECT_THAT(of(R"( friction="1.5")"), HasSubstr("friction = 1.5  # the greater"));
  EXPECT_THAT(of(R"( friction="0.5" priority="1")"),
              HasSubstr("friction = 0.5  # of the floor, which has the "
                        "higher priority; the first foot has 0.7"));
  EXPECT_THAT(of(R"( friction="1.5" priority="-1")"), HasSubstr("friction = 0.7  # of the first foot"));
  // A plane that nothing touches is no floor.
  for (const std::string& without :
       {with(text, floor + "/>", ""), with(text, floor, floor + R"( contype="0" conaffinity="0")")})
    EXPECT_THAT(guess(files, {"floor", "xml", without, 4, 8, 1}).toml,
                HasSubstr("friction = 0.7  # of the first foot in the model, which has no floor"));
}

TEST(RobotGuess, DoubtsFeetThatTheFloorOfTheModelDoesNotBearOrHold) {
  const Files files;
  const std::string text = model_of("head").text, floor = R"(<geom type="plane" size="9 9 1")";
  const auto doubts = [&](const std::string& model) {
    std::string all;
    for (const std::string& doubt : guess(files, {"floor", "xml", model, 4, 8, 1}).doubts)
      all += doubt + "\n";
    return all;
  };
  const std::string of_head = doubts(text);
  EXPECT_THAT(of_head, Not(HasSubstr("feet of these legs")));
  EXPECT_THAT(doubts(with(text, floor, floor + R"( contype="2" conaffinity="4")")),
              HasSubstr("the feet of these legs go through the model's floor"));
  EXPECT_THAT(doubts(with(text, "</mujoco>", R"(<default><geom condim="1"/></default></mujoco>)")),
              HasSubstr("the feet of these legs have no friction on the model's floor"));
  // By the floor's higher priority.
  EXPECT_THAT(doubts(with(text, floor, floor + R"( condim="1" priority="1")")), HasSubstr("by condim = 1"));
  EXPECT_EQ(doubts(with(text, floor, floor + R"( condim="1")")), of_head) << "the greater one counts";
  EXPECT_EQ(doubts(with(text, floor + "/>", "")), of_head) << "amble's own floor has friction";
}

TEST(RobotGuess, DoubtsActuatorsThatAreNoServosOfAnAngle) {
  const Files files;
  const auto doubts = [&](const std::string& actuator) {
    const SmallModel model{"odd", "xml", model_text(four_legs(), "<freejoint/>", "", tests::motors(actuator)),
                           4,     8,     0};
    std::string all;
    for (const std::string& doubt : guess(files, model).doubts) all += doubt + "\n";
    return all;
  };
  EXPECT_THAT(doubts(R"(damper kv="2" ctrlrange="0 5")"), HasSubstr("a damper, which only brakes"));
  EXPECT_THAT(doubts(R"(muscle force="10")"), HasSubstr("a muscle, which only pulls"));
  EXPECT_THAT(doubts(R"(intvelocity kp="20" ctrlrange="-3 3" actrange="-1 1")"),
              HasSubstr("integrates its control"));
  EXPECT_THAT(doubts(R"(position kp="20" forcerange="0 5")"),
              AllOf(HasSubstr("acts to one side alone"), Not(HasSubstr("the weaker"))));
  EXPECT_THAT(doubts(R"(position kp="0.2" forcerange="-5 5")"), HasSubstr("is not held even 0.8 rad"));
  EXPECT_THAT(doubts(R"(position kp="200" forcerange="-5 5")"), Not(HasSubstr("is not held even")));
}

TEST(RobotGuess, DoubtsShinsWithoutShapesAndWhatTheModelSwitchesOffOrTiesDown) {
  const Files files;
  const std::string text = model_of("head").text;
  const auto doubts = [&](const std::string& model) {
    std::string all;
    for (const std::string& doubt : guess(files, {"changed", "xml", model, 4, 8, 1}).doubts)
      all += doubt + "\n";
    return all;
  };
  const std::string before = doubts(text);
  for (const char* const what : {"no shape that collides", "disables", "one end is not on the robot"})
    EXPECT_THAT(before, Not(HasSubstr(what)));
  EXPECT_THAT(doubts(with(text, "</mujoco>", R"(<option><flag contact="disable"/></option></mujoco>)")),
              HasSubstr("disables contact"));
  EXPECT_THAT(doubts(with(text, "</mujoco>", R"(<equality><weld body1="trunk"/></equality></mujoco>)")),
              HasSubstr("one end is not on the robot, which is free to move"));
}

TEST(RobotGuess, ReadsSidesFromCodesWithANumberBehind) {
  const Files files;
  const auto of = [&](const char* left, const char* right) {
    std::string text = model_of("head").text;
    for (const auto& [was, is] : {std::pair{"FL_", left + std::string("1_")},
                                  {"RL_", left + std::string("2_")},
                                  {"FR_", right + std::string("1_")},
                                  {"RR_", right + std::string("2_")}})
      for (std::size_t at = 0; (at = text.find(was, at)) != std::string::npos; at += is.size())
        text.replace(at, 3, is);
    for (std::size_t at = 0; (at = text.find("head", at)) != std::string::npos; at += 4)
      text.replace(at, 4, "knob");
    return guess(files, {"coded", "xml", text, 4, 8, 1}).toml;
  };
  EXPECT_THAT(of("L", "R"), Not(HasSubstr("start_rpy_deg")));
  EXPECT_THAT(of("R", "L"), HasSubstr("start_rpy_deg = [0, 0, 180]"));
}

TEST(RobotGuess, TakesTheSpeedAndTheAnglesThatActuatorsReach) {
  const Files files;
  const auto of = [&](const std::string& actuator) {
    return guess(files, {"reach", "xml", model_text(four_legs(), "<freejoint/>", "", tests::motors(actuator)),
                         4, 8, 0})
        .toml;
  };
  EXPECT_THAT(of(R"(velocity kv="5" ctrlrange="-1 1" forcerange="-5 5")"), HasSubstr("gain_per_s = 1.25"));
  EXPECT_THAT(of(R"(velocity kv="5" ctrlrange="-2 2" gear="2" forcerange="-5 5")"),
              HasSubstr("gain_per_s = 1.25"));
  EXPECT_THAT(of(R"(velocity kv="5" ctrlrange="-40 40" forcerange="-5 5")"), HasSubstr("gain_per_s = 9"));
  EXPECT_THAT(of(R"(intvelocity kp="20" ctrlrange="-0.1 0.1" actrange="-0.3 0.4")"),
              HasSubstr("knee = [-0.3, 0.4]\nhip = [-0.3, 0.4]"));
}

TEST(RobotGuess, CommandsWhatActuatorsTakeAsTargets) {
  const Files files;
  const auto of = [&](const std::string& attributes) {
    return guess(files, {"ranges", "xml",
                         model_text(four_legs(), "<freejoint/>", "",
                                    tests::motors("position kp=\"40\" " + attributes)),
                         4, 8, 0})
        .toml;
  };
  const std::string narrow = of(R"(ctrllimited="true" ctrlrange="-0.3 0.4")");
  EXPECT_THAT(narrow, HasSubstr("knee = [-0.3, 0.4]\nhip = [-0.3, 0.4]"));
  EXPECT_THAT(narrow, HasSubstr("within ctrlrange of position actuators"));
  EXPECT_THAT(of(R"(ctrllimited="true" ctrlrange="-0.6 0.8" gear="2")"), HasSubstr("knee = [-0.3, 0.4]"));
  EXPECT_THAT(of(R"(ctrllimited="true" ctrlrange="-0.6 0.8" gear="-2")"), HasSubstr("knee = [-0.4, 0.3]"));
  EXPECT_THAT(of(R"(ctrllimited="true" ctrlrange="0 1.5")"), HasSubstr("knee = [0, 0.8]"));
  EXPECT_THAT(of(R"(ctrllimited="true" ctrlrange="0.2 0.5")"), HasSubstr("knee = [0, 0.5]"))
      << "with the start";
  for (const char* wide :
       {R"(ctrllimited="true" ctrlrange="-3 3")", R"(ctrllimited="false" ctrlrange="-0.3 0.4")"})
    EXPECT_THAT(of(wide), AllOf(HasSubstr("knee = [-0.8, 0.8]"), Not(HasSubstr("ctrlrange")))) << wide;
}

TEST(RobotGuess, CommandsWithinTheSoftLimitsOfAUrdf) {
  const Files files;
  SmallModel model = model_of("effort");
  model.text = with(
      model.text, R"(<dynamics damping="0.3")",
      R"(<safety_controller k_velocity="1" soft_lower_limit="-0.2" soft_upper_limit="0.4"/><dynamics damping="0.3")");
  const RobotGuess guessed = guess(files, model);
  EXPECT_THAT(guessed.toml, HasSubstr("[command.left]\nhip = [-0.2, 0.4]"));
  EXPECT_THAT(guessed.toml, HasSubstr("within the soft limits of safety controllers (left_hip_joint)"));
  ReadingNotes notes;
  load_robot(files.write("effort.toml", guessed.toml), &notes);
  EXPECT_THAT(notes.text(), HasSubstr("left out  safety controllers"));
}

TEST(RobotGuess, FallsBelowACentreOfMassThatIsBelowTheGround) {
  const Files files;
  SmallModel model = model_of("effort");
  model.text = with(model.text, R"(<inertial><mass value="3"/>)",
                    R"(<inertial><origin xyz="0 0 -4"/><mass value="3"/>)");
  const robot::RobotSpec robot = load(files, model);
  EXPECT_LT(robot.fall_height_m, robot.bodies[0].position_m.z - 4.0);
  EXPECT_GT(robot.fall_height_m, robot.bodies[0].position_m.z - 5.0);
}

TEST(RobotGuess, RefusesLegsOfHundredsOfMetres) {
  const Files files;
  const auto of = [&](double knee_m) {
    std::string text = model_of("effort").text;
    for (int side = 0; side < 2; ++side)
      text = with(text, "<origin xyz=\"0 0 -0.2\"/><axis",
                  fmt::format("<origin xyz=\"0 0 {}\"/> <axis", knee_m));
    return files.error_of([&] { guess(files, {"giant", "urdf", text, 2, 4, 0}); });
  };
  EXPECT_EQ(of(-20.0), "accepted");
  EXPECT_THAT(of(-200.0), HasSubstr("giant.urdf: its legs are 200 m long, for which amble has no settings"));
}

TEST(RobotGuess, AsksForLegsWhereNoneTouchTheGround) {
  const Files files;
  const std::string text =
      R"(<mujoco><worldbody><body name="b" pos="0 0 1"><freejoint/><geom size="0.5"/>
         <body name="arm" pos="0 0 0.6"><joint name="j" axis="0 1 0" range="-20 20"/><geom size="0.1"/></body></body></worldbody></mujoco>)";
  const RobotGuess guessed = guess(files, {"ball", "xml", text, 0, 0, 1});
  EXPECT_THAT(guessed.asked, ElementsAre(HasSubstr("legs, joint_types and [names]")));
  // The servo of the file is that of its joints, legs or not.
  EXPECT_THAT(guessed.toml, HasSubstr("no motor in the model"));
  EXPECT_THAT(guessed.toml, testing::Not(HasSubstr("servo_of")));
}

TEST(LegGuess, NamesLegsAndTypesByTheWordsOfJoints) {
  const Files files;
  const LegsGuess legs = legs_of(files, model_of("uneven_legs").text);
  ASSERT_EQ(legs.legs.size(), 4u);
  EXPECT_EQ(legs.legs[0].name, "FL");
  EXPECT_EQ(legs.legs[3].name, "RR");
  EXPECT_THAT(legs.joint_types, ElementsAre("toe", "knee", "hip"));
  EXPECT_EQ(legs.legs[2].joint_of_type[0], -1);
}

TEST(LegGuess, NamesByPlaceAndAxisWhereNamesDoNotTell) {
  const Files files;
  std::string text = model_text(four_legs());
  int number = 0;
  for (const char* type : {"_hip\"", "_knee\""})
    for (const char* leg : {"FL", "FR", "RL", "RR"})
      text = with(text, std::string("joint name=\"") + leg + type,
                  fmt::format("joint name=\"motor{}\"", ++number));
  const LegsGuess legs = legs_of(files, text);
  std::vector<std::string> names;
  for (const LegGuess& leg : legs.legs) names.push_back(leg.name);
  EXPECT_THAT(names, ElementsAre("front_left", "front_right", "rear_left", "rear_right"));
  EXPECT_THAT(legs.joint_types, ElementsAre("pitch", "pitch2"));
}

TEST(LegGuess, NamesByTheBeginningOfJointNames) {
  const Files files;
  std::string text = model_text({{.name = "f", .x = 0.2}, {.name = "b", .x = -0.2}});
  for (const char* leg : {"f", "b"})
    for (const char* type : {"hip", "knee"})
      text = with(text, fmt::format("joint name=\"{}_{}\"", leg, type),
                  fmt::format("joint name=\"{}{}\"", leg, type));
  const LegsGuess legs = legs_of(files, text);
  ASSERT_EQ(legs.legs.size(), 2u);
  EXPECT_EQ(legs.legs[0].name, "f");
  EXPECT_EQ(legs.legs[1].name, "b");
  EXPECT_THAT(legs.joint_types, ElementsAre("knee", "hip"));
}

TEST(LegGuess, SeparatesNumbersFromWordsWhereItMust) {
  EXPECT_THAT(words_of("FR_hip_joint"), ElementsAre("FR", "hip", "joint"));
  EXPECT_THAT(words_of("FRHipJoint"), ElementsAre("FR", "Hip", "Joint"));
  EXPECT_THAT(words_of("leg1-knee"), ElementsAre("leg1", "knee"));
  EXPECT_THAT(words_of("knee12", true), ElementsAre("knee", "12"));
}

TEST(LegGuess, HoldsAWaistThatCarriesTwoLegs) {
  const Files files;
  std::vector<tests::LegText> legs = four_legs();
  std::string hind = R"(<body name="hind" pos="-0.3 0 0"><joint name="waist" axis="0 0 1" range="-20 20"/>
    <geom size="0.05" mass="0.5"/>)";
  for (std::size_t l = 2; l < 4; ++l) hind += tests::leg_text(legs[l]);
  legs.resize(2);
  const std::string text = model_text(legs, "<freejoint/>", hind + "</body>");
  const ModelParts parts = extract_parts(compile_model(files.write("m.xml", text)));
  const LegsGuess guessed = guess_legs(parts);
  ASSERT_EQ(guessed.held.size(), 1u);
  EXPECT_EQ(parts.joints[static_cast<std::size_t>(guessed.held[0])].name, "waist");
  ASSERT_EQ(guessed.legs.size(), 4u);
  for (const LegGuess& leg : guessed.legs) EXPECT_EQ(leg.joints.size(), 2u) << leg.name;
}

TEST(LegGuess, TakesAFootThatCollidesOnTheLastBody) {
  const Files files;
  const SmallModel model = model_of("mesh_feet");
  const ModelParts parts = extract_parts(compile_model(files.write("m.xml", model.text)));
  for (const LegGuess& leg : guess_legs(parts).legs)
    EXPECT_EQ(parts.geoms[static_cast<std::size_t>(leg.foot_geoms[0])].name, leg.name + "_foot");
}

TEST(RobotGuess, GivesEveryJointTheServoOfItsOwnActuator) {
  // The file names servos once where joints share them, so that what is alike and what differs is drawn: the
  // robot that is read from it has each joint's own.
  const Files files;
  for (std::uint32_t i = 0; i < 60; ++i) {
    Stream stream(1, Purpose::test, i);
    std::string text =
        model_text(four_legs(), "<freejoint/>",
                   R"(<body name="head" pos="0.3 0 0.1"><joint name="neck" axis="0 0 1" range="-60 60"/>
           <geom size="0.05" mass="0.2"/><body name="jaw" pos="0.1 0 0"><joint name="jaw" axis="0 1 0"
           range="-9 9"/><geom size="0.02" mass="0.1"/></body></body>)");
    const ModelParts parts = extract_parts(compile_model(files.write("plain.xml", text)));
    std::map<std::string, robot::Servo> expected;
    std::string actuators = "<actuator>";
    for (const robot::Joint& joint : parts.joints) {
      const double kp = 10.0 + stream.below(2), kv = stream.below(2), torque = 5.0 + stream.below(2);
      actuators += fmt::format(
          R"(<general joint="{}" biastype="affine" gainprm="{}" biasprm="0 -{} -{}" forcerange="-{} {}"/>)",
          joint.name, kp, kp, kv, torque, torque);
      expected[joint.name] = {robot::ServoMode::torque, 0.0, torque, kp, kv};
    }
    const SmallModel model{"drawn", "xml", with(text, "</mujoco>", actuators + "</actuator></mujoco>"),
                           4,       8,     2};
    const robot::RobotSpec robot = load(files, model);
    ASSERT_EQ(robot.joints.size(), expected.size());
    for (const robot::Joint& joint : robot.joints) {
      const robot::Servo& own = expected.at(joint.name);
      EXPECT_EQ(joint.servo.mode, own.mode);
      EXPECT_EQ(joint.servo.max_torque_nm, own.max_torque_nm) << i << joint.name;
      EXPECT_EQ(joint.servo.kp_nm_per_rad, own.kp_nm_per_rad) << i << joint.name;
      EXPECT_EQ(joint.servo.kd_nm_s_per_rad, own.kd_nm_s_per_rad) << i << joint.name;
    }
  }
}

TEST(LegGuess, NamesALegOfOneJointAsItNamesTheOthers) {
  const Files files;
  std::string text = model_text(four_legs());
  const std::size_t knee = text.find("<joint name=\"FL_knee\"");
  text.erase(knee, text.find("/>", knee) + 2 - knee);
  const LegsGuess legs = legs_of(files, text);
  std::vector<std::string> names;
  for (const LegGuess& leg : legs.legs) names.push_back(leg.name);
  EXPECT_THAT(names, ElementsAre("FL", "FR", "RL", "RR"));
  EXPECT_THAT(legs.joint_types, ElementsAre("knee", "hip"));
}

TEST(LegGuess, TakesLettersOfAnyAlphabetForPartsOfWords) {
  EXPECT_THAT(words_of("左前_hip"), ElementsAre("左前", "hip"));
  EXPECT_THAT(words_of("Löwe-знак2"), ElementsAre("Löwe", "знак2"));
  const Files files;
  // Their first bytes are the same, but no letter.
  std::string text = model_text(four_legs());
  for (const auto& [from, to] : std::initializer_list<std::pair<std::string, std::string>>{
           {"FL_", "é"}, {"FR_", "è"}, {"RL_", "ê"}, {"RR_", "ë"}})
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  for (const LegGuess& leg : legs_of(files, text).legs) EXPECT_EQ(leg.name.size() == 1, false) << leg.name;
}

TEST(RobotGuess, WritesAFileThatIsReadBackWhateverItsPartsAreCalled) {
  const Files files;
  const std::vector<std::string> odd{"左前", "{leg}_", "{type}.", "a\\\"b'"};
  std::string text = model_text(four_legs());
  const std::vector<std::string> plain{"FL_", "FR_", "RL_", "RR_"};
  for (std::size_t l = 0; l < 4; ++l) {
    std::string written = odd[l];
    if (const std::size_t quote = written.find('"'); quote != std::string::npos)
      written.replace(quote, 1, "&quot;");
    for (std::size_t at = 0; (at = text.find(plain[l], at)) != std::string::npos; at += written.size())
      text.replace(at, plain[l].size(), written);
  }
  const RobotGuess guess = guess_robot(compile_model(files.write("m.xml", text)), "m.xml");
  const robot::RobotSpec robot = load_robot(files.write("m.toml", guess.toml));
  ASSERT_EQ(robot.legs.size(), 4u);
  for (std::size_t l = 0; l < 4; ++l)
    EXPECT_EQ(robot.joints[static_cast<std::size_t>(robot.legs[l].joints[1])].name, odd[l] + "hip");
}

}  // namespace
}  // namespace amble::morphology
