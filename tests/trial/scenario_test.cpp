#include "amble/trial/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "amble/morphology/robot_file.hpp"
#include "amble/robot/pose.hpp"

namespace amble::trial {
namespace {

constexpr double h = 0.01;

const robot::RobotSpec& quadruped() {
  static const auto robot = morphology::load_robot(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  return robot;
}

NoiseSettings everything() {
  return {.episodes = 3,
          .score = EpisodeScore::mean,
          .push_m_s = 0.2,
          .push_interval_s = 2.0,
          .start_joint_rad = 0.1,
          .start_tilt_rad = 0.1,
          .start_height_m = 0.05,
          .touch_flip_probability = 0.01,
          .joint_sensor_rad = 0.03,
          .attitude_sensor_rad = 0.04,
          .latency_ticks = 3};
}

Scenario draw(const NoiseSettings& noise, std::uint32_t episode = 0, int steps = 1500,
              std::uint32_t generation = 5) {
  return draw_scenario(noise, quadruped(), steps, h,
                       {.seed = 1, .generation = generation, .episode = episode});
}

/// All numbers of a scenario, to compare them to the bit.
std::vector<double> numbers(const Scenario& scenario) {
  std::vector<double> all{static_cast<double>(scenario.latency_ticks)};
  if (scenario.start) {
    const auto& [root, joints] = *scenario.start;
    all.insert(all.end(), {root.position_m.z, root.rotation.w, root.rotation.x, root.rotation.y});
    all.insert(all.end(), joints.begin(), joints.end());
  }
  for (const auto& push : scenario.pushes)
    all.insert(all.end(), {1.0 * push.step, push.impulse_n_s.x, push.impulse_n_s.y});
  for (const auto& flip : scenario.touch_flips) all.insert(all.end(), {1.0 * flip.step, 1.0 * flip.leg});
  all.insert(all.end(), scenario.joint_sensor_rad.begin(), scenario.joint_sensor_rad.end());
  all.insert(all.end(), scenario.attitude_sensor_rad.begin(), scenario.attitude_sensor_rad.end());
  return all;
}

TEST(Scenario, LeavesTheFirstEpisodeAloneWhereAskedTo) {
  auto noise = everything();
  noise.first_undisturbed = true;
  const auto first = draw(noise);
  EXPECT_FALSE(first.start);
  EXPECT_TRUE(first.pushes.empty() && first.touch_flips.empty());
  EXPECT_EQ(first.latency_ticks, 0);
  ASSERT_EQ(first.joint_sensor_rad.size(), 12u);
  ASSERT_EQ(first.attitude_sensor_rad.size(), 3u);
  for (const float offset : first.joint_sensor_rad) EXPECT_TRUE(offset == 0.0f && std::signbit(offset));
  for (const float offset : first.attitude_sensor_rad) EXPECT_TRUE(offset == 0.0f && std::signbit(offset));
  EXPECT_EQ(numbers(draw(noise, 1)), numbers(draw(everything(), 1))) << "and the others as they are";
}

TEST(Scenario, RepeatsForTheSameKeyAndForNoOther) {
  std::set<std::vector<double>> seen;
  for (std::uint32_t generation = 0; generation < 20; ++generation)
    for (std::uint32_t episode = 0; episode < 20; ++episode) {
      const auto once = numbers(draw(everything(), episode, 300, generation));
      EXPECT_EQ(once, numbers(draw(everything(), episode, 300, generation)));
      EXPECT_TRUE(seen.insert(once).second) << generation << ' ' << episode;
    }
  EXPECT_NE(numbers(draw_scenario(everything(), quadruped(), 300, h, {.seed = 2})),
            numbers(draw_scenario(everything(), quadruped(), 300, h, {.seed = 1})));
}

TEST(Scenario, OfALongTrialBeginsAsThatOfAShortOne) {
  const auto brief = draw(everything(), 0, 700), lasting = draw(everything(), 0, 30000);
  ASSERT_GT(lasting.pushes.size(), brief.pushes.size());
  for (std::size_t i = 0; i < brief.pushes.size(); ++i) {
    EXPECT_EQ(brief.pushes[i].step, lasting.pushes[i].step);
    EXPECT_EQ(brief.pushes[i].impulse_n_s, lasting.pushes[i].impulse_n_s);
  }
  for (std::size_t i = 0; i < brief.touch_flips.size(); ++i)
    EXPECT_EQ(brief.touch_flips[i].step, lasting.touch_flips[i].step);
  EXPECT_EQ(brief.start->joint_angle_rad, lasting.start->joint_angle_rad);
}

TEST(Scenario, KindsOfNoiseDoNotDependOnEachOther) {
  NoiseSettings only_pushes;
  only_pushes.push_m_s = everything().push_m_s;
  const auto alone = draw(only_pushes), among = draw(everything());
  ASSERT_EQ(alone.pushes.size(), among.pushes.size());
  for (std::size_t i = 0; i < alone.pushes.size(); ++i)
    EXPECT_EQ(alone.pushes[i].impulse_n_s, among.pushes[i].impulse_n_s);
  EXPECT_FALSE(alone.start);
  EXPECT_TRUE(alone.touch_flips.empty());
  EXPECT_EQ(alone.latency_ticks, 0);
}

TEST(Scenario, HasOnePushInEachIntervalUniformOverADisc) {
  const double largest_n_s = 0.2 * quadruped().total_mass_kg();
  double sum_x = 0.0, sum_y = 0.0, sum_r2 = 0.0, sum_when = 0.0, count = 0.0;
  for (std::uint32_t episode = 0; episode < 1000; ++episode) {
    const auto scenario = draw(everything(), episode, 1400);
    ASSERT_EQ(scenario.pushes.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
      const auto& [step, impulse_n_s] = scenario.pushes[i];
      ASSERT_GE(step, static_cast<int>(200 * i) + 1);
      ASSERT_LE(step, static_cast<int>(200 * i) + 200);
      ASSERT_LE(norm(impulse_n_s), largest_n_s);
      ASSERT_EQ(impulse_n_s.z, 0.0);
      sum_x += impulse_n_s.x;
      sum_y += impulse_n_s.y;
      sum_r2 += dot(impulse_n_s, impulse_n_s);
      sum_when += step - 200.0 * static_cast<double>(i);
      ++count;
    }
  }
  // Over a disc of radius R a coordinate has the variance R²/4 and r² the mean R²/2. Five standard errors.
  EXPECT_NEAR(sum_x / count, 0.0, 5 * largest_n_s / 2 / std::sqrt(count));
  EXPECT_NEAR(sum_y / count, 0.0, 5 * largest_n_s / 2 / std::sqrt(count));
  EXPECT_NEAR(sum_r2 / count, largest_n_s * largest_n_s / 2,
              5 * 0.29 * largest_n_s * largest_n_s / std::sqrt(count));
  EXPECT_NEAR(sum_when / count, 100.5, 5 * 58.0 / std::sqrt(count));
}

TEST(Scenario, FlipsTouchesAsOftenAsItSays) {
  double flips = 0.0;
  int last = 0;
  for (const auto& flip : draw(everything(), 0, 100000).touch_flips) {
    ASSERT_GE(flip.step, last) << "by rising step";
    last = flip.step;
    ASSERT_TRUE(flip.leg >= 0 && flip.leg < 4);
    ++flips;
  }
  EXPECT_NEAR(flips, 4000.0, 5 * std::sqrt(4000.0));
  EXPECT_LE(last, 100000);
}

TEST(Scenario, StartsWithinTheStopsAndNeverInTheGround) {
  const auto nominal = robot::start_poses(quadruped());
  const double clearance_m = robot::clearance_m(quadruped(), nominal);
  double largest_rad = 0.0, highest_m = 0.0, most_tilt_rad = 0.0;
  for (std::uint32_t episode = 0; episode < 500; ++episode) {
    const auto pose = draw(everything(), episode).start.value();
    for (std::size_t j = 0; j < pose.joint_angle_rad.size(); ++j) {
      ASSERT_GE(pose.joint_angle_rad[j], quadruped().joints[j].lower_rad);
      ASSERT_LE(pose.joint_angle_rad[j], quadruped().joints[j].upper_rad);
      ASSERT_LE(std::abs(pose.joint_angle_rad[j]), 0.1);
      largest_rad = std::max(largest_rad, std::abs(pose.joint_angle_rad[j]));
    }
    const auto attitude = roll_pitch_yaw(pose.root.rotation);
    ASSERT_LE(std::abs(attitude.roll_rad), 0.101);
    ASSERT_LE(std::abs(attitude.pitch_rad), 0.101);
    ASSERT_NEAR(attitude.yaw_rad, 0.0, 0.006);
    most_tilt_rad = std::max(most_tilt_rad, std::abs(attitude.roll_rad));
    const auto bodies =
        robot::poses_at(quadruped(), {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
    const double lowest_m = robot::clearance_m(quadruped(), bodies);
    ASSERT_GE(lowest_m, clearance_m - 1e-12);
    highest_m = std::max(highest_m, lowest_m - clearance_m);
  }
  EXPECT_GT(largest_rad, 0.09);
  EXPECT_GT(most_tilt_rad, 0.09);
  EXPECT_GT(highest_m, 0.045);
}

TEST(Scenario, DrawsEveryLatencyUpToTheLargest) {
  std::set<int> seen;
  for (std::uint32_t episode = 0; episode < 100; ++episode)
    seen.insert(draw(everything(), episode, 1).latency_ticks);
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace amble::trial
