#pragma once

#include <mujoco/mujoco.h>

#include <vector>

#include "amble/morphology/model_file.hpp"
#include "amble/robot/spec.hpp"

namespace amble::physics::mujoco {

/// A robot as a MuJoCo model, and the indices of its parts in MuJoCo's arrays.
struct Model {
  morphology::ModelPointer mujoco;
  std::vector<int> position_of;  ///< by joint: index into qpos
  std::vector<int> dof_of;       ///< by joint: index into qvel
  std::vector<int> joint_of;     ///< by degree of freedom: joint, −1: the root's
  std::vector<int> leg_of;       ///< by MuJoCo's geom: the leg whose foot it is, −1: none

  std::vector<int> geom_of;  ///< by MuJoCo's geom: that of the robot, −1: the ground

  const mjModel* operator->() const { return mujoco.get(); }
  const mjModel* get() const { return mujoco.get(); }
};

/// Throws UserError for what MuJoCo refuses.
Model make_model(const robot::RobotSpec& robot, double timestep_s);

}  // namespace amble::physics::mujoco
