#include "amble/physics/damaged_engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "amble/core/index.hpp"
#include "amble/damage/stages.hpp"
#include "amble/ground/ground.hpp"
#include "amble/ground/settings.hpp"
#include "tests/damage/scene.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

using damage::locked;
using damage::missing;
using damage::payload;
using damage::slack;
using damage::weak;

class Damaged : public OnEachEngine {
 protected:
  static std::unique_ptr<Engine> make(const robot::RobotSpec& robot, std::vector<damage::Part> parts,
                                      bool torques = false) {
    return make_damaged_engine(GetParam(), robot, {std::move(parts)},
                               {.timestep_s = 0.01, .torques = torques});
  }
};
ON_EACH_ENGINE(Damaged);
class Moving : public OnEachEngine {};
ON_EACH_ENGINE(Moving);

/// A gait of sorts: joint j aims at ± a part of its range, with a phase of its own.
void swing(const robot::RobotSpec& robot, int step, LaneArray& targets, int lane) {
  for (int j = 0; j < targets.rows(); ++j) {
    const robot::Joint& joint = robot.joints[to_index(j)];
    const double middle = 0.5 * (joint.lower_rad + joint.upper_rad),
                 amplitude = 0.25 * (joint.upper_rad - joint.lower_rad);
    targets.at(j, lane) = static_cast<float>(middle + amplitude * std::sin(0.05 * step + j));
  }
}

LaneArray targets_for(const Engine& engine) {
  return LaneArray(engine.sensors().joint_angle_rad.rows(), engine.lanes());
}

/// Steps lane 0 by swing() from step `first` to `last`.
void walk(Engine& engine, const robot::RobotSpec& robot, int first, int last) {
  LaneArray targets = targets_for(engine);
  for (int n = first; n <= last; ++n) {
    swing(robot, n, targets, 0);
    engine.step(targets);
  }
}

void expect_near(const MovingPose& a, const MovingPose& b, double tolerance) {
  EXPECT_NEAR(norm(a.pose.root.position_m - b.pose.root.position_m), 0.0, tolerance);
  EXPECT_NEAR(norm(a.velocity_m_s - b.velocity_m_s), 0.0, tolerance);
  EXPECT_NEAR(norm(a.angular_velocity_rad_s - b.angular_velocity_rad_s), 0.0, 10.0 * tolerance);
  ASSERT_EQ(a.joint_speed_rad_s.size(), b.joint_speed_rad_s.size());
  for (std::size_t j = 0; j < a.joint_speed_rad_s.size(); ++j) {
    EXPECT_NEAR(a.pose.joint_angle_rad[j], b.pose.joint_angle_rad[j], tolerance) << j;
    EXPECT_NEAR(a.joint_speed_rad_s[j], b.joint_speed_rad_s[j], 10.0 * tolerance) << j;
  }
}

TEST_P(Moving, ARobotIsPlacedAsItMovesAndMovesOn) {
  auto robot = lifted(quadruped(), 5.0);
  robot.contact.cfm_s_per_kg = 1e-9;  // ODE's joints are as soft as its contacts
  robot.bodies[0].com_m = {0.03, -0.02, 0.04};
  for (const double h : {0.01, 0.001})
    for (const int steps : {1, 20, 80}) {
      const EngineSettings settings{.timestep_s = h};
      const auto first = make_engine(GetParam(), robot, settings),
                 second = make_engine(GetParam(), robot, settings);
      first->place(0);
      first->push(0, {1.0, -2.0, 0.5});
      walk(*first, robot, 1, steps);
      second->place_moving(0, first->motion(0));
      // ODE's velocities are compatible with the pose before the step.
      const double tolerance = single_precision() ? 2e-5 : drifting() ? 1e-9 : 0.1 * h;
      expect_near(second->motion(0), first->motion(0), tolerance);
      EXPECT_NEAR(norm(second->com_m(0) - first->com_m(0)), 0.0, tolerance);
      EXPECT_NEAR(norm(second->momentum_kg_m_s(0) - first->momentum_kg_m_s(0)), 0.0,
                  std::string(GetParam()) == "ode" ? 20.0 * h : 20.0 * tolerance);
      walk(*first, robot, steps + 1, steps + 10);
      walk(*second, robot, steps + 1, steps + 10);
      EXPECT_NEAR(norm(second->com_m(0) - first->com_m(0)), 0.0, 10.0 * tolerance);
    }
}

TEST_P(Damaged, WithoutDamageIsTheEngineItself) {
  const auto robot = quadruped();
  const auto plain = make_engine(GetParam(), robot, {}), same = make(robot, {damage::numb("FL")});
  plain->place(0);
  same->place(0);
  walk(*plain, robot, 1, 50);
  walk(*same, robot, 1, 50);
  EXPECT_EQ(plain->state_hash(0), same->state_hash(0));
}

TEST_P(Damaged, ASlackPendulumSwingsAsAFreeOneWhateverItsTarget) {
  const auto free = scene("pendulum");  // without torque
  robot::RobotSpec driven = free;
  driven.joints[0].servo.max_torque_nm = 50.0;
  const auto expected = make_engine(GetParam(), free, {});
  const auto broken = make(driven, {slack(free.joints[0].name)});
  expected->place(0);
  broken->place(0);
  LaneArray targets = targets_for(*broken);
  targets.set_lane(0, 1.5f);
  std::vector<int> turns;
  float before = 0.0f;
  bool falling = false;
  for (int n = 1; n <= 1000; ++n) {
    expected->step(targets);
    broken->step(targets);
    ASSERT_EQ(broken->state_hash(0), expected->state_hash(0)) << n;
    const float now = broken->sensors().joint_angle_rad.at(0, 0);
    if (falling && now < before) turns.push_back(n);
    falling = now > before;
    before = now;
  }
  // 0.28 kg m² about the hinge, 1 kg at 0.5 m, 0.2 rad to either side (0.25 % more than for small swings).
  ASSERT_GT(turns.size(), 4u);
  EXPECT_NEAR(0.01 * (turns.back() - turns[1]) / static_cast<double>(turns.size() - 2),
              2.0 * 3.14159265 * std::sqrt(0.28 / 4.9) * 1.0025, 0.015);
}

TEST_P(Damaged, AJointThatGoesSlackInMidTrialSwingsOnFromThere) {
  robot::RobotSpec driven = scene("pendulum");
  driven.joints[0].servo.max_torque_nm = 50.0;
  const auto broken = make(driven, {slack(driven.joints[0].name, 0.5)});
  const auto before = make_engine(GetParam(), driven, {}),
             after = make_engine(GetParam(), scene("pendulum"), {});
  broken->place(0);
  before->place(0);
  LaneArray targets = targets_for(*broken);
  targets.set_lane(0, 1.5f);
  for (int n = 1; n <= 50; ++n) {
    broken->step(targets);
    before->step(targets);
    ASSERT_EQ(broken->state_hash(0), before->state_hash(0)) << n;
  }
  after->place_moving(0, before->motion(0));
  for (int n = 51; n <= 150; ++n) {
    broken->step(targets);
    after->step(targets);
    ASSERT_EQ(broken->state_hash(0), after->state_hash(0)) << n;
  }
}

TEST_P(Damaged, AWeakMotorIsOneOfItsShareOfTorque) {
  const auto robot = quadruped();
  robot::RobotSpec weaker = robot;
  weaker.joints[1].servo.max_torque_nm *= 0.3;
  const auto expected = make_engine(GetParam(), weaker, {});
  const auto broken = make(robot, {weak(robot.joints[1].name, 0.3)});
  expected->place(0);
  broken->place(0);
  walk(*expected, robot, 1, 100);
  walk(*broken, robot, 1, 100);
  EXPECT_EQ(broken->state_hash(0), expected->state_hash(0));
}

TEST_P(Damaged, ALockedJointStartsAtItsAngleAndStaysThereUnderLoad) {
  const auto robot = quadruped();
  for (const double angle_rad : {-0.5, 0.0}) {
    const auto engine = make(robot, {locked(robot.joints[0].name, angle_rad)}, true);
    engine->place(0);
    EXPECT_NEAR(engine->sensors().joint_angle_rad.at(0, 0), angle_rad, 1e-6);
    LaneArray targets = targets_for(*engine);
    for (int n = 1; n <= 300; ++n) {
      swing(robot, n, targets, 0);
      engine->step(targets);
      ASSERT_TRUE(engine->healthy(0));
      ASSERT_NEAR(engine->sensors().joint_angle_rad.at(0, 0), angle_rad, single_precision() ? 4e-3 : 1e-3)
          << n;
      ASSERT_EQ(engine->motor_torque_nm()->at(0, 0), 0.0f);
    }
  }
}

TEST_P(Damaged, AJointThatLocksInMidTrialMovesToItsAngle) {
  const auto robot = quadruped();
  const auto engine = make(robot, {locked(robot.joints[1].name, 0.4, 1.0)});
  engine->place(0);
  LaneArray targets = targets_for(*engine);
  for (int n = 1; n <= 100; ++n) engine->step(targets);
  EXPECT_NEAR(engine->sensors().joint_angle_rad.at(1, 0), 0.0, 0.02);
  for (int n = 1; n <= 100; ++n) engine->step(targets);
  // Within 1 s to exp(−9) of the way.
  EXPECT_NEAR(engine->sensors().joint_angle_rad.at(1, 0), 0.4, 2e-3);
}

TEST_P(Damaged, AMissingLegIsGoneButItsJointsAndTouchAreStillThereToRead) {
  const auto robot = quadruped();
  const auto engine = make(robot, {missing("FL")}, true);
  const auto rest = make_engine(GetParam(), damage::robot_at_start(robot, {{missing("FL")}}), {});
  engine->place(0);
  rest->place(0);
  ASSERT_EQ(engine->sensors().joint_angle_rad.rows(), 12);
  ASSERT_EQ(engine->sensors().touch.rows(), 4);
  LaneArray all = targets_for(*engine), own = targets_for(*rest);
  for (int n = 1; n <= 100; ++n) {
    swing(robot, n, all, 0);
    for (int j = 0; j < 9; ++j) own.at(j, 0) = all.at(j + 3, 0);  // FL is the first leg
    engine->step(all);
    rest->step(own);
    ASSERT_EQ(engine->state_hash(0), rest->state_hash(0)) << n;
    for (int j = 0; j < 3; ++j) {
      ASSERT_EQ(engine->sensors().joint_angle_rad.at(j, 0), 0.0f);
      ASSERT_EQ(engine->motor_torque_nm()->at(j, 0), 0.0f);
    }
    ASSERT_EQ(engine->sensors().touch.at(0, 0), 0.0f);
    for (int l = 0; l < 3; ++l)
      ASSERT_EQ(engine->sensors().touch.at(l + 1, 0), rest->sensors().touch.at(l, 0));
  }
}

TEST_P(Damaged, ALegThatFallsOffLeavesTheRestAsItMoved) {
  const auto robot = weightless(quadruped());
  const auto engine = make(robot, {missing("BR", 0.3)});
  engine->place(0);
  engine->push(0, {3.0, 1.0, 0.0});
  walk(*engine, robot, 1, 30);
  const MovingPose before = engine->motion(0);
  // The pose that the rest has when it is cut off, one step of rest before.
  LaneArray targets = targets_for(*engine);
  for (int j = 0; j < 12; ++j)
    targets.at(j, 0) = static_cast<float>(before.pose.joint_angle_rad[to_index(j)]);
  engine->step(targets);
  const MovingPose after = engine->motion(0);
  EXPECT_NEAR(norm(after.pose.root.position_m - before.pose.root.position_m - 0.01 * after.velocity_m_s), 0.0,
              2e-3);
  for (int j = 9; j < 12; ++j) EXPECT_EQ(after.pose.joint_angle_rad[to_index(j)], 0.0);
  // In free flight what is left keeps its momentum from then on.
  const Vec3 momentum = engine->momentum_kg_m_s(0);
  walk(*engine, robot, 32, 60);
  EXPECT_NEAR(norm(engine->momentum_kg_m_s(0) - momentum), 0.0, drifting() ? 0.05 : 1e-4);
}

TEST_P(Damaged, APayloadMovesTheCentreOfMassAndTiltsABoxOnItsSprings) {
  robot::RobotSpec robot = scene("box");
  robot.contact.cfm_s_per_kg = 1e-4;
  const double load_kg = 3.0, x_m = 0.06, h = 0.01;
  const auto engine = make(robot, {payload(load_kg, x_m, 0.0, 0.0)});
  engine->place(0);
  const double mass = robot.total_mass_kg();
  EXPECT_NEAR(engine->com_m(0).x, load_kg * x_m / (mass + load_kg), 1e-6);
  LaneArray targets = targets_for(*engine);
  for (int n = 0; n < 2000; ++n) engine->step(targets);
  // Four springs of k at ± a: depth M g / 4k, pitch load g x / (4 k a²) (nose down is positive).
  const double k = robot.contact.erp / (h * 1e-4), a = robot.geoms[0].size_m.x;
  const double pitch_rad = load_kg * 9.8 * x_m / (4.0 * k * a * a);
  EXPECT_NEAR(engine->sensors().attitude_rad.at(1, 0), pitch_rad, 0.02 * pitch_rad);
  const double depth_m = (mass + load_kg) * 9.8 / (4.0 * k);
  const Vec3 middle = engine->root_pose(0).position_m;
  EXPECT_NEAR(robot.bodies[0].position_m.z - middle.z, depth_m, 0.02 * depth_m);
}

TEST_P(Damaged, EachLaneAndEachStartGiveTheSameBits) {
  const auto robot = quadruped();
  const std::vector<damage::Part> parts{missing("BR", 0.2), locked(robot.joints[0].name, -0.3),
                                        weak(robot.joints[4].name, 0.5, 0.35),
                                        payload(1.0, 0.1, 0.1, 0.0, 0.1)};
  constexpr int steps = 60;
  std::vector<std::uint64_t> expected;
  {
    const auto alone = make(robot, parts);
    alone->place(0);
    for (int n = 1; n <= steps; ++n) {
      walk(*alone, robot, n, n);
      expected.push_back(alone->state_hash(0));
    }
  }
  // Lane l begins 3 l steps later, so that lanes are in different stages; then all begin once more.
  const auto engine = make(robot, parts);
  LaneArray targets = targets_for(*engine);
  const int lanes = engine->lanes();
  for (int n = 1; n <= 2 * steps + 3 * lanes; ++n) {
    for (int lane = 0; lane < lanes; ++lane) {
      const int own = n - 3 * lane;
      if (own == 1 || own == steps + 1) engine->place(lane);
      if (own == 2 * steps + 1) engine->retire(lane);
      if (own >= 1) swing(robot, (own - 1) % steps + 1, targets, lane);
    }
    engine->step(targets);
    for (int lane = 0; lane < lanes; ++lane) {
      const int own = n - 3 * lane;
      if (own >= 1 && own <= 2 * steps) {
        ASSERT_EQ(engine->state_hash(lane), expected[to_index((own - 1) % steps)]) << n << ' ' << lane;
      }
    }
  }
}

TEST_P(Damaged, APushInTheStepOfTheDamageActsOnWhatIsLeft) {
  const auto robot = weightless(quadruped());
  const auto engine = make(robot, {missing("BR", 0.1)});
  engine->place(0);
  LaneArray targets = targets_for(*engine);
  for (int n = 1; n <= 10; ++n) engine->step(targets);
  engine->push(0, {1.0, 0.0, 0.0});
  engine->step(targets);
  EXPECT_NEAR(engine->momentum_kg_m_s(0).x, 1.0, 1e-2);
}

TEST_P(Damaged, OnUnevenGroundTheLegsThatAreLeftTouchIt) {
  const auto robot = quadruped();
  ground::Settings settings;
  settings.kind = "hills";
  settings.height_m = 0.02;
  const auto engine = make(robot, {missing("FR"), locked(robot.joints[0].name, -0.1)});
  engine->set_ground(std::make_shared<const ground::Ground>(ground::make_field(settings, {}), robot));
  engine->place(0);
  LaneArray targets = targets_for(*engine);
  bool touched = false;
  for (int n = 1; n <= 100; ++n) {
    engine->step(targets);
    ASSERT_TRUE(engine->healthy(0));
    ASSERT_EQ(engine->sensors().touch.at(1, 0), 0.0f);
    touched = touched || engine->sensors().touch.at(2, 0) == 1.0f;
  }
  EXPECT_TRUE(touched);
}

TEST_P(Damaged, OnUnevenGroundItIsTheRobotThatIsLeftOverToTheBit) {
  // The foot that is missing is the only one of its radius, for which the ground has heights of their own.
  auto robot = quadruped();
  robot.geoms[to_index(robot.legs[1].foot_geoms[0])].size_m.x *= 0.5;
  ground::Settings settings;
  settings.kind = "hills";
  settings.height_m = 0.02;
  const auto field = ground::make_field(settings, {});
  const auto left_over = damage::stages_of(robot, {{missing("FR")}})[0].robot;
  const auto damaged = make(robot, {missing("FR")}), plain = make_engine(GetParam(), left_over, {});
  damaged->set_ground(std::make_shared<const ground::Ground>(field, robot));
  plain->set_ground(std::make_shared<const ground::Ground>(field, left_over));
  for (Engine* const engine : {damaged.get(), plain.get()}) {
    engine->place(0);
    const LaneArray targets = targets_for(*engine);
    for (int n = 0; n < 50; ++n) engine->step(targets);
  }
  EXPECT_EQ(damaged->state_hash(0), plain->state_hash(0));
}

/// How far the engines' centres of mass are apart from ODE's after a quarter of a second, m.
double disagreement_m(const robot::RobotSpec& robot, const std::vector<damage::Part>& parts,
                      double swing_rad) {
  std::vector<Vec3> com_m;
  for (const char* name : {"ode", "batch", "mujoco"}) {
    const auto engine = make_damaged_engine(name, robot, {parts}, {});
    engine->place(0);
    LaneArray targets = targets_for(*engine);
    for (int n = 1; n <= 25; ++n) {
      for (int j = 0; j < targets.rows(); ++j)
        targets.at(j, 0) = static_cast<float>(swing_rad * std::sin(0.1 * n) * std::cos(j));
      engine->step(targets);
    }
    com_m.push_back(engine->com_m(0));
  }
  return std::max(norm(com_m[1] - com_m[0]), norm(com_m[2] - com_m[0]));
}

TEST(DamagedEngines, AgreeForAQuarterOfASecond) {
  const auto standing = quadruped(), falling = lifted(quadruped(), 5.0);
  const std::string knee = standing.joints[0].name, hip = standing.joints[1].name;
  for (const auto& parts : std::vector<std::vector<damage::Part>>{{},
                                                                  {missing("FL")},
                                                                  {missing("BR", 0.1)},
                                                                  {locked(hip, 0.3)},
                                                                  {locked(hip, 0.3, 0.1)},
                                                                  {slack(knee)},
                                                                  {weak(hip, 0.2, 0.1)},
                                                                  {payload(2.0, 0.1, 0.1, 0.1)},
                                                                  {payload(2.0, 0.1, 0.1, 0.1, 0.1)}}) {
    const std::string what =
        parts.empty() ? "none" : std::string(damage::kind_names[to_index(static_cast<int>(parts[0].kind))]);
    EXPECT_LT(disagreement_m(falling, parts, 0.2), 0.002) << what;
    EXPECT_LT(disagreement_m(standing, parts, 0.0), 0.005) << what;
  }
}

}  // namespace
}  // namespace amble::physics
