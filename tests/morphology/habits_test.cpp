#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

// Model files as other programs and people leave them.
namespace amble::morphology {
namespace {

using testing::HasSubstr;
using tests::four_legs;
using tests::model_text;
using tests::urdf_with_effort;

std::string all_replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

TEST(Xacro, IsToldByWhatIsInTheFileWhateverItsName) {
  const Files files;
  const std::string plain = urdf_with_effort();
  const std::string names = with(plain, "<robot ", R"(<robot xmlns:xacro="http://www.ros.org/wiki/xacro" )");
  const std::string contents[] = {
      with(names, "<link ", R"(<xacro:include filename="tail.xacro"/><link )"),
      with(names, "<link ", R"(<xacro:property name="m" value="1"/><link )"),
      with(plain, R"(value="3")", R"(value="${base_mass}")"),
      with(plain, R"(lower="-1")", R"x(lower="$(arg lower)")x"),
      with(with(plain, "<robot ", R"(<robot xmlns:x="http://ros.org/wiki/xacro" )"), "<link ",
           R"(<x:include filename="tail.xacro"/><link )"),
  };
  for (const std::string& text : contents)
    for (const char* name : {"r.urdf", "r.urdf.xacro", "r.xacro", "r.xml"}) {
      const auto file = files.write(name, text);
      EXPECT_THAT(
          files.error_of([&] { compile_model(file); }),
          HasSubstr("a xacro file, a URDF with macros; expand it first: xacro " + std::string(name) + " > r"))
          << text;
    }
  EXPECT_THAT(files.error_of([&] { compile_model(files.write("my robot.xacro", contents[0])); }),
              HasSubstr("> '"));
  EXPECT_EQ(files.error_of([&] { compile_model(files.write("plain.xacro", plain)); }), "accepted");
  const std::string found = with(plain, "package://r/gone.dae", "$(find r)/gone.dae");
  EXPECT_EQ(files.error_of([&] { compile_model(files.write("r.urdf", found)); }), "accepted");
  EXPECT_EQ(files.error_of([&] { compile_model(files.write("r.urdf", names)); }), "accepted")
      << "what xacro writes still declares its name";
}

TEST(Urdf, WithLimitsThatLeaveNoRangeSaysThatStopsAreGone) {
  const Files files;
  const auto notes = [&](const std::string& limits) {
    return compile_model(files.write("r.urdf", with(urdf_with_effort(), R"(lower="-1" upper="1")", limits)))
        .notes.text();
  };
  EXPECT_THAT(notes(R"(lower="-1" upper="1")"), testing::Not(HasSubstr("no stops")));
  EXPECT_THAT(
      notes(R"(lower="0.8" upper="-0.8")"),
      HasSubstr(
          "lower is above their upper, which were put the right way round: left_hip_joint (0.8 to -0.8)"));
  for (const char* none : {R"(lower="0" upper="0")", "", R"(lower="0.5" upper="0.5")"})
    EXPECT_THAT(notes(none),
                HasSubstr("leave no range, as exporters write them where none are known: these joints "
                          "have no stops: left_hip_joint"));
  EXPECT_THAT(notes(R"(lower="0.8" upper="-0.8")"), testing::Not(HasSubstr("right_hip_joint")));
}

TEST(RobotGuess, OfARootThatMovesOnNamelessJointsSaysWhichKindsTheyAre) {
  const Files files;
  const auto notes = [&](const std::string& root) {
    return extract_parts(compile_model(files.write("m.xml", model_text(four_legs(), root)))).notes.text();
  };
  EXPECT_THAT(
      notes(R"(<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/><joint axis="0 1 0"/>)"),
      HasSubstr("moved by a slide joint, a slide joint, a hinge: it is free to move"));
  EXPECT_THAT(notes(R"(<joint name="x" type="slide" axis="1 0 0"/><joint axis="0 1 0"/>)"),
              HasSubstr("moved by x, a hinge: it is free to move"));
  EXPECT_THAT(notes(R"(<joint type="ball"/>)"), HasSubstr("moved by a ball joint:"));
}

/// All lengths of a model of four legs by a factor. Masses stay: MuJoCo takes no smaller moments of inertia.
std::string scaled(double by) {
  std::string text = model_text(four_legs());
  for (const char* length : {"0.05", "0.1", "0.12", "0.2", "0.21", "0.25", "0.5", "0.02", "0.015"})
    for (const char* after : {"\"", " "})
      for (const char* before : {"\"", " ", "-"})
        text = all_replaced(text, std::string(before) + length + after,
                            fmt::format("{}{}@{}", before, std::stod(length) * by, after));
  text = all_replaced(text, "@", "");
  return text;
}

TEST(Urdf, WithStopsOfContinuousJointsSaysThatTheyAreNone) {
  const Files files;
  const std::string hip = R"(<joint name="left_hip_joint" type=)";
  const ModelFile model = compile_model(
      files.write("r.urdf", with(urdf_with_effort(), hip + R"("revolute")", hip + R"("continuous")")));
  EXPECT_THAT(model.notes.text(), HasSubstr("stops of continuous joints, which have none: left_hip_joint"));
  const ModelParts parts = extract_parts(model);
  const auto joint = std::ranges::find(parts.joints, "left_hip_joint", &robot::Joint::name);
  ASSERT_NE(joint, parts.joints.end());
  EXPECT_GT(joint->upper_rad, 3.0);
}

TEST(Urdf, MayHaveCapsules) {
  const Files files;
  const auto read = [&](const std::string& shapes) {
    return extract_parts(compile_model(files.write(
        "r.urdf",
        with(urdf_with_effort(),
             R"(<collision><origin xyz="0 0 -0.2"/><geometry><sphere radius="0.03"/></geometry></collision>)",
             shapes))));
  };
  const ModelParts parts = read(
      R"(<collision name="c"><origin xyz="0 0 -0.1" rpy="1.5707963267948966 0 0"/><geometry><capsule radius="0.03" length="0.2"/></geometry></collision>)");
  EXPECT_THAT(parts.notes.text(), HasSubstr("capsules, by a cylinder and two balls: of left_shin"));
  std::vector<Vec3> balls;
  for (const robot::Geom& geom : parts.geoms)
    if (geom.shape == robot::Shape::sphere && geom.size_m.x == 0.03) balls.push_back(geom.position_m);
  ASSERT_EQ(balls.size(), 3u) << "two of the left shin, and the right one's foot";
  EXPECT_NEAR(norm(balls[0] - balls[1]), 0.2, 1e-9);
  EXPECT_NEAR(std::abs(balls[0].y - balls[1].y), 0.2, 1e-9) << "its axis is turned to y";
  // Without a mass of its own the link weighs what a capsule of water does: the balls are half within the
  // cylinder.
  const std::string inertial =
      R"(<inertial><mass value="0.3"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const std::string light =
      with(urdf_with_effort(), "<link name=\"left_shin\">" + inertial, "<link name=\"left_shin\">");
  const std::string ball = R"(<sphere radius="0.03"/>)";
  const ModelParts weighed = extract_parts(
      compile_model(files.write("r.urdf", with(light, ball, R"(<capsule radius="0.03" length="0.2"/>)"))));
  const auto shin = std::ranges::find(weighed.bodies, "left_shin", &robot::Body::name);
  ASSERT_NE(shin, weighed.bodies.end());
  EXPECT_NEAR(shin->mass_kg, 1000.0 * std::numbers::pi * 0.03 * 0.03 * (0.2 + 4.0 / 3.0 * 0.03), 1e-6);
  EXPECT_THAT(
      read(
          R"(<visual><geometry><egg/></geometry></visual><collision><geometry><sphere radius="0.03"/></geometry></collision>)")
          .notes.text(),
      HasSubstr("what is only to look at: <egg> of 'left_shin'"));
  EXPECT_THAT(files.error_of([&] { read("<collision><geometry><egg/></geometry></collision>"); }),
              HasSubstr("link 'left_shin': <egg>: expected a box, cylinder, sphere, capsule or mesh"));
}

TEST(Urdf, KeepsMotorsWithTheirJointsWhereAnEmptyLinkIsLeftOut) {
  const Files files;
  const std::string camera =
      R"(<link name="camera"/><joint name="camera_tilt" type="revolute"><parent link="base"/><child link="camera"/>
         <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>)";
  std::string text =
      with(urdf_with_effort(), R"(<link name="left_thigh">)", camera + R"(<link name="left_thigh">)");
  std::string motors;
  for (const char* joint : {"left_hip_joint", "left_knee_joint", "right_hip_joint", "right_knee_joint"})
    motors += fmt::format(R"(<transmission name="t_{0}"><joint name="{0}"/></transmission>)", joint);
  const ModelParts parts =
      extract_parts(compile_model(files.write("r.urdf", with(text, "</robot>", motors + "</robot>"))));
  ASSERT_EQ(parts.joints.size(), 4u);
  ASSERT_EQ(parts.drives.size(), 4u);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(parts.drives[j], Drive::motor) << parts.joints[j].name;
}

TEST(RobotGuess, TakesAKeyframeAtAStopAndOneWithoutAName) {
  const Files files;
  const auto toml = [&](const std::string& key, const std::string& range) {
    const std::string behind =
        tests::motors(R"(position kp="40" forcerange="-9 9")") + "<keyframe>" + key + "</keyframe>";
    return guess_robot(
               compile_model(files.write("m.xml", model_text(four_legs({.knee = range}), "<freejoint/>", "",
                                                             behind, R"(<compiler angle="radian"/>)"))),
               "m.xml")
        .toml;
  };
  for (const char* stop : {"-0.91234", "-0.9123", "-0.912349"}) {
    const std::string key =
        fmt::format(R"(<key name="home" qpos="0 0 0.38 1 0 0 0 .4 {0} .4 {0} .4 {0} .4 {0}"/>)", stop);
    EXPECT_THAT(toml(key, fmt::format(R"(range="{} 1")", stop)), HasSubstr("start = \"home\"")) << stop;
  }
  EXPECT_THAT(toml(R"(<key qpos="0 0 0.38 1 0 0 0 .4 -.8 .4 -.8 .4 -.8 .4 -.8"/>)", R"(range="-1 1")"),
              HasSubstr("start = \"key\""));
}

TEST(RobotGuess, LowersARobotWhoseFrameIsBelowItsFeet) {
  const Files files;
  const std::string text =
      all_replaced(urdf_with_effort(), R"(<origin xyz="0 0.1 0"/>)", R"(<origin xyz="0 0.1 0.9"/>)");
  const auto file = files.write(
      "r.urdf", all_replaced(text, R"(<origin xyz="0 -0.1 0"/>)", R"(<origin xyz="0 -0.1 0.9"/>)"));
  const std::string toml = guess_robot(compile_model(file), "r.urdf").toml;
  EXPECT_THAT(toml, HasSubstr("start_height_m = -0."));
}

TEST(RobotGuess, GivesTypesOtherNamesThanJointsOfNoLeg) {
  const Files files;
  std::string text = model_text(
      four_legs(), "<freejoint/>",
      R"(<body name="head" pos="0.3 0 0.1"><joint name="pitch" axis="0 1 0" range="-60 60"/><geom size="0.05" mass="0.2"/></body>)");
  int number = 0;
  for (const char* leg : {"FL", "FR", "RL", "RR"})
    for (const char* type : {"hip", "knee"})
      text = all_replaced(text, fmt::format("{}_{}", leg, type), fmt::format("j{}", ++number));
  const std::string toml = guess_robot(compile_model(files.write("m.xml", text)), "m.xml").toml;
  EXPECT_THAT(toml, HasSubstr(R"("pitch_hinge")"));
  EXPECT_THAT(toml, HasSubstr(R"(held = ["pitch"])"));
}

TEST(RobotGuess, GivesRobotsOfAnySizeHeightsThatAreTheirs) {
  const Files files;
  for (const double by : {1.0, 0.1, 0.01, 0.003, 0.001}) {
    const auto model = compile_model(files.write("m.xml", scaled(by)));
    const std::string toml = guess_robot(model, "m.xml").toml;
    const auto value = [&](const std::string& key) {
      const std::size_t at = toml.find("\n" + key + " = ");
      return at == std::string::npos ? std::nan("") : std::stod(toml.substr(at + key.size() + 4));
    };
    const double start_m = value("start_height_m"), fall_m = value("fall_height_m");
    EXPECT_NEAR(start_m / by, 0.43, 0.01) << by;
    EXPECT_NEAR(fall_m / by, 0.215, 0.01) << by;
    EXPECT_LT(fall_m, start_m);
  }
}

TEST(Urdf, MayHaveAnyCharacterInItsNames) {
  const Files files;
  // As XML writes them, and as they are.
  const std::pair<const char*, const char*> names[] = {{"left&amp;hip", "left&hip"},
                                                       {"left&#10;hip", "left\nhip"},
                                                       {"left&quot;hip'", "left\"hip'"},
                                                       {"&lt;hip&gt;", "<hip>"},
                                                       {"左腿 {leg}.", "左腿 {leg}."}};
  for (const auto& [written, stands_for] : names) {
    const std::string meant = stands_for;
    std::string text = all_replaced(urdf_with_effort(), "left_hip_joint", written);
    text = with(
        text, "</robot>",
        "<transmission name=\"t\"><joint name=\"" + std::string(written) + "\"/></transmission></robot>");
    const ModelFile file = compile_model(files.write("r.urdf", text));
    ASSERT_TRUE(file.motors.contains(meant)) << meant;
    EXPECT_GT(file.motors.at(meant).max_torque_nm, 0.0);
    EXPECT_GT(file.motors.at(meant).max_speed_rad_s, 0.0);
    EXPECT_TRUE(file.motors_named.contains(meant));
    const ModelParts parts = extract_parts(file);
    EXPECT_TRUE(std::ranges::any_of(parts.joints, [&](const auto& joint) { return joint.name == meant; }));
    text = all_replaced(urdf_with_effort(), "left_hip_joint", written);
    files.write("q.urdf", text);
    const RobotGuess guess = guess_robot(compile_model(files.path("q.urdf")), "q.urdf");
    EXPECT_EQ(files.error_of([&] { load_robot(files.write("q.toml", guess.toml)); }), "accepted")
        << guess.toml;
  }
}

TEST(Mjcf, MayHaveAnyCharacterInItsNames) {
  const Files files;
  std::string text = all_replaced(model_text(four_legs(), "<freejoint/>", {}, R"(<actuator>
    <position joint="FL_hip" kp="20" kv="3"/></actuator>)"),
                                  "FL_", "a&amp;\n&#10;&lt;b");
  const ModelFile file = compile_model(files.write("m.xml", text));
  ASSERT_TRUE(file.motors.contains("a& \n<bhip"));
  EXPECT_EQ(file.motors.at("a& \n<bhip").kv_nm_s_per_rad, 3.0);
  EXPECT_EQ(file.notes.text().find("\n<b"), std::string::npos) << "a note is a line";
}

}  // namespace
}  // namespace amble::morphology
