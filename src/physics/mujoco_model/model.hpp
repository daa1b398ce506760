#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "amble/morphology/model_file.hpp"
#include "amble/physics/engine.hpp"
#include "amble/physics/mujoco_model/root.hpp"
#include "amble/robot/original_model.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::mujoco_model {

/// A robot's own MJCF, compiled, and where its parts are in MuJoCo's arrays.
struct Model {
  morphology::ModelPointer mujoco;
  std::vector<double> start;  ///< qpos of the start pose, with the root where the robot has it
  Root root = {};
  std::vector<int> position_of;  ///< by joint: index into qpos
  std::vector<int> dof_of;       ///< by joint: index into qvel
  std::vector<int> leg_of;       ///< by MuJoCo's geom: the leg whose foot it is of, −1: none
  std::vector<int> grounds;      ///< MuJoCo's geoms that are the plane z = 0
  int steps = 1;                 ///< of MuJoCo, from one tick to the next
  double own_timestep_s = 0.0;   ///< as the model has it; option.timestep may be a little shorter

  const mjModel* operator->() const { return mujoco.get(); }
  const mjModel* get() const { return mujoco.get(); }
  /// Whether a geom belongs to nothing that moves.
  bool stands(int geom) const { return mujoco->body_weldid[mujoco->geom_bodyid[geom]] == 0; }
};

/// The model, with gravity as the robot feels it and the friction of the ground, if that has one
/// (EngineSettings). A tick is a whole number of MuJoCo's steps: where the model's timestep does not divide
/// it, steps are made shorter. Throws UserError: a robot without such a model, one that was kept by another
/// program, a start pose in which the root's joints do not let it be.
Model make_model(const robot::RobotSpec& robot, const EngineSettings& settings);

}  // namespace amble::physics::mujoco_model
