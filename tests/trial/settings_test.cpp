#include "amble/trial/settings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "amble/core/error.hpp"

namespace amble::trial {
namespace {

TEST(TrialSettings, DefaultsAreThePapers1500StepsIn15Seconds) {
  const Settings settings;
  settings.validate();
  EXPECT_EQ(settings.steps(), 1500);
}

TEST(TrialSettings, RefusesADurationThatIsNoWholeNumberOfSteps) {
  Settings settings;
  settings.duration_s = 1.005;
  try {
    settings.validate();
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(),
                 "trial.duration_s = 1.005: expected a whole number of timesteps of 0.01 s, at most 1e9");
  }
}

TEST(TrialSettings, AcceptsThreeHoursDespiteRounding) {
  Settings settings;
  settings.duration_s = 3 * 3600.0;
  settings.validate();
  EXPECT_EQ(settings.steps(), 1080000);
}

TEST(TrialSettings, AreOfAWholeNumberOfStepsFromOneToABillion) {
  const auto accepted = [](double duration_s, double timestep_s) {
    Settings settings;
    settings.duration_s = duration_s;
    settings.timestep_s = timestep_s;
    try {
      settings.validate();
    } catch (const SettingError& error) {
      EXPECT_EQ(error.keys(), (std::vector<std::string>{"trial.duration_s", "trial.timestep_s"}));
      return false;
    }
    return true;
  };
  EXPECT_TRUE(accepted(0.1, 0.1));
  EXPECT_TRUE(accepted(1e6, 1e-3));
  EXPECT_FALSE(accepted(0.0, 0.1));
  EXPECT_FALSE(accepted(0.04, 0.1));
  EXPECT_FALSE(accepted(-1.0, 0.1));
  EXPECT_FALSE(accepted(1e9 + 1, 1.0));
  EXPECT_FALSE(accepted(std::nan(""), 0.1));
  // Off by up to a millionth of themselves.
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(accepted(1000.0 + sign * 0.9e-3, 1.0));
    EXPECT_FALSE(accepted(1000.0 + sign * 1.1e-3, 1.0));
  }
}

}  // namespace
}  // namespace amble::trial
