#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <thread>

#include "amble/damage/settings.hpp"
#include "amble/physics/damaged_engine.hpp"
#include "amble/physics/mujoco_model/mujoco_model_engine.hpp"
#include "tests/models/model_edits.hpp"
#include "tests/physics/own_models.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace mujoco_model_test {

using morphology::Files;
using morphology::with;
using testing::Contains;
using testing::HasSubstr;

constexpr const char* engine_name = "mujoco-model";

double wave(int tick, int joint, double amplitude_rad = 0.4) {
  return static_cast<double>(static_cast<float>(amplitude_rad * std::sin(0.08 * tick + 1.3 * joint)));
}

void set_targets(int tick, LaneArray& targets) {
  for (int j = 0; j < targets.rows(); ++j) targets.at(j, 0) = static_cast<float>(wave(tick, j));
}

/// Every number of the state, bit by bit.
testing::AssertionResult same_state(const Engine& engine, Simulate& own, const robot::RobotSpec& robot) {
  const MovingPose motion = engine.motion(0);
  const mjtNum* const q = own.data().qpos;
  const mjtNum* const v = own.data().qvel;
  const Vec3 at = motion.pose.root.position_m;
  const Quat turn = motion.pose.root.rotation;
  if (at.x != q[0] || at.y != q[1] || at.z != q[2] || turn.w != q[3] || turn.x != q[4] || turn.y != q[5] ||
      turn.z != q[6] || motion.velocity_m_s.x != v[0] || motion.velocity_m_s.y != v[1] ||
      motion.velocity_m_s.z != v[2])
    return testing::AssertionFailure() << "the root is at " << at.z << ", not " << q[2];
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (motion.pose.joint_angle_rad[j] != own.position(robot.joints[j].name) ||
        motion.joint_speed_rad_s[j] != own.speed(robot.joints[j].name))
      return testing::AssertionFailure()
             << robot.joints[j].name << " is at " << motion.pose.joint_angle_rad[j] << ", not "
             << own.position(robot.joints[j].name);
  return testing::AssertionSuccess();
}

struct OwnPhysics {
  const char* name;
  const char* before;
  double timestep_s;
};

class AsItsAuthorWroteIt : public testing::TestWithParam<OwnPhysics> {};
INSTANTIATE_TEST_SUITE_P(
    MujocoModel, AsItsAuthorWroteIt,
    testing::Values(
        OwnPhysics{"Plain", "", 0.002},
        OwnPhysics{"Pgs",
                   R"(<option timestep="0.0025" solver="PGS" iterations="40" cone="elliptic" impratio="5"/>)",
                   0.0025},
        OwnPhysics{"Implicit",
                   R"(<option timestep="0.005" integrator="implicit" solver="CG" noslip_iterations="3"/>)",
                   0.005},
        OwnPhysics{"RungeKutta", R"(<option timestep="0.01" integrator="RK4" density="1.2" wind="1 0 0"/>)",
                   0.01},
        OwnPhysics{"Defaults", R"(<default><geom margin="0.002" solref="0.01 0.7" friction="0.9 0.01 0.001"/>
          <joint solimplimit="0.8 0.9 0.01"/></default><option gravity="0 0 -3.7"><flag warmstart="disable"/></option>)",
                   0.002}),
    [](const auto& of) { return std::string(of.param.name); });

// mj_step of the same file with the same controls, over a thousand of MuJoCo's steps.
TEST_P(AsItsAuthorWroteIt, StatesAreThoseOfMujocoToTheBit) {
  const Files files;
  // MuJoCo itself wants to know whether ranges are limits.
  const std::string mjcf =
      own_model(position_actuators, std::string(R"(<compiler autolimits="true"/>)") + GetParam().before);
  const robot::RobotSpec robot = own_robot(files, mjcf);
  Bench bench(engine_name, robot);
  Simulate own(files.path("own.xml"), robot);
  ASSERT_EQ(own.model().opt.timestep, GetParam().timestep_s);
  const int steps = static_cast<int>(std::lround(0.01 / GetParam().timestep_s));
  int contacts = 0;
  for (int tick = 0; tick < 1000 / steps; ++tick) {
    set_targets(tick, bench.targets);
    bench.steps(1);
    for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j)
      own.control(robot.joints[static_cast<std::size_t>(j)].name) = wave(tick, j);
    for (int i = 0; i < steps; ++i) own.step();
    contacts += own.data().ncon;
    ASSERT_TRUE(same_state(*bench.engine, own, robot)) << "tick " << tick;
  }
  EXPECT_GT(contacts, 100);
  EXPECT_TRUE(bench.engine->healthy(0));
}

TEST(MujocoModel, DrivesMotorsByTheRobotFilesServoAtEachStep) {
  const Files files;
  const std::string mjcf =
      own_model(tests::motors(R"(motor gear="2.5" ctrlrange="-2 2")"), R"(<compiler autolimits="true"/>)");
  robot::RobotSpec robot = own_robot(files, mjcf);
  for (robot::Joint& joint : robot.joints) joint.servo = {robot::ServoMode::torque, 0.0, 4.0, 12.0, 0.1};
  Bench bench(engine_name, robot, 0.01, true);
  Simulate own(files.path("own.xml"), robot);
  for (int tick = 0; tick < 200; ++tick) {
    set_targets(tick, bench.targets);
    bench.steps(1);
    double mean_nm = 0.0;
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j < static_cast<int>(robot.joints.size()); ++j) {
        const std::string& name = robot.joints[static_cast<std::size_t>(j)].name;
        const double torque_nm =
            std::clamp(12.0 * (wave(tick, j) - own.position(name)) - 0.1 * own.speed(name), -4.0, 4.0);
        own.control(name) = torque_nm / 2.5;
        if (j == 0) mean_nm += torque_nm / 5.0;
      }
      own.step();
    }
    ASSERT_TRUE(same_state(*bench.engine, own, robot)) << "tick " << tick;
    EXPECT_NEAR((*bench.engine->motor_torque_nm()).at(0, 0), mean_nm, 1e-5);
  }
}

TEST(MujocoModel, DrivesJointsWithoutActuatorsByTheirServos) {
  const Files files;
  robot::RobotSpec robot = own_robot(files, own_model(""));
  EXPECT_THAT(original_model_notes(robot, 0.01), Contains(HasSubstr("joints without an actuator")));
  for (robot::Joint& joint : robot.joints) joint.servo = {robot::ServoMode::velocity, 9.0, 20.0, 0.0, 0.0};
  Bench bench(engine_name, robot);
  for (int j = 0; j < bench.targets.rows(); ++j) bench.targets.at(j, 0) = 0.2f;
  bench.steps(150);
  for (int j = 0; j < bench.targets.rows(); ++j) EXPECT_NEAR(bench.angle(j), 0.2, 0.05) << j;
}

TEST(MujocoModel, IsStableWithServosThatAreTooStiffForItsStep) {
  const Files files;
  robot::RobotSpec robot = own_robot(files, own_model(tests::motors("motor gear=\"1\"")));
  for (robot::Joint& joint : robot.joints) joint.servo = {robot::ServoMode::torque, 0.0, 1000.0, 1e5, 1e4};
  EXPECT_THAT(original_model_notes(robot, 0.01), Contains(HasSubstr("as stiff as steps of 0.002 s allow")));
  Bench bench(engine_name, robot);
  bench.steps(300);
  ASSERT_TRUE(bench.engine->healthy(0));
  EXPECT_LT(norm(bench.engine->momentum_kg_m_s(0)), 0.05);
  for (int j = 0; j < bench.targets.rows(); ++j) EXPECT_NEAR(bench.angle(j), 0.0, 0.05) << j;
}

TEST(MujocoModel, VelocityActuatorsGetTheServosSpeed) {
  const Files files;
  robot::RobotSpec robot = own_robot(files, own_model(tests::motors(R"(velocity kv="0.4")")));
  ASSERT_EQ(robot.joints[0].servo.mode, robot::ServoMode::velocity);
  Bench bench(engine_name, lifted(robot, 3.0));
  bench.targets.at(0, 0) = 0.4f;
  bench.steps(60);
  EXPECT_NEAR(bench.angle(0), 0.4, 0.1);
}

TEST(MujocoModel, PositionActuatorsOfAnyGainAndBiasAimAtTheTarget) {
  const Files files;
  for (const char* gains : {R"(gainprm="40" biasprm="0 -40 -1")", R"(gainprm="20" biasprm="3 -40 -1")"}) {
    const robot::RobotSpec robot = own_robot(
        files,
        own_model(tests::motors(fmt::format(R"(general gaintype="fixed" biastype="affine" {})", gains))));
    Bench bench(engine_name, lifted(robot, 3.0));
    for (int j = 0; j < bench.targets.rows(); ++j) bench.targets.at(j, 0) = j % 2 == 0 ? 0.4f : -0.2f;
    bench.steps(60);
    for (int j = 0; j < bench.targets.rows(); ++j)
      EXPECT_NEAR(bench.angle(j), j % 2 == 0 ? 0.4 : -0.2, 0.05) << gains << " " << j;
  }
}

TEST(MujocoModel, StartsInTheRobotsPoseWithAnglesFromThere) {
  const Files files;
  const std::string key =
      R"(<keyframe><key name="home" qpos="0 0 0.4 1 0 0 0 .5 -1 .5 -1 .5 -1 .5 -1" ctrl="0 0 0 0 0 0 0 0"/></keyframe>)";
  const robot::RobotSpec crouching =
      own_robot(files, with(own_model(position_actuators), "</mujoco>", key + "</mujoco>"));
  Bench bench(engine_name, crouching);
  EXPECT_EQ(bench.engine->root_pose(0).position_m.z, crouching.bodies[0].position_m.z);
  EXPECT_NEAR(bench.engine->com_m(0).z, Bench("ode", crouching).engine->com_m(0).z, 1e-9);
  for (int j = 0; j < bench.targets.rows(); ++j) EXPECT_EQ(bench.angle(j), 0.0);
  StartPose pose{{{0.3, 0.1, 1.0}, axis_angle({0.0, 0.0, 1.0}, 0.2)}, std::vector<double>(8, 0.1)};
  bench.engine->place_at(0, pose);
  EXPECT_EQ(bench.engine->root_pose(0).position_m.x, 0.3);
  EXPECT_NEAR(bench.angle(3), 0.1, 1e-7);
  EXPECT_NEAR(bench.engine->sensors().attitude_rad.at(2, 0), 0.2, 1e-6);
  const MovingPose motion{pose, {1.0, 0.0, 0.5}, {0.0, 0.2, 0.1}, std::vector<double>(8, 0.4)};
  bench.engine->place_moving(0, motion);
  EXPECT_NEAR(norm(bench.engine->motion(0).angular_velocity_rad_s - motion.angular_velocity_rad_s), 0.0,
              1e-12);
  EXPECT_EQ(bench.engine->motion(0).joint_speed_rad_s[2], 0.4);
}

TEST(MujocoModel, ReadsTouchesFallsAndPushes) {
  const Files files;
  const robot::RobotSpec robot = own_robot(files, own_model(position_actuators));
  Bench high(engine_name, lifted(robot, 0.5));
  EXPECT_FALSE(high.touches(0));
  high.steps(10);
  EXPECT_FALSE(high.touches(0));
  Bench standing(engine_name, robot);
  standing.steps(50);
  for (int leg = 0; leg < 4; ++leg) EXPECT_TRUE(standing.touches(leg)) << leg;
  EXPECT_GT(standing.engine->root_com_m(0).z, robot.fall_height_m);

  robot::RobotSpec floating = lifted(robot, 2.0);
  floating.gravity_m_s2 = {};
  Bench pushed(engine_name, floating);
  pushed.engine->push(0, {0.6, -0.2, 0.1});
  pushed.steps(1);
  EXPECT_NEAR(norm(pushed.engine->momentum_kg_m_s(0) - Vec3{0.6, -0.2, 0.1}), 0.0, 0.02);
  const Vec3 after = pushed.engine->momentum_kg_m_s(0);
  pushed.steps(5);
  EXPECT_NEAR(norm(pushed.engine->momentum_kg_m_s(0) - after), 0.0, 0.02) << "it acts for one tick";
}

TEST(MujocoModel, MakesStepsShorterThatDoNotDivideATick) {
  const Files files;
  const robot::RobotSpec robot =
      own_robot(files, own_model(position_actuators, R"(<option timestep="0.003"/>)"));
  EXPECT_THAT(
      original_model_notes(robot, 0.01),
      Contains("the model's timestep of 0.003 s does not divide a tick of 0.01 s: 4 steps of 0.0025 s"));
  const robot::RobotSpec finer =
      own_robot(files, own_model(position_actuators, R"(<option timestep="0.0025"/>)"));
  Bench one(engine_name, robot), other(engine_name, finer);
  for (int tick = 0; tick < 50; ++tick) {
    set_targets(tick, one.targets);
    set_targets(tick, other.targets);
    one.steps(1);
    other.steps(1);
  }
  EXPECT_EQ(one.engine->state_hash(0), other.engine->state_hash(0));
}

TEST(MujocoModel, OverUnevenGroundItsStepIsMujocosOwn) {
  const Files files;
  for (const char* option : {"", R"(<option integrator="implicit" cone="elliptic" solver="CG"/>)"}) {
    const robot::RobotSpec robot = lifted(own_robot(files, own_model(position_actuators, option)), 5.0);
    Bench plane(engine_name, robot), field(engine_name, robot);
    field.engine->set_ground(std::make_shared<const ground::Ground>(ground::HeightField(0.05), robot));
    field.engine->place(0);
    for (int tick = 0; tick < 90; ++tick) {
      set_targets(tick, plane.targets);
      set_targets(tick, field.targets);
      plane.steps(1);
      field.steps(1);
      ASSERT_EQ(plane.engine->state_hash(0), field.engine->state_hash(0)) << option << tick;
    }
  }
}

TEST(MujocoModel, StandsOnUnevenGroundThatIsFlatAsOnThePlane) {
  const Files files;
  for (const char* option : {"", R"(<option integrator="implicit" cone="elliptic"/>)"}) {
    const robot::RobotSpec robot = own_robot(files, own_model(position_actuators, option));
    Bench plane(engine_name, robot), field(engine_name, robot);
    field.engine->set_ground(std::make_shared<const ground::Ground>(ground::HeightField(0.05), robot));
    field.engine->place(0);
    plane.steps(100);
    field.steps(100);
    for (int leg = 0; leg < 4; ++leg) EXPECT_TRUE(field.touches(leg)) << option;
    EXPECT_NEAR(norm(plane.engine->com_m(0) - field.engine->com_m(0)), 0.0, 1e-3) << option;
    field.engine->set_ground(nullptr);
    field.engine->place(0);
    field.steps(100);
    EXPECT_EQ(plane.engine->state_hash(0), field.engine->state_hash(0)) << "back on the plane";
  }
}

TEST(MujocoModel, TakesTheGroundsFrictionAndSlope) {
  const Files files;
  robot::RobotSpec robot = own_robot(files, own_model(position_actuators));
  const auto slides_m = [&](double friction) {
    robot::RobotSpec tilted = robot;
    tilted.gravity_m_s2 = {2.5, 0.0, -9.5};
    const auto engine = make_engine(engine_name, tilted, {.ground_friction = friction});
    engine->place(0);
    LaneArray targets(8, 1);
    const double from_m = engine->com_m(0).x;
    for (int tick = 0; tick < 100; ++tick) engine->step(targets);
    return engine->com_m(0).x - from_m;
  };
  EXPECT_LT(slides_m(-1.0), 0.2) << "its own: 0.7";
  EXPECT_GT(slides_m(0.05), 0.5);
  EXPECT_LT(slides_m(std::numeric_limits<double>::infinity()), 0.2);
}

TEST(MujocoModel, DivergenceEndsATrial) {
  const Files files;
  const std::string mjcf = own_model(tests::motors(R"(position kp="1e9")"));
  Bench bench(engine_name, own_robot(files, mjcf));
  for (int j = 0; j < bench.targets.rows(); ++j) bench.targets.at(j, 0) = 0.5f;
  bench.steps(100);
  EXPECT_FALSE(bench.engine->healthy(0));
  bench.engine->place(0);
  EXPECT_TRUE(bench.engine->healthy(0));
}

TEST(MujocoModel, RepeatsWhateverRanBeforeAndBeside) {
  const Files files;
  const robot::RobotSpec robot = own_robot(files, own_model(position_actuators));
  const auto trial = [&](Engine& engine) {
    LaneArray targets(8, 1);
    engine.place(0);
    for (int tick = 0; tick < 100; ++tick) {
      set_targets(tick, targets);
      if (tick == 30) engine.push(0, {0.3, 0.2, 0.0});
      engine.step(targets);
    }
    return engine.state_hash(0);
  };
  const auto engine = make_engine(engine_name, robot, {});
  const std::uint64_t expected = trial(*engine);
  EXPECT_EQ(trial(*engine), expected);
  std::vector<std::uint64_t> found(4);
  std::vector<std::thread> threads;
  for (std::uint64_t& hash : found)
    threads.emplace_back([&] { hash = trial(*make_engine(engine_name, robot, {})); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(found, testing::Each(expected));
}

TEST(MujocoModel, SimulatesOrRefusesEditedModels) {
  const char* asked = std::getenv("AMBLE_MODEL_EDITS");
  const int edits = asked != nullptr ? std::atoi(asked) : 25;
  const Files files;
  int simulated = 0;
  for (const tests::SmallModel& small : tests::small_models())
    for (int seed = 0; seed < edits; ++seed) {
      morphology::XmlElement model = morphology::parse_xml(small.text, small.name);
      tests::ModelEditor editor(static_cast<std::uint64_t>(seed) + 1000);
      editor.edit(model);
      const auto file = files.write("m." + small.extension, morphology::write_xml(model).text);
      try {
        const auto guess = morphology::guess_robot(morphology::compile_model(file), file.filename(), true);
        Bench bench(engine_name, morphology::load_robot(files.write("m.toml", guess.toml)));
        for (int tick = 0; tick < 20; ++tick) {
          set_targets(tick, bench.targets);
          bench.steps(1);
        }
        ++simulated;
      } catch (const UserError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
    }
  EXPECT_GT(simulated, edits);
}

std::string refusal(const robot::RobotSpec& robot, const damage::Settings& damage = {}) {
  try {
    make_damaged_engine(engine_name, robot, damage, {});
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_input);
    return error.what();
  }
  return "accepted";
}

TEST(MujocoModel, RefusesWhatItCannotDo) {
  const Files files;
  EXPECT_EQ(
      refusal(quadruped()),
      "the engine mujoco-model: robot '" + quadruped().name +
          "' does not carry the MJCF it was made from; that takes an MJCF model (no URDF), keep_model = true "
          "in the robot file, and a run begun with it");
  const auto with_actuator = [&](const std::string& actuator) {
    return refusal(own_robot(files, own_model("<actuator>" + actuator + "</actuator>")));
  };
  EXPECT_EQ(with_actuator(R"(<muscle name="m" joint="FL_hip" lengthrange="0 1"/>)"),
            "the engine mujoco-model: robot 'own': actuator 'm' of joint 'FL_hip' is no motor with a "
            "constant gain");
  EXPECT_THAT(with_actuator(R"(<intvelocity joint="FL_hip" kp="5" actrange="-1 1"/>)"),
              HasSubstr("actuator of joint 'FL_hip' integrates its control"));
  const robot::RobotSpec robot =
      own_robot(files, own_model(position_actuators, R"(<option integrator="RK4"/>)"));
  EXPECT_THAT(refusal(robot, {{{.kind = damage::Kind::missing, .leg = "FL"}}}),
              HasSubstr("of damages it knows numb feet alone"));
  EXPECT_EQ(refusal(robot, {{{.kind = damage::Kind::numb, .leg = "FL"}}}), "accepted");
  const auto engine = make_engine(engine_name, robot, {});
  try {
    make_engine(engine_name, robot, {.uneven_ground = true});
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()),
              "the engine mujoco-model: the integrator of robot 'own', RK4, works on flat ground alone");
  }
  EXPECT_THROW(engine->set_ground(std::make_shared<const ground::Ground>(ground::HeightField(0.05), robot)),
               UserError);
}

}  // namespace mujoco_model_test
}  // namespace amble::physics
