#include "amble/morphology/start_pose.hpp"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "amble/core/random.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/pose.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

/// The one-legged robot with a second hinge on the thigh and a third on the shin.
const std::string three_hinges_xml =
    with(with(one_leg_xml, R"(<joint name="A_hip")",
              R"(<joint name="A_roll" pos="0 0.02 0.01" axis="1 0 0" range="-1 1" limited="true"/>
                 <joint name="A_hip")"),
         R"(<joint name="A_knee")",
         R"(<joint name="A_twist" pos="0.01 0 0.02" axis="0 0.6 0.8" range="-1 1" limited="true"/>
            <joint name="A_knee")");
constexpr std::size_t numbers = 11;  // of a position: 7 of the root, 4 angles

std::string keyframe(const std::string& name, const std::vector<double>& position) {
  return fmt::format("<key name=\"{}\" qpos=\"{}\"/>", name, fmt::join(position, " "));
}

std::vector<double> default_position() {
  return {0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
}

std::string with_keyframes(const std::string& keys) {
  return with(three_hinges_xml, "</worldbody>", "</worldbody><keyframe>" + keys + "</keyframe>");
}

/// Places of all geoms in the world with the robot's joints at these angles.
std::vector<Vec3> places_m(const ModelParts& parts, const robot::Pose& root,
                           const std::vector<double>& angles) {
  robot::RobotSpec robot;
  robot.bodies = parts.bodies;
  robot.joints = parts.joints;
  const auto poses = robot::poses_at(robot, root, angles);
  std::vector<Vec3> places;
  for (const robot::Geom& geom : parts.geoms) places.push_back(robot::centre_m(geom, poses));
  return places;
}

double farthest_m(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = a.size() == b.size() ? 0.0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

TEST(StartPose, IsThatOfAKeyframeWhoseNumbersStandOnALineOfTheirOwn) {
  const Files files;
  const std::string key = "<key name=\"a\" qpos=\"\n  0 0 1.2  1 0 0 0\n  0 0 0 0\n\"/>";
  const ModelFile file = compile_model(files.write("m.xml", with_keyframes(key)));
  EXPECT_EQ(extract_parts(file, {.start_keyframe = "a"}).bodies[0].position_m.z, 1.2);
}

TEST(StartPose, IsThatOfItsKeyframeWhicheverNumbersDifferFromTheModelsOwn) {
  const Files files;
  const ModelParts reference = extract_parts(compile_model(files.write("m.xml", three_hinges_xml)));
  for (std::size_t k = 0; k < numbers; ++k) {
    auto position = default_position();
    position[k] += 0.3;
    if (k == 3) position[4] = 0.5;  // of a unit quaternion, w alone says nothing
    // The keyframe is neither the first nor the last.
    const auto other = keyframe("other", {9, 9, 9, 0, 1, 0, 0, 0.1, 0.2, 0.3, 0.4});
    const auto path = files.write("m.xml", with_keyframes(other + keyframe("this", position) +
                                                          other.substr(0, 11) + "2" + other.substr(11)));
    const ModelParts parts = extract_parts(compile_model(path), {.start_keyframe = "this"});
    EXPECT_EQ(parts.bodies[0].position_m, (Vec3{position[0], position[1], position[2]}));
    const std::vector<double> angles(position.begin() + 7, position.end());
    EXPECT_EQ(parts.start_rad, angles) << k;
    const double length =
        std::hypot(std::hypot(position[3], position[4]), std::hypot(position[5], position[6]));
    const robot::Pose root{
        {position[0], position[1], position[2]},
        {position[3] / length, position[4] / length, position[5] / length, position[6] / length}};
    EXPECT_LT(
        farthest_m(places_m(parts, {parts.bodies[0].position_m, parts.bodies[0].rotation}, {0, 0, 0, 0}),
                   places_m(reference, root, angles)),
        1e-12)
        << k;
  }
}

TEST(StartPose, OfAGuessedRobotIsAGoodNameOrElseTheFirst) {
  const Files files;
  const auto start_of = [&](const std::vector<std::string>& names) {
    std::string keys;
    for (const std::string& name : names) keys += keyframe(name, default_position());
    const auto guess = guess_robot(compile_model(files.write("m.xml", with_keyframes(keys))), "m.xml");
    const std::size_t at = guess.toml.find("\nstart = \"");
    return at == std::string::npos ? "" : guess.toml.substr(at + 10, guess.toml.find('"', at + 10) - at - 10);
  };
  EXPECT_EQ(start_of({}), "");
  EXPECT_EQ(start_of({"crouch"}), "crouch");
  EXPECT_EQ(start_of({"crouch", "stretch", "sit"}), "crouch");
  EXPECT_EQ(start_of({"crouch", "default", "stand"}), "stand");
  EXPECT_EQ(start_of({"stand", "crouch", "home"}), "home");
}

TEST(StartPose, GivesAnglesOfHingesOnly) {
  const Files files;
  const auto path = files.write("m.xml", three_hinges_xml);
  for (const char* name : {"root", "torso", "", "A"})
    EXPECT_EQ(files.error_of([&] {
      extract_parts(compile_model(path), {"", {{name, 0.1}}, {}});
    }),
              fmt::format("m.xml: no hinge '{}', of which a start angle is given", name));
}

TEST(FixedJoint, StaysAtItsStartAngleWhileAllOthersMoveAsBefore) {
  const Files files;
  const ModelFile file = compile_model(files.write("m.xml", three_hinges_xml));
  const std::vector<std::string> names{"A_roll", "A_hip", "A_twist", "A_knee"};
  for (std::uint32_t fixed = 1; fixed < 16; ++fixed) {
    Stream stream(1, Purpose::test, fixed);
    ReadingOptions options, all_free;
    std::vector<double> all(names.size(), 0.0), moving;
    for (std::size_t j = 0; j < names.size(); ++j) {
      options.start_angles_rad[names[j]] = stream.uniform(-0.5, 0.5);
      if ((fixed & (1u << j)) != 0)
        options.fixed_joints.push_back(names[j]);
      else
        moving.push_back(all[j] = stream.uniform(-1.0, 1.0));
    }
    all_free.start_angles_rad = options.start_angles_rad;
    const ModelParts reference = extract_parts(file, all_free), parts = extract_parts(file, options);
    ASSERT_EQ(parts.joints.size(), moving.size());
    const robot::Pose root{{0.0, 0.0, 1.0}, {}};
    EXPECT_LT(farthest_m(places_m(parts, root, moving), places_m(reference, root, all)), 1e-12) << fixed;
    // Joints of a body are numbered from 0.
    std::vector<int> met(parts.bodies.size(), 0);
    for (const robot::Joint& joint : parts.joints)
      EXPECT_EQ(joint.chain_index, met[static_cast<std::size_t>(joint.body)]++) << fixed;
  }
}

}  // namespace
}  // namespace amble::morphology
