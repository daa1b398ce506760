#include "amble/presentation/shown_trial.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "amble/experiment/replay.hpp"
#include "tests/presentation/champion.hpp"

namespace amble::presentation {
namespace {

const std::atomic<bool> unstopped{false};

TEST(ShownTrial, IsWithoutNoiseOfAWalkerThatEvolvedWithout) {
  const auto shown = shown_trial(champion_of({}), {}, {}, {}, 1, unstopped).value();
  EXPECT_FALSE(shown.key);
  EXPECT_FALSE(shown.noise.any());
  EXPECT_NE(shown.typical.find("64 trials at the level milli"), std::string::npos) << shown.typical;
}

TEST(ShownTrial, IsTheMedianOfSeveralWhereTheWalkerEvolvedUnderNoiseOrALevelIsAskedFor) {
  const auto noisy = champion_of({"noise.push_m_s=0.3"});
  const auto shown = shown_trial(noisy, {}, {}, {}, 1, unstopped).value();
  ASSERT_TRUE(shown.key);
  EXPECT_EQ(shown.noise.push_m_s, 0.3);
  EXPECT_NE(shown.typical.find("64 trials under its own noise"), std::string::npos) << shown.typical;

  const auto quiet = champion_of({});
  const auto milli = shown_trial(quiet, 2.0, "ode", {.level = "milli", .trials = 3}, 1, unstopped).value();
  ASSERT_TRUE(milli.key);
  EXPECT_EQ(milli.noise.start_joint_rad, 1e-3);
  EXPECT_NE(milli.typical.find("in 2 s: half of 3 trials at the level milli"), std::string::npos)
      << milli.typical;
}

TEST(ShownTrial, IsWithoutNoiseWhereThatIsAskedFor) {
  const auto noisy = champion_of({"noise.push_m_s=0.3"});
  const auto shown = shown_trial(noisy, {}, {}, {.level = {}, .undisturbed = true}, 1, unstopped).value();
  EXPECT_FALSE(shown.key);
  EXPECT_EQ(shown.typical, "");
}

TEST(ShownTrial, IsNothingIfItWasStopped) {
  const std::atomic<bool> stopped{true};
  EXPECT_FALSE(shown_trial(champion_of({"noise.push_m_s=0.3"}), {}, {}, {}, 1, stopped));
}

}  // namespace
}  // namespace amble::presentation
