#include "amble/page/packed_recording.hpp"
#include "amble/robot/pose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

#include "amble/io/file.hpp"
#include "amble/record/frame_codec.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/motion/fixture.hpp"
#include "tests/page/synthetic.hpp"

namespace amble::page {
namespace {

using tests::SyntheticWalk;

/// The packed numbers, row by row.
std::vector<float> unpacked(const PackedFrames& frames) {
  std::vector<float> values;
  EXPECT_TRUE(record::decompress_frames(frames.bytes, frames.count, frames.columns.size(), values));
  return values;
}

class PackedRecordingTest : public testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::filesystem::path path = folder.path() / "walk.rec";

  PackedRecording pack(const SyntheticWalk& walk) {
    walk.write(path);
    return pack_recording(path);
  }
  std::string error() {
    return tests::error_of([&] { pack_recording(path); });
  }
};

/// Compares every number of packed rows with the recording, bit by bit: row r must be frame frame_of(r).
template <typename FrameOf>
void expect_rows(const PackedFrames& frames, const SyntheticWalk& walk, std::size_t first_row,
                 FrameOf frame_of) {
  const auto all = walk.header().columns;
  const auto values = unpacked(frames);
  for (std::size_t r = first_row; r < frames.count; ++r) {
    const auto recorded = walk.frame(frame_of(r));
    for (std::size_t c = 0; c < frames.columns.size(); ++c) {
      const auto column = std::ranges::find(all, frames.columns[c]) - all.begin();
      ASSERT_EQ(values[r * frames.columns.size() + c], recorded[static_cast<std::size_t>(column)])
          << frames.columns[c] << " in row " << r;
    }
  }
}

TEST_F(PackedRecordingTest, KeepsEverySecondFrameOf100HertzToTheBit) {
  const SyntheticWalk walk{.frames = 301};
  const auto packed = pack(walk);
  EXPECT_EQ(packed.poses.first_s, 0.0);
  EXPECT_EQ(packed.poses.step_s, 0.02);
  EXPECT_EQ(packed.poses.count, 151u);  // time 0, then 0.02, 0.04, … 3.00 s
  expect_rows(packed.poses, walk, 1, [](std::size_t row) { return static_cast<int>(2 * row) - 1; });
  EXPECT_DOUBLE_EQ(packed.seconds, 3.01);
}

TEST_F(PackedRecordingTest, KeepsContactsOfEveryFrame) {
  const SyntheticWalk walk{.frames = 301};
  const auto packed = pack(walk);
  EXPECT_EQ(packed.contacts.first_s, 0.01);
  EXPECT_EQ(packed.contacts.step_s, 0.01);
  EXPECT_EQ(packed.contacts.count, 301u);
  EXPECT_EQ(packed.contacts.columns.size(), 8u);
  expect_rows(packed.contacts, walk, 0, [](std::size_t row) { return static_cast<int>(row); });
}

TEST_F(PackedRecordingTest, BeginsWithTheStartPoseOfTheRobot) {
  const auto packed = pack({.frames = 10});
  const auto values = unpacked(packed.poses);
  const Vec3 com_m = amble::robot::start_com_m(tests::robot());
  const std::vector<float> root{0, 0, 1, 1, 0, 0, 0};
  EXPECT_EQ(std::vector<float>(values.begin(), values.begin() + 7), root);
  EXPECT_FLOAT_EQ(values[9], static_cast<float>(com_m.z));
  for (std::size_t joint = 0; joint < 12; ++joint) EXPECT_EQ(values[10 + joint], 0.0f);
  EXPECT_EQ(values[22], SyntheticWalk{}.frame(0)[22]) << "the first step's target";
}

TEST_F(PackedRecordingTest, BeginsWhereTheTrialDidIfThatWasElsewhere) {
  const SyntheticWalk walk{.frames = 10};
  record::RecordingHeader header = walk.header();
  header.com_start_m = {0.1, -0.2, 0.9};
  header.angle_start_rad.assign(12, 0.25f);
  header.damage_json = R"({"parts":[]})";
  record::RecordingWriter writer(path, header);
  for (int k = 0; k < walk.frames; ++k) writer.add(walk.frame(k));
  writer.finish(record::Outcome::completed);
  const auto packed = pack_recording(path);
  const auto values = unpacked(packed.poses);
  EXPECT_EQ(values[0], walk.frame(0)[0]) << "the root is where it was after the first step";
  EXPECT_EQ(values[7], 0.1f);
  EXPECT_EQ(values[8], -0.2f);
  EXPECT_EQ(values[9], 0.9f);
  for (std::size_t joint = 0; joint < 12; ++joint) EXPECT_EQ(values[10 + joint], 0.25f);
  EXPECT_EQ(packed.damage_json, header.damage_json);
}

TEST_F(PackedRecordingTest, TakesFramesOfAnyRate) {
  for (const auto& [frame_s, step_s] : {std::pair{0.002, 0.02}, {0.05, 0.05}, {0.02, 0.02}, {0.008, 0.024}}) {
    const SyntheticWalk walk{.frames = 100, .frame_s = frame_s};
    const auto packed = pack(walk);
    const auto stride = std::lround(step_s / frame_s);
    EXPECT_DOUBLE_EQ(packed.poses.step_s, step_s);
    expect_rows(packed.poses, walk, 1,
                [&](std::size_t row) { return static_cast<int>(row) * static_cast<int>(stride) - 1; });
  }
}

TEST_F(PackedRecordingTest, HasAPoseEvenIfNoStepWasRecorded) {
  const auto packed = pack({.frames = 0, .outcome = record::Outcome::fell});
  EXPECT_EQ(packed.poses.count, 1u);
  EXPECT_EQ(packed.contacts.count, 0u);
  EXPECT_EQ(packed.seconds, 0.0);
  EXPECT_EQ(packed.outcome, record::Outcome::fell);
}

TEST_F(PackedRecordingTest, EndsBeforeTheFirstFrameThatIsNotFinite) {
  const SyntheticWalk walk{.frames = 50};
  record::RecordingWriter writer(path, walk.header());
  for (int k = 0; k < 50; ++k) {
    auto frame = walk.frame(k);
    if (k == 20) frame[2] = std::numeric_limits<float>::quiet_NaN();
    writer.add(frame);
  }
  writer.finish(record::Outcome::diverged);
  const auto packed = pack_recording(path);
  EXPECT_EQ(packed.contacts.count, 20u);
  EXPECT_DOUBLE_EQ(packed.seconds, 0.2);
}

TEST_F(PackedRecordingTest, RefusesATruncatedRecording) {
  SyntheticWalk{.frames = 600}.write(path);
  const std::string bytes = io::read_file(path);
  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, bytes.size() - 20}) {
    io::write_file(path, bytes.substr(0, size));
    EXPECT_THAT(error(), testing::HasSubstr("truncated")) << size;
  }
}

TEST_F(PackedRecordingTest, RefusesAForeignFile) {
  io::write_file(path, "Dear sir or madam, this is no recording of any kind at all.");
  EXPECT_THAT(error(), testing::StartsWith(path.string() + ": "));
}

TEST_F(PackedRecordingTest, RefusesARecordingWithoutAColumnThatItNeeds) {
  auto header = SyntheticWalk{}.header();
  header.columns[3] = "something.else";
  record::RecordingWriter writer(path, header);
  writer.finish(record::Outcome::completed);
  EXPECT_EQ(error(), path.string() + ": no column 'root.qw' in the recording");
}

TEST_F(PackedRecordingTest, RefusesARobotWithoutFeet) {
  auto header = SyntheticWalk{}.header();
  auto robot = nlohmann::json::parse(tests::robot_json());
  robot["legs"] = nlohmann::json::array();
  header.robot_json = robot.dump();
  record::RecordingWriter writer(path, header);
  writer.finish(record::Outcome::completed);
  EXPECT_EQ(error(), path.string() + ": robot: key 'legs' must be a list with at least one leg");
}

}  // namespace
}  // namespace amble::page
