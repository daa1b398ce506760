#include "amble/morphology/model_drives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::four_legs;
using tests::LegText;
using tests::model_text;

const std::string leg_motors = tests::motors(R"(position kp="40" forcerange="-9 9" forcelimited="true")");
/// A tail of two joints.
const std::string tail =
    R"(<body name="tail_a" pos="-.3 0 0"><joint name="tail_a" axis="0 0 1"/><geom size=".02" mass=".05"/>
       <body name="tail_b" pos="-.1 0 0"><joint name="tail_b" axis="0 0 1"/><geom size=".02" mass=".05"/></body></body>)";

struct Guessed {
  robot::RobotSpec robot;
  std::string toml, notes;

  const robot::Joint& joint(const std::string& name) const {
    return *std::ranges::find(robot.joints, name, &robot::Joint::name);
  }
  /// "driven", "held" or "passive".
  std::string kind(const std::string& name) const {
    const robot::Joint& found = joint(name);
    return found.driven() ? "driven" : found.has_motor() ? "held" : "passive";
  }
};

Guessed guessed(const Files& files, const std::string& text, const std::string& extension = "xml") {
  const std::string name = "m." + extension;
  Guessed all;
  all.toml = guess_robot(compile_model(files.write(name, text)), name).toml;
  ReadingNotes notes;
  all.robot = load_robot(files.write("m.toml", all.toml), &notes);
  all.notes = notes.text();
  return all;
}

std::string with_tail(const std::string& behind, const std::string& more = tail) {
  return model_text(four_legs(), "<freejoint/>", more, behind);
}

TEST(ModelDrives, LeaveJointsWithoutAnActuatorFreeWhereOthersHaveOne) {
  const Files files;
  const Guessed tailed = guessed(files, with_tail(leg_motors));
  EXPECT_EQ(tailed.robot.legs.size(), 4u);
  EXPECT_EQ(tailed.robot.leg_joint_count(), 8u);
  EXPECT_EQ(tailed.kind("FL_knee"), "driven");
  EXPECT_EQ(tailed.kind("tail_a"), "passive");
  EXPECT_THAT(tailed.toml, HasSubstr("passive = [\"tail_a\", \"tail_b\"]"));
  EXPECT_THAT(tailed.notes, HasSubstr("joints without a motor, which move freely: 'tail_a', 'tail_b'"));
  EXPECT_THAT(tailed.notes, AllOf(HasSubstr("replaced  8 actuators by the robot file's servos: 'FL_hip'"),
                                  HasSubstr("'RR_knee'")));
}

TEST(ModelDrives, GiveEveryJointAMotorWhereNoneHasAnActuator) {
  const Files files;
  const Guessed all = guessed(files, with_tail(""));
  EXPECT_EQ(all.kind("FL_knee"), "driven");
  EXPECT_EQ(all.kind("tail_a"), "held");
  EXPECT_THAT(all.toml, Not(HasSubstr("passive")));
}

TEST(ModelDrives, KeepTheSpringOfAPassiveJointAndLoseThatOfADrivenOneWithANote) {
  const Files files;
  LegText leg{.hip = R"(range="-40 40" stiffness="3")"};
  leg.shin_body =
      R"(<body name="NAME_toes" pos="0 0 -0.21"><joint name="NAME_toe" axis="0 1 0" range="-20 20" stiffness="5"
         springref="-8" damping="0.2" armature="0.001"/><geom name="NAME_toes" size="0.02" mass="0.02"/></body>)";
  const Guessed toes = guessed(files, model_text(four_legs(leg), "<freejoint/>", "", leg_motors));
  ASSERT_EQ(toes.robot.legs.size(), 4u);
  EXPECT_EQ(toes.robot.leg_joint_count(), 8u);
  const robot::Joint& toe = toes.joint("FL_toe");
  EXPECT_FALSE(toe.has_motor());
  EXPECT_EQ(toe.stiffness_nm_per_rad, 5.0);
  EXPECT_NEAR(toe.rest_rad, -8.0 * 3.14159265358979 / 180.0, 1e-12);
  EXPECT_EQ(toe.damping_nm_s_per_rad, 0.2);
  EXPECT_EQ(toe.armature_kg_m2, 0.001);
  EXPECT_EQ(toes.joint("FL_hip").stiffness_nm_per_rad, 0.0);
  EXPECT_THAT(toes.notes, HasSubstr("the springs of joints: 'FL_toe', 'FR_toe', 'RL_toe', 'RR_toe'"));
  EXPECT_THAT(
      toes.notes,
      HasSubstr("left out  the springs of joints with a motor: 'FL_hip', 'FR_hip', 'RL_hip', 'RR_hip'"));
}

TEST(ModelDrives, CountAPassiveSpringFromTheStartPose) {
  const Files files;
  const std::string fin =
      R"(<body name="fin" pos="-.3 0 0"><joint name="fin" axis="0 0 1" stiffness="2" springref="30"/><geom size=".02" mass=".05"/></body>)";
  std::string text = with_tail(leg_motors + R"(<keyframe><key name="home"
      qpos="0 0 .5 1 0 0 0 0 0 0 0 0 0 0 0 .2"/></keyframe>)",
                               fin);
  EXPECT_NEAR(guessed(files, text).joint("fin").rest_rad, 30.0 * 3.14159265358979 / 180.0 - 0.2, 1e-12);
}

TEST(ModelDrives, NameActuatorsThatAreNoServo) {
  const Files files;
  const std::string more = R"(<actuator><motor name="boost" joint="FL_hip"/><motor joint="FL_knee"/>
      <motor name="jet" site="nozzle" gear="0 0 1 0 0 0"/></actuator>)";
  const std::string notes =
      guessed(files, model_text(four_legs(), "<freejoint/>", R"(<site name="nozzle"/>)", leg_motors + more))
          .notes;
  EXPECT_THAT(notes,
              HasSubstr("left out  actuators beside another of their joint: 'boost' ('FL_hip'), 'FL_knee'"));
  EXPECT_THAT(notes, HasSubstr("left out  actuators that act on a site, a slider-crank or a body: 'jet'"));
}

TEST(ModelDrives, LetCoupledJointsMoveOnTheirOwn) {
  const Files files;
  // Neither jaw of the tail has an actuator: both are free.
  const Guessed free = guessed(
      files,
      with_tail(leg_motors + R"(<equality><joint name="jaws" joint1="tail_a" joint2="tail_b"/></equality>)"));
  EXPECT_EQ(free.kind("tail_a"), "passive");
  EXPECT_THAT(free.notes,
              HasSubstr("left out  equality constraint 'jaws': joint 'tail_a' does not follow joint "
                        "'tail_b', each moves on its own"));
  // The knees follow the hips: they get motors.
  std::string hips, couplings = "<equality>";
  for (const char* leg : {"FL", "FR", "RL", "RR"}) {
    hips += fmt::format(R"(<motor joint="{}_hip"/>)", leg);
    couplings += fmt::format(R"(<joint joint1="{0}_knee" joint2="{0}_hip" polycoef="0 -2 0 0 0"/>)", leg);
  }
  const Guessed legs =
      guessed(files, with_tail("<actuator>" + hips + "</actuator>" + couplings + "</equality>"));
  EXPECT_EQ(legs.robot.leg_joint_count(), 8u);
  EXPECT_EQ(legs.kind("RR_knee"), "driven");
  EXPECT_EQ(legs.kind("tail_b"), "passive");
  EXPECT_THAT(legs.notes, HasSubstr("equality constraint of 'RR_knee': joint 'RR_knee' does not follow"));
}

TEST(ModelDrives, HoldAJointWhoseAngleIsFixedByAConstraint) {
  const Files files;
  const Guessed fixed =
      guessed(files, with_tail(leg_motors + R"(<equality><joint name="lock" joint1="tail_a"/></equality>)"));
  EXPECT_EQ(fixed.kind("tail_a"), "held");
  EXPECT_EQ(fixed.kind("tail_b"), "passive");
  EXPECT_THAT(fixed.notes,
              HasSubstr("replaced  equality constraint 'lock', which fixes the angle of joint 'tail_a'"));
}

const std::string fixed_tendon =
    R"(<tendon><fixed name="cord"{}><joint joint="tail_a" coef="1"/><joint joint="tail_b" coef="1"/></fixed></tendon>)";

TEST(ModelDrives, HoldTheJointsOfATendonWithAnActuator) {
  const Files files;
  const std::string pull = R"(<actuator><motor name="winch" tendon="cord"/></actuator>)";
  const Guessed pulled = guessed(files, with_tail(leg_motors + with(fixed_tendon, "{}", "") + pull));
  EXPECT_EQ(pulled.kind("tail_a"), "held");
  EXPECT_EQ(pulled.kind("tail_b"), "held");
  EXPECT_THAT(pulled.notes,
              HasSubstr("left out  tendon 'cord' over 'tail_a', 'tail_b', with its actuators: 'winch'"));
  EXPECT_THAT(pulled.notes,
              HasSubstr("replaced  joints without an actuator of their own, which a servo holds: "
                        "'tail_a', 'tail_b'"));
}

TEST(ModelDrives, LeaveOutTendonsByNameWithWhatTheyDid) {
  const Files files;
  const auto notes = [&](const std::string& attributes) {
    return guessed(files, with_tail(leg_motors + with(fixed_tendon, "{}", " " + attributes))).notes;
  };
  EXPECT_THAT(notes(""), HasSubstr("left out  tendon 'cord' over 'tail_a', 'tail_b', which only measures"));
  EXPECT_THAT(notes(R"(limited="true" range="0 1")"),
              HasSubstr("tendon 'cord' over 'tail_a', 'tail_b', with its limits"));
  EXPECT_THAT(notes(R"(stiffness="2" damping="1")"), HasSubstr("with its spring, its damping"));
  EXPECT_THAT(notes(R"(frictionloss="2")"), HasSubstr("with its friction"));
}

TEST(ModelDrives, GiveAJointAMotorThatATendonCouplesWithADrivenOne) {
  const Files files;
  const Guessed coupled =
      guessed(files, with_tail(leg_motors + R"(<actuator><motor joint="tail_a"/></actuator>)" +
                               with(fixed_tendon, "{}", "") +
                               R"(<equality><tendon name="same" tendon1="cord"/></equality>)"));
  EXPECT_EQ(coupled.kind("tail_b"), "held");  // by a motor, as it belongs to no leg
  EXPECT_THAT(coupled.notes,
              HasSubstr("equality constraint 'same': what tendon 'cord' couples moves on its own"));
}

TEST(ModelDrives, RefuseClosedLoopsByName) {
  const Files files;
  const auto error_of = [&](const std::string& equality) {
    return files.error_of([&] {
      extract_parts(compile_model(files.write("m.xml", with_tail("<equality>" + equality + "</equality>"))));
    });
  };
  EXPECT_EQ(error_of(R"(<connect body1="FL_shin" body2="FR_shin" anchor="0 0 0"/>
                        <weld name="bar" body1="RL_shin" body2="RR_shin"/>)"),
            "m.xml: equality constraint of 'FL_shin' and 'FR_shin', 'bar': robots with closed loops are not "
            "supported");
  EXPECT_EQ(error_of(R"(<connect body1="FL_shin" body2="FR_shin" anchor="0 0 0" active="false"/>)"),
            "accepted");
}

TEST(ModelDrives, TakeARobotThatIsTiedToSomethingElseForFree) {
  const Files files;
  const Guessed tied =
      guessed(files, with_tail(leg_motors + R"(<equality><weld name="stand" body1="trunk"/></equality>)"));
  EXPECT_THAT(tied.notes,
              HasSubstr("left out  equality constraint 'stand', of 'trunk' and the world: one end is not on "
                        "the robot, which is free to move"));
  const Guessed unnamed =
      guessed(files, with_tail(leg_motors + R"(<equality><weld body1="trunk"/></equality>)"));
  EXPECT_THAT(
      unnamed.notes,
      HasSubstr("left out  equality constraint of 'trunk' and the world: one end is not on the robot"));
}

/// A biped with a wheel for a head.
std::string urdf(const std::string& more) {
  std::string text = tests::urdf_with_effort();
  const std::string wheel = R"(<link name="wheel"><inertial><mass value="0.1"/>
      <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="spin" type="continuous"><parent link="base"/><child link="wheel"/><origin xyz="0 0 .1"/><axis xyz="0 0 1"/></joint>)";
  return with(text, "</robot>", wheel + more + "</robot>");
}

std::string for_legs(const std::string& pattern) {
  std::string text;
  for (const char* joint : {"left_hip", "left_knee", "right_hip", "right_knee"})
    text += with(pattern, "{}", std::string(joint) + "_joint");
  return text;
}

TEST(ModelDrives, TakeAUrdfsTransmissionsAndControlInterfacesForItsMotors) {
  const Files files;
  const std::string transmission = R"(<transmission><joint name="{}"/></transmission>)",
                    interface = R"(<joint name="{}"><command_interface name="effort"/></joint>)";
  for (const std::string& given :
       {for_legs(transmission),
        "<ros2_control name=\"r\" type=\"system\">" + for_legs(interface) +
            R"(<joint name="spin"><state_interface name="position"/></joint></ros2_control>)"}) {
    const Guessed robot = guessed(files, urdf(given), "urdf");
    EXPECT_EQ(robot.robot.leg_joint_count(), 4u) << given;
    EXPECT_EQ(robot.kind("spin"), "passive") << given;
  }
  EXPECT_EQ(guessed(files, urdf(""), "urdf").kind("spin"), "held");
}

TEST(ModelDrives, TakeAListOfMotorsThatLeavesMostLegsWithoutOneForIncomplete) {
  const Files files;
  const Guessed robot = guessed(files, urdf(R"(<transmission><joint name="spin"/></transmission>)"), "urdf");
  EXPECT_EQ(robot.robot.leg_joint_count(), 4u);
  EXPECT_THAT(robot.toml, HasSubstr("every joint gets one"));
  EXPECT_THAT(robot.notes,
              HasSubstr("replaced  joints without an actuator, which get a motor: 'left_knee_joint'"));
}

TEST(ModelDrives, GiveAUrdfsMimicOfADrivenJointAMotor) {
  const Files files;
  const std::string transmission = R"(<transmission><joint name="{}"/></transmission>)";
  std::string text = with(urdf(for_legs(transmission)), R"(<origin xyz="0 0 .1"/>)",
                          R"(<origin xyz="0 0 .1"/><mimic joint="left_hip_joint"/>)");
  EXPECT_EQ(guessed(files, text, "urdf").kind("spin"), "held");
}

}  // namespace
}  // namespace amble::morphology
