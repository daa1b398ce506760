#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/robot/original_model.hpp"
#include "tests/physics/own_models.hpp"
#include "tests/physics/scene.hpp"

namespace amble::physics {
namespace {

using testing::HasSubstr;

constexpr const char* engine_name = "mujoco-model";

std::string task_file(const std::string& name, const std::string& ending) {
  return std::string(AMBLE_SOURCE_DIR "/robots/tasks/") + name + "/" + name + ending;
}

robot::RobotSpec task_robot(const std::string& name) {
  return morphology::load_robot(task_file(name, ".toml"));
}

/// A model of robots/tasks, and where the public one is after 500 of MuJoCo's steps: its qpos.
struct TaskModel {
  std::string name;
  std::vector<double> positions;
};

class TaskModels : public testing::TestWithParam<TaskModel> {};
// From gymnasium/envs/mujoco/assets/NAME.xml (github.com/Farama-Foundation/Gymnasium, commit 3f0476a8) in
// MuJoCo 2.2.2, with the controls of the test below.
INSTANTIATE_TEST_SUITE_P(
    MujocoModel, TaskModels,
    testing::Values(TaskModel{"ant",
                              {-1.2012677204977413, 1.4431586715422733, 0.49802739109422661,
                               0.46452645270492932, 0.058140626049121902, -0.035366160521128863,
                               0.88294058522076391, -0.26474721440749316, 1.0413025994815699,
                               -0.37134678129376186, -0.52631062342675949, -0.44824148696557975,
                               -0.51002174290106295, -0.080699291453680544, 0.7948903778344707}},
                    TaskModel{"half_cheetah",
                              {-1.0612313344846287, -0.05701936342329926, 0.078974896306664377,
                               0.036395857474368132, -0.11755758282526696, 0.15045878151082615,
                               -0.25830542756765268, -0.01410212499539619, 0.1539514219189011}},
                    TaskModel{"hopper",
                              {-0.36550276411593019, 0.26206315017704018, -3.0101309507058613,
                               -1.1990619586092788, -2.1393662027017215, 0.17504300562281877}},
                    TaskModel{"swimmer",
                              {0.00076008004385979926, -0.81567625509987851, 0.78900425389963946,
                               -1.7085725294896514, 1.3128449627272432}},
                    TaskModel{"walker2d",
                              {-0.2072897315234096, 0.22081357419856798, -2.5849898859314462,
                               -1.0994200459294661, -2.6093836638593197, 0.80671031926981518,
                               -1.173235679850015, -2.6261046633141905, 0.81653061376184133}}),
    [](const auto& of) { return of.param.name; });

TEST_P(TaskModels, StepAsThePublicFilesDo) {
  const auto& [name, positions] = GetParam();
  char problem[1000] = "";
  mjModel* const model =
      mj_loadXML(task_file(name, ".xml").c_str(), nullptr, problem, static_cast<int>(sizeof problem));
  ASSERT_NE(model, nullptr) << problem;
  mjData* const data = mj_makeData(model);
  for (int step = 0; step < 500; ++step) {
    for (int a = 0; a < model->nu; ++a) data->ctrl[a] = ((step / 5 * 7 + a * 3) % 13 - 6) / 8.0;
    mj_step(model, data);
  }
  ASSERT_EQ(model->nq, static_cast<int>(positions.size()));
  for (int i = 0; i < model->nq; ++i)
    EXPECT_NEAR(data->qpos[i], positions[static_cast<std::size_t>(i)], 1e-9) << i;
  mj_deleteData(data);
  mj_deleteModel(model);
}

// In amble's engine: targets become torques at the beginning of a tick, as Gymnasium's actions are controls.
TEST_P(TaskModels, AreDrivenByTorquesThatAreHeldForATick) {
  const std::string& name = GetParam().name;
  const robot::RobotSpec robot = task_robot(name);
  constexpr int steps = 5;
  char problem[1000] = "";
  mjModel* const model =
      mj_loadXML(task_file(name, ".xml").c_str(), nullptr, problem, static_cast<int>(sizeof problem));
  ASSERT_NE(model, nullptr) << problem;
  mjData* const own = mj_makeData(model);
  Bench bench(engine_name, robot, steps * model->opt.timestep, true);
  std::ranges::copy(robot.original->start, own->qpos);
  for (int tick = 0; tick < 60; ++tick) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const int number = robot.original->joints[j];
      const robot::Servo& servo = robot.joints[j].servo;
      const float target_rad = static_cast<float>(0.7 * std::sin(0.3 * tick + static_cast<double>(j)));
      bench.targets.at(static_cast<int>(j), 0) = target_rad;
      const double start_rad = robot.original->start[static_cast<std::size_t>(model->jnt_qposadr[number])];
      const double torque_nm = std::clamp(servo.kp_nm_per_rad * (static_cast<double>(target_rad) + start_rad -
                                                                 own->qpos[model->jnt_qposadr[number]]) -
                                              servo.kd_nm_s_per_rad * own->qvel[model->jnt_dofadr[number]],
                                          -servo.max_torque_nm, servo.max_torque_nm);
      for (int a = 0; a < model->nu; ++a)
        if (model->actuator_trnid[2 * a] == number) own->ctrl[a] = torque_nm / model->actuator_gear[6 * a];
    }
    bench.steps(1);
    for (int i = 0; i < steps; ++i) mj_step(model, own);
    const MovingPose motion = bench.engine->motion(0);
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const int number = robot.original->joints[j];
      const double start_rad = robot.original->start[static_cast<std::size_t>(model->jnt_qposadr[number])];
      ASSERT_NEAR(motion.pose.joint_angle_rad[j], own->qpos[model->jnt_qposadr[number]] - start_rad, 1e-9)
          << robot.joints[j].name << " in tick " << tick;
      const double torque_nm = own->qfrc_actuator[model->jnt_dofadr[number]];
      ASSERT_NEAR(static_cast<double>(bench.engine->motor_torque_nm()->at(static_cast<int>(j), 0)), torque_nm,
                  1e-4);
    }
    mj_kinematics(model, own);
    const Vec3 at = motion.pose.root.position_m;
    EXPECT_NEAR(at.x, own->xpos[3], 1e-9);
    EXPECT_NEAR(at.y, own->xpos[4], 1e-9);
    EXPECT_NEAR(at.z, own->xpos[5], 1e-9);
  }
  mj_deleteData(own);
  mj_deleteModel(model);
}

// A robot that is put down as it moved goes on as it did.
TEST_P(TaskModels, ArePlacedInMotionAsTheirRootsLetThem) {
  const robot::RobotSpec robot = task_robot(GetParam().name);
  Bench first(engine_name, robot, 0.02), second(engine_name, robot, 0.02);
  const auto drive = [](Bench& bench, int tick) {
    for (int j = 0; j < bench.targets.rows(); ++j)
      bench.targets.at(j, 0) = static_cast<float>(0.5 * std::sin(0.4 * tick + j));
    bench.steps(1);
  };
  for (int tick = 0; tick < 20; ++tick) drive(first, tick);
  second.engine->place_moving(0, first.engine->motion(0));
  for (int tick = 20; tick < 25; ++tick) {
    drive(first, tick);
    drive(second, tick);
  }
  const MovingPose a = first.engine->motion(0), b = second.engine->motion(0);
  EXPECT_NEAR(norm(a.pose.root.position_m - b.pose.root.position_m), 0.0, 1e-6);
  EXPECT_NEAR(norm(a.velocity_m_s - b.velocity_m_s), 0.0, 1e-4);
  EXPECT_NEAR(norm(a.angular_velocity_rad_s - b.angular_velocity_rad_s), 0.0, 1e-4);
  EXPECT_GT(norm(a.velocity_m_s) + norm(a.angular_velocity_rad_s), 1e-3) << "it moves";
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    EXPECT_NEAR(a.pose.joint_angle_rad[j], b.pose.joint_angle_rad[j], 1e-6);
}

// Raffin's program for Swimmer-v4 (gist.github.com/araffin/25159d668e9bad41bf31a595add22c27) from rest, on
// the public file: a return of 352.991.
TEST(TaskSwimmer, SwimsAsFarByPublishedOscillatorsAsThePublicFile) {
  const robot::RobotSpec robot = task_robot("swimmer");
  constexpr double tick_s = 0.04;
  Bench bench(engine_name, robot, tick_s, true);
  const double start_m = bench.engine->root_pose(0).position_m.x;
  double effort = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    for (int j = 0; j < 2; ++j)
      bench.targets.at(j, 0) =
          static_cast<float>(std::sin(2.0 * std::numbers::pi * (0.62 * tick * tick_s + 0.95 * j)));
    bench.steps(1);
    for (int j = 0; j < 2; ++j)
      effort += std::pow(static_cast<double>(bench.engine->motor_torque_nm()->at(j, 0)) / 150.0, 2);
  }
  const double moved_m = bench.engine->root_pose(0).position_m.x - start_m;
  EXPECT_NEAR(moved_m / tick_s - 1e-4 * effort, 352.991, 0.01);
}

TEST(TaskHalfCheetah, StartsTiltedAboutItsHingeAloneAndLiftedOnItsSlide) {
  const robot::RobotSpec robot = task_robot("half_cheetah");
  Bench bench(engine_name, robot, 0.05);
  const Quat roll = axis_angle({1.0, 0.0, 0.0}, 0.1), pitch = axis_angle({0.0, 1.0, 0.0}, 0.2);
  StartPose pose{.root = {{0.3, 0.5, 0.9}, roll * pitch}, .joint_angle_rad = {}};
  pose.joint_angle_rad.assign(robot.joints.size(), 0.0);
  bench.engine->place_at(0, pose);
  const RootPose root = bench.engine->root_pose(0);
  EXPECT_NEAR(root.position_m.x, 0.3, 1e-12);
  EXPECT_EQ(root.position_m.y, 0.0) << "no joint moves it there";
  EXPECT_NEAR(root.position_m.z, 0.9, 1e-12);
  EXPECT_NEAR(std::abs(root.rotation.y), std::sin(0.1), 1e-3);
  EXPECT_EQ(root.rotation.x, 0.0);
}

/// The message of a UserError.
std::string problem_of(const std::string& engine, const robot::RobotSpec& robot) {
  try {
    make_engine(engine, robot, {.timestep_s = 0.01});
  } catch (const UserError& error) {
    return error.what();
  }
  return "none";
}

TEST(HeldTorques, AreRefusedByEnginesOfAmblesOwnReading) {
  const robot::RobotSpec robot = task_robot("ant");
  for (const char* engine : {"batch", "ode", "mujoco"})
    EXPECT_THAT(
        problem_of(engine, robot),
        HasSubstr("joint 'front_left_ankle' holds its torque for a tick (servo.hold_torque in the robot "
                  "file), which only engines of the model itself do: expected engine = "
                  "\"mujoco-model\""));
  EXPECT_EQ(problem_of(engine_name, robot), "none");
}

TEST(BoundRoots, AreRefusedWhereTheirJointsDoNotLetThemStart) {
  robot::RobotSpec robot = task_robot("swimmer");
  robot.bodies[0].position_m.z += 0.1;
  EXPECT_THAT(problem_of(engine_name, robot), HasSubstr("its root is not free"));
  robot = task_robot("hopper");
  robot.bodies[0].position_m.z += 0.1;
  EXPECT_EQ(problem_of(engine_name, robot), "none");
  Bench bench(engine_name, robot, 0.008);
  EXPECT_NEAR(bench.engine->root_pose(0).position_m.z, 1.35, 1e-12);
}

}  // namespace
}  // namespace amble::physics
