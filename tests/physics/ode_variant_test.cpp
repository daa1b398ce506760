#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>
#include <vector>

#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

using Numbers = std::map<std::string, double>;

std::unique_ptr<Engine> variant(const robot::RobotSpec& robot, const Numbers& numbers, double h = 0.01) {
  EngineSettings settings{.timestep_s = h};
  settings.own.numbers = numbers;
  auto engine = make_engine("ode-variant", robot, settings);
  engine->place(0);
  return engine;
}

/// Where it is after so many steps of stepping on the spot.
std::vector<std::uint64_t> walk(Engine& engine, const robot::RobotSpec& robot, int steps) {
  const int motors = static_cast<int>(robot.joints.size());
  LaneArray targets(motors, engine.lanes());
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < motors; ++j) targets.at(j, 0) = 0.4f * std::sin(0.1f * static_cast<float>(i + 7 * j));
    engine.step(targets);
    hashes.push_back(engine.state_hash(0));
  }
  return hashes;
}

/// Force along the slope that holds a sliding box back, N: by how much its momentum grows too little.
double friction_of_box_n(double mass_kg, double friction_n) {
  robot::RobotSpec box = scene("box");
  const double share = mass_kg / box.bodies[0].mass_kg;
  box.bodies[0].mass_kg = mass_kg;
  box.bodies[0].inertia_kg_m2 = share * box.bodies[0].inertia_kg_m2;
  box.gravity_m_s2 = {4.0, 0.0, -9.0};
  const auto engine = variant(box, {{"friction_n", friction_n}}, 0.001);
  LaneArray targets(0, engine->lanes());
  for (int i = 0; i < 100; ++i) engine->step(targets);
  const double before = engine->momentum_kg_m_s(0).x;
  for (int i = 0; i < 400; ++i) engine->step(targets);
  return mass_kg * 4.0 - (engine->momentum_kg_m_s(0).x - before) / 0.4;
}

TEST(OdeVariant, WithAllItsNumbersAtZeroIsOdeToTheBit) {
  const auto robot = quadruped();
  const auto reference = make_engine("ode", robot, {});
  reference->place(0);
  EXPECT_EQ(walk(*variant(robot, {}), robot, 300), walk(*reference, robot, 300));
}

TEST(OdeVariant, ItsNumbersLeaveOdeAsItIs) {
  const auto robot = quadruped();
  const auto reference = make_engine("ode", robot, {});
  EngineSettings settings;
  settings.own.numbers = {{"quick_sweeps", 20}, {"friction_n", 5}};
  const auto engine = make_engine("ode", robot, settings);
  reference->place(0);
  engine->place(0);
  EXPECT_EQ(walk(*engine, robot, 50), walk(*reference, robot, 50));
}

TEST(OdeVariant, QuickStepComesToTheExactSolutionWithSweeps) {
  const auto robot = quadruped();
  const auto height_after_m = [&robot](int sweeps) {
    const auto engine = variant(robot, {{"quick_sweeps", sweeps}});
    walk(*engine, robot, 10);
    return engine->com_m(0).z;
  };
  const double exact_m = height_after_m(0);
  const double few = std::abs(height_after_m(5) - exact_m), many = std::abs(height_after_m(2000) - exact_m);
  EXPECT_GT(few, 1e-5) << "few sweeps are far off, or the test shows nothing";
  EXPECT_LT(many, 0.05 * few);
}

TEST(OdeVariant, QuickStepRepeatsToTheBitWhateverOtherThreadsStep) {
  const auto robot = quadruped();
  const auto alone = walk(*variant(robot, {{"quick_sweeps", 20}}), robot, 200);
  std::vector<std::vector<std::uint64_t>> together(4);
  std::vector<std::thread> threads;
  threads.reserve(together.size());
  for (auto& hashes : together)
    threads.emplace_back([&hashes, &robot] {
      hashes = walk(*variant(robot, {{"quick_sweeps", 20}}), robot, 200);
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& hashes : together) EXPECT_EQ(hashes, alone);
}

TEST(OdeVariant, FrictionInNewtonsIsTheSameForceWhateverThePressure) {
  const double light_n = friction_of_box_n(2.0, 0.5);
  EXPECT_GT(light_n, 0.5);
  EXPECT_NEAR(friction_of_box_n(20.0, 0.5), light_n, 0.02 * light_n) << "ten times as heavy";
  EXPECT_NEAR(friction_of_box_n(20.0, 1.0), 2.0 * light_n, 0.02 * 2.0 * light_n);
}

TEST(OdeVariant, SoftFeetSinkInByTheirSoftness) {
  const auto robot = quadruped();
  const auto height_m = [&robot](double cfm_s_per_kg) {
    const auto engine = variant(robot, {{"foot_erp", 0.2}, {"foot_cfm_s_per_kg", cfm_s_per_kg}});
    LaneArray targets(static_cast<int>(robot.joints.size()), engine->lanes());
    for (int i = 0; i < 500; ++i) engine->step(targets);
    return engine->com_m(0).z;
  };
  const double hard = height_m(1e-5), soft = height_m(0.02), softer = height_m(0.04);
  EXPECT_GT(hard - soft, 1e-4);
  EXPECT_NEAR((hard - softer) / (hard - soft), 2.0, 0.1) << "depth = cfm h f / erp";
}

}  // namespace
}  // namespace amble::physics
