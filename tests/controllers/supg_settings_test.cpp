#include "amble/controllers/supg_settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/json_file.hpp"

namespace amble::controllers {
namespace {

std::string refusal(double period_s, double timestep_s) {
  SupgSettings settings;
  settings.period_s = period_s;
  try {
    period_ticks(settings, timestep_s);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "none";
}

TEST(SupgSettings, CountThePeriodInTicks) {
  SupgSettings settings;
  EXPECT_EQ(period_ticks(settings, 0.01), 100);
  EXPECT_EQ(period_ticks(settings, 0.5), 2);
  settings.period_s = 0.3;  // 0.3 / 0.01 is not 30 to the last bit
  EXPECT_EQ(period_ticks(settings, 0.01), 30);
}

TEST(SupgSettings, RefuseAPeriodThatIsNotAWholeNumberOfTicks) {
  EXPECT_EQ(refusal(1.005, 0.01),
            "controller.supg.period_s = 1.005 is 100.49999999999999 ticks of 0.01 s: expected a whole number "
            "from 2 to 100000");
  EXPECT_NE(refusal(0.01, 0.01), "none");
  EXPECT_NE(refusal(1.0, 1e-6), "none");
  EXPECT_EQ(refusal(0.02, 0.01), "none");
}

TEST(SupgSettings, AreTheAuthorsByDefault) {
  SupgSettings settings;
  io::Json json = io::Json::object();
  settings.describe(*io::json_writer(json));
  EXPECT_EQ(json, io::Json::parse(R"({
    "period_s": 1.0, "trigger": "edge", "trigger_debounce_ticks": 1, "offset": "phase", "start_tick": 1, "idle": "mid"})"));
}

TEST(SupgSettings, TakePeriodsFromTwoTicksToAHundredThousandAndRoundingInTheTenthDigit) {
  EXPECT_EQ(refusal(2.0, 1.0), "none");
  EXPECT_NE(refusal(1.0, 1.0), "none");
  EXPECT_EQ(refusal(1e5, 1.0), "none");
  EXPECT_NE(refusal(1e5 + 1, 1.0), "none");
  EXPECT_NE(refusal(std::nan(""), 1.0), "none");
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(refusal(100.0 + sign * 0.9e-7, 1.0), "none");
    EXPECT_NE(refusal(100.0 + sign * 1.1e-7, 1.0), "none");
  }
  try {
    period_ticks({.period_s = 1.0}, 1.0);
    FAIL();
  } catch (const SettingError& error) {
    EXPECT_EQ(error.keys(), (std::vector<std::string>{"controller.supg.period_s", "trial.timestep_s"}));
  }
}

}  // namespace
}  // namespace amble::controllers
