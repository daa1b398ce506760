#include "amble/motion/recorded_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "amble/record/recording.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::motion {
namespace {

class RecordedTest : public testing::Test {
 protected:
  RecordedTest() : path_(std::filesystem::path(testing::TempDir()) / (std::string(test_name()) + ".rec")) {
    const robot::RobotSpec robot = tests::robot();
    std::vector<std::string> joints, legs;
    for (const auto& joint : robot.joints) joints.push_back(joint.name);
    for (const auto& leg : robot.legs) legs.push_back(leg.name);
    header_ = {.frame_s = 0.1,
               .columns = record::standard_columns(joints, legs),
               .robot_json = tests::robot_json(),
               .controller_json = tests::supg_json(),
               .origin = "champions/0007.json"};
    for (const auto& leg : legs) header_.columns.push_back("timer." + leg);
    for (const auto& leg : legs) header_.columns.push_back("trigger." + leg);
  }
  ~RecordedTest() override { std::filesystem::remove(path_); }

  static const char* test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  /// Writes frames whose numbers are 100 × frame + column, so that each can be told.
  void write(int frames, record::Outcome outcome, int bad_frame = -1) {
    record::RecordingWriter writer(path_, header_);
    for (int k = 0; k < frames; ++k) {
      std::vector<float> frame(header_.columns.size());
      for (std::size_t c = 0; c < frame.size(); ++c)
        frame[c] = static_cast<float>(100 * k) + static_cast<float>(c);
      if (k == bad_frame) frame[3] = std::numeric_limits<float>::quiet_NaN();
      writer.add(frame);
    }
    writer.finish(outcome);
  }

  std::filesystem::path path_;
  record::RecordingHeader header_;
};

TEST_F(RecordedTest, FindsEveryColumnByName) {
  std::ranges::reverse(header_.columns);
  const auto place = [&](const std::string& name) {
    return static_cast<double>(std::ranges::find(header_.columns, name) - header_.columns.begin());
  };
  write(3, record::Outcome::fell);
  const RecordedTrial recorded = read_recorded_trial(path_);
  const Motion& motion = recorded.motion;
  EXPECT_EQ(recorded.controller_kind, "supg");
  ASSERT_TRUE(recorded.supg.has_value());
  EXPECT_EQ(motion.outcome, record::Outcome::fell);
  ASSERT_EQ(motion.frames(), 3);
  EXPECT_NEAR(motion.seconds(), 0.3, 1e-12);
  EXPECT_EQ(motion.root_m[1].y, 100 + place("root.y"));
  EXPECT_EQ(motion.root_rotation[1].w, 100 + place("root.qw"));
  EXPECT_EQ(motion.root_rotation[1].z, 100 + place("root.qz"));
  EXPECT_EQ(motion.com_m[2].z, 200 + place("com.z"));
  EXPECT_EQ(motion.angle_rad[4][2], 200 + place("angle.FR_hip_fb"));
  EXPECT_EQ(motion.timer_ticks[3][0], place("timer.BR"));
}

TEST_F(RecordedTest, ReadsTouchAndTriggersAsYesOrNo) {
  record::RecordingWriter writer(path_, header_);
  std::vector<float> frame(header_.columns.size(), 0.0f);
  const auto at = [&](const std::string& name) -> float& {
    return frame[static_cast<std::size_t>(std::ranges::find(header_.columns, name) -
                                          header_.columns.begin())];
  };
  at("touch.FR") = 1.0f;
  at("trigger.BL") = 1.0f;
  writer.add(frame);
  writer.finish(record::Outcome::completed);
  const Motion motion = read_recorded_trial(path_).motion;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_EQ(motion.touch[leg][0], leg == 1);
    EXPECT_EQ(motion.trigger[leg][0], leg == 2);
  }
}

TEST_F(RecordedTest, EndsBeforeTheFirstFrameThatIsNotFinite) {
  write(5, record::Outcome::diverged, 3);
  EXPECT_EQ(read_recorded_trial(path_).motion.frames(), 3);
}

TEST_F(RecordedTest, TakesAControllerWithoutTimers) {
  header_.columns.resize(header_.columns.size() - 8);
  header_.controller_json = tests::network_json();
  write(2, record::Outcome::completed);
  const RecordedTrial recorded = read_recorded_trial(path_);
  EXPECT_FALSE(recorded.supg.has_value());
  ASSERT_TRUE(recorded.network.has_value());
  EXPECT_EQ(recorded.network->nodes.size(), 3u);
  EXPECT_TRUE(recorded.motion.timer_ticks.empty());
  EXPECT_TRUE(recorded.motion.trigger.empty());
}

TEST_F(RecordedTest, TakesARecordingWithoutFrames) {
  write(0, record::Outcome::diverged);
  EXPECT_EQ(read_recorded_trial(path_).motion.frames(), 0);
}

TEST_F(RecordedTest, NamesFileAndPartOfWhatIsWrong) {
  header_.controller_json = "{\"kind\": \"supg\", \"patterns_rad\": []}";
  write(1, record::Outcome::completed);
  EXPECT_EQ(tests::error_of([&] { read_recorded_trial(path_); }),
            path_.string() + ": controller: key 'period_ticks' is missing");
  header_.robot_json = "{}";
  write(1, record::Outcome::completed);
  EXPECT_EQ(tests::error_of([&] { read_recorded_trial(path_); }),
            path_.string() + ": robot: key 'legs' is missing");
}

TEST_F(RecordedTest, NamesAColumnThatIsMissing) {
  std::erase(header_.columns, "touch.BL");
  write(1, record::Outcome::completed);
  EXPECT_EQ(tests::error_of([&] { read_recorded_trial(path_); }),
            path_.string() + ": no column 'touch.BL' in the recording");
}

TEST(Recorded, RefusesWhatIsNoRecording) {
  const auto path = std::filesystem::path(testing::TempDir()) / "recorded_trial_test_foreign.rec";
  std::ofstream(path) << "not a recording";
  EXPECT_THAT(tests::error_of([&] { read_recorded_trial(path); }), testing::StartsWith(path.string()));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace amble::motion
