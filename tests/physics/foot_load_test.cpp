#include <gtest/gtest.h>

#include "tests/physics/own_models.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

class FootLoad : public OnEachEngine {};
ON_EACH_ENGINE(FootLoad);

double sum_of(const LaneArray& loads_n) {
  double sum = 0.0;
  for (int leg = 0; leg < loads_n.rows(); ++leg) sum += static_cast<double>(loads_n.at(leg, 0));
  return sum;
}

TEST_P(FootLoad, TheFeetOfARobotThatStandsCarryItsWeight) {
  const robot::RobotSpec robot = quadruped();
  const double weight_n = robot.total_mass_kg() * norm(robot.gravity_m_s2);
  const auto engine = make_engine(GetParam(), robot, {.timestep_s = 0.01, .loads = true});
  LaneArray targets(static_cast<int>(robot.joints.size()), engine->lanes());
  engine->place(0);
  ASSERT_NE(engine->foot_load_n(), nullptr);
  EXPECT_EQ(sum_of(*engine->foot_load_n()), 0.0);  // before the first step
  double sum_n = 0.0;
  for (int step = 0; step < 600; ++step) {
    engine->step(targets);
    if (step < 200) continue;
    sum_n += sum_of(*engine->foot_load_n());
    for (int leg = 0; leg < 4; ++leg) EXPECT_GE(engine->foot_load_n()->at(leg, 0), 0.0f);
  }
  EXPECT_NEAR(sum_n / 400.0, weight_n, 0.01 * weight_n);
}

TEST_P(FootLoad, IsNoneInTheAirAndChangesNoBit) {
  const robot::RobotSpec robot = lifted(quadruped(), 0.05);
  const auto with = make_engine(GetParam(), robot, {.timestep_s = 0.01, .loads = true});
  const auto without = make_engine(GetParam(), robot, {.timestep_s = 0.01});
  EXPECT_EQ(without->foot_load_n(), nullptr);
  LaneArray targets(static_cast<int>(robot.joints.size()), with->lanes());
  with->place(0);
  without->place(0);
  bool loaded = false;
  for (int step = 0; step < 60; ++step) {
    with->step(targets);
    without->step(targets);
    ASSERT_EQ(with->state_hash(0), without->state_hash(0)) << step;
    for (int leg = 0; leg < 4; ++leg) {
      const float load_n = with->foot_load_n()->at(leg, 0);
      loaded = loaded || load_n > 0.0f;
      EXPECT_TRUE(load_n == 0.0f || with->sensors().touch.at(leg, 0) == 1.0f) << step;
    }
  }
  EXPECT_TRUE(loaded);
}

TEST(FootLoadOfAnOwnModel, IsTheWeightOfARobotThatStands) {
  const morphology::Files files;
  const robot::RobotSpec robot = own_robot(files, own_model(position_actuators));
  const auto engine = make_engine("mujoco-model", robot, {.timestep_s = 0.01, .loads = true});
  LaneArray targets(static_cast<int>(robot.joints.size()), 1);
  engine->place(0);
  double sum_n = 0.0;
  for (int step = 0; step < 600; ++step) {
    engine->step(targets);
    if (step >= 200) sum_n += sum_of(*engine->foot_load_n());
  }
  const double weight_n = robot.total_mass_kg() * norm(robot.gravity_m_s2);
  EXPECT_NEAR(sum_n / 400.0, weight_n, 0.01 * weight_n);
}

}  // namespace
}  // namespace amble::physics
