#include "amble/trial/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

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

/// Smallest, largest and mean of what was seen.
struct Range {
  double smallest = INFINITY, largest = -INFINITY, sum = 0.0;
  int count = 0;

  void see(double value) {
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
    sum += value;
    ++count;
  }
};

/// That what was seen is spread over ± `limit`, evenly to both sides: neither end is further than a
/// fiftieth of the range, and the mean of a uniform distribution has the standard error 2 limit/√(12 n).
void expect_spread(const Range& seen, double limit) {
  EXPECT_GE(seen.smallest, -limit);
  EXPECT_LE(seen.largest, limit);
  EXPECT_LT(seen.smallest, -0.96 * limit);
  EXPECT_GT(seen.largest, 0.96 * limit);
  EXPECT_NEAR(seen.sum / seen.count, 0.0, 5.0 * 2.0 * limit / std::sqrt(12.0 * seen.count));
}

/// Height of the lowest point over the ground.
double clearance_m(const physics::StartPose& pose) {
  const auto bodies =
      robot::poses_at(quadruped(), {pose.root.position_m, pose.root.rotation}, pose.joint_angle_rad);
  return robot::clearance_m(quadruped(), bodies);
}

double nominal_clearance_m() {
  return robot::clearance_m(quadruped(), robot::start_poses(quadruped()));
}

TEST(Scenario, TurnsAndBendsTheStartToBothSidesWithinItsLimitsAndTheStops) {
  auto noise = everything();
  noise.start_tilt_rad = 0.07;
  Range roll_rad, pitch_rad;
  std::vector<Range> joint_rad(quadruped().joints.size());
  for (std::uint32_t episode = 0; episode < 1000; ++episode) {
    const auto pose = draw(noise, episode).start.value();
    const auto attitude = roll_pitch_yaw(pose.root.rotation);
    roll_rad.see(attitude.roll_rad);
    pitch_rad.see(attitude.pitch_rad);
    ASSERT_NEAR(attitude.yaw_rad, 0.0, 0.003);
    ASSERT_EQ(pose.joint_angle_rad.size(), joint_rad.size());
    for (std::size_t j = 0; j < joint_rad.size(); ++j) {
      ASSERT_GE(pose.joint_angle_rad[j], quadruped().joints[j].lower_rad);
      ASSERT_LE(pose.joint_angle_rad[j], quadruped().joints[j].upper_rad);
      joint_rad[j].see(pose.joint_angle_rad[j]);
    }
  }
  constexpr double limit_rad = 1.01 * 0.07;  // the two turns are about one axis each only if they are small
  expect_spread(roll_rad, limit_rad);
  expect_spread(pitch_rad, limit_rad);
  for (std::size_t j = 0; j < joint_rad.size(); ++j) {
    SCOPED_TRACE(quadruped().joints[j].name);
    if (quadruped().joints[j].lower_rad <= -0.1 && quadruped().joints[j].upper_rad >= 0.1)
      expect_spread(joint_rad[j], 0.1);
  }
}

TEST(Scenario, LiftsTheStartJustOutOfTheGround) {
  auto noise = everything();
  noise.start_height_m = 0.0;
  int lifted = 0;
  for (std::uint32_t episode = 0; episode < 500; ++episode) {
    const auto pose = draw(noise, episode).start.value();
    const double lowest_m = clearance_m(pose);
    ASSERT_GE(lowest_m, nominal_clearance_m() - 1e-12);
    if (pose.root.position_m.z <= robot::start_poses(quadruped())[0].position_m.z) continue;
    ASSERT_LE(lowest_m, nominal_clearance_m() + 2e-6) << "lifted by no more than it had sunk";
    ++lifted;
  }
  EXPECT_GT(lifted, 400);
}

TEST(Scenario, DropsTheStartFromEveryHeightUpToTheLargest) {
  auto low = everything(), high = everything();
  low.start_height_m = 0.0;
  Range higher_m;
  for (std::uint32_t episode = 0; episode < 500; ++episode)
    higher_m.see(draw(high, episode).start->root.position_m.z - draw(low, episode).start->root.position_m.z);
  EXPECT_GE(higher_m.smallest, 0.0);
  EXPECT_LT(higher_m.smallest, 0.001);
  EXPECT_GT(higher_m.largest, 0.049);
  EXPECT_LE(higher_m.largest, 0.05);
}

TEST(Scenario, OffsetsEachSensorByItsOwnAmount) {
  std::vector<Range> attitude_rad(3), joint_rad(12);
  for (std::uint32_t episode = 0; episode < 1000; ++episode) {
    const auto scenario = draw(everything(), episode, 1);
    ASSERT_EQ(scenario.attitude_sensor_rad.size(), attitude_rad.size());
    ASSERT_EQ(scenario.joint_sensor_rad.size(), joint_rad.size());
    for (std::size_t i = 0; i < 3; ++i) attitude_rad[i].see(scenario.attitude_sensor_rad[i]);
    for (std::size_t j = 0; j < 12; ++j) joint_rad[j].see(scenario.joint_sensor_rad[j]);
  }
  for (const Range& seen : attitude_rad) expect_spread(seen, 0.04);
  for (const Range& seen : joint_rad) expect_spread(seen, 0.03);
}

/// One number of each kind of noise, the first that is drawn of it, with mean 0 and variance 1.
std::vector<double> first_numbers(std::uint32_t episode) {
  auto noise = everything();
  noise.touch_flip_probability = 0.5;
  noise.latency_ticks = 99;
  const auto scenario = draw(noise, episode, 200);
  const auto& flips = scenario.touch_flips;
  const bool flipped = !flips.empty() && flips[0].step == 1 && flips[0].leg == 0;
  const double roll_rad = roll_pitch_yaw(scenario.start->root.rotation).roll_rad;
  const double per_uniform = std::sqrt(12.0);  // the variance of a uniform distribution of width 1 is 1/12
  return {per_uniform * (roll_rad / 0.2), per_uniform * ((scenario.pushes[0].step - 0.5) / 200.0 - 0.5),
          flipped ? 1.0 : -1.0, per_uniform * (scenario.attitude_sensor_rad[0] / 0.08),
          per_uniform * ((scenario.latency_ticks + 0.5) / 100.0 - 0.5)};
}

TEST(Scenario, OfOneEpisodeTellsNothingOfTheOthersNorOneKindOfNoiseOfAnother) {
  constexpr std::uint32_t episodes = 2000, furthest = 4;
  std::vector<std::vector<double>> numbers;
  for (std::uint32_t episode = 0; episode < episodes; ++episode) numbers.push_back(first_numbers(episode));
  for (std::uint32_t later = 0; later <= furthest; ++later)
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < 5; ++b) {
        double correlation = 0.0;
        for (std::uint32_t i = 0; i + later < episodes; ++i)
          correlation += numbers[i][a] * numbers[i + later][b] / (episodes - later);
        const bool itself = later == 0 && a == b;
        EXPECT_NEAR(correlation, itself ? 1.0 : 0.0, 5.0 / std::sqrt(episodes - later))
            << "kinds " << a << " and " << b << ", " << later << " episodes later";
      }
}

TEST(Scenario, DrawsEveryLatencyUpToTheLargest) {
  std::set<int> seen;
  for (std::uint32_t episode = 0; episode < 100; ++episode)
    seen.insert(draw(everything(), episode, 1).latency_ticks);
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3}));
}

/// Hills under the quadruped.
const ground::Ground& hills() {
  static const ground::Ground hills = [] {
    ground::Settings settings;
    settings.kind = "hills";
    settings.height_m = 0.3;
    return ground::Ground(ground::make_field(settings, {}), quadruped());
  }();
  return hills;
}

TEST(Scenario, StartsAnywhereAroundTheOriginAsHighOverTheGroundAsOnThePlane) {
  for (const bool disturbed : {false, true}) {
    NoiseSettings noise = disturbed ? everything() : NoiseSettings{};
    Range x_m, y_m, higher_m;
    for (std::uint32_t episode = 0; episode < 500; ++episode) {
      const ScenarioKey key{.seed = 1, .generation = 5, .episode = episode};
      const auto draw_with = [&](double start_height_m, const ground::Ground* ground) {
        noise.start_height_m = start_height_m;
        return draw_scenario(noise, quadruped(), 100, h, key, {.ground = ground, .place_m = 3.0})
            .start.value();
      };
      const auto low = draw_with(0.0, &hills()), high = draw_with(0.05, &hills()),
                 plane = draw_with(0.05, nullptr);
      x_m.see(low.root.position_m.x);
      y_m.see(low.root.position_m.y);
      ASSERT_EQ(plane.root.position_m.x, low.root.position_m.x) << "the place does not depend on the ground";
      const auto bodies =
          robot::poses_at(quadruped(), {low.root.position_m, low.root.rotation}, low.joint_angle_rad);
      ASSERT_NEAR(hills().clearance_m(quadruped(), bodies), nominal_clearance_m(), 2e-6);
      higher_m.see(high.root.position_m.z - low.root.position_m.z);
    }
    expect_spread(x_m, 3.0);
    expect_spread(y_m, 3.0);
    EXPECT_GE(higher_m.smallest, 0.0);
    EXPECT_LT(higher_m.smallest, 0.001);
    EXPECT_GT(higher_m.largest, 0.049);
    EXPECT_LE(higher_m.largest, 0.05);
  }
}

}  // namespace
}  // namespace amble::trial
