#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
