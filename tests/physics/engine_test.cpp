#include "amble/physics/engine.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "amble/core/error.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

std::string refusal(const robot::RobotSpec& robot, std::string_view engine = "ode") {
  try {
    make_engine(engine, robot, {});
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "accepted";
}

class Place : public OnEachEngine {};
class Traits : public OnEachEngine {};
class Retire : public OnEachEngine {};
ON_EACH_ENGINE(Place);
ON_EACH_ENGINE(Traits);
ON_EACH_ENGINE(Retire);

TEST_P(Traits, AreThoseOfTheEngineThatIsMade) {
  EXPECT_EQ(engine_traits(GetParam()).lanes, make_engine(GetParam(), quadruped(), {})->lanes());
}

TEST(MakeEngine, RefusesAnUnknownName) {
  EXPECT_THROW(engine_traits("odd"), UserError);
  EXPECT_EQ(refusal(quadruped(), "odd"),
            fmt::format("unknown engine 'odd': expected {}", fmt::join(engine_names(), ", ")));
  EXPECT_THAT(refusal(quadruped(), "odd"), testing::HasSubstr("expected ode, batch, mujoco"));
}

TEST(MakeEngine, MujocoRefusesAnImpossibleInertia) {
  robot::RobotSpec robot = quadruped();
  robot.bodies[0].inertia_kg_m2 = {1.0, 1.0, 3.0};  // no body has more than the sum of the other two
  EXPECT_EQ(refusal(robot, "ode"), "accepted");
  EXPECT_THAT(refusal(robot, "mujoco"), testing::StartsWith("the mujoco engine: MuJoCo refuses the model: "));
}

TEST(MakeEngine, BatchRefusesSelfCollision) {
  robot::RobotSpec robot = quadruped();
  robot.self_collision = true;
  EXPECT_EQ(refusal(robot, "batch"),
            "the batch engine knows no self-collision: set self_collision = false, or use engine ode");
}

TEST(MakeEngine, BatchRefusesAChainOfMoreThanTwentyFourJoints) {
  robot::RobotSpec robot = quadruped();
  for (int more = 0; more < 22; ++more) {  // the first leg's three and 22 in a row below them
    robot.bodies.push_back(robot.bodies[2]);
    robot.bodies.back().parent = more == 0 ? 2 : static_cast<int>(robot.bodies.size()) - 2;
    robot.joints.push_back(robot.joints[0]);
    robot.joints.back().body = static_cast<int>(robot.bodies.size()) - 1;
  }
  EXPECT_THAT(refusal(robot, "batch"),
              testing::HasSubstr("cannot simulate more than 24 joints in one chain, as at body"));
}

TEST(MakeEngine, BatchTakesThreeJointsOnOneBody) {
  robot::RobotSpec robot = quadruped();
  robot.joints[0].body = robot.joints[1].body;
  robot.joints[0].chain_index = 2;
  robot.bodies.erase(robot.bodies.begin() + 2);
  for (auto& body : robot.bodies) body.parent -= body.parent > 2 ? 1 : 0;
  for (auto& geom : robot.geoms) geom.body -= geom.body >= 2 ? 1 : 0;
  for (auto& joint : robot.joints) joint.body -= joint.body > 2 ? 1 : 0;
  EXPECT_EQ(refusal(robot, "batch"), "accepted");
}

TEST_P(Place, PutsTheRobotIntoTheStartPoseOfItsModel) {
  for (const char* variant : {"authors", "paper"}) {
    const Bench bench(GetParam(), quadruped(variant));
    const RootPose root = bench.engine->root_pose(0);
    EXPECT_NEAR(norm(root.position_m - Vec3{0.0, 0.0, 0.88404}), 0.0, single_precision() ? 1e-6 : 0.0);
    EXPECT_EQ(root.rotation, Quat{});
    EXPECT_EQ(bench.engine->momentum_kg_m_s(0), Vec3{});
    for (int j = 0; j < 12; ++j) EXPECT_NEAR(bench.angle(j), 0.0, 1e-7);
    for (int row = 0; row < 3; ++row) EXPECT_EQ(bench.engine->sensors().attitude_rad.at(row, 0), 0.0f);
    for (int leg = 0; leg < 4; ++leg) EXPECT_TRUE(bench.touches(leg));
    EXPECT_TRUE(bench.engine->healthy(0));
  }
}

TEST_P(Place, StandsTheRootFrameNotItsCentreOfMassWhereTheModelSays) {
  robot::RobotSpec robot = weightless(scene("pendulum"));
  robot.bodies[0].com_m = {0.1, -0.2, 0.3};
  robot.bodies[0].rotation = axis_angle({0.0, 0.0, 1.0}, 0.5);
  const Bench bench(GetParam(), robot);
  const double rounding = single_precision() ? 2e-5 : 1e-14;
  const Vec3 offset = bench.engine->root_pose(0).position_m - robot.bodies[0].position_m;
  EXPECT_NEAR(norm(offset), 0.0, rounding);
  const Vec3 com = robot.bodies[0].position_m + rotate(robot.bodies[0].rotation, {0.1, -0.2, 0.3});
  EXPECT_NEAR(norm(bench.engine->root_com_m(0) - com), 0.0, rounding);
  // Attitude is counted from the start pose, whichever way the root's axes point in it.
  EXPECT_NEAR(static_cast<double>(bench.engine->sensors().attitude_rad.at(2, 0)), 0.0,
              single_precision() ? 5e-7 : 1e-7);
}

TEST_P(Retire, StopsTheRobotUntilItIsPlacedAgain) {
  Bench bench(GetParam(), lifted(quadruped(), 1.0));
  const std::uint64_t start = bench.engine->state_hash(0);
  bench.steps(10);
  bench.engine->retire(0);
  const std::uint64_t retired = bench.engine->state_hash(0);
  EXPECT_NE(retired, start);
  bench.steps(10);
  EXPECT_EQ(bench.engine->state_hash(0), retired);
  bench.engine->place(0);
  EXPECT_EQ(bench.engine->state_hash(0), start);
  bench.steps(1);
  EXPECT_NE(bench.engine->state_hash(0), start);
}

}  // namespace
}  // namespace amble::physics
