#include "amble/morphology/foot_shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::UnorderedElementsAre;

/// Two legs, of thigh and shank with this inside of the shank, 0.2 m long.
std::string biped(const std::string& of_shank, const std::string& behind = "") {
  std::string text =
      R"(<mujoco><worldbody><body name="trunk" pos="0 0 .6"><freejoint/><geom size=".08" mass="3"/>)";
  for (const char* side : {"left", "right"}) {
    text += fmt::format(
        R"(<body name="{0}_thigh" pos="0 {1} 0"><joint name="{0}_hip" axis="0 1 0" range="-40 40"/>
      <geom name="{0}_thigh" type="capsule" fromto="0 0 0 0 0 -.2" size=".02" mass=".3"/>
      <body name="{0}_shank" pos="0 0 -.2"><joint name="{0}_knee" axis="0 1 0" range="-40 40"/>
      <geom name="{0}_shank" type="capsule" fromto="0 0 0 0 0 -.2" size=".015" mass=".2"/>)",
        side, side[0] == 'l' ? 0.1 : -0.1);
    std::string inside = of_shank;
    for (std::size_t at = 0; (at = inside.find("NAME", at)) != std::string::npos;)
      inside.replace(at, 4, side);
    text += inside + "</body></body>";
  }
  return text + "</body></worldbody>" + behind + "</mujoco>";
}

/// The shapes of the left foot, without "left_".
std::vector<std::string> foot_of(const std::string& text) {
  const Files files;
  const ModelParts parts = extract_parts(compile_model(files.write("m.xml", text)));
  const LegsGuess legs = guess_legs(parts);
  std::vector<std::string> names;
  for (const LegGuess& leg : legs.legs)
    if (leg.name == "left")
      for (const int g : leg.foot_geoms)
        names.push_back(parts.geoms[static_cast<std::size_t>(g)].name.substr(5));
  return names;
}

/// A ball, heights from the knee.
std::string ball(const std::string& name, double x, double y, double z, double radius = 0.01) {
  return fmt::format(R"(<geom name="NAME_{}" pos="{} {} {}" size="{}" mass=".02"/>)", name, x, y, z, radius);
}

const std::string four_balls = ball("a", 0.08, 0.03, -0.03) + ball("b", 0.08, -0.03, -0.03) +
                               ball("c", -0.05, 0.03, -0.03) + ball("d", -0.05, -0.03, -0.03);
std::string foot_body(const std::string& inside, bool hinge = true, const std::string& more = "") {
  return std::string(R"(<body name="NAME_foot" pos="0 0 -.2">)") +
         (hinge ? R"(<joint name="NAME_ankle" axis="0 1 0" range="-30 30")" + more + "/>" : "") + inside +
         "</body>";
}

TEST(FootShapes, OfAShankAreItsBallAndNotTheShankItself) {
  EXPECT_THAT(foot_of(biped(ball("ball", 0, 0, -0.21, 0.02))), UnorderedElementsAre("ball"));
}

TEST(FootShapes, OfAShankAreAllBallsThatCanBeTheFirstToTouch) {
  EXPECT_THAT(foot_of(biped(ball("toe", 0.05, 0, -0.21) + ball("heel", -0.05, 0, -0.205) +
                            ball("calf", -0.03, 0, -0.1))),
              UnorderedElementsAre("toe", "heel"));
}

TEST(FootShapes, OfAFootBehindAnAnkleAreAll) {
  EXPECT_THAT(foot_of(biped(foot_body(four_balls))), UnorderedElementsAre("a", "b", "c", "d"));
  // The plate between rails touches only on edges of the ground.
  const std::string rails =
      R"(<geom name="NAME_plate" type="box" size=".05 .03 .005" pos="0 0 -.02" mass=".1"/>
         <geom name="NAME_rail" type="capsule" fromto="-.06 .03 -.03 .06 .03 -.03" size=".01" mass=".02"/>
         <geom name="NAME_skid" type="capsule" fromto="-.06 -.03 -.03 .06 -.03 -.03" size=".01" mass=".02"/>
         <geom name="NAME_cover" type="box" size=".06 .04 .02" contype="0" conaffinity="0" mass="0"/>)";
  EXPECT_THAT(foot_of(biped(foot_body(rails))), UnorderedElementsAre("plate", "rail", "skid"));
}

TEST(FootShapes, OfAFootThatIsWeldedToTheShankAreAllOfTheWeldedLink) {
  EXPECT_THAT(foot_of(biped(foot_body(four_balls + ball("top", 0, 0, 0.01), false))),
              UnorderedElementsAre("a", "b", "c", "d", "top"));
  // And of the shank what reaches as low.
  EXPECT_THAT(foot_of(biped(ball("spur", -0.07, 0, -0.225) +
                            foot_body(ball("a", 0.05, 0, -0.03) + ball("b", -0.03, 0, -0.03), false))),
              UnorderedElementsAre("a", "b", "spur"));
}

TEST(FootShapes, IncludeWhatAJointWithoutAMotorJoinsToAFoot) {
  const std::string motors =
      R"(<actuator><motor joint="left_hip"/><motor joint="left_knee"/><motor joint="left_ankle"/>
      <motor joint="right_hip"/><motor joint="right_knee"/><motor joint="right_ankle"/></actuator>)";
  const std::string toes =
      R"(<body name="NAME_toes" pos=".06 0 -.03"><joint name="NAME_toe" axis="0 1 0" range="-30 30" stiffness="4"/>)" +
      ball("tip", 0.03, 0, 0) + "</body>";
  const std::string text = biped(foot_body(four_balls + toes), motors);
  EXPECT_THAT(foot_of(text), UnorderedElementsAre("a", "b", "c", "d", "tip"));
}

TEST(FootShapes, OfAWheelAreTheWheelAlone) {
  const std::string motors = R"(<actuator><motor joint="left_hip"/><motor joint="left_knee"/>
      <motor joint="right_hip"/><motor joint="right_knee"/></actuator>)";
  const std::string wheel = R"(<body name="NAME_wheel" pos="0 0 -.2"><joint name="NAME_axle" axis="0 1 0"/>
      <geom name="NAME_wheel" type="cylinder" size=".04 .01" euler="90 0 0" mass=".1"/></body>)";
  EXPECT_THAT(foot_of(biped(wheel, motors)), UnorderedElementsAre("wheel"));
}

TEST(FootShapes, AreWrittenAsAListThatReadsBack) {
  const Files files;
  const std::string toml =
      guess_robot(compile_model(files.write("m.xml", biped(foot_body(four_balls)))), "m.xml").toml;
  EXPECT_THAT(toml, testing::HasSubstr("foot = [\"left_a\", \"left_b\", \"left_c\", \"left_d\"]"));
  const robot::RobotSpec robot = load_robot(files.write("m.toml", toml));
  ASSERT_EQ(robot.legs.size(), 2u);
  for (const robot::Leg& leg : robot.legs) EXPECT_EQ(leg.foot_geoms.size(), 4u);
}

TEST(FootShapes, OfAFootWithADrivenToeAreSoleAndToe) {
  const std::string foot =
      R"(<body name="NAME_foot" pos="0 0 -.2"><joint name="NAME_ankle" axis="0 1 0" range="-40 40"/>
      <geom name="NAME_sole" type="box" size=".06 .03 .01" mass=".2"/>
      <body name="NAME_toe" pos=".06 0 0"><joint name="NAME_toe_joint" axis="0 1 0" range="-40 40"/>
      <geom name="NAME_toe" type="box" size=".02 .03 .01" pos=".02 0 0" mass=".05"/></body></body>)";
  EXPECT_THAT(foot_of(biped(foot)), UnorderedElementsAre("sole", "toe"));
}

}  // namespace
}  // namespace amble::morphology
