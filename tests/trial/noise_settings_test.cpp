#include "amble/trial/noise_settings.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "amble/core/error.hpp"

namespace amble::trial {
namespace {

std::string error_of(const NoiseSettings& noise) {
  try {
    noise.validate({});
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(NoiseSettings, AreOffByDefault) {
  const NoiseSettings noise;
  EXPECT_FALSE(noise.any());
  EXPECT_EQ(noise.episodes, 1);
  EXPECT_EQ(error_of(noise), "");
}

TEST(NoiseSettings, AreOnWithAnyAmount) {
  const auto with = [](auto member) {
    NoiseSettings noise;
    noise.*member = 1;
    return noise.any();
  };
  EXPECT_TRUE(with(&NoiseSettings::push_m_s));
  EXPECT_TRUE(with(&NoiseSettings::start_joint_rad));
  EXPECT_TRUE(with(&NoiseSettings::start_tilt_rad));
  EXPECT_TRUE(with(&NoiseSettings::start_height_m));
  EXPECT_TRUE(with(&NoiseSettings::touch_flip_probability));
  EXPECT_TRUE(with(&NoiseSettings::joint_sensor_rad));
  EXPECT_TRUE(with(&NoiseSettings::attitude_sensor_rad));
  EXPECT_TRUE(with(&NoiseSettings::latency_ticks));
  EXPECT_FALSE(with(&NoiseSettings::push_interval_s)) << "how often is no amount";
}

TEST(NoiseSettings, RefuseEpisodesThatWouldAllBeTheSame) {
  NoiseSettings noise;
  noise.episodes = 3;
  EXPECT_EQ(error_of(noise), "noise.episodes = 3: without any noise they would all be the same; expected 1");
  noise.latency_ticks = 1;
  EXPECT_EQ(error_of(noise), "");
}

TEST(NoiseSettings, RefuseASingleEpisodeThatWouldBeUndisturbed) {
  NoiseSettings noise;
  noise.latency_ticks = 1;
  noise.first_undisturbed = true;
  EXPECT_EQ(error_of(noise),
            "noise.first_undisturbed leaves noise.episodes = 1 no noise; expected at least 2");
  noise.episodes = 2;
  EXPECT_EQ(error_of(noise), "");
}

TEST(NoiseSettings, RefusePushesMoreOftenThanSteps) {
  NoiseSettings noise;
  noise.push_m_s = 0.1;
  noise.push_interval_s = 0.005;
  EXPECT_EQ(error_of(noise), "noise.push_interval_s = 0.005: expected at least one timestep, 0.01 s");
}

TEST(NoiseSettings, DisturbTheStartWithEachOfItsAmountsAndNoOther) {
  const auto disturbs = [](auto member) {
    NoiseSettings noise;
    noise.*member = 1;
    return noise.disturbs_start();
  };
  for (const auto member :
       {&NoiseSettings::start_joint_rad, &NoiseSettings::start_tilt_rad, &NoiseSettings::start_height_m})
    EXPECT_TRUE(disturbs(member));
  for (const auto member : {&NoiseSettings::push_m_s, &NoiseSettings::touch_flip_probability,
                            &NoiseSettings::joint_sensor_rad, &NoiseSettings::attitude_sensor_rad})
    EXPECT_FALSE(disturbs(member));
  EXPECT_FALSE(disturbs(&NoiseSettings::latency_ticks));
}

TEST(NoiseSettings, TakeEpisodesWithoutNoiseThatStartAtOtherPlaces) {
  NoiseSettings noise;
  noise.episodes = 2;
  EXPECT_NO_THROW(noise.validate({}, true));
  EXPECT_THROW(noise.validate({}, false), SettingError);
  noise.first_undisturbed = true;
  EXPECT_NO_THROW(noise.validate({}, true));
}

TEST(NoiseSettings, TakeAPushInEachStepAndAnyIntervalWithoutPushes) {
  NoiseSettings noise;
  noise.push_interval_s = 0.005;
  EXPECT_EQ(error_of(noise), "");
  noise.push_m_s = 0.1;
  EXPECT_NE(error_of(noise), "");
  noise.push_interval_s = 0.01;
  EXPECT_EQ(error_of(noise), "");
}

TEST(NoiseSettings, NameTheKeysThatCouldBeChanged) {
  const auto keys = [](NoiseSettings noise) -> std::vector<std::string> {
    try {
      noise.validate({});
    } catch (const SettingError& error) {
      return error.keys();
    }
    return {};
  };
  using Keys = std::vector<std::string>;
  EXPECT_EQ(keys({.first_undisturbed = true}), (Keys{"noise.first_undisturbed", "noise.episodes"}));
  EXPECT_EQ(keys({.episodes = 2}), Keys{"noise.episodes"});
  EXPECT_EQ(keys({.push_m_s = 0.1, .push_interval_s = 1e-5}),
            (Keys{"noise.push_interval_s", "trial.timestep_s"}));
}

TEST(NoiseSettings, OfALevelTurnTheStartAndDropItFromATenthAsMuch) {
  const NoiseSettings milli = noise_of(*record::find_level("milli"));
  EXPECT_EQ(milli.start_joint_rad, 1e-3);
  EXPECT_EQ(milli.start_tilt_rad, 1e-3);
  EXPECT_DOUBLE_EQ(milli.start_height_m, 1e-4);
  EXPECT_EQ(milli.push_m_s, 0.0);
  const NoiseSettings control = noise_of(*record::find_level("control"));
  EXPECT_FALSE(control.disturbs_start());
  EXPECT_EQ(control.push_m_s, 1e-20);
}

}  // namespace
}  // namespace amble::trial
