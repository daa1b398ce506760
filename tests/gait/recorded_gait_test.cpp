#include "amble/gait/recorded_gait.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "amble/gait/report_text.hpp"
#include "amble/record/recording.hpp"
#include "tests/gait/synthetic_gait.hpp"
#include "tests/io/expect_error.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::gait {
namespace {

/// The fixture's robot trots at 0.4 m/s for 12 s, its first joint turning by 0.001 rad a step under 2 N m.
class RecordedGait : public testing::Test {
 protected:
  RecordedGait()
      : path_(std::filesystem::path(testing::TempDir()) /
              (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".rec")) {
    for (const auto& joint : robot_.joints) joints_.push_back(joint.name);
    for (const auto& leg : robot_.legs) legs_.push_back(leg.name);
  }
  ~RecordedGait() override { std::filesystem::remove(path_); }

  void write(bool with_torques, record::Outcome outcome, int bad_frame = -1) {
    record::RecordingHeader header{.frame_s = 0.01,
                                   .columns = record::standard_columns(joints_, legs_),
                                   .robot_json = tests::robot_json(),
                                   .controller_json = tests::supg_json(),
                                   .origin = "test"};
    if (with_torques)
      for (auto& name : record::torque_columns(joints_)) header.columns.push_back(name);
    record::RecordingWriter writer(path_, header);
    const tests::Clockwork feet{.stride = 60, .stance = 36, .offset = {30, 0, 0, 30}};
    const auto start = robot::start_com_m(robot_);
    for (int k = 0; k < 1200; ++k) {
      std::vector<float> frame(header.columns.size());
      const auto put = [&](const std::string& name, double value) {
        for (std::size_t c = 0; c < frame.size(); ++c)
          if (header.columns[c] == name) frame[c] = static_cast<float>(value);
      };
      put("com.x", start.x + 0.004 * (k + 1));
      put("com.y", start.y);
      put("com.z", start.z);
      put("angle." + joints_[0], 0.001 * (k + 1));
      put("torque." + joints_[0], 2.0);
      for (std::size_t leg = 0; leg < 4; ++leg) put("touch." + legs_[leg], feet.touches(leg, k) ? 1.0 : 0.0);
      if (k == bad_frame) put("com.z", std::numeric_limits<double>::quiet_NaN());
      writer.add(frame);
    }
    writer.finish(outcome);
  }

  robot::RobotSpec robot_ = tests::robot();
  std::vector<std::string> joints_, legs_;
  std::filesystem::path path_;
};

TEST_F(RecordedGait, IsMeasuredFromItsFrames) {
  write(true, record::Outcome::fell);
  const Report report = recorded_gait(path_, {});
  EXPECT_EQ(report.classification, (Classification{Gait::trot, Irregular::no}));
  EXPECT_EQ(report.outcome, record::Outcome::fell);
  EXPECT_DOUBLE_EQ(report.seconds, 12.0);
  EXPECT_NEAR(report.distance_m, 4.8, 1e-5);
  EXPECT_NEAR(report.legs[0].stride_s.value(), 0.6, 1e-12);
  // 2 N m over 1.2 rad, less half of the first step; 1.4 kg over 4.8 m.
  EXPECT_NEAR(report.work->positive_j, 2.0 * 1.1995, 1e-4);
  EXPECT_NEAR(report.cost_of_transport_positive.value(), 2.0 * 1.1995 / (1.4 * 9.8 * 4.8), 1e-5);
}

TEST_F(RecordedGait, HasNoCostOfTransportWithoutTorques) {
  write(false, record::Outcome::completed);
  const Report report = recorded_gait(path_, {});
  EXPECT_EQ(report.classification, (Classification{Gait::trot, Irregular::no}));
  EXPECT_FALSE(report.work);
  EXPECT_FALSE(report.cost_of_transport_positive);
  EXPECT_NE(report_table(report).find("not known (no motor torques)"), std::string::npos);
}

TEST_F(RecordedGait, CanBeCutToItsFirstSeconds) {
  write(true, record::Outcome::fell);
  const Report report = recorded_gait(path_, {}, 6.0);
  EXPECT_DOUBLE_EQ(report.seconds, 6.0);
  EXPECT_EQ(report.outcome, record::Outcome::completed);
  EXPECT_NEAR(report.distance_m, 2.4, 1e-5);
  EXPECT_EQ(recorded_gait(path_, {}, 100.0).outcome, record::Outcome::fell);
}

TEST_F(RecordedGait, IsNotOfMoreSecondsThanACompletedTrialHas) {
  write(true, record::Outcome::completed);
  EXPECT_DOUBLE_EQ(recorded_gait(path_, {}, 12.0).seconds, 12.0);
  EXPECT_EQ(test::error_of(ExitCode::bad_input, [&] { recorded_gait(path_, {}, 100.0); }),
            path_.string() + ": seconds = 100: it is 12 s long; expected at most that");
}

TEST_F(RecordedGait, IsOfWholeFrames) {
  write(true, record::Outcome::completed);
  EXPECT_THAT(test::error_of(ExitCode::bad_input, [&] { recorded_gait(path_, {}, 1.0005); }),
              testing::HasSubstr("seconds = 1.0005: expected a whole number of timesteps of "));
}

TEST_F(RecordedGait, EndsBeforeAFrameThatIsNotFinite) {
  write(true, record::Outcome::diverged, 700);
  const Report report = recorded_gait(path_, {});
  EXPECT_DOUBLE_EQ(report.seconds, 7.0);
  EXPECT_EQ(report.outcome, record::Outcome::diverged);
}

TEST_F(RecordedGait, AsJsonHasTheDocumentedNames) {
  write(true, record::Outcome::completed);
  const Report report = recorded_gait(path_, {});
  const auto json = nlohmann::ordered_json::parse(report_json(report));
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"format",
                                             "version",
                                             "robot",
                                             "outcome",
                                             "seconds",
                                             "settings",
                                             "gait",
                                             "irregular_reason",
                                             "gait_seconds",
                                             "pairs",
                                             "duty_factor",
                                             "stride_s",
                                             "reference_leg",
                                             "legs",
                                             "segments",
                                             "windows",
                                             "distance_m",
                                             "path_m",
                                             "speed_m_s",
                                             "path_speed_m_s",
                                             "straightness",
                                             "leg_length_m",
                                             "froude",
                                             "mass_kg",
                                             "work_positive_j",
                                             "work_absolute_j",
                                             "cost_of_transport_positive",
                                             "cost_of_transport_absolute"}));
  EXPECT_EQ(json["format"], "amble-gait");
  EXPECT_EQ(json["gait"], "trot");
  EXPECT_EQ(json["reference_leg"], "BL");
  EXPECT_EQ(json["legs"][1]["name"], "FR");
  EXPECT_EQ(json["legs"][1]["phase"]["phase"], report.legs[1].phase->phase);
  EXPECT_EQ(json["windows"].size(), report.windows.size());
  EXPECT_EQ(json["windows"][0]["phases"][3]["resultant"], report.windows[0].phases[3]->resultant);
  EXPECT_EQ(json["segments"][0]["gait"], "trot");
  EXPECT_EQ(json["gait_seconds"]["trot"], 10.0);
  EXPECT_EQ(json["pairs"]["hind"]["count"], report.quadruped->hind.count);
}

}  // namespace
}  // namespace amble::gait
