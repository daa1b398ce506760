#include "amble/trial/noise_settings.hpp"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace amble::trial
