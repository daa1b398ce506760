#include "amble/motion/supg_patterns.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "tests/motion/fixture.hpp"

namespace amble::motion {
namespace {

std::string error_after(const std::function<void(nlohmann::json&)>& change) {
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
  EXPECT_EQ(error_after([](auto& json) { json.erase("period_ticks"); }),
            "walk.rec: controller: key 'period_ticks' is missing");
  EXPECT_EQ(error_after([](auto& json) { json["period_ticks"] = 0; }),
            "walk.rec: controller: key 'period_ticks' must be a whole number from 1 to 1000000");
  EXPECT_EQ(error_after([](auto& json) { json["timestep_s"] = -1; }),
            "walk.rec: controller: key 'timestep_s' must be a number above 0");
  EXPECT_EQ(error_after([](auto& json) { json["offset"] = "late"; }),
            "walk.rec: controller: key 'offset' must be phase or delay");
  for (const int ticks : {-1'000'001, 1'000'001})
    EXPECT_EQ(error_after([ticks](auto& json) { json["offset_ticks"][3] = ticks; }),
              "walk.rec: controller: key 'offset_ticks[3]' must be a whole number from -1000000 to 1000000");
  EXPECT_EQ(error_after([](auto& json) { json["offset_ticks"].push_back(1); }),
            "walk.rec: controller: key 'offset_ticks' must be a number for each leg");
  EXPECT_EQ(error_after([](auto& json) { json["patterns_rad"].erase(0); }),
            "walk.rec: controller: key 'patterns_rad' must be a list for each joint of a leg");
  EXPECT_EQ(
      error_after([](auto& json) { json["patterns_rad"][3].erase(0); }),
      "walk.rec: controller: key 'patterns_rad[3]' must be a number for each tick from 0 to period_ticks");
  EXPECT_EQ(error_after([](auto& json) { json["patterns_rad"][3][4] = "inf"; }),
            "walk.rec: controller: key 'patterns_rad[3][4]' must be a finite number");
}

TEST(SupgPatterns, TellsEachEndOfTheRangesOfItsNumbers) {
  const auto with_period = [](std::int64_t ticks) {
    return error_after([=](auto& json) {
      json["period_ticks"] = ticks;
      for (auto& pattern : json["patterns_rad"]) pattern = {0.0, 0.1};
    });
  };
  EXPECT_EQ(with_period(1), "no error");
  EXPECT_NE(with_period(1'000'000).find("a number for each tick"), std::string::npos)
      << "the period itself is sound";
  for (const std::int64_t ticks : {std::int64_t{-1}, std::int64_t{1'000'001}, std::int64_t{1} << 40})
    EXPECT_NE(with_period(ticks).find("a whole number from 1 to 1000000"), std::string::npos) << ticks;
  EXPECT_EQ(error_after([](auto& json) { json["timestep_s"] = 1e-9; }), "no error");
  for (const char* timestep : {"0", "\"inf\"", "\"-inf\""})
    EXPECT_NE(error_after([&](auto& json) {
                json["timestep_s"] = nlohmann::json::parse(timestep);
              }).find("'timestep_s' must be a number above 0"),
              std::string::npos)
        << timestep;
  EXPECT_NE(
      error_after([](auto& json) { json["patterns_rad"][3].push_back(0.0); }).find("a number for each tick"),
      std::string::npos);
  EXPECT_NE(error_after([](auto& json) { json["offset_ticks"].erase(0); }).find("a number for each leg"),
            std::string::npos);
}

}  // namespace
}  // namespace amble::motion
