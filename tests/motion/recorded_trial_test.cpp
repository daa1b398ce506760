#include "amble/motion/recorded_trial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

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

TEST(NeuralNetwork, IsReadFromJson) {
  const NeuralNetwork network = parse_network(tests::network_json(), "x");
  EXPECT_EQ(network.coordinates, (std::vector<std::string>{"x", "y"}));
  ASSERT_EQ(network.nodes.size(), 3u);
  EXPECT_EQ(network.nodes[0].role, NodeRole::sensor);
  EXPECT_EQ(network.nodes[1].role, NodeRole::hidden);
  EXPECT_EQ(network.nodes[2].role, NodeRole::joint);
  EXPECT_EQ(network.nodes[1].name, "inner");
  EXPECT_EQ(network.nodes[1].at, (std::vector{0.0, 0.5}));
  ASSERT_EQ(network.links.size(), 2u);
  EXPECT_EQ(network.links[0].source, 0);
  EXPECT_EQ(network.links[0].target, 1);
  EXPECT_EQ(network.links[0].weight, 2.0);
  EXPECT_EQ(network.links[1].weight, -0.5);
  EXPECT_EQ(network.possible_links, 4);
}

template <typename Spoil>
std::string error_after(Spoil spoil) {
  auto json = nlohmann::json::parse(tests::network_json());
  spoil(json);
  return tests::error_of([&] { parse_network(json.dump(), "walk.rec: controller"); });
}

TEST(NeuralNetwork, NamesWhatIsWrong) {
  using Json = nlohmann::json;
  EXPECT_EQ(error_after([](Json& json) { json["links"][0]["target"] = 3; }),
            "walk.rec: controller: key 'links[0].target' must be the index of a node");
  EXPECT_EQ(error_after([](Json& json) { json["links"][0]["source"] = -1; }),
            "walk.rec: controller: key 'links[0].source' must be the index of a node");
  EXPECT_EQ(error_after([](Json& json) { json["nodes"][0]["at"] = {1}; }),
            "walk.rec: controller: key 'nodes[0].at' must be a number for each coordinate");
  EXPECT_EQ(error_after([](Json& json) { json["nodes"][0]["role"] = "king"; }),
            "walk.rec: controller: key 'nodes[0].role' must be sensor, hidden or joint");
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{1} << 31})
    EXPECT_EQ(error_after([count](Json& json) { json["possible_links"] = count; }),
              "walk.rec: controller: key 'possible_links' must be a whole number from 0 to 2147483647");
  EXPECT_EQ(error_after([](Json& json) { json.erase("possible_links"); }),
            "walk.rec: controller: key 'possible_links' is missing");
}

TEST(NeuralNetwork, LinksNodesFromTheFirstToTheLast) {
  using Json = nlohmann::json;
  for (const char* end : {"source", "target"}) {
    for (const int node : {0, 2})
      EXPECT_EQ(error_after([&](Json& json) { json["links"][1][end] = node; }), "no error");
    for (const int node : {-1, 3})
      EXPECT_NE(
          error_after([&](Json& json) { json["links"][1][end] = node; }).find("must be the index of a node"),
          std::string::npos)
          << end << " " << node;
  }
  EXPECT_NE(error_after([](Json& json) { json["links"][1]["weight"] = "inf"; }).find("a finite number"),
            std::string::npos);
  EXPECT_NE(error_after([](Json& json) {
              json["nodes"][0]["at"] = {1, 2, 3};
            }).find("a number for each coordinate"),
            std::string::npos);
}

std::string supg_error_after(const std::function<void(nlohmann::json&)>& change) {
  auto json = nlohmann::json::parse(tests::supg_json());
  change(json);
  return tests::error_of([&] { parse_supg(json.dump(), tests::robot(), "walk.rec: controller"); });
}

TEST(SupgPatterns, IsReadFromJson) {
  const SupgPatterns supg = parse_supg(tests::supg_json(), tests::robot(), "x");
  EXPECT_EQ(supg.period_ticks, 10);
  EXPECT_DOUBLE_EQ(supg.period_s(), 1.0);
  EXPECT_TRUE(supg.starts_at_offset);
  EXPECT_EQ(supg.offset_ticks, (std::vector<int>{1, 2, 3, 4}));
  ASSERT_EQ(supg.patterns_rad.size(), 12u);
  EXPECT_DOUBLE_EQ(supg.patterns_rad[11][10], 0.12);
}

TEST(SupgPatterns, NamesWhatIsWrong) {
  EXPECT_EQ(supg_error_after([](auto& json) { json.erase("period_ticks"); }),
            "walk.rec: controller: key 'period_ticks' is missing");
  EXPECT_EQ(supg_error_after([](auto& json) { json["period_ticks"] = 0; }),
            "walk.rec: controller: key 'period_ticks' must be a whole number from 1 to 1000000");
  EXPECT_EQ(supg_error_after([](auto& json) { json["timestep_s"] = -1; }),
            "walk.rec: controller: key 'timestep_s' must be a number above 0");
  EXPECT_EQ(supg_error_after([](auto& json) { json["offset"] = "late"; }),
            "walk.rec: controller: key 'offset' must be phase or delay");
  for (const int ticks : {-1'000'001, 1'000'001})
    EXPECT_EQ(supg_error_after([ticks](auto& json) { json["offset_ticks"][3] = ticks; }),
              "walk.rec: controller: key 'offset_ticks[3]' must be a whole number from -1000000 to 1000000");
  EXPECT_EQ(supg_error_after([](auto& json) { json["offset_ticks"].push_back(1); }),
            "walk.rec: controller: key 'offset_ticks' must be a number for each leg");
  EXPECT_EQ(supg_error_after([](auto& json) { json["patterns_rad"].erase(0); }),
            "walk.rec: controller: key 'patterns_rad' must be a list for each joint of a leg");
  EXPECT_EQ(
      supg_error_after([](auto& json) { json["patterns_rad"][3].erase(0); }),
      "walk.rec: controller: key 'patterns_rad[3]' must be a number for each tick from 0 to period_ticks");
  EXPECT_EQ(supg_error_after([](auto& json) { json["patterns_rad"][3][4] = "inf"; }),
            "walk.rec: controller: key 'patterns_rad[3][4]' must be a finite number");
}

TEST(SupgPatterns, TellsEachEndOfTheRangesOfItsNumbers) {
  const auto with_period = [](std::int64_t ticks) {
    return supg_error_after([=](auto& json) {
      json["period_ticks"] = ticks;
      for (auto& pattern : json["patterns_rad"]) pattern = {0.0, 0.1};
    });
  };
  EXPECT_EQ(with_period(1), "no error");
  EXPECT_NE(with_period(1'000'000).find("a number for each tick"), std::string::npos)
      << "the period itself is sound";
  for (const std::int64_t ticks : {std::int64_t{-1}, std::int64_t{1'000'001}, std::int64_t{1} << 40})
    EXPECT_NE(with_period(ticks).find("a whole number from 1 to 1000000"), std::string::npos) << ticks;
  EXPECT_EQ(supg_error_after([](auto& json) { json["timestep_s"] = 1e-9; }), "no error");
  for (const char* timestep : {"0", "\"inf\"", "\"-inf\""})
    EXPECT_NE(supg_error_after([&](auto& json) {
                json["timestep_s"] = nlohmann::json::parse(timestep);
              }).find("'timestep_s' must be a number above 0"),
              std::string::npos)
        << timestep;
  EXPECT_NE(supg_error_after([](auto& json) {
              json["patterns_rad"][3].push_back(0.0);
            }).find("a number for each tick"),
            std::string::npos);
  EXPECT_NE(supg_error_after([](auto& json) { json["offset_ticks"].erase(0); }).find("a number for each leg"),
            std::string::npos);
}

}  // namespace

}  // namespace amble::motion
