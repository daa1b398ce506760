#include "amble/trial/settings.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace amble::trial
