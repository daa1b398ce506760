#include "amble/morphology/servo_guess.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// `text` with every `from` in it replaced.
std::string all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// A biped of 4.2 kg with legs of 0.4 m, which bear 8 N m: efforts of 12 and 9 N m.
class Servos : public testing::Test {
 protected:
  RobotGuess guess(const std::string& urdf) {
    return guess_robot(compile_model(files_.write("r.urdf", urdf)), "r.urdf");
  }
  std::string notes_on(const std::string& toml, const std::string& urdf) {
    files_.write("r.urdf", urdf);
    ReadingNotes notes;
    load_robot(files_.write("r.toml", toml), &notes);
    return notes.text();
  }
  Files files_;
  const std::string urdf_ = tests::urdf_with_effort();
};

TEST_F(Servos, WithoutALimitOfSpeedAreNamedAsThoseWithoutOneOfTorque) {
  const auto speedless = HasSubstr("no limit of speed that a motor could have");
  EXPECT_THAT(guess(urdf_).doubts, Not(Contains(speedless)));
  for (const char* velocity : {"", " velocity=\"0\""})
    EXPECT_THAT(guess(all(urdf_, " velocity=\"5\"", velocity)).doubts,
                Contains(AllOf(speedless, HasSubstr("left_hip_joint"), HasSubstr("gain_per_s"))))
        << velocity;
  // Only one of the joints.
  EXPECT_THAT(guess(with(urdf_, "effort=\"9\" velocity=\"5\"", "effort=\"9\"")).doubts,
              Contains(AllOf(speedless, HasSubstr("left_knee_joint"), Not(HasSubstr("right")))));
  // A limit of speed alone is taken.
  const RobotGuess fast = guess(all(all(urdf_, "effort=\"12\" ", ""), "effort=\"9\" ", ""));
  EXPECT_THAT(fast.doubts, Contains(HasSubstr("no limit of torque")));
  EXPECT_THAT(fast.doubts, Not(Contains(speedless)));
  EXPECT_THAT(fast.toml, HasSubstr("gain_per_s = 6.25"));
}

TEST_F(Servos, OfAnMjcfLackNoLimitOfSpeed) {
  for (const tests::SmallModel& model : tests::small_models()) {
    if (model.extension != "xml") continue;
    const RobotGuess guessed = guess_robot(compile_model(files_.write("m.xml", model.text)), "m.xml");
    EXPECT_THAT(guessed.doubts, Not(Contains(HasSubstr("limit of speed")))) << model.name;
  }
}

TEST_F(Servos, WithAnEffortThatWasReplacedAreAskedForTheirUnit) {
  const auto with_hips = [&](const std::string& effort) {
    return guess(all(urdf_, "effort=\"12\"", "effort=\"" + effort + "\"")).doubts;
  };
  EXPECT_THAT(with_hips("420"), Contains(AllOf(HasSubstr("no limit of torque"), HasSubstr("kg·cm"))));
  EXPECT_THAT(with_hips("100000"), Contains(AllOf(HasSubstr("no limit of torque"), Not(HasSubstr("kg·cm")))));
}

/// A quadruped of 1.3 kg with a hip and a knee a leg, and these attributes of each position actuator.
std::string mjcf_with_actuators(const std::string& attributes) {
  std::string legs, actuators;
  for (const auto& [name, x, y] :
       {std::tuple{"fl", 0.1, 0.07}, {"fr", 0.1, -0.07}, {"rl", -0.1, 0.07}, {"rr", -0.1, -0.07}}) {
    legs += fmt::format(R"(<body name="{0}_thigh" pos="{1} {2} 0"><joint name="{0}_hip" axis="0 1 0"/>
      <geom type="capsule" size="0.01" fromto="0 0 0 0 0 -0.08" mass="0.05"/>
      <body name="{0}_shin" pos="0 0 -0.08"><joint name="{0}_knee" axis="0 1 0"/>
      <geom type="capsule" size="0.01" fromto="0 0 0 0 0 -0.08" mass="0.025"/></body></body>)",
                        name, x, y);
    for (const char* joint : {"hip", "knee"})
      actuators += fmt::format(R"(<position joint="{}_{}" kp="20" {}/>)", name, joint, attributes);
  }
  return fmt::format(R"(<mujoco><worldbody><body name="trunk" pos="0 0 0.17"><freejoint/>
    <geom type="box" size="0.12 0.05 0.03" mass="1"/>{}</body></worldbody><actuator>{}</actuator></mujoco>)",
                     legs, actuators);
}

TEST_F(Servos, OfAnMjcfThatAreTooStrongForTheRobotAreAskedForTheirUnit) {
  const auto doubts = [&](const std::string& attributes) {
    return guess_robot(compile_model(files_.write("m.xml", mjcf_with_actuators(attributes))), "m.xml").doubts;
  };
  EXPECT_THAT(doubts(R"(forcerange="-15.3 15.3")"),
              Contains(AllOf(HasSubstr("kg·cm"), HasSubstr("fl_hip (15.3 N m)"), HasSubstr("and 4 more"))));
  EXPECT_THAT(doubts(R"(forcerange="-1.5 1.5")"), Not(Contains(HasSubstr("kg·cm"))));
  // A force before a gear is no torque of a data sheet.
  EXPECT_THAT(doubts(R"(forcerange="-3.06 3.06" gear="5")"), Not(Contains(HasSubstr("kg·cm"))));
  EXPECT_THAT(doubts(""), Not(Contains(HasSubstr("are they in kg·cm"))));
}

TEST_F(Servos, OfActuatorsInTheFrameOfTheParentAreThoseOfTheirJoint) {
  const auto of = [&](const std::string& text) {
    const std::string toml = guess_robot(compile_model(files_.write("m.xml", text)), "m.xml").toml;
    return toml.substr(toml.find("[servo]"));
  };
  const std::string text = mjcf_with_actuators(R"(forcerange="-3 3" kv="0.4")");
  EXPECT_EQ(of(all(text, "<position joint=", "<position jointinparent=")), of(text));
  EXPECT_THAT(of(text), AllOf(HasSubstr("max_torque_nm = 3"), HasSubstr("kd_nm_s_per_rad = 0.4")));
}

TEST_F(Servos, OfAPositionActuatorHaveTheDampingOfAVelocityActuatorBesideIt) {
  const std::string text = mjcf_with_actuators(R"(forcerange="-3 3")");
  std::string behind = text, before = text;
  for (const char* joint : {"hip", "knee"})
    for (const char* leg : {"fl", "fr", "rl", "rr"}) {
      const std::string velocity = fmt::format(R"(<velocity joint="{}_{}" kv="0.7"/>)", leg, joint);
      behind = with(behind, "</actuator>", velocity + "</actuator>");
      before = with(before, "<actuator>", "<actuator>" + velocity);
    }
  for (const std::string& both : {behind, before}) {
    const ModelFile file = compile_model(files_.write("m.xml", both));
    EXPECT_THAT(guess_robot(file, "m.xml").toml,
                AllOf(HasSubstr("kp_nm_per_rad = 20"), HasSubstr("kd_nm_s_per_rad = 0.7")));
    EXPECT_THAT(extract_parts(file).notes.text(), Not(HasSubstr("beside another")));
  }
}

TEST_F(Servos, OfAnUnevenRangeOfForceHaveItsWeakerSideAndAreNamed) {
  const auto of = [&](const std::string& attributes) {
    return guess_robot(compile_model(files_.write("m.xml", mjcf_with_actuators(attributes))), "m.xml");
  };
  const auto named = Contains(AllOf(HasSubstr("stronger to one side"), HasSubstr("fl_hip (")));
  for (const char* range : {R"(forcerange="-1 5")", R"(forcerange="-5 1")"}) {
    EXPECT_THAT(of(range).toml, HasSubstr("max_torque_nm = 1\n")) << range;
    EXPECT_THAT(of(range).toml, HasSubstr("torque: the weaker side of the actuator's force range"));
    EXPECT_THAT(of(range).doubts, named) << range;
  }
  EXPECT_THAT(of(R"(forcerange="0 5")").toml, HasSubstr("max_torque_nm = 5\n")) << "it has but one side";
  EXPECT_THAT(of(R"(forcerange="-5 5")").doubts, Not(named));
}

TEST_F(Servos, HaveTheSmallestOfAllLimitsOfTheirTorque) {
  const auto most_of = [&](const std::string& actuator, const std::string& joint = "") {
    std::string text = all(mjcf_with_actuators(""), "position joint", actuator + " joint");
    text = all(text, "<joint ", "<joint " + joint + " ");
    if (!actuator.starts_with("position")) text = all(text, "kp=\"20\"", "");
    return guess_robot(compile_model(files_.write("m.xml", text)), "m.xml").toml;
  };
  const std::string of_joint = R"(actuatorfrcrange="-2 2")";
  EXPECT_THAT(most_of(R"(position forcerange="-10 10")", of_joint),
              AllOf(HasSubstr("max_torque_nm = 2\n"), HasSubstr("the joint's actuatorfrcrange")));
  EXPECT_THAT(most_of(R"(position forcerange="-1 1")", of_joint), HasSubstr("max_torque_nm = 1\n"));
  EXPECT_THAT(most_of(R"(motor ctrlrange="-10 10")", of_joint), HasSubstr("max_torque_nm = 2\n"));
  EXPECT_THAT(most_of(R"(motor gear="2" ctrlrange="-1 1" forcerange="-10 10")"),
              AllOf(HasSubstr("max_torque_nm = 2\n"), HasSubstr("control range × gear")));
}

TEST_F(Servos, HaveTheDampingOfTheirActuatorThroughItsGear) {
  const auto toml = [&](const std::string& attributes) {
    return guess_robot(compile_model(files_.write("m.xml", mjcf_with_actuators(attributes))), "m.xml").toml;
  };
  EXPECT_THAT(toml(R"(kv="1")"), AllOf(HasSubstr("kp_nm_per_rad = 20"), HasSubstr("kd_nm_s_per_rad = 1\n")));
  EXPECT_THAT(toml(R"(kv="1" gear="2")"),
              AllOf(HasSubstr("kp_nm_per_rad = 80"), HasSubstr("kd_nm_s_per_rad = 4\n")));
  EXPECT_THAT(toml(R"(dampratio="1")"), Not(HasSubstr("kd_nm_s_per_rad = 0\n")));
}

TEST_F(Servos, ThatDifferFromACorrectedUrdfAreNoted) {
  const std::string toml = guess(urdf_).toml;
  EXPECT_THAT(notes_on(toml, urdf_), AllOf(Not(HasSubstr("effort")), Not(HasSubstr("velocity"))));
  EXPECT_THAT(notes_on(toml, all(urdf_, "effort=\"9\"", "effort=\"1.5\"")),
              AllOf(HasSubstr("replaced  effort of <limit>"), HasSubstr("left_knee_joint (9, not 1.5)"),
                    HasSubstr("max_torque_nm"), Not(HasSubstr("hip_joint (")), Not(HasSubstr("velocity"))));
  EXPECT_THAT(notes_on(toml, all(urdf_, "velocity=\"5\"", "velocity=\"4\"")),
              AllOf(HasSubstr("replaced  velocity of <limit>"), HasSubstr("left_hip_joint (6.25, not 5)"),
                    Not(HasSubstr("effort"))));
  // As fast as the paper's motors is fast enough.
  const std::string fast = all(urdf_, "velocity=\"5\"", "velocity=\"8\"");
  EXPECT_THAT(notes_on(guess(fast).toml, all(fast, "velocity=\"8\"", "velocity=\"80\"")),
              Not(HasSubstr("velocity")));
}

TEST_F(Servos, OfACorrectedUrdfWhoseStopsAreNarrowerAreRefusedWithWhatToDo) {
  const std::string toml = guess(urdf_).toml;
  const std::string error = files_.error_of(
      [&] { notes_on(toml, all(urdf_, "lower=\"-1\" upper=\"1\"", "lower=\"-0.2\" upper=\"0.2\"")); });
  EXPECT_THAT(error, AllOf(HasSubstr("goes beyond its stops -0.2 … 0.2 rad"), HasSubstr("[command]"),
                           HasSubstr("amble robot --init")));
}

}  // namespace
}  // namespace amble::morphology
