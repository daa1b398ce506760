#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "amble/core/hash.hpp"
#include "amble/physics/batch/batch_engine.hpp"
#include "amble/physics/batch/workspace.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

float target(int gait, int joint, int step) {
  return 0.6f * static_cast<float>(std::sin(0.06 * step + 1.7 * gait * joint));
}

/// Where a gait starts and how it is pushed: every second one leans, and is pushed twice.
void place(Engine& engine, const robot::RobotSpec& robot, int lane, int gait) {
  if (gait % 2 == 0) return engine.place(lane);
  StartPose start{.root = {robot.bodies[0].position_m, axis_angle({0.6, 0.8, 0.0}, 0.004 * gait)},
                  .joint_angle_rad = {}};
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    start.joint_angle_rad.push_back(std::clamp(0.01 * static_cast<double>(j) - 0.02,
                                               robot.joints[j].lower_rad, robot.joints[j].upper_rad));
  engine.place_at(lane, start);
}
void push(Engine& engine, int lane, int gait, int age) {
  if (gait % 2 == 1 && (age == 20 + gait || age == 80)) engine.push(lane, {0.1 * gait, 0.5, -0.2});
}

/// Every lane on its own walk: `gaits[lane]`, −1: stays empty. Lanes may begin late. One hash per lane over
/// all its states and torques.
std::vector<std::uint64_t> walk(
    const robot::RobotSpec& robot, const std::vector<int>& gaits,
    const std::vector<int>& begin = std::vector<int>(16, 0), int steps = 200,
    const std::function<void()>& before_step = [] {}) {
  const auto engine = make_engine("batch", robot, {.torques = true});
  std::vector<std::vector<std::uint64_t>> hashes(16);
  std::vector<float> torques(robot.joints.size());
  LaneArray targets(static_cast<int>(robot.joints.size()), 16);
  for (int n = 0; n < steps + 100; ++n) {
    for (int lane = 0; lane < 16; ++lane) {
      const int gait = gaits[static_cast<std::size_t>(lane)], age = n - begin[static_cast<std::size_t>(lane)];
      if (gait < 0) continue;
      if (age == 0) place(*engine, robot, lane, gait);
      if (age == steps) engine->retire(lane);
      if (age >= 0 && age < steps) push(*engine, lane, gait, age);
      for (int j = 0; j < targets.rows(); ++j) targets.at(j, lane) = target(gait, j, age);
    }
    before_step();
    engine->step(targets);
    for (int lane = 0; lane < 16; ++lane) {
      const int age = n - begin[static_cast<std::size_t>(lane)];
      if (age < 0 || age >= steps || gaits[static_cast<std::size_t>(lane)] < 0) continue;
      for (std::size_t j = 0; j < torques.size(); ++j)
        torques[j] = engine->motor_torque_nm()->at(static_cast<int>(j), lane);
      hashes[static_cast<std::size_t>(lane)].push_back(engine->state_hash(lane));
      hashes[static_cast<std::size_t>(lane)].push_back(hash_span<float>(torques));
    }
  }
  std::vector<std::uint64_t> all;
  for (const auto& lane : hashes) all.push_back(hash_span<std::uint64_t>(lane));
  return all;
}

const std::vector<int> in_order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

TEST(BatchLanes, AWalkIsTheSameInEveryLaneAndCompany) {
  for (const auto& robot : {quadruped("paper"), quadruped("authors"), limping(quadruped("paper"))}) {
    const auto together = walk(robot, in_order);
    for (std::size_t a = 0; a < 16; ++a)
      for (std::size_t b = 0; b < a; ++b) ASSERT_NE(together[a], together[b]);

    std::vector<int> shuffled;
    for (int lane = 0; lane < 16; ++lane) shuffled.push_back((lane * 7 + 3) % 16);
    const auto other = walk(robot, shuffled);
    for (std::size_t lane = 0; lane < 16; ++lane)
      EXPECT_EQ(other[lane], together[static_cast<std::size_t>(shuffled[lane])]) << lane;

    for (const int gait : {0, 5, 11}) {
      std::vector<int> alone(16, -1);
      alone[static_cast<std::size_t>(15 - gait)] = gait;
      EXPECT_EQ(walk(robot, alone)[static_cast<std::size_t>(15 - gait)],
                together[static_cast<std::size_t>(gait)]);
    }
  }
}

TEST(BatchLanes, ALaneThatIsRefilledMidwayDisturbsNobodyAndIsNotDisturbed) {
  const auto robot = quadruped("paper");
  std::vector<int> begin;
  for (int lane = 0; lane < 16; ++lane) begin.push_back(6 * lane);
  EXPECT_EQ(walk(robot, in_order, begin), walk(robot, in_order));
}

// All engines of a thread share it.
TEST(BatchLanes, ScratchMemoryCarriesNothingFromStepToStep) {
  const auto poison = [] {
    constexpr std::size_t floats = 1 << 18;
    std::fill_n(batch::thread_scratch(floats), floats, std::numeric_limits<float>::quiet_NaN());
  };
  for (const auto& robot :
       {quadruped("paper"), quadruped("authors"), limping(quadruped("paper")), scene("sled")})
    EXPECT_EQ(walk(robot, in_order, std::vector<int>(16, 0), 120, poison),
              walk(robot, in_order, std::vector<int>(16, 0), 120));
}

TEST(BatchLanes, EveryInstructionSetGivesTheSameBits) {
  const std::int64_t all = hwy::SupportedTargets();
  for (const auto& robot :
       {quadruped("paper"), quadruped("authors"), limping(quadruped("paper")), scene("sled")}) {
    const auto best = walk(robot, in_order, std::vector<int>(16, 0), 120);
    int compared = 0;
    for (const std::int64_t set :
         {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_SCALAR}}) {
      if ((all & set) == 0 && set != HWY_SCALAR) continue;
      hwy::SetSupportedTargetsForTest(set);
      EXPECT_EQ(walk(robot, in_order, std::vector<int>(16, 0), 120), best) << hwy::TargetName(set);
      ++compared;
    }
    hwy::SetSupportedTargetsForTest(0);
    EXPECT_GE(compared, 1);
  }
}

TEST(BatchLanes, ALaneThatExplodesLeavesTheOthersAlone) {
  const auto robot = quadruped("paper");
  const auto run = [&](float bad) {
    const auto engine = make_engine("batch", robot, {});
    LaneArray targets(12, 16);
    engine->place(3);
    engine->place(4);
    for (int n = 0; n < 100; ++n) {
      for (int j = 0; j < 12; ++j) targets.at(j, 3) = targets.at(j, 4) = target(2, j, n);
      if (n == 30) targets.at(5, 3) = bad;
      engine->step(targets);
    }
    EXPECT_EQ(engine->healthy(3), !std::isnan(bad));
    EXPECT_TRUE(engine->healthy(4));
    return engine->state_hash(4);
  };
  EXPECT_EQ(run(std::numeric_limits<float>::quiet_NaN()), run(0.1f));
}

TEST(BatchLanes, TheHashOfALaneSeesEveryNumberOfItsState) {
  const auto robot = quadruped("paper");
  const auto engine = make_batch_engine(robot, {});
  engine->place(5);
  LaneArray targets(12, 16);
  for (int j = 0; j < 12; ++j) targets.at(j, 5) = target(1, j, 7);
  for (int n = 0; n < 20; ++n) engine->step(targets);
  const RobotState state = engine->state(5);
  const auto numbers = [](RobotState& of) {
    std::vector<double*> all;
    for (Vec3* v : {&of.com_m, &of.velocity_m_s, &of.angular_momentum_kg_m2_s})
      all.insert(all.end(), {&v->x, &v->y, &v->z});
    all.insert(all.end(), {&of.rotation.w, &of.rotation.x, &of.rotation.y, &of.rotation.z});
    for (auto* values : {&of.angle_rad, &of.speed_rad_s})
      for (double& value : *values) all.push_back(&value);
    return all;
  };
  engine->set_state(5, state);
  std::vector<std::uint64_t> hashes{engine->state_hash(5)};
  RobotState other = state;
  for (std::size_t k = 0; k < numbers(other).size(); ++k) {
    other = state;
    *numbers(other)[k] += 1e-5;
    engine->set_state(5, other);
    EXPECT_EQ(std::ranges::count(hashes, engine->state_hash(5)), 0) << "number " << k;
    hashes.push_back(engine->state_hash(5));
  }
  EXPECT_EQ(hashes.size(), 1u + 13u + 24u);
  engine->set_state(5, state);
  EXPECT_EQ(engine->state_hash(5), hashes[0]);
}

TEST(BatchLanes, ForcesBeyondAllNumbersEndTheTrialAndNotTheProcess) {
  robot::RobotSpec robot = quadruped();
  robot.gravity_m_s2.z = -1e308;
  Bench bench("batch", robot);
  const std::uint64_t start = bench.engine->state_hash(0);
  bench.steps(3);
  EXPECT_FALSE(bench.engine->healthy(0));
  bench.engine->place(0);
  EXPECT_TRUE(bench.engine->healthy(0));
  EXPECT_EQ(bench.engine->state_hash(0), start);
}

TEST(BatchLanes, AbsurdSpeedIsNotHealthy) {
  robot::RobotSpec robot = lifted(scene("box"), 1e6);
  robot.gravity_m_s2 = {0.0, 0.0, -9.8e3};
  Bench bench("batch", robot);
  bench.steps(10);  // 980 m/s
  EXPECT_TRUE(bench.engine->healthy(0));
  bench.steps(1);  // 1078 m/s
  EXPECT_FALSE(bench.engine->healthy(0));
}

}  // namespace
}  // namespace amble::physics
