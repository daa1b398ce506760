
#include "amble/morphology/mjcf_writer.hpp"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "amble/exporting/trace.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/physics/mujoco/model.hpp"
#include "tests/exporting/champions.hpp"
#include "tests/robot/legged.hpp"

namespace amble::morphology {
namespace {

struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// How far two arrays of MuJoCo's are apart, relative to their size.
double gap(const mjtNum* a, const mjtNum* b, int count) {
  double largest = 0.0;
  for (int i = 0; i < count; ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(1.0, std::abs(a[i])));
  return largest;
}

TEST(SimulationMjcf, HasTheSameRobotAsThePlainModel) {
  for (const robot::RobotSpec& robot :
       {tests::legged_robot(3), tests::with_held_joint(tests::legged_robot(2), 1, 0)}) {
    const auto plain = compile_mjcf(write_mjcf(robot).text, "plain");
    ModelFile file;
    file.model = compile_mjcf(simulation_mjcf(robot, 0.01), "simulation");
    const mjModel &a = *plain, &b = *file.model;
    ASSERT_EQ(a.nbody, b.nbody);
    ASSERT_EQ(a.njnt, b.njnt);
    ASSERT_EQ(a.ngeom, b.ngeom);
    EXPECT_EQ(gap(a.body_mass, b.body_mass, a.nbody), 0.0);
    EXPECT_EQ(gap(a.body_inertia, b.body_inertia, 3 * a.nbody), 0.0);
    EXPECT_EQ(gap(a.body_pos, b.body_pos, 3 * a.nbody), 0.0);
    EXPECT_EQ(gap(a.jnt_axis, b.jnt_axis, 3 * a.njnt), 0.0);
    EXPECT_EQ(gap(a.jnt_range, b.jnt_range, 2 * a.njnt), 0.0);
    EXPECT_EQ(gap(a.geom_size, b.geom_size, 3 * a.ngeom), 0.0);
    EXPECT_EQ(gap(a.geom_friction, b.geom_friction, 3 * a.ngeom), 0.0);
    // amble's own reader accepts it, and sees the robot in it.
    EXPECT_EQ(extract_parts(file).joints.size(), robot.joints.size());
    EXPECT_EQ(extract_parts(file, {.start_keyframe = "start"}).bodies.size(), robot.bodies.size());
  }
}

TEST(SimulationMjcf, HasTheContactsAndStopsOfTheMujocoEngine) {
  const robot::RobotSpec robot = tests::legged_robot(2);
  const auto written = compile_mjcf(simulation_mjcf(robot, 0.01), "simulation");
  const auto engine = physics::mujoco::make_model(robot, 0.01);
  const mjModel &a = *engine.mujoco, &b = *written;
  ASSERT_EQ(a.ngeom, b.ngeom);
  EXPECT_LE(gap(a.geom_solref + mjNREF, b.geom_solref + mjNREF, mjNREF * (a.ngeom - 1)), 1e-9);
  for (int g = 1; g < a.ngeom; ++g) EXPECT_NEAR(a.geom_solimp[mjNIMP * g], b.geom_solimp[mjNIMP * g], 1e-9);
  EXPECT_LE(gap(a.jnt_solref + mjNREF, b.jnt_solref + mjNREF, mjNREF * (a.njnt - 1)), 1e-9);
}

TEST(SimulationMjcf, HasTheServosAsActuatorsInControlOrder) {
  robot::RobotSpec robot = tests::legged_robot(1);
  robot.joints[1].servo = {
      .mode = robot::ServoMode::torque, .max_torque_nm = 7.0, .kp_nm_per_rad = 40.0, .kd_nm_s_per_rad = 0.5};
  const auto model = compile_mjcf(simulation_mjcf(robot, 0.01), "simulation");
  const mjModel& m = *model;
  ASSERT_EQ(m.nu, 6);
  EXPECT_DOUBLE_EQ(m.opt.timestep, 0.001);
  for (int j = 0; j < m.nu; ++j) {
    EXPECT_EQ(std::string(m.names + m.name_actuatoradr[j]), robot.joints[static_cast<std::size_t>(j)].name);
    EXPECT_EQ(std::string(m.names + m.name_jntadr[m.actuator_trnid[2 * j]]),
              robot.joints[static_cast<std::size_t>(j)].name);
  }
  EXPECT_DOUBLE_EQ(m.actuator_forcerange[2 * 1 + 1], 7.0);
  EXPECT_DOUBLE_EQ(m.actuator_gainprm[mjNGAIN * 1], 40.0);
  EXPECT_DOUBLE_EQ(m.actuator_biasprm[mjNBIAS * 1 + 2], -(0.5 + 40.0 * 0.01));
  EXPECT_DOUBLE_EQ(m.actuator_biasprm[mjNBIAS * 0 + 2],
                   -robot.joints[0].servo.max_torque_nm / motor_slip_rad_s);
  EXPECT_DOUBLE_EQ(m.numeric_data[0], 0.01);
  EXPECT_DOUBLE_EQ(m.key_qpos[2], 0.55);
}

TEST(SimulationMjcf, HasNoActuatorButTheSpringOfAJointWithoutAMotor) {
  const robot::RobotSpec robot = tests::with_passive_joint(tests::legged_robot(1));
  const auto model = compile_mjcf(simulation_mjcf(robot, 0.01), "simulation");
  const mjModel& m = *model;
  ASSERT_EQ(m.nu, 5);
  for (int a = 0; a < m.nu; ++a)
    EXPECT_NE(std::string(m.names + m.name_jntadr[m.actuator_trnid[2 * a]]), robot.joints.back().name);
  const int id = mj_name2id(model.get(), mjOBJ_JOINT, robot.joints.back().name.c_str());
  EXPECT_EQ(m.jnt_stiffness[id], 20.0);
  EXPECT_EQ(m.qpos_spring[m.jnt_qposadr[id]], 0.1);
}

/// Root-mean-square distance (rad) of the joints from those that the engine mujoco had under the same
/// targets.
double error_rad(const exporting::Trace& trace, const mjModel& model) {
  const std::unique_ptr<mjData, DeleteData> data(mj_makeData(&model));
  mj_resetDataKeyframe(&model, data.get(), 0);
  double sum = 0.0;
  int count = 0;
  for (std::size_t t = 0; t + 1 < trace.ticks.size(); ++t) {
    for (int j = 0; j < model.nu; ++j) data->ctrl[j] = trace.ticks[t].target_rad[static_cast<std::size_t>(j)];
    for (int step = 0; step < steps_per_tick; ++step) mj_step(&model, data.get());
    for (int j = 0; j < model.nu; ++j) {
      const int joint = model.actuator_trnid[2 * j];
      const double angle_rad = data->qpos[model.jnt_qposadr[joint]];
      const double gap_rad = angle_rad - trace.ticks[t + 1].angle_rad[static_cast<std::size_t>(j)];
      sum += gap_rad * gap_rad;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

struct Fidelity {
  robot::ServoMode mode;
  double height_m;  ///< of the start above its usual one
  double most_rad;
};

/// In the air the servos alone matter; on the ground feet come down and leave a little earlier or later.
TEST(SimulationMjcf, MovesAsTheMujocoEngineDoes) {
  using enum robot::ServoMode;
  const experiment::Champion champion = tests::evolve(tests::twenty_samples().front());
  const std::atomic<bool> stop{false};
  for (const Fidelity& fidelity :
       {Fidelity{velocity, 10.0, 0.02}, {torque, 10.0, 0.02}, {velocity, 0.0, 0.15}, {torque, 0.0, 0.15}}) {
    experiment::Problem problem = champion.problem;
    problem.engine = "mujoco";
    problem.trial.first_command = trial::FirstCommand::before_first_step;
    problem.robot.bodies[0].position_m.z += fidelity.height_m;
    for (robot::Joint& joint : problem.robot.joints)
      joint.servo = {
          .mode = fidelity.mode, .max_torque_nm = 8.0, .kp_nm_per_rad = 40.0, .kd_nm_s_per_rad = 1.0};
    const auto trace = exporting::record_trace(problem, champion.genome, 100, stop);
    const auto model = compile_mjcf(simulation_mjcf(problem.robot, 0.01), "simulation");
    EXPECT_LT(error_rad(trace, *model), fidelity.most_rad)
        << (fidelity.mode == velocity ? "velocity" : "torque") << fidelity.height_m;
  }
}

}  // namespace
}  // namespace amble::morphology
