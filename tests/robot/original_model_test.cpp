#include "amble/robot/original_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "amble/core/error.hpp"

namespace amble::robot {
namespace {

using testing::HasSubstr;

OriginalModel sample() {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
  return {.mjcf = "<mujoco model=\"ü\"/>\n",
          .meshes = {{"mesh0.stl", bytes}, {"mesh1.obj", ""}},
          .start = {0.1, 1.0 / 3.0, -0.0},
          .joints = {2, 1},
          .geoms = {5}};
}

RobotSpec robot_of_two_joints() {
  RobotSpec robot;
  robot.joints.resize(2);
  robot.geoms.resize(1);
  return robot;
}

std::string refusal(io::Json json) {
  try {
    original_model_from_json(io::JsonView(json, "file"), robot_of_two_joints());
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_file);
    return error.what();
  }
  return "accepted";
}

TEST(OriginalModel, ReadsBackFromJsonToTheSameBits) {
  const OriginalModel model = sample();
  const io::Json json = io::parse_json(to_json(model).dump(), "text");
  const auto read = original_model_from_json(io::JsonView(json, "text"), robot_of_two_joints());
  EXPECT_EQ(read->mjcf, model.mjcf);
  EXPECT_EQ(read->meshes, model.meshes);
  EXPECT_EQ(read->start, model.start);
  EXPECT_EQ(read->joints, model.joints);
  EXPECT_EQ(read->geoms, model.geoms);
}

TEST(OriginalModel, RefusesWhatDoesNotFit) {
  const io::Json good = to_json(sample());
  EXPECT_EQ(refusal(good), "accepted");
  io::Json json = good;
  json["joints"] = {1};
  EXPECT_THAT(refusal(json), HasSubstr("key 'joints' must be a number for each of the robot's"));
  json = good;
  json["geoms"] = {-1};
  EXPECT_THAT(refusal(json), HasSubstr("must be an index"));
  json = good;
  json["meshes"]["mesh0.stl"]["bytes"] = 999;
  EXPECT_THAT(refusal(json), HasSubstr("must be a zlib stream of so many bytes, in base64"));
  json = good;
  json["meshes"]["mesh0.stl"]["deflated"] = "????";
  EXPECT_THAT(refusal(json), HasSubstr("must be a zlib stream"));
  json = good;
  json["meshes"]["mesh0.stl"]["bytes"] = std::int64_t{1} << 40;
  EXPECT_THAT(refusal(json), HasSubstr("must be a number of bytes"));
  json = good;
  json.erase("mjcf");
  EXPECT_THAT(refusal(json), HasSubstr("key 'mjcf' is missing"));
}

TEST(OriginalModel, IsComparedByWhatIsWritten) {
  RobotSpec a = robot_of_two_joints(), b = a;
  EXPECT_TRUE(same_original_model(a, b));
  a.original = std::make_shared<const OriginalModel>(sample());
  EXPECT_FALSE(same_original_model(a, b));
  b.original = std::make_shared<const OriginalModel>(sample());
  EXPECT_TRUE(same_original_model(a, b));
  OriginalModel other = sample();
  other.mjcf += " ";
  b.original = std::make_shared<const OriginalModel>(other);
  EXPECT_FALSE(same_original_model(a, b));
}

}  // namespace
}  // namespace amble::robot
